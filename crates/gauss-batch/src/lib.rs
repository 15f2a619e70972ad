//! Many states of one scene at once: lanes times threads.
//!
//! A kernel whose scalar is a pack ([`simd`](gauss_runtime::simd)) works on several states for about the price of one.
//! [`States`] holds any number of states in blocks of that width, and a [`Batch`] works through the blocks:
//! accelerations, runs of fixed steps by any [`OneStep`], or runs whose steps are chosen, with events ([`Ensemble`]),
//! on one thread or, with the feature `rayon`, on all.
//!
//! The struct that the kernel is derived from is generic in its scalar, `struct Body<T>`. Where all states have the
//! same parameters, these are numbers repeated in every lane; a sweep over parameters gives each state its own, a
//! kernel for every block ([`Batch::each`]).
//!
//! ```
//! use gauss_batch::{Batch, Packs, States};
//! use gauss_runtime::prelude::*;
//!
//! /// A heavy top that turns about O.
//! #[derive(GaussDynamics)]
//! #[gauss(motion = fixed_point)]
//! struct Top<T> {
//!     #[gauss(mass)]           mass: T,
//!     #[gauss(center_of_mass)] center: Vector3<T>,
//!     #[gauss(inertia)]        inertia: Vector3<T>,
//!     #[gauss(gravity)]        g: T,
//! }
//!
//! /// The same top in any scalar, its mass given.
//! fn top<T: Real>(mass: T) -> Top<T> {
//!     let f = T::from_f64;
//!     Top { mass, center: Vector3::new(f(0.0), f(0.0), f(0.4)), inertia: Vector3::new(f(0.2), f(0.2), f(0.05)), g: f(9.81) }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! type Four = Lanes<f64, 4>;
//!
//! // A thousand spins of one top.
//! let tilted = UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0);
//! let spin = |i: usize| Vector3::new(0.0, 0.0, 20.0 + 0.02 * i as f64);
//! let mut states = States::<TopKernel<Four>>::from_fn(1000, |i| (tilted, spin(i)));
//! let kernel = top(Four::splat(1.0)).kernel()?;
//! Batch::new(&kernel).advance(&RungeKutta(DormandPrince8), 0.01, 0.0..1.0, &mut states)?;
//!
//! // Each is, bit by bit, what a run of its own gives.
//! let alone = top(1.0).kernel()?;
//! let end = Simulation::new(&alone).fixed_step(0.01).run_to_end(tilted, spin(617), 0.0..1.0)?;
//! assert_eq!(states.get(617), (end.q, end.z));
//!
//! // A thousand masses: a kernel for every block of four.
//! let masses = Packs::<Four>::from_fn(1000, |i| 1.0 + 0.001 * i as f64);
//! let kernels: Vec<_> = masses.blocks().iter().map(|&mass| top(mass).kernel()).collect::<Result<_, _>>()?;
//! let mut states = States::<TopKernel<Four>>::from_fn(1000, |_| (tilted, spin(0)));
//! Batch::each(&kernels).advance(&RungeKutta(DormandPrince8), 0.01, 0.0..1.0, &mut states)?;
//! let accelerations = Batch::each(&kernels).accelerations(1.0, &states);
//! assert_eq!(accelerations.len(), 1000);
//! # Ok(())
//! # }
//! ```
//!
//! **Bits.** A state gets the bits of a run of its own ([`Fixed`](gauss_runtime::integrate::Fixed)) by explicit
//! methods. Three things look at other lanes: iterations of implicit methods end when all lanes are solved, projections
//! onto constraints go on until all are on them, and increments of more than half a radian, in the same step as smaller
//! ones, take another formula for the same number; all differ by rounding.
//!
//! **Steps of their own.** In an [`Ensemble`] every run takes the steps that it would take alone: the trials, errors
//! and lengths of a step are those of its lane, and a lane whose run has ended is handed to the next.
//! [`Taylor`](gauss_runtime::integrate::Taylor) has one order for the lanes of a block, so only with an order given are
//! its steps those of single runs.
//!
//! **Failures.** A state that cannot go on stops by itself: it stays in its lane, with a step of length zero, and the
//! others of its block go on as if nothing had happened.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

mod advance;
mod ensemble;
mod error;
mod input;
mod lanes;
mod packs;
mod sampling;

use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::integrate::{
    Feedback, Form, InputSource, MomentumForm, NoInput, OneStep, SystemProblem, VelocityForm, WithoutContacts,
};
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

use advance::Interval;
pub use ensemble::Ensemble;
pub use error::BatchError;
pub use input::{FunctionInput, HoldInput, LaneInput, SampledInput};
pub use lanes::{BatchSystem, Ended, EventState, LaneControl, RunError, RunOutcome, SingleConfiguration, SingleSpeeds};
pub use packs::{Packs, States};
pub use sampling::LaneSamples;

