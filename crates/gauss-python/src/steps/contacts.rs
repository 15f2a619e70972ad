//! Runs with contacts, and what these do at a state.

use gauss_contact::{ContactRun, EventKind, Mode};
use gauss_runtime::prelude::*;

use super::causes::of_contacts;
use super::contact_rows::Touching;
use super::outcome::{InContact, Outcome};
use super::request::{Control, Request};
use super::{components, contact_events, contact_steps, vector};

/// A run with contacts.
///
/// # Errors
/// A controller that cannot sample; states at times that cannot be found.
pub fn run<S: Touching>(system: &S, q: S::Configuration, request: &Request<'_>) -> Result<Outcome, String> {
    let start = (q, vector::<S::Speeds>(request.z));
    match request.control {
        Control::ContactSteps(length, scheme, law) => contact_steps::run(system, request, start, (length, scheme, law)),
        _ => contact_events::run(system, request, start),
    }
}

/// Acceleration at a state, with modes and forces of the contacts: a run of no length decides it.
///
/// # Errors
/// A state at which velocities jump.
pub fn at<S: Touching>(
    system: &S,
    t: f64,
    (q, z): (S::Configuration, &[f64]),
    input: &[f64],
) -> Result<InContact, String> {
    let (z, u) = (vector::<S::Speeds>(z), vector::<S::Input>(input));
    let run = ContactRun::new(system).adaptive(1e-9, 1e-9).input(move |_: f64, _: &S::Configuration, _: &S::Speeds| u);
    let run = run.run(q, z, t..t).map_err(|error| of_contacts(&error))?;
    if let Some(struck) = run.events().iter().find(|event| matches!(event.kind, EventKind::Impact(_))) {
        return Err(format!("contact {} is closing: velocities jump there, and forces are not finite", struck.name));
    }
    let (forces, modes) = (run.forces(t), run.modes(t));
    let (forces, modes) = (forces.map_err(|error| of_contacts(&error))?, modes.map_err(|error| of_contacts(&error))?);
    let free = system.impulse_dynamics(t, &q, &z, &u);
    let pushed = system.impulse_velocities(&free.response.factors, &forces);
    let word = |mode: &Mode| match mode {
        Mode::Open => "open",
        Mode::Closed => "closed",
        Mode::Sticks => "sticks",
        Mode::Slides(_) => "slides",
    };
    Ok(InContact {
        acceleration: components(&free.acceleration.add_scaled(1.0, &pushed)),
        modes: modes.iter().map(word).collect(),
        forces: components(forces.rows()),
    })
}
