//! Why a run with contacts cannot go on.

use core::fmt;

use gauss_runtime::constraint::ProjectionError;
use gauss_runtime::integrate::{IntegrationError, IntegrationErrorKind};

use crate::impact::Impact;
use crate::residual::Residual;

/// A run with contacts that cannot go on: where, when, and why. The part that was made is kept: see
/// [`ContactRun::attempt`](crate::ContactRun::attempt), whose last sample is the position.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactError {
    /// The contact, by its name; `None` where it is not one of them.
    pub contact: Option<&'static str>,
    /// The time.
    pub time: f64,
    /// The cause.
    pub kind: ContactErrorKind,
}

/// The cause of a run's end.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ContactErrorKind {
    /// The run starts with a gap that is negative by more than rounding.
    NegativeGap {
        /// The gap.
        gap: f64,
    },
    /// A gap that counts as open became negative without having been seen to close.
    Penetration {
        /// The gap.
        gap: f64,
    },
    /// An event of the run makes the state jump to a gap that is negative by more than rounding.
    JumpPenetrates {
        /// The number of the event.
        event: usize,
        /// The gap.
        gap: f64,
    },
    /// A coefficient of restitution outside [0, 1], or not a number.
    InvalidRestitution {
        /// e.
        restitution: f64,
    },
    /// A coefficient of friction, or a bound of dry friction, that is negative, not finite, or zero along some of the
    /// axes alone.
    InvalidFriction {
        /// μ, or f.
        friction: f64,
    },
    /// The run would go back in time, in which impacts and friction have no unique solution, or its times are not
    /// finite.
    InvalidInterval,
    /// The lengths of steps must be finite and greater than 0, the shortest no longer than the longest.
    InvalidStep {
        /// The length.
        step: f64,
    },
    /// Tolerances must be finite, not negative, and not both zero.
    InvalidTolerance {
        /// The relative tolerance.
        relative: f64,
        /// The absolute tolerance.
        absolute: f64,
    },
    /// Between impacts no step is short enough for the tolerance: the motion is singular here, or the tolerance below
    /// rounding.
    StepTooSmall {
        /// The length.
        step: f64,
    },
    /// No steppers for the lanes of a pack, or more than these.
    Lanes {
        /// Number of lanes.
        lanes: usize,
        /// Number of steppers given.
        given: usize,
    },
    /// Elements have [states](gauss_runtime::system::GaussSystem::STATES), which steps of one length do not follow:
    /// runs from event to event do.
    States {
        /// Number of states of the elements.
        states: usize,
    },
    /// Forces change with places or speeds more than a step can follow, in parts as well: stiff springs and dampers, a
    /// body that turns by more than a radian in a sixteenth of the step.
    Stiff {
        /// The speed for which they do, by its place among the quasi-velocities.
        speed: usize,
        /// The length of the part.
        step: f64,
    },
    /// Forces change with places more than whole steps can follow, as steps by
    /// [`StepScheme::MoreauJean`](crate::StepScheme::MoreauJean) are on springs.
    StiffSprings {
        /// The angle by which what swings turns in the step, at least: ωh, in radians.
        phase: f64,
        /// The length of the step.
        step: f64,
    },
    /// A step with an impact would gain more energy for no reason than all that moves has, in sixteen parts as well; or
    /// a run has gained more than that beyond what inputs, forces, drives and contacts gave.
    EnergyFromNowhere {
        /// The energy that nothing explains.
        gained: f64,
        /// The kinetic energy that is explained: at the end of the step that has more of it, or the largest of the run.
        kinetic: f64,
        /// The length of the part.
        step: f64,
    },
    /// More steps than the run may have.
    TooManySteps {
        /// The limit.
        limit: u64,
    },
    /// Every n-th state alone is asked for in steps, which states in between are made from.
    EveryState {
        /// n.
        every: u64,
    },
    /// Gaps, rates or coefficients of the contacts, or functions that a run watches, are not finite.
    NonFinite,
    /// Painlevé's paradox: no contact force agrees with rigid bodies and Coulomb's law here. See
    /// [`ContactRun::impact_without_collision`](crate::ContactRun::impact_without_collision).
    Inconsistent,
    /// Painlevé's paradox: several motions agree with rigid bodies and Coulomb's law here.
    Indeterminate,
    /// No forces were found that satisfy the laws.
    Unsolved {
        /// Distance of the best forces from the laws.
        residual: Residual,
    },
    /// The impact would create energy: Newton's law with friction can (T. R. Kane 1984).
    EnergyGrows {
        /// The law of the run.
        law: Impact,
        /// The kinetic energy before.
        before: f64,
        /// And after.
        after: f64,
    },
    /// Impacts follow each other without end in no time, and are not those of one gap that comes to rest.
    Zeno {
        /// Number of impacts at this time.
        impacts: u32,
    },
    /// Contacts change their modes without end in no time.
    Chatter {
        /// Number of changes at this time.
        changes: u32,
    },
    /// More events than so many within so long a time, at several contacts, in a run that changes over to steps there.
    EventsPile {
        /// Number of events that there may be.
        events: usize,
        /// Within what time.
        span: f64,
    },
    /// Steps have Newton's law of impact alone; a run by another law cannot change over to them.
    LawWithoutSteps {
        /// The law of the run.
        law: Impact,
    },
    /// More events than the run may have.
    TooManyEvents {
        /// The limit.
        limit: usize,
    },
    /// The state cannot be brought onto closed gaps.
    Projection(ProjectionError),
    /// To close gaps, bodies would move much farther than these are from zero: planes of contacts contradict one
    /// another.
    Displacement {
        /// The largest of the gaps, as a positive number.
        gap: f64,
        /// The distance by which a point of a contact would move.
        moved: f64,
    },
    /// The numbers of the run carry derivatives, and the time of this event has none: the gap, force or slip that ends
    /// the mode of the contact touches zero without passing through it.
    Grazes {
        /// Its rate, per unit of time.
        rate: f64,
    },
    /// The numbers of the run carry derivatives, and this gap closes at one time with another, but not nearby: what
    /// happens there depends on which of them is first, and what follows has no derivative.
    Together,
    /// Derivatives of a step: they are those of Coulomb's law, and the steps have another one.
    NotCoulomb,
    /// Derivatives of a step: contacts depend on one another at the state, but not nearby.
    NoDerivative,
    /// Derivatives of a step: the system in dual numbers is another one, with other contacts or parameters.
    OtherSystem {
        /// Difference of the end of its step from that in `f64`.
        difference: f64,
    },
    /// A closed gap is closing, so that an impact comes before accelerations are finite.
    Strikes {
        /// The rate of the gap.
        rate: f64,
    },
    /// The run does not cover the time.
    OutsideRun,
    /// The integration between two events failed.
    Integration(IntegrationError),
    /// A controller cannot [sample](gauss_runtime::integrate::Simulation::sampled).
    Sampling(IntegrationErrorKind),
}

