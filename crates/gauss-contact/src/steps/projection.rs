//! The end of a step: closed gaps brought to zero, then their rates and the slips of what sticks.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::{ConstraintLevel, ProjectionError, ProjectionFailure};
use gauss_runtime::contact::{ContactSystem, Each, ImpulseResponse};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::dense::value;
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
    /// Contacts whose gaps were brought to zero.
    pub(crate) held: K::EachContact<bool>,
}

/// Places with closed gaps.
pub(crate) struct Closed<K: ContactSystem> {
    pub(crate) q: K::Configuration,
    pub(crate) gaps: K::Gaps,
    /// How far the lowest gap was below zero.
    pub(crate) penetration: f64,
    /// How far from zero those were that are closed, above it too.
    pub(crate) closure: f64,
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
        Self { matrix, right, solution, rows, ends, count: 0, held: Each::from_fn(|_| false) }
    }

    /// Factors of D at some rows; whether there are any.
    fn factorise(&mut self, delassus: &K::Delassus, rows: impl Iterator<Item = usize>) -> bool {
        let mut count = 0;
        for row in rows.filter(|&row| value(delassus[(row, row)]) > 0.0) {
            self.rows[count] = row as Place;
            count += 1;
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
            factorise_symmetric(self.matrix, &mut self.ends.as_mut()[..count], self.solution, 0.0)
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
        after_impulses(kernel, z, &response.factors, &impulses)
    }

    /// Gaps of closed contacts brought to zero, and those that are negative, from places with their gaps.
    pub(crate) fn close(
        &mut self,
        kernel: &K,
        (t, mut q, mut gaps): (T, K::Configuration, K::Gaps),
        response: &ImpulseResponse<K>,
        closed: &[bool],
    ) -> Result<Closed<K>, ProjectionError> {
        let magnitude = (0..TangentOf::<K>::DIM).map(|i| q.magnitude(i)).fold(0.0, f64::max);
        let each = || K::CONTACTS.iter().enumerate().filter(|(_, contact)| contact.has_gap());
        let lowest = each().map(|(i, _)| value(gaps.component(i))).fold(0.0, f64::min);
        self.held = Each::from_fn(|_| false);
        let (mut left, mut size, mut closure) = (f64::INFINITY, 0.0, 0.0);
        for n in 0..CORRECTIONS {
            let mut grown = n == 0;
            for (i, _) in each() {
                let joins = !self.held[i] && (closed[i] || value(gaps.component(i)) < 0.0);
                self.held[i] |= joins;
                grown |= joins;
            }
            let held = self.held;
            let gap = |i: usize| if held[i] { gaps.component(i) } else { T::zero() };
            size = (0..K::CONTACTS.len()).map(|i| value(gap(i)).abs()).fold(0.0, f64::max);
            if n == 0 {
                closure = size;
            }
            // Below rounding, or where a correction no longer halves what is left, there is nothing to gain.
            if size <= 2.0 * f64::EPSILON * magnitude || (!grown && size >= 0.5 * left) {
                break;
            }
            left = size;
            let normals = each().filter(|(i, _)| held[*i]).map(|(_, contact)| contact.normal);
            if grown && !self.factorise(&response.delassus, normals) {
                break;
            }
            let of_row =
                |row: usize| each().find(|(_, contact)| contact.normal == row).map_or(T::zero(), |(i, _)| gap(i));
            let zero = K::Speeds::zero();
            let moved = self.pushed(kernel, &zero, response, of_row);
            // ψ is affine in z: what an impulse adds to it is an increment of the configuration.
            let still = kernel.kinematics(t, &q, &zero);
            q = q.advance(&kernel.kinematics(t, &q, &moved).add_scaled(-T::one(), &still));
            gaps = kernel.gaps(t, &q);
        }
        // Half of the digits: what is farther off was not on its way to zero.
        if size.is_nan() || size > Real::sqrt(f64::EPSILON) * magnitude.max(1e-3) {
            return Err(ProjectionError::new(ConstraintLevel::Position, ProjectionFailure::NotConverged, size));
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
        (mode, rounding): (impl Fn(usize) -> Mode, f64),
    ) -> (K::Speeds, K::ContactRows) {
        let rows = || {
            K::CONTACTS.iter().enumerate().flat_map(|(i, contact)| match mode(i) {
                Mode::Open => 0..0,
                Mode::Sticks => contact.rows(),
                Mode::Closed | Mode::Slides(_) => contact.normal..contact.tangent_rows().start,
            })
        };
        let mut left = f64::INFINITY;
        for n in 0..CORRECTIONS {
            let size = rows().map(|row| value(rates.component(row)).abs()).fold(0.0, f64::max);
            if size <= rounding || size >= 0.5 * left {
                break;
            }
            left = size;
            if n == 0 && !self.factorise(&response.delassus, rows()) {
                break;
            }
            z = self.pushed(kernel, &z, response, |row| rates.component(row));
            rates = kernel.contact_rates(t, q, &z);
        }
        (z, rates)
    }
}
