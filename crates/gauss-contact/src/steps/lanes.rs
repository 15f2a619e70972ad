//! Steps of several states at once, in lockstep.
//!
//! A kernel whose scalar is a pack ([`simd`](gauss_runtime::simd)) gives each lane the bits that it would get alone. As
//! long as all lanes decide alike a step is made in packs from end to end (`together`). Where they do not, the kernel
//! still works on all lanes at once, and the laws of that step are solved by the stepper of each lane: so a lane has
//! the bits of a stepper of its own. Lanes that need something else than the others go that step alone: at the start
//! and after impacts, where the step is made twice, where a flight ends, where a step is made again for its speeds, and
//! where it is made in parts.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, ImpulseResponse};
use gauss_runtime::integrate::problem::state::TangentOf;
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

use crate::error::{ContactError, ContactErrorKind};
use crate::mode::Mode;

use super::impulses;
use super::motion::Middle;
use super::outcome::{Attempt, Pushed, Solved};
use super::projection::{Closed, Projection};
use super::report::StepReport;
use super::stepper::ContactStepper;

/// A system in packs, each lane of which is the system `K`: `Kernel<wide::f64x8>` of a struct that is generic in its
/// scalar, of which `K` is `Kernel<f64>`.
pub trait LanesOf<K: ContactSystem<Scalar = f64>>:
    ContactSystem<
        Scalar: Packed<Single = f64>,
        Configuration: Packed<Single = K::Configuration>,
        Input: Packed<Single = K::Input>,
        ImpulseFactors: Packed<Single = K::ImpulseFactors>,
        Delassus: Packed<Single = K::Delassus>,
    >
{
}

impl<W, K: ContactSystem<Scalar = f64>> LanesOf<K> for W where
    W: ContactSystem<
            Scalar: Packed<Single = f64>,
            Configuration: Packed<Single = K::Configuration>,
            Input: Packed<Single = K::Input>,
            ImpulseFactors: Packed<Single = K::ImpulseFactors>,
            Delassus: Packed<Single = K::Delassus>,
        >
{
}

/// As many systems on their way in steps as a pack has lanes, or fewer.
///
/// Both kernels are of the same struct with the same parameters, or lanes of the first have those of their own and
/// steppers have kernels of their own ([`of`](Self::of)).
pub struct ContactLanes<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> {
    pub(super) wide: &'k W,
    pub(super) steppers: Vec<ContactStepper<'k, K>>,
    /// Outcome of the last step, lane by lane.
    pub(super) outcomes: Vec<Result<StepReport, ContactError>>,
    /// Progress of the lanes in a step.
    stages: Vec<Stage<K>>,
    /// Responses to impulses, in lanes that solve their laws alone: large, so that they stay where they are.
    responses: Vec<Option<ImpulseResponse<K>>>,
    /// The state of all lanes in packs, where the last step was made in packs.
    pub(super) packed: Option<PackedState<W>>,
    /// The modes after a step in packs, and what the laws came to, lane by lane.
    pub(super) solved: Vec<(K::EachContact<Mode>, Solved<K>)>,
    /// Memory for the laws of all lanes.
    pub(super) memory: Vec<W::Scalar>,
    /// Whether contacts of a lane depended on one another before the step.
    known: Vec<bool>,
    /// Lanes that do not go on.
    pub(super) halted: Vec<bool>,
    alone: u64,
}

impl<W: LanesOf<K>, K: ContactSystem<Scalar = f64>> core::fmt::Debug for ContactLanes<'_, W, K> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { steppers, outcomes, alone, .. } = self;
        let mut shown = f.debug_struct("ContactLanes");
        shown.field("steppers", steppers).field("outcomes", outcomes).field("alone", alone).finish_non_exhaustive()
    }
}

/// The states of all lanes, which steppers have as well.
pub(super) struct PackedState<W: ContactSystem> {
    pub(super) t: W::Scalar,
    pub(super) q: W::Configuration,
    pub(super) z: W::Speeds,
    pub(super) gaps: W::Gaps,
    pub(super) rates: W::ContactRows,
    pub(super) impulses: W::ContactRows,
    pub(super) acceleration: W::Speeds,
}

