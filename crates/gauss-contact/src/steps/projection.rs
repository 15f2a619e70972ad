//! The end of a step: closed gaps brought to zero, then their rates and the slips of what sticks.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::{ConstraintLevel, ProjectionError, ProjectionFailure};
use gauss_runtime::contact::{ContactSystem, Each, ImpulseResponse};
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::lockstep::{Lockstep, larger};
use crate::mode::{Mode, after_impulses};

use super::linear::{Place, factorise_symmetric, solve_symmetric, stride};

/// By what part of the diagonal a matrix is made regular where contacts depend on one another: corrections are
/// repeated.
const PULLS: [f64; 3] = [1e-10, 1e-8, 1e-6];
/// Corrections at most. With the matrix of half of the step each leaves a part of the order of the step.
const CORRECTIONS: usize = 12;

/// Memory for projections.
pub(crate) struct Projection<'m, K: ContactSystem> {
    matrix: &'m mut [K::Scalar],
    right: &'m mut [K::Scalar],
    solution: &'m mut [K::Scalar],
    rows: K::EachRow<Place>,
    /// Of the rows of factors.
    ends: K::EachRow<Place>,
    count: usize,
    pub(crate) lockstep: Lockstep,
    /// Contacts whose gaps were brought to zero.
    pub(crate) held: K::EachContact<bool>,
}

/// Places with closed gaps.
pub(crate) struct Closed<K: ContactSystem> {
    pub(crate) q: K::Configuration,
    pub(crate) gaps: K::Gaps,
    /// How far the lowest gap was below zero.
    pub(crate) penetration: K::Scalar,
    /// How far from zero those were that are closed, above it too.
    pub(crate) closure: K::Scalar,
}

impl<'m, T: Real, K: ContactSystem<Scalar = T>> Projection<'m, K> {
    /// How many rows there are.
    const ROWS: usize = K::ContactRows::DIM;
    /// How many numbers it needs.
    pub(crate) const MEMORY: usize = stride(Self::ROWS) * (Self::ROWS + 1) + Self::ROWS;

    pub(crate) fn new(memory: &'m mut [T]) -> Self {
        let (matrix, memory) = memory.split_at_mut(Self::ROWS * stride(Self::ROWS));
        let (solution, memory) = memory.split_at_mut(stride(Self::ROWS));
        let right = &mut memory[..Self::ROWS];
        let (rows, ends) = (Each::from_fn(|_| 0), Each::from_fn(|_| 0));
        Self {
            matrix,
            right,
            solution,
            rows,
            ends,
            count: 0,
            lockstep: Lockstep::default(),
            held: Each::from_fn(|_| false),
        }
    }

    /// Factors of D at some rows; whether there are any.
    fn factorise(&mut self, delassus: &K::Delassus, rows: impl Iterator<Item = usize>) -> bool {
        let mut count = 0;
        for row in rows {
            if self.lockstep.less(T::zero(), delassus[(row, row)]) {
                self.rows[count] = row as Place;
                count += 1;
            }
        }
        self.count = count;
        // Rounding may ask for more where masses are far apart.
        PULLS.into_iter().any(|pull| {
            let stride = stride(count);
            for i in 0..count {
                let row = &mut self.matrix[i * stride..(i + 1) * stride];
                for j in i..count {
                    // D is symmetric.
                    row[j] = delassus[(usize::from(self.rows[j]), usize::from(self.rows[i]))];
                }
                row[i] *= T::from_f64(1.0 + pull);
                row[..i].fill(T::zero());
                row[count..].fill(T::zero());
            }
            factorise_symmetric(&self.lockstep, self.matrix, &mut self.ends.as_mut()[..count], self.solution, 0.0)
        })
    }

    /// Speeds after impulses that take away rates.
    fn pushed(
        &mut self,
        kernel: &K,
        z: &K::Speeds,
        response: &ImpulseResponse<K>,
        rate: impl Fn(usize) -> T,
    ) -> K::Speeds {
        let n = self.count;
        (0..n).for_each(|k| self.right[k] = -rate(usize::from(self.rows[k])));
        solve_symmetric(self.matrix, &self.ends.as_ref()[..n], &self.right[..n], self.solution);
        let mut impulses = K::ContactRows::zero();
        (0..n).for_each(|k| impulses.set_component(usize::from(self.rows[k]), self.solution[k]));
        after_impulses(&self.lockstep, kernel, z, (&response.factors, &impulses))
    }

