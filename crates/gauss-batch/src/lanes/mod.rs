//! Lanes with steps of their own: many runs in lockstep, each as if it were alone.
//!
//! A step is made in all lanes at once, but its length, its error, and whether it stands are those of each lane; of
//! steps of one length, only how many are left. So every run takes the steps that it would take alone, and a lane is
//! handed to the next run as soon as one ends ([`Ensemble`](crate::Ensemble)). A common step, that of the most
//! demanding lane, would need none of this and takes more steps the more the runs differ.

mod adams;
mod adaptive;
mod ended;
mod fixed;
mod method;
pub(crate) mod run;
mod system;
mod taylor;

pub use ended::{Ended, EventState, RunError, RunOutcome};
pub use system::{BatchSystem, SingleConfiguration, SingleSpeeds};

use alloc::vec::Vec;

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::control::{Control, StepStatistics};
use gauss_runtime::integrate::drive::tolerance::worst_lane;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

/// A choice of steps that can be made for every lane by itself:
/// [`Adaptive`](gauss_runtime::integrate::Adaptive) by any method that estimates its error,
/// [`Taylor`](gauss_runtime::integrate::Taylor), [`Fixed`](gauss_runtime::integrate::Fixed) by any method,
/// [`Adams`](gauss_runtime::integrate::Adams), and what is chosen of these by name, a
/// [`MethodControl`](gauss_runtime::integrate::MethodControl). Its functions are for the runs of this crate, which
/// alone implements it.
pub trait LaneControl<S: BatchSystem>: Control<S> + Sealed {
    /// Memory of the lanes from step to step.
    #[doc(hidden)]
    type Memory;

    /// Whether it may turn out on the way that a run has no prospect of its end.
    #[doc(hidden)]
    fn paced(&self) -> bool {
        true
    }

    /// Before any lane is on its way.
    #[doc(hidden)]
    fn memory(&self, span: f64, limit: u64) -> Result<Self::Memory, IntegrationErrorKind>;

    /// A lane of the group has got a state to start from; it may make so many steps.
    #[doc(hidden)]
    fn begin<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &Group<S>,
        lane: (usize, u64),
        memory: &mut Self::Memory,
    ) -> Result<(), IntegrationErrorKind>;

    /// Tries a step in some lanes, and says what became of it in each of them.
    ///
    /// # Errors
    /// When it fails in any of them; then nothing has changed.
    #[doc(hidden)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        memory: &mut Self::Memory,
    ) -> Result<(), IntegrationErrorKind>;

    /// A step that failed in a lane that tried alone: what becomes of it.
    #[doc(hidden)]
    fn failed<P: Problem<System = S>>(
        &self,
        at: (&P, &Group<S>),
        lane: usize,
        kind: IntegrationErrorKind,
        memory: &mut Self::Memory,
    ) -> Verdict;

    /// The length of step that a lane is at.
    #[doc(hidden)]
    fn length(&self, lane: usize, memory: &Self::Memory) -> f64;

    /// Whether the method passes over what decays fast.
    #[doc(hidden)]
    fn passes_over_decay(&self) -> bool;
}

/// The bound that makes [`LaneControl`] a trait of this crate alone: its path is private.
pub trait Sealed {}

/// Outcome of a step in a lane.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub enum Verdict {
    /// It is to be tried again.
    Rejected,
    /// It stands; whether it was the last one.
    Taken(StepStatistics, bool),
    /// There will be no other.
    Stopped(StopReason),
}

/// Runs in lockstep, one in each lane, each from its own time to a common end. A lane without a run holds a valid state
/// and makes steps of length zero from it.
#[doc(hidden)]
pub struct Group<S: BatchSystem> {
    pub(crate) state: State<S>,
    pub(crate) rates: Rates<S>,
    pub(crate) verdicts: Vec<Verdict>,
    /// The end of all runs.
    pub(crate) end: S::Scalar,
    /// From their start to there.
    pub(crate) span: f64,
    /// Whether nobody looks at the states between the steps of one attempt.
    pub(crate) unseen: bool,
    /// Whether lanes that have runs are left out of an attempt.
    pub(crate) alone: bool,
    /// So many steps were made by one attempt in every lane that took them.
    pub(crate) steps: u64,
}

impl<S: BatchSystem> Group<S> {
    /// The time that is left to a lane.
    pub(crate) fn left(&self, lane: usize) -> f64 {
        number(self.end - self.state.t, lane).abs()
    }

    /// Steps of given lengths in some lanes: those lanes get the new state, with the derivatives there.
    #[inline(always)]
    fn take(&mut self, ones: S::Scalar, all: bool, (state, rates): (State<S>, Rates<S>)) {
        (self.state, self.rates) = if all {
            (state, rates)
        } else {
            (chosen_state(ones, &state, &self.state), chosen_rates(ones, &rates, &self.rates))
        };
    }
}

/// The number in a lane; the first one where lanes are packs themselves.
#[inline(always)]
pub(crate) fn number<T: Real + Packed<Single: Real>>(pack: T, lane: usize) -> f64 {
    pack.extract(lane).lane(0)
}

/// The largest number in a lane; NaN where one is.
#[inline(always)]
fn largest<T: Real + Packed<Single: Real>>(pack: T, lane: usize) -> f64 {
    worst_lane(pack.extract(lane))
}

/// The numbers that a lane is made of: one, but where lanes are packs themselves.
pub(crate) fn numbers_of<T: Real + Packed>(lane: usize) -> core::ops::Range<usize> {
    let each = T::LANES / T::WIDTH;
    lane * each..(lane + 1) * each
}

/// 1 in some lanes and 0 in others.
#[inline(always)]
pub(crate) fn ones_in<T: Real + Packed<Single: Real>>(lanes: impl Fn(usize) -> bool) -> T {
    let mut ones = T::zero();
    for lane in (0..T::WIDTH).filter(|&lane| lanes(lane)) {
        ones.replace(lane, &Real::one());
    }
    ones
}

/// The new vector in lanes where `ones` is 1, the old one elsewhere.
#[inline(always)]
pub(crate) fn chosen<T: Real, V: VectorSpace<T>>(ones: T, new: &V, old: &V) -> V {
    let mut chosen = *new;
    for i in 0..V::DIM {
        chosen.set_component(i, T::select_lt(T::zero(), ones, new.component(i), old.component(i)));
    }
    chosen
}

#[inline(always)]
pub(crate) fn chosen_state<S: BatchSystem>(ones: S::Scalar, new: &State<S>, old: &State<S>) -> State<S> {
    State {
        t: S::Scalar::select_lt(S::Scalar::zero(), ones, new.t, old.t),
        q: S::Configuration::from_components(&chosen(ones, &new.q.components(), &old.q.components())),
        y: chosen(ones, &new.y, &old.y),
    }
}

#[inline(always)]
pub(crate) fn chosen_rates<S: BatchSystem>(ones: S::Scalar, new: &Rates<S>, old: &Rates<S>) -> Rates<S> {
    Rates {
        configuration: chosen(ones, &new.configuration, &old.configuration),
        variables: chosen(ones, &new.variables, &old.variables),
    }
}
