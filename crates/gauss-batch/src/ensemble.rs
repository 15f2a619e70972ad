//! Many runs with steps of their own, and how each of them ended.

use alloc::vec::Vec;
use core::ops::Range;

use gauss_runtime::integrate::drive::event::{Events, JumpFunction, NoEvents, Watched};
use gauss_runtime::integrate::{Adaptive, Crossing, DEFAULT_LIMIT, Form, Sample, SystemProblem, Taylor};
use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

use crate::input::{LaneInput, LaneSource};
use crate::lanes::run::{InLanes, Runs};
use crate::lanes::{BatchSystem, LaneControl, RunOutcome, SingleConfiguration, SingleSpeeds};
use crate::packs::States;
use crate::{Batch, Kernels};

/// Many runs over one interval, in lanes and on threads, each with steps and an end of its own.
///
/// Every run takes the steps that it would take alone and is told of by itself: one that ends early or fails does not
/// hold up the others, its lane is handed to the next. Where all states share a kernel ([`Batch::new`]) that is the
/// next state whichever block it is in; where each has parameters of its own ([`Batch::each`]), lanes belong to their
/// states.
///
/// Throws until they hit the ground, at speeds that differ:
///
/// ```
/// use gauss_batch::{Batch, States};
/// use gauss_runtime::prelude::*;
///
/// /// A point with weight and drag.
/// #[derive(GaussDynamics)]
/// #[gauss(
///     coordinates(x, z),
///     particle(mass = mass, position = [x, 0, z]),
///     damping = drag / 2 * (rate(x) * rate(x) + rate(z) * rate(z)),
/// )]
/// struct Point<T> {
///     mass: T,
///     drag: T,
///     #[gauss(gravity)] g: T,
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// type Eight = Lanes<f64, 8>;
/// let number = Eight::splat;
/// let kernel = Point { mass: number(0.2), drag: number(0.01), g: number(9.81) }.kernel()?;
/// let speed = |i: usize| 1.0 + 0.1 * i as f64;
/// let start = |i: usize| (SVector::from([0.0, 1.0]), SVector::from([speed(i), speed(i)]));
/// let mut states = States::<PointKernel<Eight>>::from_fn(100, start);
/// let ends = Batch::new(&kernel)
///     .adaptive(1e-10, 1e-10)
///     .until(Crossing::Falling, |_t, q, _z| q[1])
///     .run(0.0..60.0, &mut states);
/// for (i, end) in ends.into_iter().enumerate() {
///     let end = end?; // or why this one failed
///     let (q, _) = states.get(i);
///     assert!(end.stopped_by == Some(0) && q[1].abs() < 1e-9 && q[0] < speed(i) * end.time);
/// }
/// # Ok(())
/// # }
/// ```
#[must_use = "an ensemble does nothing before `run`"]
pub struct Ensemble<'k, K: ?Sized, F, I, C, E = NoEvents> {
    batch: Batch<'k, K, F, I>,
    control: C,
    events: E,
    limit: u64,
    progress: Option<&'k (dyn Fn(usize) + Sync)>,
}

impl<'k, K: ?Sized, F, I> Batch<'k, K, F, I> {
    /// Steps as long as the tolerances allow, of each state by itself, by
    /// [`RungeKutta`](gauss_runtime::integrate::RungeKutta) of order 8 (Dormand and Prince): see [`Adaptive::new`].
    pub fn adaptive(self, relative: f64, absolute: f64) -> Ensemble<'k, K, F, I, Adaptive> {
        self.control(Adaptive::new(relative, absolute))
    }

    /// Taylor's method: steps of each state by itself, series of one order for the states of a block.
    pub fn taylor(self, relative: f64, absolute: f64) -> Ensemble<'k, K, F, I, Taylor> {
        self.control(Taylor::new(relative, absolute))
    }

    /// Any method that chooses or counts its steps in every lane, a [`LaneControl`]: also steps of one length, where
    /// runs end at events or fail, by methods that remember earlier ones (`Adams::<_, 10>::new(Pack::splat(0.02))`)
    /// or by a closed form (`Fixed::by(…, Pack::splat(100.0))`).
    pub fn control<C>(self, control: C) -> Ensemble<'k, K, F, I, C> {
        Ensemble { batch: self, control, events: NoEvents, limit: DEFAULT_LIMIT, progress: None }
    }
}