    /// Gaps of closed contacts brought to zero, and those that are negative, from places with their gaps. `magnitude`:
    /// how large numbers of the configuration are.
    pub(crate) fn close(
        &mut self,
        kernel: &K,
        (t, mut q, mut gaps): (T, K::Configuration, K::Gaps),
        (response, magnitude): (&ImpulseResponse<K>, T),
        closed: &[bool],
    ) -> Result<Closed<K>, ProjectionError> {
        let (zero, infinite) = (T::zero(), T::from_f64(f64::INFINITY));
        let each = || K::CONTACTS.iter().enumerate().filter(|(_, contact)| contact.has_gap());
        let smaller = |a: T, b: T| T::select_lt(b, a, b, a);
        let lowest = each().map(|(i, _)| gaps.component(i)).fold(zero, smaller);
        self.held = Each::from_fn(|_| false);
        let (mut left, mut size, mut closure, mut goes_on) = (infinite, zero, zero, T::one());
        for n in 0..CORRECTIONS {
            let mut grown = n == 0;
            for (i, _) in each() {
                let joins = !self.held[i] && (closed[i] || self.lockstep.less(gaps.component(i), zero));
                self.held[i] |= joins;
                grown |= joins;
            }
            let held = self.held;
            let gap = |i: usize| if held[i] { gaps.component(i) } else { zero };
            size = (0..K::CONTACTS.len()).map(|i| gap(i).abs()).fold(zero, larger);
            if n == 0 {
                closure = size;
            }
            // Below rounding, or where a correction no longer halves what is left, there is nothing to gain.
            goes_on = T::select_lt(T::from_f64(2.0 * f64::EPSILON) * magnitude, size, goes_on, zero);
            if !grown {
                goes_on = T::select_lt(size, T::from_f64(0.5) * left, goes_on, zero);
            }
            if !goes_on_somewhere(goes_on) {
                break;
            }
            left = size;
            let normals = each().filter(|(i, _)| held[*i]).map(|(_, contact)| contact.normal);
            if grown && !self.factorise(&response.delassus, normals) {
                break;
            }
            let of_row = |row: usize| each().find(|(_, contact)| contact.normal == row).map_or(zero, |(i, _)| gap(i));
            let still = K::Speeds::zero();
            let moved = self.pushed(kernel, &still, response, of_row);
            // ψ is affine in z: what an impulse adds to it is an increment of the configuration.
            let still = kernel.kinematics(t, &q, &still);
            let next = q.advance(&kernel.kinematics(t, &q, &moved).add_scaled(-T::one(), &still));
            q = if T::LANES == 1 {
                next
            } else {
                K::Configuration::from_components(&chosen(goes_on, &next.components(), &q.components()))
            };
            gaps = kernel.gaps(t, &q);
        }
        // Half of the digits: what is farther off was not on its way to zero.
        let allowed = T::from_f64(Real::sqrt(f64::EPSILON)) * larger(T::from_f64(1e-3), magnitude);
        if !self.lockstep.at_most(size, allowed) {
            return Err(ProjectionError::new(ConstraintLevel::Position, ProjectionFailure::NotConverged, value(size)));
        }
        Ok(Closed { q, gaps, penetration: -lowest, closure })
    }

    /// Rates of closed gaps, and slips of what sticks, brought to zero where they are more than rounding; with all
    /// rates there.
    pub(crate) fn stop(
        &mut self,
        kernel: &K,
        (t, q, mut z, mut rates): (T, &K::Configuration, K::Speeds, K::ContactRows),
        response: &ImpulseResponse<K>,
        (mode, rounding): (impl Fn(usize) -> Mode, T),
    ) -> (K::Speeds, K::ContactRows) {
        let rows = || {
            K::CONTACTS.iter().enumerate().flat_map(|(i, contact)| match mode(i) {
                Mode::Open => 0..0,
                Mode::Sticks => contact.rows(),
                Mode::Closed | Mode::Slides(_) => contact.normal..contact.tangent_rows().start,
            })
        };
        let (mut left, mut goes_on) = (T::from_f64(f64::INFINITY), T::one());
        for n in 0..CORRECTIONS {
            let size = rows().map(|row| rates.component(row).abs()).fold(T::zero(), larger);
            goes_on = T::select_lt(rounding, size, goes_on, T::zero());
            goes_on = T::select_lt(size, T::from_f64(0.5) * left, goes_on, T::zero());
            if !goes_on_somewhere(goes_on) {
                break;
            }
            left = size;
            if n == 0 && !self.factorise(&response.delassus, rows()) {
                break;
            }
            let next = self.pushed(kernel, &z, response, |row| rates.component(row));
            z = if T::LANES == 1 { next } else { chosen(goes_on, &next, &z) };
            rates = kernel.contact_rates(t, q, &z);
        }
        (z, rates)
    }
}

/// Whether there is a lane that is not done.
fn goes_on_somewhere<T: Real>(goes_on: T) -> bool {
    (0..T::LANES).any(|lane| goes_on.lane(lane) > 0.0)
}

/// The next value in the lanes that go on, in the others that before.
fn chosen<T: Real, V: VectorSpace<T>>(goes_on: T, next: &V, before: &V) -> V {
    let mut chosen = *before;
    for i in 0..V::DIM {
        chosen.set_component(i, T::select_lt(T::zero(), goes_on, next.component(i), before.component(i)));
    }
    chosen
}