/// State at which forces were taken, and the acceleration by them.
type Forces<K> = (Middle<K>, <K as GaussSystem>::Speeds);

/// Progress of a lane in a step.
enum Stage<K: ContactSystem<Scalar = f64>> {
    /// It goes this step alone.
    Alone,
    /// The step is made.
    Made,
    /// It has the speeds at half of the step.
    Middle(Middle<K>),
    /// The same in flight.
    Flies(Middle<K>),
    /// It has the speeds at the end of a flight.
    Flown(Forces<K>, K::Speeds),
    /// At the end of a flight.
    Lands(Forces<K>, K::Configuration, K::Speeds, K::Gaps),
    /// It has impulses.
    Pushed(Forces<K>, Pushed<K>),
    /// At the end, before closed gaps are zero.
    Open(Forces<K>, K::Configuration, K::Speeds, Pushed<K>),
    /// It has closed gaps at zero.
    Closed(Forces<K>, Closed<K>, K::Speeds, Pushed<K>),
}

impl<K: ContactSystem<Scalar = f64>> core::fmt::Debug for Stage<K> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Alone => "Alone",
            Self::Made => "Made",
            Self::Middle(..) => "Middle",
            Self::Flies(..) => "Flies",
            Self::Flown(..) => "Flown",
            Self::Lands(..) => "Lands",
            Self::Pushed(..) => "Pushed",
            Self::Open(..) => "Open",
            Self::Closed(..) => "Closed",
        })
    }
}

