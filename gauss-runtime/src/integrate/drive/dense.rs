//! Runs that can be asked at any time with the accuracy of their method.

use core::ops::Deref;

use crate::integrate::drive::control::Control;
use crate::integrate::drive::simulation::sample_of;
use crate::integrate::drive::trajectory::{Sample, Trajectory};
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::form::{Form, InputSource, Problem, State};
use crate::real::Real;
use crate::system::GaussSystem;

/// A trajectory together with what made it: see [`Simulation::run_dense`](crate::integrate::Simulation::run_dense). All that a [`Trajectory`]
/// does it does too; what differs is how [`at`](Self::at) finds a state between samples.
#[derive(Debug)]
pub struct Dense<'k, S: GaussSystem, F, I, C> {
    trajectory: Trajectory<S>,
    problem: Problem<'k, S, F, I>,
    control: C,
    /// Whether neighbouring samples are one step apart.
    every_step: bool,
}

impl<S: GaussSystem, F, I, C> Deref for Dense<'_, S, F, I, C> {
    type Target = Trajectory<S>;

    fn deref(&self) -> &Trajectory<S> {
        &self.trajectory
    }
}

impl<'k, S, F, I, C> Dense<'k, S, F, I, C>
where
    S: GaussSystem,
    F: Form<S>,
    I: InputSource<S>,
    C: Control<S>,
{
    pub(in crate::integrate) fn new(
        trajectory: Trajectory<S>,
        problem: Problem<'k, S, F, I>,
        control: C,
        every_step: bool,
    ) -> Self {
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
        let state_of = |sample: &Sample<S>| {
            let y = problem.form.variables(problem.system, sample.t, &sample.q, &sample.z);
            State { t: sample.t, q: sample.q, y }
        };
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
            return self.control.drive(problem, state, t, u64::MAX, nobody).map(|end| sample_of(problem, &end));
        }
        let reached = self.control.within(problem, &state, &problem.rates(&state), t - state.t);
        match reached {
            Ok(end) => Ok(sample_of(problem, &State { t, ..end })),
            Err(kind) => Err(IntegrationError::at(problem, &state, kind)),
        }
    }
}

#[cfg(test)]
#[path = "dense_tests.rs"]
mod tests;
