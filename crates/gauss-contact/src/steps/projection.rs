//! The end of a step: closed gaps brought to zero, then their rates and the slips of what sticks.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::constraint::{ConstraintLevel, ProjectionError, ProjectionFailure};
use gauss_runtime::contact::{ContactResponse, ContactSystem};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;

use crate::mode::{Mode, pushed};

use super::cones::{MOST, MOST_ROWS};
use super::linear::{Place, factorise, solve};

/// By what part of the diagonal a matrix is made regular where contacts depend on one another: corrections are
/// repeated.
const PULL: f64 = 1e-10;
/// Corrections at most. With the matrix of half of the step each leaves a part of the order of the step.
const CORRECTIONS: usize = 12;

/// Memory for projections.
pub(crate) struct Projection<'m> {
    matrix: &'m mut [f64],
    right: &'m mut [f64],
    solution: &'m mut [f64],
    /// The solution in all rows.
    all: &'m mut [f64],
    rows: [Place; MOST_ROWS],
    order: [Place; MOST_ROWS],
    count: usize,
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

impl<'m> Projection<'m> {
    /// How many numbers it needs for so many rows.
    pub(crate) const fn memory(rows: usize) -> usize {
        rows * rows + 3 * rows
    }

    pub(crate) fn new(memory: &'m mut [f64], rows: usize) -> Self {
        let (matrix, memory) = memory.split_at_mut(rows * rows);
        let (right, memory) = memory.split_at_mut(rows);
        let (solution, memory) = memory.split_at_mut(rows);
        let (rows, order) = ([0; MOST_ROWS], [0; MOST_ROWS]);
        Self { matrix, right, solution, all: memory, rows, order, count: 0 }
    }

    /// Factors of D at some rows.
    fn factorise<K: ContactSystem<Scalar = f64>>(&mut self, delassus: &K::Delassus, rows: impl Iterator<Item = usize>) {
        let mut count = 0;
        for row in rows.filter(|&row| delassus[(row, row)] > 0.0) {
            self.rows[count] = row as Place;
            count += 1;
        }
        self.count = count;
        for i in 0..count {
            for j in 0..count {
                let entry = delassus[(usize::from(self.rows[i]), usize::from(self.rows[j]))];
                self.matrix[i * count + j] = if i == j { entry * (1.0 + PULL) } else { entry };
            }
        }
        factorise(&mut self.matrix[..count * count], &mut self.order[..count], 0.0);
    }

    /// Impulses that take away rates, in all rows.
    fn cancelling(&mut self, rate: impl Fn(usize) -> f64) -> &[f64] {
        let n = self.count;
        (0..n).for_each(|k| self.right[k] = -rate(usize::from(self.rows[k])));
        solve(&self.matrix[..n * n], &self.order[..n], &self.right[..n], &mut self.solution[..n]);
        self.all.fill(0.0);
        (0..n).for_each(|k| self.all[usize::from(self.rows[k])] = self.solution[k]);
        self.all
    }

    /// Gaps of closed contacts brought to zero, and those that are negative, from places with their gaps.
    pub(crate) fn close<K: ContactSystem<Scalar = f64>>(
        &mut self,
        kernel: &K,
        (t, mut q, mut gaps): (f64, K::Configuration, K::Gaps),
        response: &ContactResponse<K>,
        closed: &[bool; MOST],
    ) -> Result<Closed<K>, ProjectionError> {
        let magnitude = (0..TangentOf::<K>::DIM).map(|i| q.magnitude(i)).fold(0.0, f64::max);
        let each = || K::CONTACTS.iter().enumerate().filter(|(_, contact)| contact.has_gap());
        let lowest = each().map(|(i, _)| gaps.component(i)).fold(0.0, f64::min);
        let mut held = [false; MOST];
        let (mut left, mut size, mut closure) = (f64::INFINITY, 0.0, 0.0);
        for n in 0..CORRECTIONS {
            let mut grown = n == 0;
            for (i, _) in each() {
                let joins = !held[i] && (closed[i] || gaps.component(i) < 0.0);
                held[i] |= joins;
                grown |= joins;
            }
            let gap = |i: usize| if held[i] { gaps.component(i) } else { 0.0 };
            size = (0..K::CONTACTS.len()).map(|i| gap(i).abs()).fold(0.0, f64::max);
            if n == 0 {
                closure = size;
            }
            // Below rounding, or where a correction no longer halves what is left, there is nothing to gain.
            if size <= 2.0 * f64::EPSILON * magnitude || (!grown && size >= 0.5 * left) {
                break;
            }
            left = size;
            if grown {
                self.factorise::<K>(
                    &response.delassus,
                    each().filter(|(i, _)| held[*i]).map(|(_, contact)| contact.normal),
                );
            }
            let of_row = |row: usize| each().find(|(_, contact)| contact.normal == row).map_or(0.0, |(i, _)| gap(i));
            let impulses = self.cancelling(of_row);
            let zero = K::Speeds::zero();
            let moved = pushed::<K>(&zero, &response.columns, impulses);
            // ψ is affine in z: what an impulse adds to it is an increment of the configuration.
            let still = kernel.kinematics(t, &q, &zero);
            q = q.advance(&kernel.kinematics(t, &q, &moved).add_scaled(-1.0, &still));
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
    pub(crate) fn stop<K: ContactSystem<Scalar = f64>>(
        &mut self,
        kernel: &K,
        (t, q, mut z, mut rates): (f64, &K::Configuration, K::Speeds, K::ContactRows),
        response: &ContactResponse<K>,
        (mode, rounding): (&dyn Fn(usize) -> Mode, f64),
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
            let size = rows().map(|row| rates.component(row).abs()).fold(0.0, f64::max);
            if size <= rounding || size >= 0.5 * left {
                break;
            }
            left = size;
            if n == 0 {
                self.factorise::<K>(&response.delassus, rows());
            }
            z = pushed::<K>(&z, &response.columns, self.cancelling(|row| rates.component(row)));
            rates = kernel.contact_rates(t, q, &z);
        }
        (z, rates)
    }
}
