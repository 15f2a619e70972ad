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
    /// The cause of the failure in the step from there.
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

    /// The last good state (at the start: the one handed over), all digits of q and z in words. Empty without an
    /// allocator: the observer has seen it then.
    #[must_use]
    pub fn state(&self) -> &str {
        #[cfg(feature = "alloc")]
        let state = &self.state;
        #[cfg(not(feature = "alloc"))]
        let state = "";
        state
    }
}

/// The cause of a failed step or run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationErrorKind {
    /// A number became infinite or undefined, or so large that its square is infinite.
    NonFinite {
        /// The part of the step in which the number was seen first.
        part: RunPart,
    },
    /// Steps shrink until they no longer change the time, and neither the coordinates nor rounding are to blame: the
    /// motion itself is singular here, or a force jumps where there is no motion that agrees with it, as dry friction
    /// at rest.
    StepTooSmall {
        /// The step.
        step: f64,
    },
    /// Times so far from zero are further apart than the steps of the run.
    TimeTooCoarse {
        /// The step.
        step: f64,
        /// The time.
        time: f64,
    },
    /// The limit of steps was reached before the end, or the end is farther away than the limit allows.
    TooManySteps {
        /// The limit.
        limit: u64,
    },
    /// The limit of steps was reached before the end, and it was jumps at events that made so many.
    TooManyJumps {
        /// The event of the last jump, by its number.
        event: usize,
        /// Number of the jumps.
        jumps: u64,
        /// The time between the last two.
        interval: f64,
    },
    /// A part of the motion decays so much faster than the rest that an explicit method cannot make longer steps, or
    /// could not make the steps that it was given.
    Stiff {
        /// The rate of the decay, per unit of time.
        rate: f64,
        /// The length of steps.
        step: f64,
    },
    /// The motion has rates at which the end of the run is out of reach of the steps that follow it, or that steps are
    /// too long for.
    TooFast {
        /// The largest rate, per unit of time.
        rate: f64,
        /// The length of steps.
        step: f64,
    },
    /// Events at which the state jumps follow each other at once: the jump does not lead away from zero, or infinitely
    /// many of them pile up at this time, and the next flight is lower than rounding.
    Zeno {
        /// The number of the event.
        event: usize,
        /// The time from the last of them to the next.
        interval: f64,
    },
    /// The jump at an event changes the state and does not lead back: the function of the configuration goes on through
    /// zero, where it would never be seen again. See [`event`](crate::integrate::drive::event).
    NotTurnedBack {
        /// The number of the event.
        event: usize,
        /// The rate of its function before the jump, per unit of time in the direction of integration.
        before: f64,
        /// The rate after it.
        after: f64,
    },
    /// The numbers of the run carry derivatives, and the time of an event has none: its function touches zero or jumps
    /// over it, or the numbers are packs.
    NoDerivative {
        /// The number of the event.
        event: usize,
        /// The rate of its function there, per unit of time; NaN for packs of numbers.
        rate: f64,
    },
    /// The jump at an event sets another time, or speeds and momenta that disagree.
    InvalidJump {
        /// The number of the event.
        event: usize,
        /// Which of the two.
        mistake: JumpMistake,
    },
    /// A controller cannot sample.
    Sampling {
        /// The number of the controller, in the order in which they were added, from 0.
        controller: usize,
        /// Why it cannot.
        mistake: SamplingMistake,
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
        /// The regularity nearest to the singularity that was seen: 0 where the step passes over it.
        regularity: f64,
    },
    /// The equations of an implicit step are not solved by iteration: a shorter step may do.
    NotConverged {
        /// Number of the iterations that were made.
        iterations: u32,
        /// Change by the last iteration, relative to the size of the state.
        residual: f64,
    },
    /// The state cannot be brought back onto the constraints.
    Projection {
        /// The error of the projection.
        error: ProjectionError,
    },
    /// The projection onto the constraints would move the end of a step farther than its error can be, or what a jump
    /// sets farther than the jump goes: the constraints become dependent on one another here (a singular position of a
    /// mechanism), or the step is too long.
    ProjectionTooFar {
        /// Whether it moves the configuration so far, or the speeds (momenta in the momentum form).
        level: ConstraintLevel,
        /// Distance of the projection: a component of the increment.
        distance: f64,
        /// The largest distance that is allowed.
        allowed: f64,
    },
    /// The initial state violates the constraints by more than the rounding of its numbers:
    /// [`GaussSystem::project`] makes it consistent.
    InconsistentStart {
        /// Whether the configuration is wrong, or the velocity only.
        level: ConstraintLevel,
        /// Distance of the nearest state that satisfies them: the largest component of the increment.
        distance: f64,
    },
    /// The given step is zero or not finite.
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
    /// The scene has [contacts](GaussSystem::HAS_CONTACTS), whose forces this run or step does not have.
    Contacts,
    /// The run does not cover the time of the requested state.
    OutsideRun {
        /// The time.
        time: f64,
    },
}

