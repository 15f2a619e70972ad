//! Simulations in a type that can be written: fields of structs, results of functions.

use core::fmt;
use core::ops::Range;

use alloc::boxed::Box;
use alloc::rc::Rc;

use crate::integrate::drive::control::Control;
use crate::integrate::drive::event::Events;
use crate::integrate::drive::observer::Observer;
use crate::integrate::drive::run::Run;
use crate::integrate::drive::summary::End;
use crate::integrate::drive::trajectory::{Maker, Trajectory};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationError;
use crate::system::GaussSystem;

/// A [`Simulation`](crate::integrate::Simulation) of a system, whatever its input, steps, observer and events: made by
/// [`Simulation::boxed`](crate::integrate::Simulation::boxed).
///
/// It borrows the kernel and can be run many times. Each run begins anew; observers and jumps keep their
/// data from run to run. Its runs have the bits of those of the simulation.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::integrate::BoxedSimulation;
use gauss_runtime::prelude::*;

/// A pendulum with a motor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
    input(torque),
    drive(angle = torque),
)]
struct Pendulum {
    #[gauss(gravity)] g: f64,
}

/// A pendulum whose motor pushes along the rate, with the simulation prepared once.
struct Model<'k> {
    simulation: BoxedSimulation<'k, PendulumKernel>,
    angle: f64,
    rate: f64,
}

impl Model<'_> {
    fn advance(&mut self, time: f64) -> Result<(), IntegrationError> {
        let end = self.simulation.run_to_end(SVector::from([self.angle]), SVector::from([self.rate]), 0.0..time)?;
        (self.angle, self.rate) = (end.q[0], end.z[0]);
        Ok(())
    }
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { g: 9.81 }.kernel()?;
let pushed = Simulation::new(&kernel).input(|_t, _q, z| *z).adaptive(1e-9, 1e-9);
let mut model = Model { simulation: pushed.boxed(), angle: 0.1, rate: 0.0 };
for _ in 0..3 {
    model.advance(1.0)?;
}
// The amplitude grows by about exp(t/2).
assert!(kernel.energy(0.0, &SVector::from([model.angle]), &SVector::from([model.rate])) > -9.81 * 0.3_f64.cos());
# Ok(())
# }
```
"##
)]
#[must_use = "a simulation does nothing before `run`"]
pub struct BoxedSimulation<'k, S: GaussSystem>(Box<dyn CompleteSimulation<'k, S> + 'k>);

impl<'k, S: GaussSystem> BoxedSimulation<'k, S> {
    pub(in crate::integrate) fn new<P, C, O, E>(
        (problem, control): (P, C),
        (observer, events): (O, E),
        every: u64,
        limit: Option<u64>,
    ) -> Self
    where
        P: Problem<System = S> + 'k,
        C: Control<S> + 'k,
        O: Observer<S> + 'k,
        E: Events<S> + 'k,
    {
        let maker = Rc::new(Maker { problem, control, every_step: every == 1 });
        Self(Box::new(Parts { maker, observer, events, every, limit }))
    }

    /// A run whose samples are kept: see [`Simulation::run`](crate::integrate::Simulation::run).
    ///
    /// # Errors
    /// When the run does not reach the end; [`attempt`](Self::attempt) then gives the part that was made.
    pub fn run(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<Trajectory<'k, S>, IntegrationError> {
        match self.attempt(q0, z0, interval) {
            (trajectory, None) => Ok(trajectory),
            (_, Some(error)) => Err(error),
        }
    }

    /// A run up to the last good state: see [`Simulation::attempt`](crate::integrate::Simulation::attempt).
    pub fn attempt(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> (Trajectory<'k, S>, Option<IntegrationError>) {
        self.0.attempt(q0, z0, interval)
    }

    /// A run of which the end is kept: see [`Simulation::run_to_end`](crate::integrate::Simulation::run_to_end).
    ///
    /// # Errors
    /// When the run does not reach the end.
    pub fn run_to_end(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<End<S>, IntegrationError> {
        self.0.run_to_end(q0, z0, interval)
    }
}

impl<S: GaussSystem> fmt::Debug for BoxedSimulation<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BoxedSimulation").finish_non_exhaustive()
    }
}

/// A simulation of which all is chosen.
trait CompleteSimulation<'k, S: GaussSystem> {
    fn attempt(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> (Trajectory<'k, S>, Option<IntegrationError>);

    fn run_to_end(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<End<S>, IntegrationError>;
}

/// The parts of a simulation; trajectories share what makes the states between their samples.
struct Parts<P, C, O, E> {
    maker: Rc<Maker<P, C>>,
    observer: O,
    events: E,
    every: u64,
    limit: Option<u64>,
}

impl<'k, S, P, C, O, E> CompleteSimulation<'k, S> for Parts<P, C, O, E>
where
    S: GaussSystem,
    P: Problem<System = S> + 'k,
    C: Control<S> + 'k,
    O: Observer<S>,
    E: Events<S>,
{
    fn attempt(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> (Trajectory<'k, S>, Option<IntegrationError>) {
        self.events.each(&mut |_, mark| mark.renew());
        let Maker { problem, control, .. } = &*self.maker;
        let run = Run::kept(problem, control, self.every, self.limit);
        let (kept, error) = run.keep(&mut self.events, &mut self.observer, (q0, z0), interval);
        (Trajectory::made_by(kept, Rc::clone(&self.maker) as _), error)
    }

    fn run_to_end(
        &mut self,
        q0: S::Configuration,
        z0: S::Speeds,
        interval: Range<S::Scalar>,
    ) -> Result<End<S>, IntegrationError> {
        self.events.each(&mut |_, mark| mark.renew());
        let Maker { problem, control, .. } = &*self.maker;
        let run = Run::new(problem, control, self.every, self.limit);
        run.to_end(&mut self.events, &mut self.observer, (q0, z0), interval)
    }
}

#[cfg(test)]
#[path = "boxed_tests.rs"]
mod tests;
