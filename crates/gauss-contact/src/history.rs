//! What happened at the contacts of a run.

use gauss_runtime::contact::ContactSystem;

use crate::residual::Residual;

/// A change of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// When.
    pub time: f64,
    /// The contact, by its place in [`ContactSystem::CONTACTS`].
    pub contact: usize,
    /// What happened.
    pub kind: EventKind,
}

impl ContactEvent {
    /// The name of the contact in the system of the run.
    #[must_use]
    pub fn name<K: ContactSystem>(&self) -> &'static str {
        K::CONTACTS[self.contact].name
    }
}

/// What happens to a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EventKind {
    /// Velocities jump.
    Impact(ImpactRecord),
    /// The gap closes without an impact, or after one without restitution.
    Closes,
    /// The gap closes for good: infinitely many impacts that were to come are left out.
    Rests {
        /// The rate of the gap that was taken away.
        speed: f64,
        /// How high the first flight would have been that was left out.
        height: f64,
        /// How long all of them would have taken.
        remaining: f64,
    },
    /// The gap opens.
    Leaves,
    /// The slip ends.
    Sticks,
    /// The slip begins, in this direction along the tangents and, with friction of drilling, of the spin.
    Slides([f64; 3]),
    /// The slip turns round at once.
    Reverses([f64; 3]),
}

/// An impact at one contact. Entries are along the normal, then along the tangents, and of the spin with friction of
/// drilling; of rolling resistance the first is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImpactRecord {
    /// Rates before.
    pub before: [f64; 4],
    /// Rates after.
    pub after: [f64; 4],
    /// The impulse.
    pub impulse: [f64; 4],
    /// The kinetic energy that it takes away: −Λ·(u⁺ + u⁻)/2, of which the sum over simultaneous ones is the loss.
    pub energy_lost: f64,
}

/// One solution of the laws: at an impact, or where modes are chosen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveRecord {
    /// When.
    pub time: f64,
    /// Whether velocities were solved for, at an impact; else accelerations.
    pub impact: bool,
    /// The contacts that took part, with their residuals.
    pub residuals: alloc::vec::Vec<(usize, Residual)>,
}
