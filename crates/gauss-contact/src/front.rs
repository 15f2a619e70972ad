//! The choice of contact forces in a simulation.

use gauss_runtime::contact::ContactSystem;
use gauss_runtime::integrate::drive::observer::Unobserved;
use gauss_runtime::integrate::drive::simulation::NoControl;
use gauss_runtime::integrate::{Simulation, SystemProblem, VelocityForm};

use crate::run::ContactRun;
use crate::steps::ContactSteps;

/// The contact forces of a [`Simulation`] of a scene with contacts: from event to event, or in steps. Kernel, input,
/// steps, events, `every` and `max_steps` are those of the simulation, but that steps refuse `every`: in its place they
/// have [`visit`](ContactSteps::visit). Both runs give a record that tables, pages and plots take
/// ([`ContactRecord`](crate::ContactRecord)).
///
/// ```
/// use gauss_contact::WithContacts;
/// use gauss_runtime::prelude::*;
///
/// /// A ball above a floor.
/// #[derive(GaussDynamics)]
/// #[gauss(
///     coordinates(height),
///     particle(mass = 2, position = [0, 0, height]),
///     contact(floor, gap = height, restitution = 0.5),
/// )]
/// struct Ball {
///     #[gauss(gravity)] g: f64,
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let kernel = Ball { g: 9.81 }.kernel()?;
/// let (q, z) = (SVector::from([1.0]), SVector::zeros());
/// let exact = Simulation::new(&kernel).adaptive(1e-9, 1e-12).contact_events().run(q, z, 0.0..4.0)?;
/// let steps = Simulation::new(&kernel).contact_steps(1e-3).run(q, z, 0.0..4.0)?;
/// // It lies there, and the floor bears its weight.
/// assert!((exact.forces(4.0)?[0] - 2.0 * 9.81).abs() < 1e-12);
/// assert!((steps.forces(4.0)?[0] - 2.0 * 9.81).abs() < 1e-10);
/// // The first impact is at √(2h/g); steps know it to a step.
/// let lands = (2.0_f64 / 9.81).sqrt();
/// assert!((exact.jumps()[0] - lands).abs() < 1e-12 && (steps.jumps()[0] - lands).abs() < 1e-3);
/// # Ok(())
/// # }
/// ```
pub trait WithContacts<'k, K: ContactSystem>: Sized {
    /// The choice of steps between events.
    type Control;
    /// The input.
    type Input;
    /// The events that the simulation watches for.
    type Events;

    /// From event to event, exactly: each landing, each end of a slip at its time. For accuracy, for controllers and
    /// gaits that are differentiated, and for up to some dozens of contacts. What rests, sticks or ends a slip is
    /// judged by the tolerance of the steps; see [`ContactRun`] for laws of impact, limits, and changing over to steps
    /// where events pile up.
    fn contact_events(self) -> ContactRun<'k, K, Self::Control, Self::Input, Self::Events>;

    /// In steps of length `h` in velocities and impulses: any number of contacts, all impacts of a step at once, each
    /// known to a step. The input is held for a step. It needs no other choice of steps; see [`ContactSteps`] for steps
    /// that keep a tolerance.
    fn contact_steps(self, h: f64) -> ContactSteps<'k, K, Self::Input, Self::Events>
    where
        Self::Control: Unchosen,
        K: ContactSystem<Scalar = f64>;
}

/// No choice of steps so far.
#[diagnostic::on_unimplemented(
    message = "steps with contacts have lengths of their own",
    label = "`{Self}` chooses steps already",
    note = "leave out `.adaptive(…)`, `.fixed_step(…)`, `.control(…)`; steps that keep a tolerance are \
            `.contact_steps(longest).adaptive(relative, absolute)`"
)]
pub trait Unchosen {}

impl Unchosen for NoControl {}

impl<'k, K: ContactSystem, I, C, E> WithContacts<'k, K>
    for Simulation<SystemProblem<'k, K, VelocityForm, I>, C, Unobserved, E>
{
    type Control = C;
    type Input = I;
    type Events = E;

    fn contact_events(self) -> ContactRun<'k, K, C, I, E> {
        let (SystemProblem { system, input, .. }, control, events, every, steps) = self.into_parts();
        let mut run = ContactRun::of_parts(system, control, input, events);
        (run.settings.every, run.settings.steps) = (every, steps);
        run
    }

    fn contact_steps(self, h: f64) -> ContactSteps<'k, K, I, E>
    where
        C: Unchosen,
        K: ContactSystem<Scalar = f64>,
    {
        let (SystemProblem { system, input, .. }, _, events, every, limit) = self.into_parts();
        ContactSteps::of_parts(system, h, (input, events), (every, limit))
    }
}
