//! Why an integration stopped.

use core::fmt;

#[cfg(feature = "alloc")]
use alloc::{boxed::Box, format};

use crate::constraint::{ConstraintLevel, ProjectionError};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::state::State;
use crate::real::Real;
use crate::system::GaussSystem;

/// An integration that cannot go on: when, in which state, and why. What was reached is kept: see
/// [`Simulation::attempt`](crate::integrate::Simulation::attempt), whose last sample is that state.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct IntegrationError {
    /// The last time that was reached with a good state.
    pub time: f64,
    /// What went wrong in the step from there.
    pub kind: IntegrationErrorKind,
    #[cfg(feature = "alloc")]
    state: Box<str>,
}

impl IntegrationError {
    /// The error of a run that was at `state` last.
    #[must_use]
    pub fn at<S: GaussSystem, P: Problem<System = S>>(
        problem: &P,
        state: &State<S>,
        kind: IntegrationErrorKind,
    ) -> Self {
        #[cfg(not(feature = "alloc"))]
        let _ = problem;
        Self {
            time: state.t.lane(0),
            kind,
            #[cfg(feature = "alloc")]
            state: {
                let z = problem.speeds(state.t, &state.q, &state.y);
                format!("q = {:?}, z = {z:?}", state.q).into_boxed_str()
            },
        }
    }

    /// The last good state (at the start: the one handed over), all digits of q and z in words. Empty without an allocator: the
    /// observer has seen it then.
    #[must_use]
    pub fn state(&self) -> &str {
        #[cfg(feature = "alloc")]
        let state = &self.state;
        #[cfg(not(feature = "alloc"))]
        let state = "";
        state
    }
}

/// What went wrong in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationErrorKind {
    /// A number became infinite or undefined.
    NonFinite {
        /// Where it was seen first.
        part: Part,
    },
    /// The step that the tolerance asks for no longer changes the time.
    StepTooSmall {
        /// The step.
        step: f64,
    },
    /// The limit of steps was reached before the end.
    TooManySteps {
        /// The limit.
        limit: u64,
    },
    /// The rotation in one step exceeds half a turn, beyond which its logarithm is not the shortest and the method's
    /// differential soon is singular.
    IncrementTooLarge {
        /// The angle, in radians.
        angle: f64,
    },
    /// The coordinates are singular here, or change sides of a singularity in the step: see
    /// [`GaussSystem::regularity`].
    SingularChart {
        /// The regularity at the end of the step.
        regularity: f64,
    },
    /// The equations of an implicit step are not solved by iteration: a shorter step may do.
    NotConverged {
        /// How many iterations were made.
        iterations: u32,
        /// How much the last one still changed, relative to the size of the state.
        residual: f64,
    },
    /// The state cannot be brought back onto the constraints.
    Projection {
        /// What the projection says.
        error: ProjectionError,
    },
    /// The initial state violates the constraints by more than the rounding of what was typed:
    /// [`GaussSystem::project`] makes it consistent.
    InconsistentStart {
        /// Whether the configuration is wrong, or the velocity only.
        level: ConstraintLevel,
        /// How far the nearest state is that satisfies them: the largest component of the increment.
        distance: f64,
    },
    /// A step that is zero or not finite was asked for.
    InvalidStep {
        /// The step.
        step: f64,
    },
    /// Tolerances must be finite, not negative, and not both zero.
    InvalidTolerance {
        /// The relative tolerance.
        relative: f64,
        /// The absolute tolerance.
        absolute: f64,
    },
    /// An end of the interval of time is not finite.
    InvalidInterval,
    /// A state was asked for at a time that the run does not cover.
    OutsideRun {
        /// The time.
        time: f64,
    },
}

/// Where a number that is not finite was seen first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Part {
    /// The initial configuration or velocity, or the momentum made of them.
    InitialState,
    /// The equations of motion at the last good state.
    Derivative,
    /// The state at the end of a step, or a stage on the way.
    Step,
    /// The function of an event, at the end of the next step or on the way.
    Event,
}

impl fmt::Display for IntegrationErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NonFinite { part } => {
                let whence = match part {
                    Part::Event => "the function of an event is",
                    Part::InitialState => "the initial state is",
                    Part::Derivative => "the equations of motion are",
                    Part::Step => "the next step is",
                };
                write!(f, "{whence} infinite or undefined; check parameters and inputs, and the chart's singularities")
            }
            Self::StepTooSmall { step } => write!(
                f,
                "the tolerance asks for a step of {step:e}, which no longer changes the time; \
                 the motion is singular here, or the tolerance below rounding"
            ),
            Self::TooManySteps { limit } => {
                write!(f, "{limit} steps did not reach the end; raise the limit or the tolerance")
            }
            Self::IncrementTooLarge { angle } => write!(
                f,
                "the body turns by {angle:.3} rad in one step, and at most π can be told from less; use a smaller step"
            ),
            Self::SingularChart { regularity } => write!(
                f,
                "the coordinates are singular here (regularity {regularity:e}); use another sequence of angles, or a chart \
                 without angles"
            ),
            Self::NotConverged { iterations, residual } => write!(
                f,
                "the implicit step is not solved after {iterations} iterations, of which the last changes it by {residual:e} \
                 (relative); use a smaller step"
            ),
            Self::Projection { error } => error.fmt(f),
            Self::InconsistentStart { level, distance } => write!(
                f,
                "the initial {level} violates the constraints, the nearest one that satisfies them is {distance:e} away; \
                 call `kernel.project(t, &q, &z)` first and start from what it returns"
            ),
            Self::InvalidStep { step } => write!(f, "a step of {step} was asked for; it must be finite and not zero"),
            Self::InvalidTolerance { relative, absolute } => write!(
                f,
                "tolerances {relative:e} (relative) and {absolute:e} (absolute) must be finite, not negative, not both 0"
            ),
            Self::OutsideRun { time } => write!(f, "the run does not cover t = {time}"),
            Self::InvalidInterval => f.write_str("the interval of time has an end that is not finite"),
        }
    }
}

impl fmt::Display for IntegrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "integration stopped at t = {}: {}", self.time, self.kind)?;
        if self.state().is_empty() { Ok(()) } else { write!(f, "; the last good state is {}", self.state()) }
    }
}

impl core::error::Error for IntegrationErrorKind {}

impl core::error::Error for IntegrationError {}
