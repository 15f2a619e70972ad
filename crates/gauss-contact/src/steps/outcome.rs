//! Outcome of an attempt at a step.

use gauss_runtime::contact::{Contact, ContactSystem};

use crate::error::{ContactError, ContactErrorKind};
use crate::law::carrier;
use crate::mode::Mode;
use crate::residual::Residual;

use super::impulses::Found;
use super::relaxed::{StepLaw, lifts};
use super::report::StepReport;
use super::watch::Attempted;

/// Impulses of a step.
pub(super) struct Pushed<K: ContactSystem> {
    pub(super) impulses: K::ContactRows,
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    pub(super) solved: Solved<K>,
}

/// An attempt at a step, with the acceleration without contact forces that it took at half of the step.
pub(super) struct Attempt<K: ContactSystem> {
    pub(super) end: End<K>,
    pub(super) acceleration: K::Speeds,
}

/// The end of a step.
pub(super) struct End<K: ContactSystem> {
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
    pub(super) gaps: K::Gaps,
    pub(super) rates: K::ContactRows,
    pub(super) impulses: K::ContactRows,
    /// Contacts that are closed and stay so.
    pub(super) rests: K::EachContact<bool>,
    /// Contacts that acted and are open.
    pub(super) left: K::EachContact<bool>,
    /// Contacts that were open before it and may bounce.
    pub(super) opened: K::EachContact<bool>,
    /// Whether contacts may have changed their modes.
    pub(super) touches: bool,
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    pub(super) report: StepReport,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

impl<K: ContactSystem> End<K> {
    /// Whether no contact acts. Gaps of zero may be such by rounding alone, and be looked at or not: where they press
    /// nothing that is to be the same step.
    pub(super) fn flies(&self) -> bool {
        self.report.closed == 0
    }

    /// The attempt at this end, with the modes of the contacts.
    pub(super) fn attempted<'a>(&'a self, modes: &'a [Mode]) -> Attempted<'a, K> {
        let Self { impulses, rests, left, opened, dependent, struck, .. } = self;
        let modes = self.touches.then_some(modes);
        let (rests, left, opened) = (rests.as_ref(), left.as_ref(), opened.as_ref());
        Attempted { impulses, modes, rests, left, opened, dependent: *dependent, struck: *struck }
    }
}

/// Solution of the laws of a step.
pub(super) struct Solved<K: ContactSystem> {
    pub(super) found: Found,
    /// Distance of it from Coulomb's law.
    pub(super) from_coulomb: Residual,
    /// Contacts that are closed after the step.
    pub(super) rests: K::EachContact<bool>,
    /// Whether velocities have jumped.
    pub(super) struck: bool,
    /// Gaps that have closed.
    pub(super) impacts: usize,
    /// Work of the impulses.
    pub(super) work: f64,
}

impl<K: ContactSystem<Scalar = f64>> Solved<K> {
    /// Which contacts have struck and which rest, from those that rested before the step, the modes after it, and for
    /// each contact the rate that an impact passes on and whether its gap closes before the step. A gap that only comes
    /// to lie on zero, as those that press nothing do step by step, is no impact.
    pub(super) fn tell(
        &mut self,
        (contacts, law): (&[Contact], StepLaw),
        (rested, after): (&[bool], &[Mode]),
        of: impl Fn(usize) -> (f64, bool),
    ) {
        for i in 0..contacts.len() {
            let (was_open, is_closed) = (!rested[i], after[i].is_closed());
            let closes = is_closed && contacts[i].has_gap();
            let lifts = lifts(contacts, law, after, i);
            self.struck |= closes && (was_open || lifts);
            let carries = carrier(contacts, i);
            let (passed_on, approaches) = of(carries);
            let parts = contacts[carries].has_gap() && passed_on != 0.0;
            let bounces = passed_on.abs() > self.found.residual.rounding;
            self.impacts += usize::from(closes && (was_open && approaches || bounces));
            self.rests[i] = is_closed && !parts && !lifts;
        }
    }
}

/// Why a step is not made as a whole.
pub(super) enum Refused {
    /// An impact in it gains energy; the error where that is more than all that moves has.
    Gains(Option<ContactError>),
    Error(ContactError),
}

impl From<ContactError> for Refused {
    fn from(error: ContactError) -> Self {
        Self::Error(error)
    }
}

/// Whether a step is too long for its forces.
pub(super) fn is_stiff(error: &ContactError) -> bool {
    matches!(error.kind, ContactErrorKind::Stiff { .. })
}

/// Whether the laws, or places, of an attempt have no solution.
pub(super) fn has_no_end(error: &ContactError) -> bool {
    use ContactErrorKind::{Displacement, Projection, Unsolved};
    matches!(error.kind, Projection(_) | Displacement { .. } | Unsolved { .. })
}
