//! Steps of several states at once.
//!
//! A kernel whose scalar is a pack ([`simd`](gauss_runtime::simd)) gives each lane the bits that it would get alone. It
//! works on all lanes at once; as long as all decide alike their laws are solved in packs as well, else by the stepper
//! of each lane (`together`): so a lane has the bits of a stepper of its own. Lanes that need something else than the
//! others go that step alone: at the start and after impacts, where the step is made twice, where a flight ends, where
//! a step is made again for its speeds, and where it is made in parts.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use crate::error::{ContactError, ContactErrorKind};

use super::impulses;
use super::lane::{Lane, LanesOf, PackedState, Stage, middle_of, packed, single};
use super::motion::{self, Middle};
use super::outcome::Attempt;
use super::projection::{Closed, Projection};
use super::report::{StepReport, StepScheme};
use super::step::{Contacted, Step};
use super::stepper::ContactStepper;
use super::together::Together;
use super::used::Used;

/// As many systems on their way in steps as a pack has lanes, or fewer.
///
/// Both kernels are of the same struct with the same parameters, or lanes of the first have those of their own and
/// steppers have kernels of their own ([`of`](Self::of)).
pub struct ContactLanes<'k, W: LanesOf<K>, K: ContactSystem<Scalar = f64>> {
    wide: &'k W,
    steppers: Vec<ContactStepper<'k, K>>,
    /// Outcome of the last step, lane by lane.
    outcomes: Vec<Result<StepReport, ContactError>>,
    lanes: Vec<Lane<'k, K>>,
    /// The state of all lanes in packs, where the last step was made in lockstep.
    packed: Option<PackedState<W>>,
    /// Memory for the laws of all lanes.
    memory: Vec<W::Scalar>,
    /// Lanes that do not go on.
    halted: Vec<bool>,
    alone: u64,
}