impl ContactErrorKind {
    /// Writes the errors of steps alone.
    fn of_steps(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidStep { step } => {
                write!(
                    f,
                    "a step of {step:e}; steps are finite and longer than 0, the shortest no longer than the longest"
                )
            }
            Self::InvalidTolerance { relative, absolute } => write!(
                f,
                "tolerances {relative:e} (relative) and {absolute:e} (absolute) must be finite, not negative, not both 0"
            ),
            Self::StepTooSmall { step } => {
                write!(
                    f,
                    "steps of {step:e} are still too long for the tolerance; allow more, or look at the motion here"
                )
            }
            Self::Lanes { lanes, given } => write!(f, "{given} steppers for {lanes} lanes; one to {lanes} go together"),
            Self::TooManySteps { limit } => {
                write!(f, "{limit} steps do not reach the end; use a larger tolerance, or allow more by `max_steps`")
            }
            Self::Displacement { gap, moved } => write!(
                f,
                "to close gaps of {gap:.1e} a point would move by {moved:.1e}: the planes of contacts contradict one \
                 another; shorter steps meet them one after the other"
            ),
            Self::Stiff { speed, step } => write!(
                f,
                "forces on speed number {speed} (from 0) change with places or speeds faster than a step can follow, in \
                 a part of {step:e} as well: make steps shorter than that, and write friction that jumps with the \
                 sign of a speed as `dry_friction`"
            ),
            Self::StiffSprings { phase, step } => write!(
                f,
                "what moves swings by {phase:.2} rad in a step of {step:e}, and `StepScheme::MoreauJean` follows 1: \
                 make steps shorter than {:.1e}, or take `StepScheme::Midpoint`, which makes springs implicit",
                step / phase
            ),
            Self::EnergyFromNowhere { gained, kinetic, step } => write!(
                f,
                "{gained:.1e} of energy would come from nowhere, more than the {kinetic:.1e} of all that moves, in an \
                 impact or in all steps so far, of {step:e} as well: make steps shorter than that, or run it from \
                 event to event"
            ),
            Self::States { states } => write!(
                f,
                "elements of the scene have {states} states, which steps of one length do not follow; run it from event \
                 to event: `ContactRun`"
            ),
            Self::EveryState { every } => write!(
                f,
                "steps with contacts keep every state, and `every({every})` asks for fewer; leave it out, and take \
                 `sampled` or `at_times` of the run, or `visit` and keep what you want"
            ),
            Self::LawWithoutSteps { law } => {
                write!(f, "a run by the law {law:?} cannot change over to steps: these have Newton's law alone")
            }
            _ => Ok(()),
        }
    }

    /// Writes why closed gaps, and those that should be open, are refused.
    fn of_gaps(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NegativeGap { gap } => write!(
                f,
                "the gap starts at {gap:e}; it must not be negative, not even by rounding: start a little above, from \
                 where a body falls to rest"
            ),
            Self::JumpPenetrates { event, gap } => {
                write!(f, "the jump of event {event} (from 0) leaves the gap at {gap:e}; it must not be negative")
            }
            Self::Penetration { gap } => {
                write!(
                    f,
                    "the gap of an open contact is {gap:e} and was not seen to close; `attempt` gives the motion up to \
                     here, and `changing_over` goes on in steps"
                )
            }
            Self::Projection(error) => {
                let flat = "nor has a rim that lies flat: give points on it contacts of their own in its place";
                write!(
                    f,
                    "{error}; a gap with a kink where it closes (`abs`, `min`) has no rate there: smooth it; {flat}"
                )
            }
            Self::Strikes { rate } => {
                write!(f, "the closed gap is closing at {rate:e}; start from the state after the impact")
            }
            Self::NonFinite => f.write_str(
                "gaps, rates, coefficients or forces are not finite: look at the input first, then at the scene; a \
                 rim that lies flat (a coin, a cylinder on its face) has no lowest point: give points on it contacts of \
                 their own in its place, or end the run before",
            ),
            _ => Ok(()),
        }
    }
}

/// Writes why the motion between events cannot go on.
fn between_events(error: &IntegrationError, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    fmt::Display::fmt(error, f)?;
    if matches!(error.kind, IntegrationErrorKind::Stiff { .. }) {
        let slow = "; a slow slip along two axes turns as fast as that: larger tolerances count it as none sooner, and \
                    contact steps pass over it";
        f.write_str(slow)?;
    }
    Ok(())
}

impl fmt::Display for ContactErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NegativeGap { .. } | Self::JumpPenetrates { .. } | Self::Penetration { .. } => self.of_gaps(f),
            Self::Projection(_) | Self::Strikes { .. } | Self::NonFinite => self.of_gaps(f),
            Self::InvalidRestitution { restitution } => {
                write!(f, "the coefficient of restitution is {restitution}; it must be between 0 and 1")
            }
            Self::InvalidFriction { friction } => write!(
                f,
                "the bound of friction is {friction}; it must be finite and not negative, and zero along all axes or \
                 none"
            ),
            Self::InvalidInterval => f.write_str("the run must go forward in time, between finite ends"),
            Self::InvalidStep { .. }
            | Self::InvalidTolerance { .. }
            | Self::StepTooSmall { .. }
            | Self::Lanes { .. }
            | Self::LawWithoutSteps { .. }
            | Self::EveryState { .. }
            | Self::States { .. }
            | Self::Displacement { .. }
            | Self::Stiff { .. }
            | Self::StiffSprings { .. }
            | Self::EnergyFromNowhere { .. }
            | Self::TooManySteps { .. } => self.of_steps(f),
            Self::Inconsistent => f.write_str("no contact force agrees with rigid bodies and Coulomb's law (Painlevé)"),
            Self::Indeterminate => f.write_str("several motions agree with rigid bodies and Coulomb's law (Painlevé)"),
            Self::Unsolved { residual } => write!(
                f,
                "no forces were found that satisfy the laws: residuals {:.1e} (Signorini), {:.1e} (Coulomb), {:.1e} \
                 (dissipation) at a rounding of {:.1e}",
                residual.signorini, residual.coulomb, residual.dissipation, residual.rounding
            ),
            Self::EnergyGrows { law, before, after } => write!(
                f,
                "by the law {law:?} the impact would raise the kinetic energy from {before:e} to {after:e}; \
                 `Impact::Moreau` and `Poisson` keep it from growing"
            ),
            Self::Zeno { impacts } => write!(f, "{impacts} impacts at one time do not end"),
            Self::Chatter { changes } => write!(f, "{changes} changes of modes at one time do not end"),
            Self::EventsPile { events, span } => write!(f, "more than {events} events within {span:e}"),
            Self::TooManyEvents { limit } => write!(f, "{limit} events do not reach the end; allow more by `max_events`"),
            Self::Grazes { rate } => {
                write!(f, "what ends the mode only touches zero (rate {rate:.1e}): its time has no derivative")
            }
            Self::Together => f.write_str(
                "the gap closes at one time with another, and nearby before or after it: what follows has no derivative",
            ),
            Self::NotCoulomb => f.write_str("derivatives of a step are those of Coulomb's law; leave out `law`"),
            Self::NoDerivative => f.write_str("contacts depend on one another here alone: the step has no derivative"),
            Self::OtherSystem { difference } => write!(
                f,
                "the system in dual numbers is another one: its step ends {difference:.1e} away; give it the same \
                 parameters"
            ),
            Self::OutsideRun => f.write_str("the run does not cover this time"),
            Self::Integration(error) => between_events(error, f),
            Self::Sampling(kind) => kind.fmt(f),
        }
    }
}

impl fmt::Display for ContactError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.contact {
            Some(name) => write!(f, "contact `{name}` at t = {}: {}", self.time, self.kind),
            None => write!(f, "contacts at t = {}: {}", self.time, self.kind),
        }
    }
}

impl core::error::Error for ContactErrorKind {}

impl core::error::Error for ContactError {}
