//! Controllers that sample in lanes: each run has its own.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::integrate::drive::task::{Controlled, Task};
use gauss_runtime::integrate::problem::sampled::Law;
use gauss_runtime::integrate::{Controller, Feedback, NoInput};
use gauss_runtime::system::GaussSystem;

use crate::Kernels;
use crate::ensemble::Ensemble;
use crate::input::SampledInput;

/// Inputs to which a controller that samples can be added: none, a closure, that of other controllers.
pub trait LaneSamples {
    /// The part that is a function of time and state.
    type Rest;

    /// Returns that part.
    #[doc(hidden)]
    fn rest(self) -> Self::Rest;
}

impl LaneSamples for NoInput {
    type Rest = Self;

    fn rest(self) -> Self {
        self
    }
}

impl<G> LaneSamples for Feedback<G> {
    type Rest = Self;

    fn rest(self) -> Self {
        self
    }
}

impl<R> LaneSamples for SampledInput<R> {
    type Rest = R;

    fn rest(self) -> R {
        self.0
    }
}

/// An ensemble with one controller more.
type SampledEnsemble<'k, K, F, I, C, E, S, D> =
    Ensemble<'k, K, F, SampledInput<<I as LaneSamples>::Rest>, C, Controlled<E, Task<S, D>>>;

impl<'k, K: ?Sized, F, I: LaneSamples, C, E> Ensemble<'k, K, F, I, C, E> {
    /// A controller that samples, in every run by itself, as
    /// [`Simulation::sampled`](gauss_runtime::integrate::Simulation::sampled) does: each run begins with a clone of it,
    /// so that what it keeps is of that run. The function is one of whole packs, and sees the state of its run in all
    /// lanes.
    ///
    /// Carts that a computer brings to rest, each by the rates of its own last two places:
    ///
    /// ```
    /// use gauss_batch::{Batch, States};
    /// use gauss_runtime::prelude::*;
    ///
    /// #[derive(GaussDynamics)]
    /// #[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), input(push), drive(x = push))]
    /// struct Cart<T> {
    ///     m: T,
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// type Eight = Lanes<f64, 8>;
    /// let kernel = Cart { m: Eight::splat(2.0) }.kernel()?;
    /// let mut states = States::<CartKernel<Eight>>::from_fn(16, |i| ([0.01 * i as f64].into(), [0.0].into()));
    /// let mut before = None;
    /// let ends = Batch::new(&kernel)
    ///     .adaptive(1e-9, 1e-9)
    ///     .sampled(0.05, move |_t, q: &SVector<Eight, 1>, _z: &SVector<Eight, 1>| {
    ///         let rate = (q[0] - before.replace(q[0]).unwrap_or(q[0])) * Eight::splat(20.0);
    ///         SVector::from([Eight::splat(-8.0) * q[0] - Eight::splat(6.0) * rate])
    ///     })
    ///     .run(0.0..10.0, &mut states);
    /// assert!(ends.iter().all(Result::is_ok) && (0..16).all(|i| states.get(i).0[0].abs() < 1e-3));
    /// # Ok(())
    /// # }
    /// ```
    pub fn sampled<S, G>(self, period: f64, controller: G) -> SampledEnsemble<'k, K, F, I, C, E, S, Law<G>>
    where
        S: GaussSystem<Input: VectorSpace<S::Scalar>>,
        K: Kernels<S>,
        G: FnMut(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
    {
        self.sampled_by(period, Law(controller))
    }

    /// A controller that samples, as a type that implements [`Controller`]: see [`sampled`](Self::sampled).
    pub fn sampled_by<S, D>(self, period: f64, controller: D) -> SampledEnsemble<'k, K, F, I, C, E, S, D>
    where
        S: GaussSystem<Input: VectorSpace<S::Scalar>>,
        K: Kernels<S>,
        D: Controller<S>,
    {
        let task = Task::new(period, controller);
        self.map_parts(|input| SampledInput(input.rest()), |others| Controlled { others, task })
    }
}

impl<'k, K: ?Sized, F, I, C, E, S, D> Ensemble<'k, K, F, I, C, Controlled<E, Task<S, D>>>
where
    S: GaussSystem<Input: VectorSpace<S::Scalar>>,
{
    /// Lets the input of the controller that was added last act so much time after each sample: see
    /// [`Simulation::delayed`](gauss_runtime::integrate::Simulation::delayed).
    pub fn delayed(self, time: f64) -> Self {
        self.with_task(|task| task.delayed(time))
    }

    /// Lets it act so many of its periods after each sample.
    pub fn delayed_samples(self, samples: u32) -> Self {
        self.with_task(|task| task.delayed_samples(samples))
    }

    /// Sets the input that the controller that was added last holds until its first sample acts, instead of zero.
    pub fn initially(self, input: S::Input) -> Self {
        self.with_task(|task| task.initially(input))
    }

    fn with_task(self, change: impl FnOnce(Task<S, D>) -> Task<S, D>) -> Self {
        self.map_parts(|input| input, |Controlled { others, task }| Controlled { others, task: change(task) })
    }
}
