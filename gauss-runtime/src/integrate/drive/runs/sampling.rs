//! Controllers that sample, added to a simulation.

use crate::integrate::drive::simulation::Simulation;
use crate::integrate::drive::task::{Controlled, Task};
use crate::integrate::problem::equations::SystemProblem;
use crate::integrate::problem::sampled::{Controller, Law, Sampled, Samples};
use crate::system::GaussSystem;
use crate::vector_space::VectorSpace;

/// A simulation with one controller more.
type SampledSimulation<'k, S, F, I, K, C, O, E> =
    Simulation<SystemProblem<'k, S, F, Sampled<S, <I as Samples<S>>::Rest>>, C, O, Controlled<E, Task<S, K>>>;

impl<'k, S, F, I, C, O, E> Simulation<SystemProblem<'k, S, F, I>, C, O, E>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
{
    /// A controller that samples: a function of time and state is called at the start of a run and every `period`
    /// after that, once each, in the order of time, and the input that it gives is held in between. It may have a state
    /// of its own, which it moves in.
    ///
    /// - Each instant is the end of a step, so that no step meets the jump of the input, with whatever method, steps
    ///   and events. The run is one run, with one [`Trajectory`](crate::integrate::Trajectory), one table and one page;
    ///   [`input`](crate::integrate::Trajectory::input) tells what was held.
    /// - Several controllers, each with a period of its own, add up what they hold; a loop within another one is given
    ///   its goal by a `Cell` that both closures refer to. Those that sample at the same time, but for roundings of it,
    ///   do so in the order in which they were added. A function of time and state that was given *before*, by
    ///   [`input`](Self::input), is added as well: a gust, or what is not sampled. One that is given after that is
    ///   refused when the run begins.
    /// - [`delayed`](Simulation::delayed), [`delayed_samples`](Simulation::delayed_samples) and
    ///   [`initially`](Simulation::initially) say when the input acts, and what does before.
    /// - The end of a run is no instant: a run that goes on from there begins with it.
    /// - Runs go forward in time; a controller that cannot sample ends the run with
    ///   [`Sampling`](crate::integrate::IntegrationErrorKind::Sampling).
    /// - Random numbers are those of a generator that the controller owns, such as a `Stream` of the crate
    ///   `gauss-study`, a function of seed, name and the number of a run: every run has the same bits.
    /// - Of simulations that are run many times ([`boxed`](Self::boxed)) a closure keeps its data from run to run, as
    ///   observers do; a type begins anew by [`Controller::start`].
    ///
    #[cfg_attr(
        feature = "derive",
        doc = r##"
A cart that a computer brings to rest at x = 0: every 50 ms it takes the rate from the last two places, and the motor
obeys 10 ms later.

```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = 2, position = [x, 0, 0]), input(push), drive(x = push))]
struct Cart {}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Cart {}.kernel()?;
let mut before = None;
let run = Simulation::new(&kernel)
    .sampled(0.05, move |_t, q, _z| {
        let rate = (q[0] - before.replace(q[0]).unwrap_or(q[0])) / 0.05;
        SVector::from([-8.0 * q[0] - 6.0 * rate])
    })
    .delayed(0.01)
    .adaptive(1e-10, 1e-10)
    .run(SVector::from([1.0]), SVector::zeros(), 0.0..10.0)?;
assert!(run.last().q[0].abs() < 1e-4);
let push = |t: f64| run.at(t).map(|s| run.input(s.t, &s.q, &s.z)[0]);
assert_eq!((push(0.005)?, push(0.01)?, push(0.059)?), (0.0, -8.0, -8.0));
# Ok(())
# }
```
"##
    )]
    #[doc(alias = "hold")]
    #[doc(alias = "zero-order hold")]
    #[doc(alias = "discrete controller")]
    pub fn sampled<G>(self, period: f64, controller: G) -> SampledSimulation<'k, S, F, I, Law<G>, C, O, E>
    where
        I: Samples<S>,
        G: FnMut(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
    {
        self.sampled_by(period, Law(controller))
    }

    /// A controller that samples, as a type that implements [`Controller`]: see [`sampled`](Self::sampled).
    pub fn sampled_by<K>(self, period: f64, controller: K) -> SampledSimulation<'k, S, F, I, K, C, O, E>
    where
        I: Samples<S>,
        K: Controller<S>,
    {
        let task = Task::new(period, controller);
        self.with_problem(|SystemProblem { system, form, input }| {
            let input = Sampled::with(input.rest());
            SystemProblem { system, form, input }
        })
        .with_events(|others| Controlled { others, task })
    }
}

impl<S, P, K, C, O, E> Simulation<P, C, O, Controlled<E, Task<S, K>>>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
{
    /// Lets the input of the controller that was added last act so much time after each sample: for computing, on the
    /// way. It may be longer than the period; before the first one acts the input is [`initially`](Self::initially)
    /// that, or zero.
    pub fn delayed(self, time: f64) -> Self {
        self.with_events(|Controlled { others, task }| Controlled { others, task: task.delayed(time) })
    }

    /// Lets the input of the controller that was added last act so many of its periods after each sample, at one of its
    /// instants.
    pub fn delayed_samples(self, samples: u32) -> Self {
        self.with_events(|Controlled { others, task }| Controlled { others, task: task.delayed_samples(samples) })
    }

    /// Sets the input that the controller that was added last holds until its first sample acts, instead of zero.
    pub fn initially(self, input: S::Input) -> Self {
        self.with_events(|Controlled { others, task }| Controlled { others, task: task.initially(input) })
    }
}