/// A mistake in the state that a jump sets: see [`Simulation::then`](crate::integrate::Simulation::then).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum JumpMistake {
    /// The time.
    Time,
    /// Speeds and momenta that do not belong to each other.
    SpeedsAndMomenta,
}

/// A mistake in how a controller samples: see `Simulation::sampled`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SamplingMistake {
    /// The time between samples has to be finite and positive.
    Period(f64),
    /// The delay has to be finite and not negative.
    Delay(f64),
    /// The input that the controller gave is infinite or undefined.
    Input,
    /// The run goes backward in time.
    Backward,
    /// An input that was given after the controller has taken its place.
    Replaced,
}

impl fmt::Display for SamplingMistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Period(period) => write!(f, "samples every {period:e}; that must be finite and positive"),
            Self::Delay(delay) => write!(f, "acts after a delay of {delay:e}, which must be finite and not negative"),
            Self::Input => f.write_str("gave an input that is infinite or undefined"),
            Self::Backward => f.write_str("samples in the order of time, and the run goes backward"),
            Self::Replaced => f.write_str("has no effect: call `input` before `sampled`, and both add up"),
        }
    }
}

/// Part of a run where a number that is not finite was seen first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RunPart {
    /// The initial configuration or velocity, or the momentum made of them.
    InitialState,
    /// The equations of motion at the last good state.
    Derivative,
    /// The state at the end of a step, or a stage on the way.
    Step,
    /// The function of an event, at the end of the next step or on the way.
    Event,
    /// The state that an event's jump leads to.
    Jump,
}

impl RunPart {
    /// Describes the number that was found there, and the remedy.
    fn finding(self) -> &'static str {
        match self {
            Self::Event => "the function of an event is undefined; give it a value wherever the run may come",
            Self::Jump => "the state after the jump at an event is infinite or undefined; check what sets it",
            Self::InitialState => "the initial state is undefined, or so large that squares overflow",
            Self::Derivative => "the equations of motion are infinite or undefined here; check parameters and inputs",
            Self::Step => {
                "the next step is undefined, or so large that squares overflow; check parameters and inputs, and whether \
                 the motion itself runs away"
            }
        }
    }
}

