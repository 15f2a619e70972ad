//! Bounds of how far closing gaps may move places.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::constraint::{ConstraintLevel, ProjectionError, ProjectionFailure};
use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::error::ContactErrorKind;
use crate::lockstep::{Lockstep, larger};

/// The factor by which points of contacts may move farther than the sum of what each gap would move them alone: two
/// planes that meet at an angle β move a point by 1/sin(β/2) of its depth, so that β is at least 14°.
const TOGETHER: f64 = 8.0;

/// The factor by which points may move farther where contacts are pulled shut by more than the step has done: not much.
const ALONE: f64 = 1.5;

/// Contacts whose gaps are to be zero at the end of a step, with what it did to them.
pub(super) struct Touched<'a, K: ContactSystem> {
    pub(super) closed: &'a [bool],
    pub(super) impulses: &'a K::ContactRows,
    /// Rates before the step.
    pub(super) rates: &'a K::ContactRows,
    pub(super) h: f64,
}

/// Why gaps are not closed, and at which contact.
pub(super) struct NotClosed {
    pub(super) contact: Option<usize>,
    pub(super) kind: ContactErrorKind,
}

/// The bounds of a projection.
pub(super) struct Bounds<'m, K: ContactSystem> {
    kernel: &'m K,
    /// The impulses of pulls, at most.
    pulls: K::Gaps,
    /// Half of the digits of places: what moves by less, or is open by less, is where it was.
    pub(super) near: K::Scalar,
    /// Rounding of places.
    pub(super) rounding: f64,
}

impl<'m, T: Real, K: ContactSystem<Scalar = T>> Bounds<'m, K> {
    pub(super) fn new(kernel: &'m K, touched: &Touched<'_, K>, delassus: &K::Delassus, magnitude: T) -> Self {
        let near = T::from_f64(Real::sqrt(f64::EPSILON)) * magnitude;
        let mut pulls = K::Gaps::zero();
        for (i, contact) in gaps_of(kernel).filter(|(i, _)| touched.closed[*i]) {
            let (row, least) = (contact.normal, T::from_f64(f64::MIN_POSITIVE));
            let positive = |x: T| larger(x, T::zero());
            let (impulse, rate) = (positive(touched.impulses.component(row)), positive(touched.rates.component(row)));
            let half = T::from_f64(0.5 * touched.h);
            pulls.set_component(i, half * impulse + (half * rate + near) / larger(delassus[(row, row)], least));
        }
        Self { kernel, pulls, near, rounding: f64::EPSILON * value(magnitude) }
    }

    /// The least impulse of a row, after those that were.
    pub(super) fn lowest(&self, i: usize, row: usize, done: &K::ContactRows) -> T {
        -self.pulls.component(i) - done.component(row)
    }

    /// Whether impulses pull a contact by more than its bound, and together move points farther than a gap asks for
    /// alone and than half of their digits.
    pub(super) fn pulls_too_much(
        &self,
        lockstep: &Lockstep,
        delassus: &K::Delassus,
        (done, moves): (&K::ContactRows, &K::ContactRows),
        gap: impl Fn(usize) -> T,
    ) -> bool {
        let beyond = |(i, contact): (usize, &Contact)| {
            let row = contact.normal;
            lockstep.less(moves.component(row), self.lowest(i, row, done).min(T::zero()))
        };
        if !gaps_of(self.kernel).any(beyond) {
            return false;
        }
        let asked = gaps_of(self.kernel).map(|(i, contact)| alone::<K>(delassus, gap(i).abs(), contact.normal));
        let asked = T::from_f64(ALONE) * asked.fold(T::zero(), larger);
        !lockstep.at_most(farthest(self.kernel, delassus, moves), larger(self.near, asked))
    }