/// The kernels of a batch: one for all blocks, or a slice with one for each.
pub trait Kernels<S> {
    /// Whether all blocks have the same, so that a state may be worked on in any lane.
    const SHARED: bool;

    /// The kernel of a block.
    fn of_block(&self, block: usize) -> &S;
}

impl<S: GaussSystem> Kernels<S> for S {
    const SHARED: bool = true;

    #[inline(always)]
    fn of_block(&self, _: usize) -> &S {
        self
    }
}

impl<S: GaussSystem> Kernels<S> for [S] {
    const SHARED: bool = false;

    #[inline(always)]
    fn of_block(&self, block: usize) -> &S {
        &self[block]
    }
}

/// Kernels of many states, with the form of the equations and the input.
///
/// See the [module](self) for an example.
#[derive(Debug)]
#[must_use = "a batch does nothing before `advance` or `accelerations`"]
pub struct Batch<'k, K: ?Sized, F = VelocityForm, I = NoInput> {
    kernels: &'k K,
    form: F,
    input: I,
}

impl<'k, S: GaussSystem> Batch<'k, S> {
    /// One kernel for all states; in velocity form and without inputs unless said otherwise.
    pub fn new(kernel: &'k S) -> Self {
        Self { kernels: kernel, form: VelocityForm, input: NoInput }
    }
}

impl<'k, S: GaussSystem> Batch<'k, [S]> {
    /// A kernel for each block of states: parameters of their own for every lane.
    pub fn each(kernels: &'k [S]) -> Self {
        Self { kernels, form: VelocityForm, input: NoInput }
    }
}

impl<'k, K: ?Sized, F, I> Batch<'k, K, F, I> {
    /// Integrates momenta instead of quasi-velocities.
    pub fn momentum_form(self) -> Batch<'k, K, MomentumForm, I> {
        Batch { kernels: self.kernels, form: MomentumForm, input: self.input }
    }

    /// Runs scenes with contacts as if they had none, as
    /// [`Simulation::without_contacts`](gauss_runtime::integrate::Simulation::without_contacts) does; without this each
    /// state ends at once with [`Contacts`](gauss_runtime::integrate::IntegrationErrorKind::Contacts).
    pub fn without_contacts(self) -> Batch<'k, K, WithoutContacts<F>, I> {
        Batch { kernels: self.kernels, form: WithoutContacts(self.form), input: self.input }
    }

    /// The input as a function of time and state, both of a whole block.
    pub fn input<S, G>(self, input: G) -> Batch<'k, K, F, Feedback<G>>
    where
        S: GaussSystem,
        K: Kernels<S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Input,
    {
        self.input_from(Feedback(input))
    }

    /// The input from a type that implements [`InputSource`].
    pub fn input_from<J>(self, input: J) -> Batch<'k, K, F, J> {
        Batch { kernels: self.kernels, form: self.form, input }
    }

    /// The accelerations ż of all states at the time `t`. They have no contact forces: a scene with contacts is refused
    /// while it compiles, but for [`without_contacts`](Self::without_contacts).
    ///
    /// ```compile_fail,E0080
    /// # use gauss_batch::{Batch, States};
    /// # use gauss_runtime::prelude::*;
    /// # #[derive(GaussDynamics)]
    /// # #[gauss(coordinates(height), particle(mass = m, position = [0, 0, height]), contact(floor, gap = height))]
    /// # struct Ball<T> { m: T }
    /// # type Four = Lanes<f64, 4>;
    /// # let kernel = Ball { m: Four::splat(1.0) }.kernel().unwrap();
    /// # let states = States::<BallKernel<Four>>::from_fn(4, |_| (SVector::from([1.0]), SVector::from([0.0])));
    /// let all = Batch::new(&kernel).accelerations(0.0, &states); // with `.without_contacts()` it compiles
    /// ```
    ///
    /// # Panics
    /// When there are fewer kernels than blocks.
    #[must_use]
    pub fn accelerations<S>(&self, t: f64, states: &States<S>) -> Packs<S::Speeds>
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: InputSource<S>,
    {
        let mut accelerations = states.speeds.with_blocks(Vec::with_capacity(states.speeds.blocks().len()));
        self.accelerations_into(t, states, &mut accelerations);
        accelerations
    }

    /// [`accelerations`](Self::accelerations) written over earlier ones, whose number may differ: repeated calls need
    /// no new memory. For more states than the caches hold, new memory costs more than the accelerations.
    ///
    /// # Panics
    /// As [`accelerations`](Self::accelerations).
    pub fn accelerations_into<S>(&self, t: f64, states: &States<S>, accelerations: &mut Packs<S::Speeds>)
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: InputSource<S>,
    {
        refuse_contacts::<S, F>();
        let t = S::Scalar::from_f64(t);
        let blocks = states.configurations.blocks().iter().zip(states.speeds.blocks()).enumerate();
        accelerations.refill(
            states.len(),
            blocks.map(|(block, (q, z))| {
                let kernel = self.kernels.of_block(block);
                kernel.acceleration(t, q, z, &self.input.input(t, q, z))
            }),
        );
    }

    /// Carries all states over the interval, which may run backwards, by steps of length |step|; the last one ends in
    /// time.
    ///
    /// # Errors
    /// When states do not reach the end: they stay where they stopped. All others do reach it.
    ///
    /// # Panics
    /// When there are fewer kernels than blocks.
    pub fn advance<S, M>(
        &self,
        method: &M,
        step: f64,
        interval: Range<f64>,
        states: &mut States<S>,
    ) -> Result<(), BatchError>
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: InputSource<S>,
        M: OneStep<S>,
    {
        let count = states.len();
        let interval = Interval::new(step, interval);
        let blocks = states.configurations.blocks.iter_mut().zip(&mut states.speeds.blocks).enumerate();
        collect(
            blocks.flat_map(|(block, (q, z))| self.advance_block(method, &interval, count, block, (q, z))).collect(),
        )
    }

    /// One block, and the states that stopped on the way.
    fn advance_block<S, M>(
        &self,
        method: &M,
        interval: &Interval,
        count: usize,
        block: usize,
        state: (&mut S::Configuration, &mut S::Speeds),
    ) -> Vec<RunError>
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: InputSource<S>,
        M: OneStep<S>,
    {
        let lanes = S::Scalar::WIDTH;
        let first = block * lanes;
        let problem =
            SystemProblem { system: self.kernels.of_block(block), form: self.form, input: Borrowed(&self.input) };
        let mut failures = advance::advance(&problem, method, interval, lanes.min(count - first), state);
        failures.sort_unstable_by_key(|failure| failure.state);
        failures.iter_mut().for_each(|failure| failure.state += first);
        failures
    }
}

