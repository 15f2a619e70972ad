//! What is known of a contact before its force is.

use gauss_runtime::contact::Contact;
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::friction::Bounds;

/// What is known of a contact before its force is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Law<T = f64> {
    /// Of a gap; else of dry friction.
    pub(crate) has_normal: bool,
    /// 0 without friction, else 1 or 2.
    pub(crate) tangents: usize,
    /// μ, or f.
    pub(crate) friction: T,
    /// ŝ on the circle where it slides already.
    pub(crate) slip: Option<[T; 2]>,
    /// By which forces and slips are scaled to a circle.
    pub(crate) bounds: Bounds<T>,
}

impl<T: Real> Law<T> {
    /// `slip`: the direction in which it slides already.
    pub(crate) fn new(contact: &Contact, bounds: Bounds<T>, slip: Option<[T; 2]>) -> Self {
        Self {
            has_normal: contact.has_gap(),
            tangents: contact.tangents,
            friction: bounds.largest,
            slip: slip.map(|along| bounds.on_circle(along)),
            bounds,
        }
    }

    /// The values.
    pub(crate) fn values(&self) -> Law {
        Law {
            has_normal: self.has_normal,
            tangents: self.tangents,
            friction: value(self.friction),
            slip: self.slip.map(|slip| slip.map(value)),
            bounds: self.bounds.values(),
        }
    }

    /// The direction of slip where it slides already.
    pub(crate) fn along(&self) -> Option<[T; 2]> {
        self.slip.map(|direction| self.bounds.slip_of(direction))
    }

    pub(crate) fn rows(&self) -> usize {
        usize::from(self.has_normal) + self.tangents
    }
}

/// By what forces of the rows of a contact are those of the circle, and slips in reverse.
pub(crate) fn scales<T: Real>(law: &Law<T>) -> impl Iterator<Item = T> + use<T> {
    core::iter::repeat_n(T::one(), usize::from(law.has_normal)).chain(law.bounds.weights.into_iter().take(law.tangents))
}
