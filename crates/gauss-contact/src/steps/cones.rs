//! The laws of a step by rows: which rows are normals, and which together are friction of what size.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each};
use gauss_runtime::real::Real;

use crate::error::ContactErrorKind;
use crate::friction::invalid;
use crate::lockstep::larger;

/// The normal of a gap, or friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone<T = f64> {
    /// The row of the normal, if there is a gap.
    pub(crate) normal: Option<usize>,
    /// The row of the normal whose impulse bounds friction: its own, or of rolling resistance that of another contact.
    pub(crate) pressed: Option<usize>,
    /// Rows of friction: from, and how many.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// μ, or of dry friction the bound of its impulse; the largest of its rows.
    pub(crate) friction: T,
    /// Whether its laws hold in this step.
    pub(crate) acts: bool,
}

impl<T: Real> Cone<T> {
    pub(crate) fn tangents(&self) -> core::ops::Range<usize> {
        self.first..self.first + self.count
    }

    /// All its rows.
    pub(crate) fn rows(&self) -> core::ops::Range<usize> {
        self.normal.unwrap_or(self.first)..self.first + self.count
    }

    /// The largest friction under impulses.
    pub(crate) fn radius(&self, impulses: &[T]) -> T {
        self.friction * self.pressed.map_or(T::one(), |row| larger(impulses[row], T::zero()))
    }
}

/// The contacts of a system in a step.
pub(crate) struct Laws<K: ContactSystem> {
    pub(crate) cones: K::EachContact<Cone<K::Scalar>>,
    /// Factors by which forces on circles become those of rows, and slips in reverse: 1 but for friction that differs
    /// by direction.
    pub(crate) scales: K::EachRow<K::Scalar>,
}

impl<T: Real, K: ContactSystem<Scalar = T>> Laws<K> {
    /// Cones that do not act yet, of friction in all rows. An error is the contact whose friction is no bound, with it.
    pub(crate) fn new(kernel: &K, h: f64, friction: &K::ContactRows) -> Result<Self, (usize, ContactErrorKind)> {
        let none = Cone { normal: None, pressed: None, first: 0, count: 0, friction: T::zero(), acts: false };
        let mut laws = Self { cones: Each::from_fn(|_| none), scales: Each::from_fn(|_| T::one()) };
        for (i, contact) in kernel.contacts().iter().enumerate() {
            if let Some(friction) = invalid(contact, friction) {
                return Err((i, ContactErrorKind::InvalidFriction { friction }));
            }
            let rows = contact.friction_rows();
            let largest = rows.clone().map(|row| friction.component(row)).fold(T::zero(), larger);
            let normal = contact.has_gap().then_some(contact.normal);
            let pressed = contact.rolls_on().map(|on| kernel.contacts()[on].normal).or(normal);
            // 1 where there is none.
            let scale = |row: usize| T::select_lt(T::zero(), largest, friction.component(row) / largest, T::one());
            rows.clone().for_each(|row| laws.scales[row] = scale(row));
            // A force that is bounded by f has an impulse of h f.
            let friction = if pressed.is_some() { largest } else { T::from_f64(h) * largest };
            laws.cones[i] = Cone { normal, pressed, first: rows.start, count: rows.len(), friction, acts: false };
        }
        Ok(laws)
    }
}