impl<'k, K: ?Sized, F, I, C, E> Ensemble<'k, K, F, I, C, E> {
    /// The most steps of a run (rejected ones included) before it is given up, instead of [`DEFAULT_LIMIT`].
    pub fn max_steps(mut self, limit: u64) -> Self {
        self.limit = limit;
        self
    }

    /// Calls a function with the number of each state whose run has ended, however it did, in the thread that carried
    /// it.
    pub fn progress(mut self, ended: &'k (dyn Fn(usize) + Sync)) -> Self {
        self.progress = Some(ended);
        self
    }

    /// Finds the states in which a function of time and state passes through zero, in every run by itself: see
    /// [`Simulation::event`](gauss_runtime::integrate::Simulation::event). The function is one of whole packs.
    pub fn event<S, G>(self, crossing: Crossing, function: G) -> Ensemble<'k, K, F, I, C, Watched<E, G>>
    where
        S: GaussSystem,
        K: Kernels<S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.watch(|events| Watched::after(events, crossing, false, function))
    }

    /// Ends a run at the first such state: [`Ended::stopped_by`](crate::Ended) tells whether it came to that.
    pub fn until<S, G>(self, crossing: Crossing, function: G) -> Ensemble<'k, K, F, I, C, Watched<E, G>>
    where
        S: GaussSystem,
        K: Kernels<S>,
        G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    {
        self.watch(|events| Watched::after(events, crossing, true, function))
    }

    fn watch<D>(self, watched: impl FnOnce(E) -> D) -> Ensemble<'k, K, F, I, C, D> {
        self.map_parts(|input| input, watched)
    }

    /// Replaces the input and the events.
    pub(crate) fn map_parts<J, D>(
        self,
        fed: impl FnOnce(I) -> J,
        watched: impl FnOnce(E) -> D,
    ) -> Ensemble<'k, K, F, J, C, D> {
        let Self { batch, control, events, limit, progress } = self;
        let Batch { kernels, form, input } = batch;
        let batch = Batch { kernels, form, input: fed(input) };
        Ensemble { batch, control, events: watched(events), limit, progress }
    }
}

impl<'k, K: ?Sized, F, I, M, E> Ensemble<'k, K, F, I, Adaptive<M>, E> {
    /// The length of the first step of every run, instead of an estimate.
    pub fn first_step(mut self, length: f64) -> Self {
        self.control = self.control.first_step(length);
        self
    }

    /// The longest step.
    pub fn largest_step(mut self, length: f64) -> Self {
        self.control = self.control.largest_step(length);
        self
    }
}

impl<'k, K: ?Sized, F, I, C, E, G> Ensemble<'k, K, F, I, C, Watched<E, G>> {
    /// Changes the state at the event that was added last, as
    /// [`Simulation::then`](gauss_runtime::integrate::Simulation::then) does. The function sees a whole pack; what it
    /// makes of the lanes of other runs is dropped.
    pub fn then<S, J>(self, jump: J) -> Ensemble<'k, K, F, I, C, Watched<E, G, JumpFunction<J>>>
    where
        S: GaussSystem,
        K: Kernels<S>,
        J: FnMut(&mut Sample<S>),
    {
        self.watch(|events| events.then(jump, false))
    }

    /// Changes the state where the function may go on through zero, as
    /// [`Simulation::then_through`](gauss_runtime::integrate::Simulation::then_through) does.
    pub fn then_through<S, J>(self, jump: J) -> Ensemble<'k, K, F, I, C, Watched<E, G, JumpFunction<J>>>
    where
        S: GaussSystem,
        K: Kernels<S>,
        J: FnMut(&mut Sample<S>),
    {
        self.watch(|events| events.then(jump, true))
    }
}

impl<'k, K: ?Sized, F, I, C, E> Ensemble<'k, K, F, I, C, E> {
    /// Carries all states over the interval, which may run backwards. The result has the end of each run, in the order
    /// of the states, which are then the last good ones.
    ///
    /// # Panics
    /// When there are fewer kernels than blocks.
    #[must_use = "runs may have failed"]
    pub fn run<S, Kind>(&self, interval: Range<f64>, states: &mut States<S>) -> Vec<RunOutcome<S>>
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: LaneInput<S, Kind>,
        C: LaneControl<S>,
        E: Events<S> + Clone,
    {
        let (count, blocks) = (states.len(), states.configurations.blocks.len());
        let size = if K::SHARED { blocks.max(1) } else { 1 };
        let configurations = states.configurations.blocks.chunks_mut(size);
        let parts = configurations.zip(states.speeds.blocks.chunks_mut(size)).enumerate();
        parts.flat_map(|(part, blocks)| self.carry(&interval, (count, part * size), blocks)).collect()
    }

