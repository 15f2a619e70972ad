//! Runs that can be asked at any time with the accuracy of their method.

use core::ops::Deref;

use crate::integrate::drive::control::Control;
use crate::integrate::drive::trajectory::Trajectory;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Sample, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// A trajectory together with what made it: see [`Simulation::run_dense`](crate::integrate::Simulation::run_dense). All that a [`Trajectory`]
/// does it does too; what differs is how [`at`](Self::at) finds a state between samples.
#[derive(Debug)]
pub struct Dense<P: Problem, C> {
    trajectory: Trajectory<P::System>,
    problem: P,
    control: C,
    /// Whether neighbouring samples are one step apart.
    every_step: bool,
}

impl<P: Problem, C> Deref for Dense<P, C> {
    type Target = Trajectory<P::System>;

    fn deref(&self) -> &Trajectory<P::System> {
        &self.trajectory
    }
}

impl<S, P, C> Dense<P, C>
where
    S: GaussSystem,
    P: Problem<System = S>,
    C: Control<S>,
{
    pub(in crate::integrate) fn new(trajectory: Trajectory<S>, problem: P, control: C, every_step: bool) -> Self {
        Self { trajectory, problem, control, every_step }
    }

    /// The state at time `t`, which the method reaches from the last sample before it: by a shorter step, or where samples are
    /// several steps apart by a short run. So it has the error of the samples, whatever their distance, satisfies constraints
    /// as they do, and costs one step, where the interpolation of [`Trajectory::at`] costs no evaluation of the kernel.
    ///
    /// For packs of numbers the first lane of the times decides from which sample to start.
    ///
    /// # Errors
    /// [`IntegrationErrorKind::OutsideRun`] when the run does not cover `t`, else what the step says.
    pub fn at(&self, t: S::Scalar) -> Result<Sample<S>, IntegrationError> {
        let problem = &self.problem;
        let state_of = |sample: &Sample<S>| problem.state(sample.t, sample.q, &sample.z);
        let Some(after) = self.trajectory.knot_from(t) else {
            let kind = IntegrationErrorKind::OutsideRun { time: t.lane(0) };
            return Err(IntegrationError::at(problem, &state_of(self.trajectory.last()), kind));
        };
        let samples = (after.checked_sub(1).and_then(|before| self.trajectory.get(before)), self.trajectory.get(after));
        let from = match samples {
            (Some(before), Some(after)) if after.t != t => before,
            (_, after) => return Ok(*after.unwrap_or(self.trajectory.last())),
        };
        let state = state_of(from);
        if !self.every_step {
            let nobody = &mut |_: &State<S>, _: &_| core::ops::ControlFlow::Continue(());
            return self.control.drive(problem, state, t, u64::MAX, nobody).map(|end| problem.sample(&end));
        }
        let reached = self.control.within(problem, &state, &problem.rates(&state), t - state.t);
        match reached {
            Ok(end) => Ok(problem.sample(&State { t, ..end })),
            Err(kind) => Err(IntegrationError::at(problem, &state, kind)),
        }
    }
}

#[cfg(test)]
#[path = "dense_tests.rs"]
mod tests;
