//! Data of a contact that its law has before its force is known.

use gauss_runtime::contact::Contact;
use gauss_runtime::real::Real;

use crate::friction::Bounds;

/// Data of a contact that its law has before its force is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Law<T = f64> {
    /// Whether it is the law of a gap; else it is that of dry friction.
    pub(crate) has_normal: bool,
    /// The law, among those of the same problem, whose normal force bounds friction: of rolling resistance.
    pub(crate) on: Option<usize>,
    /// Rows of friction: 0 without, else 1 to 3.
    pub(crate) tangents: usize,
    /// μ, or f.
    pub(crate) friction: T,
    /// ŝ on the circle where it slides already.
    pub(crate) slip: Option<[T; 3]>,
    /// Bounds by which forces and slips are scaled to a circle.
    pub(crate) bounds: Bounds<T>,
}

impl<T: Real> Law<T> {
    /// `slip`: the direction in which it slides already.
    pub(crate) fn new(contact: &Contact, bounds: Bounds<T>, slip: Option<[T; 3]>) -> Self {
        Self {
            has_normal: contact.has_gap(),
            on: None,
            tangents: contact.friction_rows().len(),
            friction: bounds.largest,
            slip: slip.map(|along| bounds.on_circle(along)),
            bounds,
        }
    }

    /// Law of the friction of a contact alone, with bounds that are known.
    pub(crate) fn dry(contact: &Contact, bounds: Bounds<T>) -> Self {
        Self { has_normal: false, ..Self::new(contact, bounds, None) }
    }

    /// As a part of a problem of these contacts, in their order.
    pub(crate) fn among(self, contact: &Contact, contacts: &[usize]) -> Self {
        let place = |on: usize| contacts.iter().position(|&i| i == on);
        Self { on: contact.rolls_on().and_then(place), ..self }
    }

    /// The same law in other numbers.
    pub(crate) fn in_numbers<U>(&self, number: impl Fn(T) -> U) -> Law<U> {
        Law {
            has_normal: self.has_normal,
            on: self.on,
            tangents: self.tangents,
            friction: number(self.friction),
            slip: self.slip.map(|slip| slip.map(&number)),
            bounds: self.bounds.in_numbers(&number),
        }
    }

    /// The direction of slip where it slides already.
    pub(crate) fn along(&self) -> Option<[T; 3]> {
        self.slip.map(|direction| self.bounds.slip_of(direction))
    }

    pub(crate) fn rows(&self) -> usize {
        usize::from(self.has_normal) + self.tangents
    }
}

/// The contact that has the gap: of rolling resistance another one.
pub(crate) fn carrier(contacts: &[Contact], i: usize) -> usize {
    contacts[i].rolls_on().unwrap_or(i)
}

/// Factors of the rows of a contact by which forces on the circle become its own, and slips in reverse.
pub(crate) fn scales<T: Real>(law: &Law<T>) -> impl Iterator<Item = T> + use<T> {
    core::iter::repeat_n(T::one(), usize::from(law.has_normal)).chain(law.bounds.weights.into_iter().take(law.tangents))
}