    /// [`run`](Self::run) on all threads. Threads change no bit that lanes do not.
    ///
    /// # Panics
    /// When there are fewer kernels than blocks.
    #[cfg(feature = "rayon")]
    #[must_use = "runs may have failed"]
    pub fn run_on_all_threads<S, Kind>(&self, interval: Range<f64>, states: &mut States<S>) -> Vec<RunOutcome<S>>
    where
        S: BatchSystem<Configuration: Packed<Single: Send> + Send, Speeds: Packed<Single: Send> + Send>,
        K: Kernels<S> + Sync,
        F: Form<S> + Sync,
        I: LaneInput<S, Kind> + Sync,
        C: LaneControl<S> + Sync,
        E: Events<S> + Clone + Sync,
    {
        use rayon::prelude::*;

        /// Parts for each thread, so that no thread waits long for another, and the most blocks of a part.
        const PARTS: usize = 4;
        const MOST: usize = 64;

        let (count, blocks) = (states.len(), states.configurations.blocks.len());
        let fair = blocks.div_ceil(PARTS * rayon::current_num_threads());
        let size = if K::SHARED { fair.clamp(1, MOST) } else { 1 };
        let configurations = states.configurations.blocks.par_chunks_mut(size);
        let parts = configurations.zip(states.speeds.blocks.par_chunks_mut(size)).enumerate();
        parts.flat_map_iter(|(part, blocks)| self.carry(&interval, (count, part * size), blocks)).collect()
    }

    /// The runs of some blocks, the number of the first of which is `block`.
    fn carry<S, Kind>(
        &self,
        interval: &Range<f64>,
        (count, block): (usize, usize),
        (q, z): (&mut [S::Configuration], &mut [S::Speeds]),
    ) -> Vec<RunOutcome<S>>
    where
        S: BatchSystem,
        K: Kernels<S>,
        F: Form<S>,
        I: LaneInput<S, Kind>,
        C: LaneControl<S>,
        E: Events<S> + Clone,
    {
        let batch = &self.batch;
        let input = LaneSource::<S, I, Kind> { input: &batch.input, room: I::room() };
        let problem = SystemProblem { system: batch.kernels.of_block(block), form: batch.form, input };
        let hold = |lane: usize, input: &S::Input| I::hold(&problem.input.room, lane, input);
        let in_lanes = InLanes {
            control: &self.control,
            problem: &problem,
            events: &self.events,
            times: (interval.start, interval.end),
            limit: self.limit,
            hold: &hold,
        };
        let first = block * S::Scalar::WIDTH;
        let states = (count - first).min(q.len() * S::Scalar::WIDTH);
        let ends = (0..states).map(|_| None).collect();
        let mut part = Part { q, z, first, next: 0, last: first + states == count, ends, progress: self.progress };
        in_lanes.carry(&mut part);
        part.ends.into_iter().flatten().collect()
    }
}

/// Some blocks of states, in the place of which their ends are put.
struct Part<'a, S: BatchSystem> {
    q: &'a mut [S::Configuration],
    z: &'a mut [S::Speeds],
    /// The number of the first state.
    first: usize,
    /// Place among these states of the one to start next.
    next: usize,
    /// Whether the last state of all is here, which the rest of its block repeats.
    last: bool,
    ends: Vec<Option<RunOutcome<S>>>,
    progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

impl<S: BatchSystem> Runs<S> for Part<'_, S> {
    fn next(&mut self) -> Option<(usize, SingleConfiguration<S>, SingleSpeeds<S>)> {
        let n = self.next;
        self.next += 1;
        let (block, lane) = (n / S::Scalar::WIDTH, n % S::Scalar::WIDTH);
        (n < self.ends.len()).then(|| (self.first + n, self.q[block].extract(lane), self.z[block].extract(lane)))
    }

    fn end(&mut self, run: usize, (q, z): (SingleConfiguration<S>, SingleSpeeds<S>), how: RunOutcome<S>) {
        let n = run - self.first;
        let (block, lane) = (n / S::Scalar::WIDTH, n % S::Scalar::WIDTH);
        let lanes = if self.last && n + 1 == self.ends.len() { lane..S::Scalar::WIDTH } else { lane..lane + 1 };
        for lane in lanes {
            self.q[block].replace(lane, &q);
            self.z[block].replace(lane, &z);
        }
        self.ends[n] = Some(how);
        if let Some(progress) = self.progress {
            progress(run);
        }
    }
}
