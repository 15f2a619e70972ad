//! The state of a stepper before a step, to go back to.

use gauss_runtime::contact::ContactSystem;

use crate::mode::Mode;

use super::account::Account;
use super::report::StepReport;
use super::stiffness::LastForces;

/// All of a stepper that a step changes, but memory.
pub(super) struct Kept<K: ContactSystem<Scalar = f64>> {
    pub(super) t: f64,
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
    pub(super) gaps: K::Gaps,
    pub(super) rates: K::ContactRows,
    pub(super) impulses: K::ContactRows,
    pub(super) last: LastForces<K::Speeds>,
    pub(super) account: Option<Account>,
    pub(super) dependent: bool,
    pub(super) modes: K::EachContact<Mode>,
    pub(super) rests: K::EachContact<bool>,
    pub(super) report: StepReport,
}

impl<K: ContactSystem<Scalar = f64>> Kept<K> {
    /// Mode of a contact: of one that an impact parts it is open.
    pub(super) fn mode(&self, i: usize) -> Mode {
        if self.rests[i] { self.modes[i] } else { Mode::Open }
    }

    /// Whether a contact does something else at another time.
    pub(super) fn differs(&self, other: &Self, contacts: usize) -> bool {
        (0..contacts).any(|i| match (self.mode(i), other.mode(i)) {
            (Mode::Slides(before), Mode::Slides(after)) => {
                before.iter().zip(&after).map(|(a, b)| a * b).sum::<f64>() <= 0.0
            }
            (before, after) => before != after,
        })
    }
}
