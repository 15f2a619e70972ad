//! What an attempt at a step has come to.

use gauss_runtime::contact::ContactSystem;

use crate::mode::Mode;
use crate::residual::Residual;

use super::impulses::Found;
use super::projection::Factored;
use super::report::StepReport;
use super::watch::Attempted;

/// What impulses have made of the speeds of a step.
pub(super) struct Pushed<K: ContactSystem> {
    pub(super) z: K::Speeds,
    pub(super) impulses: K::ContactRows,
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    pub(super) solved: Solved<K>,
}

/// The end of a step.
pub(super) struct End<K: ContactSystem> {
    pub(super) q: K::Configuration,
    pub(super) z: K::Speeds,
    pub(super) gaps: K::Gaps,
    pub(super) rates: K::ContactRows,
    pub(super) impulses: K::ContactRows,
    /// What is closed and stays so.
    pub(super) rests: K::EachContact<bool>,
    /// Whether contacts may have changed their modes.
    pub(super) touches: bool,
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    pub(super) report: StepReport,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

impl<K: ContactSystem> End<K> {
    /// With what contacts did.
    pub(super) fn attempted<'a>(&'a self, modes: &'a [Mode]) -> Attempted<'a, K> {
        let Self { impulses, rests, dependent, struck, .. } = self;
        let modes = self.touches.then_some(modes);
        Attempted { impulses, modes, rests: rests.as_ref(), dependent: *dependent, struck: *struck }
    }
}

/// What the laws of a step came to.
pub(super) struct Solved<K: ContactSystem> {
    pub(super) found: Found,
    /// How far it is from Coulomb's law.
    pub(super) from_coulomb: Residual,
    /// Contacts that are closed after the step.
    pub(super) rests: K::EachContact<bool>,
    /// Whether velocities have jumped.
    pub(super) struck: bool,
    /// Gaps that have closed.
    pub(super) impacts: usize,
    /// Of the impulses.
    pub(super) work: f64,
    /// Factors of D that the laws were solved with.
    pub(super) factored: Option<Factored<K>>,
}