/// Refuses a scene whose contact forces would be left out unasked, while it compiles.
fn refuse_contacts<S: GaussSystem, F: Form<S>>() {
    const {
        assert!(
            !S::HAS_CONTACTS || F::LEAVES_CONTACTS_OUT,
            "the scene has contacts, whose forces accelerations of a batch do not have: leave contacts out on purpose \
             by `without_contacts()`, or take `InMode` of gauss-contact for what holds in closed contacts"
        );
    }
}

#[cfg(feature = "rayon")]
impl<K: ?Sized + Sync, F, I: Sync> Batch<'_, K, F, I> {
    /// [`accelerations`](Self::accelerations) on all threads.
    ///
    /// # Panics
    /// As [`accelerations`](Self::accelerations).
    #[must_use]
    pub fn accelerations_on_all_threads<S>(&self, t: f64, states: &States<S>) -> Packs<S::Speeds>
    where
        S: BatchSystem<Configuration: Sync, Speeds: Send + Sync>,
        K: Kernels<S>,
        F: Form<S>,
        I: InputSource<S>,
    {
        use rayon::prelude::*;

        refuse_contacts::<S, F>();
        let t = S::Scalar::from_f64(t);
        let (kernels, input) = (self.kernels, &self.input);
        let (configurations, speeds) = (states.configurations.blocks(), states.speeds.blocks());
        let blocks = configurations.par_iter().zip(speeds).enumerate().map(|(block, (q, z))| {
            let kernel = kernels.of_block(block);
            kernel.acceleration(t, q, z, &input.input(t, q, z))
        });
        states.speeds.with_blocks(blocks.collect())
    }

    /// [`advance`](Self::advance) on all threads. Threads change no bit.
    ///
    /// # Errors
    /// When states do not reach the end: they stay where they stopped. All others do reach it.
    ///
    /// # Panics
    /// When there are fewer kernels than blocks.
    pub fn advance_on_all_threads<S, M>(
        &self,
        method: &M,
        step: f64,
        interval: Range<f64>,
        states: &mut States<S>,
    ) -> Result<(), BatchError>
    where
        S: BatchSystem<Configuration: Send, Speeds: Send>,
        K: Kernels<S>,
        F: Form<S> + Sync,
        I: InputSource<S>,
        M: OneStep<S> + Sync,
    {
        use rayon::prelude::*;

        let count = states.len();
        let interval = Interval::new(step, interval);
        let blocks = states.configurations.blocks.par_iter_mut().zip(&mut states.speeds.blocks).enumerate();
        let failures =
            blocks.flat_map_iter(|(block, (q, z))| self.advance_block(method, &interval, count, block, (q, z)));
        collect(failures.collect())
    }
}

fn collect(failures: Vec<RunError>) -> Result<(), BatchError> {
    if failures.is_empty() { Ok(()) } else { Err(BatchError { failures }) }
}

/// A source that several blocks ask.
struct Borrowed<'a, I>(&'a I);

impl<S: GaussSystem, I: InputSource<S>> InputSource<S> for Borrowed<'_, I> {
    #[inline(always)]
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.0.input(t, q, z)
    }
}

/// The example of the README is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