impl<W: LanesOf<K>, K: ContactSystem<Scalar = f64>> core::fmt::Debug for ContactLanes<'_, W, K> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { steppers, outcomes, alone, .. } = self;
        let mut shown = f.debug_struct("ContactLanes");
        shown.field("steppers", steppers).field("outcomes", outcomes).field("alone", alone).finish_non_exhaustive()
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
        let lane = || Lane { stage: Stage::Done, dependent: false, dynamics: None, pushed: None, closed: None };
        let lanes = steppers.iter().map(|_| lane()).collect();
        let halted = steppers.iter().map(|_| false).collect();
        let memory = alloc::vec![W::Scalar::zero(); memory::<W>()];
        Ok(Self { wide, steppers, outcomes, lanes, packed: None, memory, halted, alone: 0 })
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
        self.begin(h);
        let packed = self.packed.take();
        if self.lanes.iter().any(|lane| matches!(lane.stage, Stage::Flies | Stage::Touches)) {
            let state = packed.unwrap_or_else(|| self.pack());
            let half = motion::half_way::<W>(h, &state.q, &self.wide.kinematics(state.t, &state.q, &state.z));
            let z = state.z.add_scaled(W::Scalar::from_f64(0.5 * h), &state.acceleration);
            let middle = Middle::<W>::new((state.t, h), half, state.z, z);
            let end = state.t + W::Scalar::from_f64(h);
            let step = Step { kernel: self.wide, h, end, z: &state.z, middle: &middle };
            self.touch(&step, &state, input);
            self.fly(&step, &state, input);
        }
        for (lane, stepper) in self.steppers.iter_mut().enumerate() {
            if self.lanes[lane].stage == Stage::Alone {
                self.alone += 1;
                stepper.dependent = self.lanes[lane].dependent;
                self.outcomes[lane] = stepper.step(h, &input.extract(lane));
            }
        }
        &self.outcomes
    }

    /// Which lanes go together: those of which the speeds at half of the step are foreseen.
    fn begin(&mut self, h: f64) {
        for (lane, stepper) in self.steppers.iter().enumerate() {
            let is_foreseen = stepper.scheme == StepScheme::Midpoint && stepper.last.acceleration.is_some();
            let stage = match (h > 0.0 && h.is_finite() && is_foreseen && !stepper.last.is_stiff(), stepper.flies()) {
                _ if self.halted[lane] => Stage::Done,
                (false, _) => Stage::Alone,
                (true, true) => Stage::Flies,
                (true, false) => Stage::Touches,
            };
            let dependent = stepper.dependent;
            self.lanes[lane] = Lane { stage, dependent, dynamics: None, pushed: None, closed: None };
        }
    }

    /// The states of all lanes.
    fn pack(&self) -> PackedState<W> {
        let of = |lane: usize| &self.steppers[if lane < self.steppers.len() { lane } else { 0 }];
        let (mut t, mut q) = (W::Scalar::repeat(&of(0).t), W::Configuration::repeat(&of(0).q));
        for lane in 1..self.steppers.len() {
            t.replace(lane, &of(lane).t);
            q.replace(lane, &of(lane).q);
        }
        PackedState {
            t,
            q,
            z: packed::<W, _, _>(|lane| of(lane).z),
            gaps: packed::<W, _, _>(|lane| of(lane).gaps),
            rates: packed::<W, _, _>(|lane| of(lane).rates),
            impulses: packed::<W, _, _>(|lane| of(lane).impulses),
            acceleration: packed::<W, _, _>(|lane| of(lane).last.acceleration.unwrap_or(of(lane).z)),
        }
    }

    /// Decisions of the lanes in a stage, if there are any.
    fn together<'a>(&'a mut self, state: &'a PackedState<W>, stage: Stage) -> Option<Together<'a, 'k, W, K>> {
        let Self { steppers, lanes, memory, .. } = self;
        let in_lockstep = lanes.iter().all(|lane| lane.stage == stage);
        let goes = lanes.iter().any(|lane| lane.stage == stage);
        goes.then_some(Together { steppers, lanes, memory, state, stage, in_lockstep })
    }

    /// Lanes with contacts that may act.
    fn touch(&mut self, step: &Step<W>, state: &PackedState<W>, input: &W::Input) {
        let Some(mut decide) = self.together(state, Stage::Touches) else { return };
        if let Ok(Contacted { pushed, closed, stopped: (z, rates), acceleration }) = step.touching(input, &mut decide) {
            let (Closed { q, gaps, .. }, in_lockstep) = (closed, decide.in_lockstep);
            let end = PackedState { t: step.end, q, z, gaps, rates, impulses: pushed, acceleration };
            self.take(step, end, (Stage::Touches, in_lockstep), input);
        }
    }

    /// Lanes in flight.
    fn fly(&mut self, step: &Step<W>, state: &PackedState<W>, input: &W::Input) {
        let wide = self.wide;
        let Some(mut decide) = self.together(state, Stage::Flies) else { return };
        let Ok(Some(((q, z), acceleration))) = step.flight(input, &mut decide) else { return };
        let gaps = wide.gaps(step.end, &q);
        let below_zero =
            |lane, kernel: &K| ContactStepper::<K>::is_below_zero(kernel, &single::<W, _, K::Gaps>(&gaps, lane));
        if decide.each(|lane, stepper, _| (!below_zero(lane, stepper.kernel)).then_some(())).is_ok() {
            let in_lockstep = decide.in_lockstep;
            let (rates, impulses) = (wide.contact_rates(step.end, &q, &z), W::ContactRows::zero());
            let end = PackedState { t: step.end, q, z, gaps, rates, impulses, acceleration };
            self.take(step, end, (Stage::Flies, in_lockstep), input);
        }
    }

    /// Takes the end of a step in the lanes that are not to make it again, or in parts. The acceleration is that at
    /// half of the step, without contacts.
    fn take(&mut self, step: &Step<W>, end: PackedState<W>, (stage, in_lockstep): (Stage, bool), input: &W::Input) {
        let (h, middle, mut at_mean) = (step.h, step.middle, None);
        let mut goes_on = in_lockstep;
        let each = self.steppers.iter_mut().zip(&mut self.lanes).enumerate();
        for (lane, (stepper, of)) in each.filter(|(_, (_, of))| of.stage == stage) {
            of.stage = Stage::Alone;
            let at_end = (single::<W, _, K::Speeds>(&end.z, lane), single::<W, _, K::ContactRows>(&end.rates, lane));
            let end_of_lane = match (of.pushed.take(), of.closed.take()) {
                (Some(pushed), Some(closed)) => stepper.end(pushed, closed, at_end),
                _ => {
                    let gaps = single::<W, _, K::Gaps>(&end.gaps, lane);
                    ContactStepper::<K>::flown((end.q.extract(lane), at_end.0), gaps, at_end.1)
                }
            };
            let mut made =
                Attempt { end: end_of_lane, acceleration: single::<W, _, K::Speeds>(&end.acceleration, lane) };
            let used = Used {
                h,
                least: stepper.least(h),
                before: stepper.z,
                used: single::<W, _, K::Speeds>(&middle.z, lane),
                acceleration: made.acceleration,
                after: made.end.z,
            };
            let is_smooth = stepper.last.may_stiffen(&used) == Some(false) && !used.is_rough() && !made.end.struck;
            let input_of_lane = || input.extract(lane);
            let agrees = if is_smooth {
                let flies = made.end.flies();
                used.is_plain(flies) || {
                    let mean = motion::mean(step.z, &end.z);
                    let at_mean =
                        at_mean.get_or_insert_with(|| self.wide.acceleration(middle.t, &middle.q, &mean, input));
                    stepper.holds_at_mean(&used, flies, &single::<W, _, K::Speeds>(at_mean, lane))
                }
            } else {
                stepper.is_taken(h, (&middle_of::<W, K>(middle, lane), &made), &input_of_lane())
            };
            let gain = (agrees && made.end.struck).then(|| stepper.gain(h, (&made, false), &input_of_lane()));
            made.end.report.unexplained = gain.as_ref().map_or(0.0, |gain| gain.unexplained);
            if agrees && gain.is_none_or(|gain| gain.is_little()) {
                goes_on &= !made.end.struck;
                self.outcomes[lane] = stepper.made(h, made);
                goes_on &= self.outcomes[lane].is_ok();
                of.stage = Stage::Done;
            } else {
                goes_on = false;
            }
        }
        if goes_on {
            let acceleration = end.z.add_scaled(-W::Scalar::one(), step.z).scale(W::Scalar::from_f64(1.0 / h));
            self.packed = Some(PackedState { acceleration, ..end });
        }
    }
}

/// Number of numbers that the laws of all lanes need.
const fn memory<W: ContactSystem>() -> usize {
    impulses::memory(W::ContactRows::DIM) + Projection::<W>::MEMORY
}