impl<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> ContactLanes<'k, W, K> {
    /// Steppers that go on together, at most as many as there are lanes; a kernel of each must have the parameters of
    /// its lane in `wide`. All have the same scheme and law or not, as they like.
    ///
    /// # Errors
    /// `Lanes` where there are none or more than lanes.
    pub fn of(wide: &'k W, steppers: Vec<ContactStepper<'k, K>>) -> Result<Self, ContactError> {
        let lanes = W::Scalar::WIDTH;
        if steppers.is_empty() || steppers.len() > lanes {
            let kind = ContactErrorKind::Lanes { lanes, given: steppers.len() };
            return Err(ContactError { contact: None, time: 0.0, kind });
        }
        let outcomes = steppers.iter().map(|_| Ok(StepReport::default())).collect();
        let (stages, known) = (Vec::with_capacity(steppers.len()), Vec::with_capacity(steppers.len()));
        let halted = steppers.iter().map(|_| false).collect();
        let responses = steppers.iter().map(|_| None).collect();
        let memory = alloc::vec![W::Scalar::zero(); memory::<W>()];
        let solved = Vec::with_capacity(steppers.len());
        let (packed, alone) = (None, 0);
        Ok(Self { wide, steppers, outcomes, stages, responses, packed, solved, memory, known, halted, alone })
    }

    /// The steppers, lane by lane.
    pub fn steppers(&self) -> &[ContactStepper<'k, K>] {
        &self.steppers
    }

    /// Number of steps of lanes that were made alone, in all.
    pub fn alone(&self) -> u64 {
        self.alone
    }

    /// The error of the last step of a lane that goes on.
    pub(super) fn fails(&self, lane: usize) -> Option<ContactError> {
        self.outcomes[lane].as_ref().err().filter(|_| !self.halted[lane]).cloned()
    }

    /// Keeps a lane where it is from now on: its outcome stays.
    pub fn halt(&mut self, lane: usize) {
        self.halted[lane] = true;
    }

    /// One step of length `h` of all lanes, under inputs that stay; what it came to, lane by lane: as of
    /// [`ContactStepper::step`], bit by bit. A lane whose step is an error stays where it was.
    pub fn step(&mut self, h: f64, input: &W::Input) -> &[Result<StepReport, ContactError>] {
        if self.step_together(h, input).is_some() {
            return &self.outcomes;
        }
        self.packed = None;
        self.start(h);
        if self.stages.iter().any(|stage| matches!(stage, Stage::Middle(_) | Stage::Flies(_))) {
            self.push(h, input);
            self.fly(h, input);
            self.second_half(h);
            self.close(h);
            self.end(h, input);
        }
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            if matches!(self.stages[lane], Stage::Alone) {
                self.alone += 1;
                stepper.dependent = self.known[lane];
                self.outcomes[lane] = stepper.step(h, &input.extract(lane));
            }
        }
        &self.outcomes
    }

    /// A number of each lane; those without one repeat that of the first.
    pub(super) fn number(&self, of: impl Fn(usize) -> f64) -> W::Scalar {
        let mut pack = W::Scalar::repeat(&of(0));
        (1..self.steppers.len()).for_each(|lane| pack.replace(lane, &of(lane)));
        pack
    }

    pub(super) fn places(&self, of: impl Fn(usize) -> K::Configuration) -> W::Configuration {
        let mut pack = W::Configuration::repeat(&of(0));
        (1..self.steppers.len()).for_each(|lane| pack.replace(lane, &of(lane)));
        pack
    }

    fn speeds(&self, of: impl Fn(usize) -> K::Speeds) -> W::Speeds {
        self.vectors(of)
    }

    /// The numbers of all lanes; those without one repeat the first.
    pub(super) fn vectors<V: VectorSpace<f64>, P: VectorSpace<W::Scalar>>(&self, of: impl Fn(usize) -> V) -> P {
        let mut pack = P::zero();
        for lane in 0..W::Scalar::WIDTH {
            let vector = of(if lane < self.steppers.len() { lane } else { 0 });
            put::<W, _, _>(&mut pack, lane, &vector);
        }
        pack
    }

    /// Half of the step, of lanes that go together.
    fn start(&mut self, h: f64) {
        self.stages.clear();
        self.known.clear();
        self.known.extend(self.steppers.iter().map(|stepper| stepper.dependent));
        let Self { steppers, stages, halted, .. } = self;
        let stage = |halted: &bool| if *halted { Stage::Made } else { Stage::Alone };
        stages.extend(halted.iter().map(stage));
        let together = |lane: usize| !halted[lane] && h > 0.0 && h.is_finite();
        if !(0..steppers.len()).any(together) {
            return;
        }
        let t = self.number(|lane| self.steppers[lane].t);
        let q = self.places(|lane| self.steppers[lane].q);
        let z = self.speeds(|lane| self.steppers[lane].z);
        let rates = self.wide.kinematics(t, &q, &z);
        let Self { steppers, stages, halted, .. } = self;
        for (lane, (stepper, stage)) in steppers.iter().zip(stages).enumerate() {
            if !halted[lane]
                && !stepper.last.is_stiff()
                && let (middle, true) = stepper.middle(h, &single::<W, _, TangentOf<K>>(&rates, lane))
            {
                *stage = if stepper.flies() { Stage::Flies(middle) } else { Stage::Middle(middle) };
            }
        }
    }

    /// The state of a lane at half of the step; of one that goes alone that before it.
    fn middle(&self, lane: usize) -> (f64, K::Configuration, K::Speeds) {
        match &self.stages[lane] {
            Stage::Middle(middle) | Stage::Flies(middle) => (middle.t, middle.q, middle.z),
            Stage::Flown((middle, _), z) => (middle.t, middle.q, *z),
            Stage::Pushed((middle, _), pushed) => (middle.t, middle.q, pushed.z),
            _ => (self.steppers[lane].t, self.steppers[lane].q, self.steppers[lane].z),
        }
    }

    fn middles(&self) -> (W::Scalar, W::Configuration, W::Speeds) {
        (
            self.number(|lane| self.middle(lane).0),
            self.places(|lane| self.middle(lane).1),
            self.speeds(|lane| self.middle(lane).2),
        )
    }

    /// Flights, as far as their speeds at the end.
    fn fly(&mut self, h: f64, input: &W::Input) {
        if !self.stages.iter().any(|stage| matches!(stage, Stage::Flies(_))) {
            return;
        }
        let (t, q, z) = self.middles();
        let accelerations = self.wide.acceleration(t, &q, &z, input);
        for (lane, stepper) in self.steppers.iter().enumerate() {
            self.stages[lane] = match core::mem::replace(&mut self.stages[lane], Stage::Alone) {
                Stage::Flies(middle) => {
                    let acceleration = single::<W, _, K::Speeds>(&accelerations, lane);
                    Stage::Flown((middle, acceleration), stepper.z.add_scaled(h, &acceleration))
                }
                other => other,
            };
        }
        let (t, q, _) = self.middles();
        let mean = self.speeds(|lane| match &self.stages[lane] {
            Stage::Flown(_, z) => self.steppers[lane].mean_of_flight(z),
            _ => self.steppers[lane].z,
        });
        let rates = self.wide.contact_rates(t, &q, &mean);
        for (lane, stepper) in self.steppers.iter().enumerate() {
            let flown = matches!(self.stages[lane], Stage::Flown(..));
            if flown && stepper.comes_to_zero(h, &single::<W, _, K::ContactRows>(&rates, lane)) {
                self.stages[lane] = Stage::Alone;
            }
        }
    }

    /// Impulses, by the laws of each lane.
    fn push(&mut self, h: f64, input: &W::Input) {
        if !self.stages.iter().any(|stage| matches!(stage, Stage::Middle(_))) {
            return;
        }
        let (t, q, z) = self.middles();
        let friction = self.wide.friction(t, &q, &z, input);
        let dynamics = self.wide.impulse_dynamics(t, &q, &z, input);
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            let middle = match core::mem::replace(&mut self.stages[lane], Stage::Alone) {
                Stage::Middle(middle) => middle,
                other => {
                    self.stages[lane] = other;
                    continue;
                }
            };
            let friction = single::<W, _, K::ContactRows>(&friction, lane);
            let acceleration = single::<W, _, K::Speeds>(&dynamics.acceleration, lane);
            let bias = single::<W, _, K::ContactRows>(&dynamics.bias, lane);
            let response = self.responses[lane].insert(ImpulseResponse::new(
                dynamics.response.factors.extract(lane),
                dynamics.response.delassus.extract(lane),
            ));
            // Where it has no solution it is tried in parts, alone.
            if let Ok(pushed) = stepper.push(h, &middle, &friction, (&acceleration, &bias, response)) {
                self.stages[lane] = Stage::Pushed((middle, acceleration), pushed);
            }
        }
    }

    fn second_half(&mut self, h: f64) {
        let (t, q, z) = self.middles();
        let rates = self.wide.kinematics(t, &q, &z);
        for (lane, stepper) in self.steppers.iter().enumerate() {
            let rate = single::<W, _, TangentOf<K>>(&rates, lane);
            let half = |middle: &Middle<K>, z: K::Speeds| stepper.second_half(h, middle, (z, &rate));
            self.stages[lane] = match core::mem::replace(&mut self.stages[lane], Stage::Alone) {
                Stage::Pushed(forces, pushed) => match half(&forces.0, pushed.z) {
                    Ok((q, z)) => Stage::Open(forces, q, z, pushed),
                    Err(_) => Stage::Alone,
                },
                Stage::Flown(forces, z) => match half(&forces.0, z) {
                    Ok((q, z)) => Stage::Lands(forces, q, z, K::Gaps::zero()),
                    Err(_) => Stage::Alone,
                },
                other => other,
            };
        }
    }

    /// The end of a step as far as it is known.
    fn place(&self, lane: usize) -> (K::Configuration, K::Speeds) {
        match &self.stages[lane] {
            Stage::Open(_, q, z, _) | Stage::Lands(_, q, z, _) => (*q, *z),
            Stage::Closed(_, closed, z, _) => (closed.q, *z),
            _ => (self.steppers[lane].q, self.steppers[lane].z),
        }
    }

    fn close(&mut self, h: f64) {
        let t = self.number(|lane| self.steppers[lane].t + h);
        let q = self.places(|lane| self.place(lane).0);
        let gaps = self.wide.gaps(t, &q);
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            let gaps = single::<W, _, K::Gaps>(&gaps, lane);
            let response = &self.responses[lane];
            self.stages[lane] = match (core::mem::replace(&mut self.stages[lane], Stage::Alone), response) {
                (Stage::Open(forces, q, z, mut pushed), Some(response)) => {
                    match stepper.close(h, (response, &mut pushed), (q, gaps)) {
                        Ok(closed) => Stage::Closed(forces, closed, z, pushed),
                        Err(_) => Stage::Alone,
                    }
                }
                (Stage::Lands(..), _) if ContactStepper::<K, Vec<f64>>::is_below_zero(stepper.kernel, &gaps) => {
                    Stage::Alone
                }
                (Stage::Lands(forces, q, z, _), _) => Stage::Lands(forces, q, z, gaps),
                (other, _) => other,
            };
        }
    }

    fn end(&mut self, h: f64, input: &W::Input) {
        let t = self.number(|lane| self.steppers[lane].t + h);
        let q = self.places(|lane| self.place(lane).0);
        let z = self.speeds(|lane| self.place(lane).1);
        let rates = self.wide.contact_rates(t, &q, &z);
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            let rates = single::<W, _, K::ContactRows>(&rates, lane);
            let stage = core::mem::replace(&mut self.stages[lane], Stage::Alone);
            let ((middle, acceleration), end) = match (stage, &self.responses[lane]) {
                (Stage::Closed(forces, closed, z, pushed), Some(response)) => {
                    let (z, rates) = stepper.stop(h, (response, &pushed), &closed, (z, rates));
                    (forces, stepper.end(pushed, closed, (z, rates)))
                }
                (Stage::Lands(forces, q, z, gaps), _) => {
                    (forces, ContactStepper::<K, Vec<f64>>::flown((q, z), gaps, rates))
                }
                (other, _) => {
                    self.stages[lane] = other;
                    continue;
                }
            };
            let (mut made, input) = (Attempt { end, acceleration }, input.extract(lane));
            // A step that is made again, or in parts, goes alone.
            let agrees = !stepper.stiffens(h, (&middle, &made), &input)
                && stepper.steep(h, (&middle, &made), &input).is_none()
                && stepper.strikes_stiffly(h, (&middle, &made), &input).is_none()
                && stepper.agrees(h, (&middle, &made), &input);
            let gain = (agrees && made.end.struck).then(|| stepper.gain(h, (&made, false), &input));
            made.end.report.unexplained = gain.as_ref().map_or(0.0, |gain| gain.unexplained);
            if agrees && gain.is_none_or(|gain| gain.is_little()) {
                self.outcomes[lane] = stepper.made(h, made);
                self.stages[lane] = Stage::Made;
            }
        }
    }
}

/// Number of numbers that the laws of all lanes need.
const fn memory<W: ContactSystem>() -> usize {
    impulses::memory(W::ContactRows::DIM) + Projection::<W>::MEMORY
}

/// The numbers of a lane.
pub(super) fn single<W: ContactSystem<Scalar: Packed<Single = f64>>, V: VectorSpace<W::Scalar>, U: VectorSpace<f64>>(
    pack: &V,
    lane: usize,
) -> U {
    let mut one = U::zero();
    (0..U::DIM).for_each(|i| one.set_component(i, pack.component(i).extract(lane)));
    one
}

/// The numbers of a lane, replaced.
pub(super) fn put<W: ContactSystem<Scalar: Packed<Single = f64>>, V: VectorSpace<W::Scalar>, U: VectorSpace<f64>>(
    pack: &mut V,
    lane: usize,
    one: &U,
) {
    for i in 0..V::DIM {
        let mut number = pack.component(i);
        number.replace(lane, &one.component(i));
        pack.set_component(i, number);
    }
}
