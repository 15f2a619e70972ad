//! The settings of a run from event to event.

use gauss_runtime::integrate::Control;
use gauss_runtime::integrate::drive::tolerance::Tolerance;
use gauss_runtime::system::GaussSystem;

use crate::impact::Impact;

/// Events of a run unless it sets another limit.
const MOST_EVENTS: usize = 1_000_000;

/// The settings of a run but for its kernel, its method and its input.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    pub(crate) law: Impact,
    /// Whether impulses stop slips that have no motion (Painlevé).
    pub(crate) jams: bool,
    pub(crate) tolerance: Option<Tolerance>,
    /// The most events.
    pub(crate) limit: usize,
    /// The most steps.
    pub(crate) steps: Option<u64>,
    /// Every how many states between events are kept.
    pub(crate) every: u64,
}

impl Settings {
    /// Newton's law, and the tolerance of the steps.
    pub(crate) const fn new() -> Self {
        Self { law: Impact::Newton, jams: false, tolerance: None, limit: MOST_EVENTS, steps: None, every: 1 }
    }

    /// The speeds that count as rest: those of the run, or else the tolerance of its steps.
    pub(crate) fn tolerance<S: GaussSystem>(&self, control: &impl Control<S>) -> Tolerance {
        self.tolerance.or(control.tolerance()).unwrap_or(TOLERANCE)
    }
}

/// The tolerance of runs whose steps have none.
pub(crate) const TOLERANCE: Tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };
