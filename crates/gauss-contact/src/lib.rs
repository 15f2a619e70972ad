//! Contact, dry friction and impacts of scenes of Gauss, exactly: runs from event to event.
//!
//! A [`ContactSystem`](gauss_runtime::contact::ContactSystem) has gaps that may close. Between two events each contact
//! has a [`Mode`]: open, closed, sticking, or sliding. The motion is smooth then, and any adaptive method integrates it
//! to the accuracy that is asked for. At an event (a gap closes, a contact force vanishes, a slip ends, friction
//! reaches its bound) impacts are solved by a law that has a name ([`Impact`]), and the modes are chosen anew by the
//! laws of Signorini and Coulomb for accelerations.
//!
//! - What sticks has slip 0, and what rests has gap 0 to rounding: they are constraints.
//! - Bounces that pile up end in rest ([`EventKind::Rests`]), with what was left out, and so do impacts that alternate
//!   between contacts.
//! - Contacts that depend on one another, as four legs of a table, hold as long as any of their forces keep all laws;
//!   those of least norm are given if they do.
//! - Each solution of the laws has its residuals in the history ([`SolveRecord`]).
//! - Where rigid bodies and Coulomb's law have no motion or several (Painlevé), the run ends with an error; where they
//!   have none it can go on by an impulse ([`ContactRun::impact_without_collision`]).
//!
//! For many contacts there are steps of one length in velocities and impulses: any number of contacts, all impacts of a
//! step at once, without events and without allocation.
//!
//! | for | begin with |
//! |---|---|
//! | a run | `Simulation::new(&kernel)` and [`contact_events`](WithContacts::contact_events) or [`contact_steps`](WithContacts::contact_steps) of [`WithContacts`] |
//! | its states, forces, tables, pages | [`ContactRecord`] |
//! | one step at a time | [`ContactStepper`] |
//! | many systems in steps | [`ContactEnsemble`] |
//! | a system in given modes, its accelerations and derivatives | [`InMode`] |
//! | contacts that come at run time | [`Slots`] |
//!
//! Limits: flights lower than some hundred roundings of the largest coordinate are rest, or an error where e = 1. No
//! first touch is missed, however long the steps: the rate of a gap is bounded by kinetic energy. Where that is not
//! enough, as for gaps that depend on the time, or of bodies that turn some thousand times in a step, whose tips may be
//! met some turns late, the run says so ([`ContactTrajectory::sampled_gaps`]). A gap that is found below zero all the
//! same ends it with [`ContactErrorKind::Penetration`].
//!
//! Scalars are any of one lane. Values decide what happens; where numbers carry derivatives, so do times of events,
//! impulses and forces, and the end of a run has those of the run through its events. Derivatives are those of the
//! modes that the run has: where a slip or a gap is at the edge of two modes, one-sided. Of bounces that pile up they
//! are followed as far as the bounces are; what rests moves with its closed gap, so that a start on a closed gap is
//! differentiated along it. What has none ends with [`ContactErrorKind::Grazes`] or [`ContactErrorKind::Together`].
//!
//! Friction is Coulomb's, a circle, an ellipse, or with drilling an ellipsoid; dry friction of a given bound; and
//! resistance to rolling in proportion to a normal force. With several rows and a friction so large that it can reverse
//! the effect of a normal force, uniqueness is not checked for contacts that begin to slide.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

// `front` (contacts chosen in a `Simulation`), `record` (one record of all runs, which tables and pages read); contact,
// friction and impacts from event to event: `law` and `friction` (what bounds a force), `solver` (the laws at an
// instant, over `dense`), `equations` (which forces keep which rates at zero), `mode` (a system in given modes),
// `witness` (what ends them), `moving` (gaps that change with time), `impact`, `poisson`, `decide` (what becomes of a
// state at an event), `jumps` (those of the state, by events of the user), `rest` (bounces that pile up), `run` with
// `watching` (events and jumps that it is given), `trajectory`, `present`, `action`, `balance`, `sensors` (forces at
// contacts), `rounding`. Contacts that depend on one another: `shared` (their forces) over `reserve` (how far inside
// the bounds forces can be) and `sticking` (whether there are any). Decisions are made by values; equations are solved
// in the scalar, so that derivatives pass through. `steps`: steps of one length in given memory: `cones` (the laws by
// rows), `impulses` (their solver) with `unknowns` and `equations` over `linear`, `passing` (functions of the user
// within a step), `made` (the record of steps), `projection` (the end of a step, within `bounds`, over `least`),
// `speeds` (the speeds of its forces), `stiffness` (how much these change with places), `springs` (what steps without a
// memory refuse), `gain` (the energy of its impacts), `account` (that of a run), `step` (one step, in any scalar and
// whoever decides, over the formulas of `motion`), `stepper` (decides by the values of one state) and `outcome` (what
// an attempt came to), `held` (between steps, while contacts change), `report`, `run`; `relaxed`, the other law, and
// `adaptive`, steps that keep a tolerance. `lanes`: several states at once in packs, each a `lane`; `together` decides
// for all of them, by laws (`posed`, the laws of a step as a problem) that are generic in the scalar and know by
// `lockstep` whether lanes decide alike, or lane by lane; `rounds`, what one lane tries alone. `ensemble`: many on
// threads. `changeover`: from `run` to `steps` and back. `slots`: contacts that come at run time: `slot`, `place` (how
// it moves), `envelope` (A), `system`. Derivatives of a step: `watch` (what a step decided), `followed` (decides as it
// did, in dual numbers, over `active`, the laws of contacts that act), `edges` (contacts at a change), `derivatives`;
// `kept` (a state to go back to).
mod action;
mod balance;
mod ball;
mod changeover;
mod decide;
mod dense;
mod directions;
mod equations;
mod error;
mod frame;
mod friction;
mod front;
mod history;
mod impact;
mod jumps;
mod law;
mod lockstep;
mod mode;
mod moving;
mod poisson;
mod present;
mod problem;
mod record;
mod reserve;
mod residual;
mod rest;
mod rounding;
mod run;
mod sampling;
mod sensors;
mod settings;
mod shared;
mod slots;
mod solution;
mod solver;
mod start;
mod steps;
mod sticking;
mod trajectory;
mod watching;
mod witness;

pub use balance::ContactBalance;
pub use changeover::{ChangingRun, ChangingTrajectory, EventPart, RunPart, StepPart};
pub use error::{ContactError, ContactErrorKind};
pub use front::{Unchosen, WithContacts};
pub use history::{ContactEvent, EventKind, ImpactRecord, Passage, SampledGap, SolveRecord, StateJump};
pub use impact::Impact;
pub use mode::{InMode, Mode};
pub use record::ContactRecord;
pub use residual::Residual;
pub use run::ContactRun;
pub use sensors::{ContactForce, ContactForces, ContactWrench, SensorError};
pub use slots::{Slot, SlotError, SlotField, SlotRule, Slots};
pub use steps::{
    AdaptiveContactSteps, AtChange, Change, ContactEnsemble, ContactLanes, ContactStepper, ContactSteps, HeldSteps,
    LanesOf, StepDerivatives, StepLaw, StepReport, StepSample, StepScheme, StepStatistics, SteppedRun,
};
pub use trajectory::{ContactTrajectory, Segment};

/// The page of the crate, whose program is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
