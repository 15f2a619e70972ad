//! Runs with contacts, and what these do at a state.

use gauss_contact::{ContactErrorKind, InMode, Mode};
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
        Control::ContactSteps(length, tolerances, scheme, law) => {
            contact_steps::run(system, request, start, (length, tolerances, scheme, law))
        }
        _ => contact_events::run(system, request, start),
    }
}

/// Acceleration at a state, with modes and forces of the contacts: the state decides it.
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
    let in_mode = InMode::at(system, t, &q, &z, &u).map_err(|error| match (&error.kind, error.contact) {
        (ContactErrorKind::Strikes { .. }, Some(name)) => {
            format!("contact {name} is closing: velocities jump there, and forces are not finite")
        }
        _ => of_contacts(&error),
    })?;
    let (forces, modes) = (in_mode.contact_forces(t, &q, &z, &u), in_mode.modes());
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