    /// Refuses motions that are larger than what gaps ask for, each alone, and than pulls, which have their bounds.
    pub(super) fn moves_enough(
        &self,
        lockstep: &Lockstep,
        delassus: &K::Delassus,
        (done, entries): (&K::ContactRows, &K::Gaps),
    ) -> Result<(), NotClosed> {
        let (zero, moved) = (T::zero(), farthest(self.kernel, delassus, done));
        if lockstep.at_most(moved, self.near) {
            return Ok(());
        }
        let each = |(i, contact): (usize, &Contact)| {
            let (row, impulse) = (contact.normal, done.component(contact.normal));
            let pulled = -impulse * delassus[(row, row)];
            alone::<K>(delassus, T::select_lt(impulse, zero, pulled, entries.component(i)), row)
        };
        let sum = gaps_of(self.kernel).map(each).fold(zero, |sum, alone| sum + alone);
        let allowed = self.near + T::from_f64(TOGETHER) * sum;
        if lockstep.at_most(moved, allowed) {
            return Ok(());
        }
        let strength = |i: usize| {
            let row = self.kernel.contacts()[i].normal;
            value(done.component(row) * delassus[(row, row)])
        };
        let contact = gaps_of(self.kernel).map(|(i, _)| i).reduce(|a, b| if strength(b) > strength(a) { b } else { a });
        let gap = contact.map_or(0.0, |i| value(entries.component(i)));
        Err(NotClosed { contact, kind: ContactErrorKind::Displacement { gap, moved: value(moved) } })
    }
}

/// The largest distance by which a point moves where a gap is closed alone.
fn alone<K: ContactSystem>(delassus: &K::Delassus, gap: K::Scalar, row: usize) -> K::Scalar {
    let (zero, least) = (K::Scalar::zero(), K::Scalar::from_f64(f64::MIN_POSITIVE));
    let most = (0..K::ContactRows::DIM).map(|other| delassus[(other, row)].abs()).fold(zero, larger);
    gap * most / larger(delassus[(row, row)], least)
}

/// The largest distance by which impulses move a point of a contact.
fn farthest<K: ContactSystem>(kernel: &K, delassus: &K::Delassus, moves: &K::ContactRows) -> K::Scalar {
    let zero = K::Scalar::zero();
    let moved = |row: usize| gap_after(kernel, delassus, zero, row, moves).abs();
    (0..K::ContactRows::DIM).map(moved).fold(zero, larger)
}

/// A gap, or a place along a tangent, after impulses at all gaps.
pub(super) fn gap_after<K: ContactSystem>(
    kernel: &K,
    delassus: &K::Delassus,
    gap: K::Scalar,
    row: usize,
    moves: &K::ContactRows,
) -> K::Scalar {
    let each = gaps_of(kernel).map(|(_, contact)| contact.normal);
    each.fold(gap, |sum, column| sum + delassus[(row, column)] * moves.component(column))
}

/// The contacts that have gaps.
pub(super) fn gaps_of<K: ContactSystem>(kernel: &K) -> impl Iterator<Item = (usize, &'static Contact)> + use<K> {
    kernel.contacts().iter().enumerate().filter(|(_, contact)| contact.has_gap())
}

/// The contact whose gap has this row.
pub(super) fn contact_at<K: ContactSystem>(kernel: &K, row: usize) -> Option<usize> {
    gaps_of(kernel).find(|(_, contact)| contact.normal == row).map(|(i, _)| i)
}

/// Gaps that did not come to zero.
pub(super) fn not_closed(contact: Option<usize>, gap: f64) -> NotClosed {
    let cause = ProjectionError::new(ConstraintLevel::Position, ProjectionFailure::NotConverged, gap);
    NotClosed { contact, kind: ContactErrorKind::Projection(cause) }
}

/// The lowest gap that is below zero, or zero.
pub(super) fn lowest_of<K: ContactSystem>(kernel: &K, gaps: &K::Gaps) -> K::Scalar {
    let smaller = |a: K::Scalar, b: K::Scalar| K::Scalar::select_lt(b, a, b, a);
    gaps_of(kernel).map(|(i, _)| gaps.component(i)).fold(K::Scalar::zero(), smaller)
}
