//! Open contacts of a step: which of them would close, and which would bounce.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactSystem};

use crate::law::carrier;

use super::bounds::gaps_of;
use super::stepper::ContactStepper;

impl<K: ContactSystem<Scalar = f64>, M: AsMut<[f64]>> ContactStepper<'_, K, M> {
    /// Whether a contact is open and passes on a part of an approach. What has no restitution may come to lie on zero
    /// and leave it by a rounding from step to step: its rates are those of what rests, so that this is no jump.
    pub(super) fn may_bounce(&self, i: usize) -> bool {
        self.kernel.contacts().get(i).is_some_and(Contact::has_gap)
            && !self.modes[i].is_closed()
            && self.kernel.restitution().component(i) > 0.0
    }

    /// Whether all contacts are open.
    pub(super) fn flies(&self) -> bool {
        let contacts = self.kernel.contacts();
        (0..contacts.len()).all(|i| contacts[carrier(contacts, i)].has_gap() && !self.modes[i].is_closed())
    }

    /// Whether a gap would not be open at the end of a step, given its mean rates.
    pub(super) fn comes_to_zero(&self, h: f64, mean: &K::ContactRows) -> bool {
        let stays_open =
            |(i, contact): (usize, &Contact)| self.gaps.component(i) + h * mean.component(contact.normal) > 0.0;
        !gaps_of(self.kernel).all(stays_open)
    }

    /// Whether a gap is below zero.
    pub(super) fn is_below_zero(kernel: &K, gaps: &K::Gaps) -> bool {
        !gaps_of(kernel).all(|(i, _)| gaps.component(i) >= 0.0)
    }
}
