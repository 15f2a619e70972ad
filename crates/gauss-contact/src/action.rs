//! Accelerations of a system whatever its contacts hold: for looks at inputs.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{Contact, ContactKind, ContactSystem};
use gauss_runtime::forces::Columns;

use crate::mode::InMode;

impl<K: ContactSystem> InMode<'_, K> {
    /// Accelerations without contact forces, with those that bounds of dry friction would make: what holds a system at
    /// rest hides both.
    pub(crate) fn action(&self, t: K::Scalar, q: &K::Configuration, z: &K::Speeds, input: &K::Input) -> K::Speeds {
        let mut action = self.kernel.acceleration(t, q, z, input);
        let is_dry = |contact: &&Contact| contact.kind == ContactKind::DryFriction;
        if !self.kernel.contacts().iter().any(|contact| is_dry(&contact)) {
            return action;
        }
        let (bounds, columns) = (self.kernel.friction(t, q, z, input), self.kernel.contact_response(t, q).columns);
        for row in self.kernel.contacts().iter().filter(is_dry).flat_map(|contact| contact.rows()) {
            if let Some(column) = columns.nth(row) {
                action = action.add_scaled(bounds.component(row), &column);
            }
        }
        action
    }
}