impl IntegrationErrorKind {
    /// The message of those that constraints bring.
    fn of_constraints(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Projection { error } => fmt::Display::fmt(error, f),
            Self::ProjectionTooFar { level, distance, allowed } => write!(
                f,
                "the projection onto the constraints moves the {level} by {distance:.1e} after the next step or jump, and no more than \
                 {allowed:.1e} is due to it: the constraints become dependent on one another here (a singular position \
                 of a mechanism); leave out constraints that others imply, start elsewhere, or use a smaller step or tolerance"
            ),
            Self::InconsistentStart { level, distance } => write!(
                f,
                "the initial {level} violates the constraints, the nearest one that satisfies them is {distance:e} away; \
                 call `kernel.project(t, &q, &z)` first and start from what it returns"
            ),
            _ => Ok(()),
        }
    }

    /// Describes an error in the jump of an event.
    fn of_jump(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyJumps { event, jumps, interval } => write!(
                f,
                "after {jumps} jumps, of which the last of event {event} came {interval:.1e} after the one before, the steps that are \
                 allowed do not reach the end; allow more with `max_steps`, or end the run with `until` where jumps are so near"
            ),
            Self::Zeno { event, interval } => write!(
                f,
                "event {event} comes again after {interval:.1e}, and again: its jump does not lead away from zero, or \
                 infinitely many pile up here; end the run with `until` before, and go on with what is then at rest"
            ),
            Self::NotTurnedBack { event, before, after } => write!(
                f,
                "the jump of event {event} does not turn its function back, which goes on through zero at a rate of \
                 {after:.3e} after {before:.3e}; turn the velocity along the function (speeds of a body may be in its own \
                 axes), or use `then_through` where it is to pass"
            ),
            Self::NoDerivative { event, rate } if rate.is_nan() => write!(
                f,
                "the time of event {event} has derivatives, which packs of numbers do not share; run them one by one"
            ),
            Self::NoDerivative { event, rate } => write!(
                f,
                "the time of event {event} has no derivative: its function touches zero or jumps over it (rate \
                 {rate:.1e}); watch a function that passes through zero, or run with plain numbers"
            ),
            Self::InvalidJump { event, mistake: JumpMistake::Time } => {
                write!(f, "the jump of event {event} sets the time; it may set q, and z or p")
            }
            Self::InvalidJump { event, mistake: JumpMistake::SpeedsAndMomenta } => {
                write!(
                    f,
                    "the jump of event {event} sets speeds and momenta that disagree; set z or p, and the other follows"
                )
            }
            _ => Ok(()),
        }
    }

    /// Describes a setting that a run cannot have.
    fn of_request(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidStep { step } => write!(f, "the step is {step}; it must be finite and not zero"),
            Self::InvalidTolerance { relative, absolute } => write!(
                f,
                "tolerances {relative:e} (relative) and {absolute:e} (absolute) must be finite, not negative, not both 0"
            ),
            Self::OutsideRun { time } => write!(f, "the run does not cover t = {time}"),
            Self::InvalidInterval => f.write_str("the interval of time has an end that is not finite"),
            Self::Contacts => f.write_str(
                "the scene has contacts, and nothing here has their forces: choose `contact_events()` or \
                 `contact_steps(h)` of a `Simulation` (trait `WithContacts` of the crate `gauss-contact`), leave \
                 contacts out on purpose by `without_contacts()`, or take `InMode` for what holds in closed contacts",
            ),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for IntegrationErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NonFinite { part } => f.write_str(part.finding()),
            Self::StepTooSmall { step } => write!(
                f,
                "steps shrink to {step:.1e} and less: the motion is singular here, or a force jumps where nothing can move as it \
                 asks (dry friction at rest: use a smooth law)"
            ),
            Self::TimeTooCoarse { step, time } => write!(
                f,
                "steps of {step:.1e} do not tell times near {time:e} apart; count the time from another zero, or make longer \
                 steps"
            ),
            Self::TooManySteps { limit } => write!(
                f,
                "{limit} steps do not reach the end; use a larger tolerance or step, or allow more with `max_steps` (and keep \
                 fewer with `every`)"
            ),
            Self::Stiff { rate, step } => write!(
                f,
                "the scene is stiff: something decays at a rate of {rate:.1e} per unit of time, which steps of {step:.1e} of an \
                 explicit method cannot pass over; use `Rosenbrock` (with `#[gauss(linearize)]`), or leave out what decays"
            ),
            Self::TooFast { rate, step } => write!(
                f,
                "the motion has rates of {rate:.1e} per unit of time, for which steps of {step:.1e} are too long or too many; check \
                 units and parameters, shorten the run, or use a method that need not resolve them (`FreeFlow`, `Splitting`)"
            ),
            Self::TooManyJumps { .. }
            | Self::Zeno { .. }
            | Self::NotTurnedBack { .. }
            | Self::NoDerivative { .. }
            | Self::InvalidJump { .. } => self.of_jump(f),
            Self::Sampling { controller, mistake } => write!(f, "controller {controller} {mistake}"),
            Self::IncrementTooLarge { angle } => write!(
                f,
                "the body turns by {angle:.3} rad in one step, and at most π can be told from less; use a smaller step"
            ),
            Self::SingularChart { regularity } => write!(
                f,
                "the coordinates are singular here or within the next step (regularity {regularity:.1e}); use another sequence \
                 of angles, or a chart without singularities"
            ),
            Self::NotConverged { iterations, residual } => write!(
                f,
                "the implicit step is not solved after {iterations} iterations, of which the last changes it by {residual:e} \
                 (relative); use a smaller step"
            ),
            Self::Projection { .. } | Self::ProjectionTooFar { .. } | Self::InconsistentStart { .. } => {
                self.of_constraints(f)
            }
            Self::InvalidStep { .. }
            | Self::InvalidTolerance { .. }
            | Self::OutsideRun { .. }
            | Self::InvalidInterval
            | Self::Contacts => self.of_request(f),
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
