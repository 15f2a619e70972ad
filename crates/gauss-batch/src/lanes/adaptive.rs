//! Embedded pairs in lanes: the decisions of [`Adaptive`] for each of them.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::drive::adaptive::{Adaptive, ROUNDED};
use gauss_runtime::integrate::drive::cause::{StopReason, change};
use gauss_runtime::integrate::drive::control::{
    StepStatistics, check_tolerances, longest, smallest, to_a_number, unresolved,
};
use gauss_runtime::integrate::drive::logarithms::{exponential, logarithm};
use gauss_runtime::integrate::drive::looks::Looks;
use gauss_runtime::integrate::drive::projection::{AVOIDED, accept, check_move, clear_part, is_hopeless};
use gauss_runtime::integrate::drive::search::StepEnds;
use gauss_runtime::integrate::drive::step_length::StepLength;
use gauss_runtime::integrate::drive::tolerance::{Floor, Tolerance, Trial};
use gauss_runtime::integrate::problem::called_equations::CalledEquations;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::integrate::step::one_step::EstimatingStep;
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use super::system::BatchSystem;
use super::{Group, LaneControl, Sealed, Verdict, chosen_rates, chosen_state, largest, number, numbers_of, ones_in};

/// Memory of one lane: the fields of the same names of a run of its own.
#[derive(Clone, Copy)]
struct AdaptiveLane {
    length: f64,
    lengths: StepLength,
    looks: Looks,
    looked: f64,
    rejected: u32,
    /// Whether the floor is known.
    floored: bool,
    /// Present trial: the length that is tried, whether it is the last, its error.
    used: f64,
    last: bool,
    error: f64,
    /// The length to try in its place, for what acts within it or for where it ends.
    shorter: Option<f64>,
}

impl AdaptiveLane {
    /// Whether the error of the trial is too large.
    fn rejects(&self) -> bool {
        self.error.is_nan() || self.error > self.lengths.limit()
    }
}

#[doc(hidden)]
pub struct AdaptiveMemory<S: BatchSystem> {
    lanes: Vec<AdaptiveLane>,
    floor: Option<Floor<S>>,
    longest: f64,
}

impl<S: BatchSystem> AdaptiveMemory<S> {
    /// The lengths of the steps to try, with their signs and without; lanes that cannot make one are told so.
    #[inline(always)]
    fn lengths(&mut self, group: &mut Group<S>, who: &[bool]) -> (S::Scalar, S::Scalar) {
        let (mut h, mut lengths) = (S::Scalar::zero(), S::Scalar::one());
        let rest = group.end - group.state.t;
        for (n, lane) in self.lanes.iter_mut().enumerate() {
            lane.used = 0.0;
            if !who[n] {
                continue;
            }
            let left = number(rest, n).abs();
            // Stretch by 1 % rather than leave a sliver.
            lane.last = lane.length >= left * 0.99;
            let of = <S::Scalar as Packed>::Single::from_f64;
            let t = group.state.t.extract(n);
            let length = if group.span < 0.0 { -lane.length } else { lane.length };
            let signed = if lane.last { rest.extract(n) } else { to_a_number(t, length) };
            if t + signed == t || !lane.last && lane.length <= smallest::<S::Scalar>(t.lane(0), group.span) {
                let vanishes = unresolved::<S::Scalar>(lane.length, t.lane(0), group.span);
                group.verdicts[n] = Verdict::Stopped(StopReason::AnyStep(vanishes));
                continue;
            }
            lane.used = if lane.last { left } else { lane.length };
            h.replace(n, &signed);
            lengths.replace(n, &of(lane.used));
        }
        (h, lengths)
    }

    /// Measures what rounding does at the state in the lanes that are asked for.
    #[cold]
    #[inline(never)]
    fn look<P: Problem<System = S>>(&mut self, problem: &P, group: &Group<S>, asked: impl Fn(&AdaptiveLane) -> bool) {
        let here = Floor::at(problem, &group.state, &group.rates);
        let ones = ones_in::<S::Scalar>(|lane| asked(&self.lanes[lane]));
        self.floor = Some(self.floor.take().unwrap_or_else(Floor::none).or(ones, &here));
    }

    /// Looks at what acts within the step of each lane that makes a long one; whether it is too long in any.
    #[inline(never)]
    fn look_at_inputs<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        tolerance: &Tolerance,
        group: &Group<S>,
        after: (&State<S>, &Rates<S>),
    ) -> bool {
        let mut too_long = false;
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.used > 0.0 && !lane.rejects()) {
            if lane.shorter.is_none() && lane.looks.want(number(group.state.t, n), lane.used, lane.error) {
                let made =
                    StepEnds { lane: numbers_of::<S::Scalar>(n).start, before: (&group.state, &group.rates), after };
                lane.shorter = lane.looks.unseen(problem, &made, tolerance);
                too_long |= lane.shorter.is_some();
            }
        }
        too_long
    }

    /// Looks at where the step of each lane ends; whether it is to end elsewhere in any.
    fn look_at_ends<P: Problem<System = S>>(&mut self, problem: &P, trial: &Trial<'_, S>, moved: &Rates<S>) -> bool {
        let mut too_long = false;
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.used > 0.0 && !lane.rejects()) {
            if !lane.last && lane.rejected < AVOIDED {
                let part = clear_part(problem, trial, moved, numbers_of::<S::Scalar>(n).start);
                lane.shorter = part.map(|part| lane.used * lane.lengths.stop_before(part));
                too_long |= part.is_some();
            }
        }
        too_long
    }

    /// Takes lanes whose step is not taken back to its start; the others are 1.
    #[cold]
    fn hold_back(&self, group: &Group<S>, reached: &mut State<S>, next: &mut Rates<S>) -> S::Scalar {
        let takes = |lane: &AdaptiveLane| lane.used > 0.0 && !lane.rejects() && lane.shorter.is_none();
        let ones = ones_in(|n| takes(&self.lanes[n]));
        *reached = chosen_state(ones, reached, &group.state);
        *next = chosen_rates(ones, next, &group.rates);
        ones
    }

    /// Forgets the floor in lanes that do not ask for it.
    #[cold]
    #[inline(never)]
    fn forget(&mut self) {
        let known = ones_in::<S::Scalar>(|lane| self.lanes[lane].floored);
        self.floor = match self.floor.take() {
            Some(floor) if self.lanes.iter().any(|lane| lane.floored) => Some(Floor::none().or(known, &floor)),
            _ => None,
        };
    }

    /// The lengths to try next, and what is told of the step, in every lane that tried one.
    #[inline(always)]
    fn judge<P: Problem<System = S>>(&mut self, problem: &P, group: &mut Group<S>, floors: Option<S::Scalar>) {
        let (mut look, mut forget, most) = (false, false, self.longest);
        for (part, lanes) in self.lanes.chunks_mut(TOGETHER).enumerate() {
            let excesses = floors.map(|floors| excesses(floors, part * TOGETHER, lanes));
            let (logarithms, growths) = growths(lanes, &excesses);
            for (n, lane) in lanes.iter_mut().enumerate().filter(|(_, lane)| lane.used > 0.0) {
                let verdict = &mut group.verdicts[part * TOGETHER + n];
                if lane.rejects() {
                    lane.length = lane.used * lane.lengths.reject(lane.error);
                    lane.rejected += 1;
                    *verdict = Verdict::Rejected;
                    continue;
                }
                if let Some(shorter) = lane.shorter.take() {
                    lane.length = shorter;
                    lane.rejected += 1;
                    *verdict = Verdict::Rejected;
                    continue;
                }
                lane.looks.take(lane.error);
                let excess = excesses.map_or(0.0, |excesses| excesses[n]);
                lane.length = (lane.used * lane.lengths.grow(logarithms[n], growths[n])).min(most);
                // Where rounding is in the way it is asked for again, elsewhere when steps have become short.
                let short = lane.length < 0.5 * lane.looked;
                let again = excess > 0.0 || short;
                forget |= lane.floored;
                look |= again;
                lane.floored = again;
                if again {
                    lane.looked = lane.length;
                }
                lane.looked = lane.looked.max(lane.length);
                let rejected = core::mem::take(&mut lane.rejected);
                *verdict = Verdict::Taken(StepStatistics::new(rejected, excess), lane.last);
                // For those that are asked for below.
                lane.used = if again { f64::INFINITY } else { lane.used };
            }
        }
        if forget {
            self.forget();
        }
        if look {
            self.look(problem, group, |lane| lane.used == f64::INFINITY);
        }
    }
}

/// So many lanes have their logarithms and exponentials formed together.
const TOGETHER: usize = 8;

/// Ratios of rounding to the tolerance in some lanes, the first of which is given; 0 where rounding is not more.
#[cold]
#[inline(never)]
fn excesses<T: Real + Packed<Single: Real>>(floors: T, first: usize, lanes: &[AdaptiveLane]) -> [f64; TOGETHER] {
    core::array::from_fn(|n| match lanes.get(n) {
        Some(lane) if lane.floored => Some(largest(floors, first + n)).filter(|&beyond| beyond > 1.0).unwrap_or(0.0),
        _ => 0.0,
    })
}

/// Logarithms of errors, and the factors that the controller makes of them.
#[inline(always)]
fn growths(lanes: &[AdaptiveLane], excesses: &Option<[f64; TOGETHER]>) -> ([f64; TOGETHER], [f64; TOGETHER]) {
    let mut values = [1.0; TOGETHER];
    for (n, (value, lane)) in values.iter_mut().zip(lanes).enumerate() {
        let excess = excesses.map_or(0.0, |excesses| excesses[n]);
        // Well below what rounding does there is nothing to be learnt of the step.
        let told = if excess > 0.0 && lane.error < 0.5 { lane.error.min(ROUNDED) } else { lane.error };
        *value = StepLength::told(told);
    }
    // Not `map` of arrays, which compilers leave a call.
    let mut logarithms = [0.0; TOGETHER];
    for n in 0..TOGETHER {
        logarithms[n] = logarithm(values[n]);
    }
    let mut growths = [0.0; TOGETHER];
    for (n, lane) in lanes.iter().enumerate() {
        growths[n] = lane.lengths.exponent(logarithms[n]);
    }
    for growth in &mut growths {
        *growth = exponential(*growth);
    }
    (logarithms, growths)
}

impl<M> Sealed for Adaptive<M> {}

impl<S: BatchSystem, M: EstimatingStep<S>> LaneControl<S> for Adaptive<M> {
    type Memory = AdaptiveMemory<S>;

    fn memory(&self, span: f64, limit: u64) -> Result<AdaptiveMemory<S>, IntegrationErrorKind> {
        check_tolerances(self.tolerance.relative, self.tolerance.absolute)?;
        Looks::check(self.input_changes)?;
        let longest = if span == 0.0 { 0.0 } else { longest(self.largest_step, span, limit)? };
        let lane = AdaptiveLane {
            length: 0.0,
            lengths: StepLength::new(self.method.estimate_order(), S::SMOOTHNESS),
            looks: Looks::new(self.input_changes, 0.0, span),
            looked: 0.0,
            rejected: 0,
            floored: false,
            used: 0.0,
            last: false,
            error: 0.0,
            shorter: None,
        };
        Ok(AdaptiveMemory { lanes: vec![lane; S::Scalar::WIDTH], floor: None, longest })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &Group<S>,
        (lane, _): (usize, u64),
        memory: &mut AdaptiveMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let lanes = (ones_in(|other| other == lane), numbers_of::<S::Scalar>(lane));
        let start = (&group.state, &group.rates);
        let estimate = || self.first_length(problem, start, &lanes, group.span.signum());
        let first = self.first_step.unwrap_or_else(estimate);
        if !(first.is_finite() && first > 0.0) {
            return Err(IntegrationErrorKind::InvalidStep { step: first });
        }
        let this = &mut memory.lanes[lane];
        this.lengths = StepLength::new(self.method.estimate_order(), problem.system().smoothness());
        (this.length, this.looked, this.rejected) = (first.min(memory.longest), 0.0, 0);
        let span = number(group.end - group.state.t, lane);
        this.looks = Looks::new(self.input_changes, number(group.state.t, lane), span);
        this.shorter = None;
        if core::mem::take(&mut this.floored) {
            memory.forget();
        }
        Ok(())
    }

    #[inline(never)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        memory: &mut AdaptiveMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let (h, lengths) = memory.lengths(group, who);
        let called = CalledEquations(problem);
        let (step, coarse) = self.method.step_and_estimates(&called, &group.state, &group.rates, h)?;
        let tolerance = &self.tolerance;
        let measured = |change: &Rates<S>| problem.change_of_speeds(&step.state, change);
        let (fine, coarse) = (measured(&step.error), coarse.as_ref().map(measured));
        let seen = [&group.state, &step.state].map(|state| problem.in_speeds(state));
        let states = (&seen[0], &seen[1], lengths);
        let estimates = (&fine, coarse.as_ref());
        let errors = match &memory.floor {
            None => {
                let trial = Trial { from: states.0, to: states.1, length: lengths, floor: None };
                tolerance.errors(&trial, estimates.0, estimates.1)
            }
            Some(floor) => tolerance.errors_above(floor, states, estimates),
        };
        let mut look = false;
        for (n, lane) in memory.lanes.iter_mut().enumerate() {
            lane.error = if lane.used > 0.0 { largest(errors, n) } else { 0.0 };
            look |= lane.rejects() && !lane.floored;
        }
        if look {
            // It may be rounding that is too much.
            memory.look(problem, group, |lane| lane.rejects() && !lane.floored);
            let above = |floor: &Floor<S>| tolerance.errors_above(floor, states, estimates);
            let errors = memory.floor.as_ref().map_or(errors, above);
            for (n, lane) in memory.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.rejects() && !lane.floored) {
                (lane.error, lane.floored) = (largest(errors, n), true);
            }
        }

        // Lanes that do not take the step stay where they are.
        let takes = |n: usize| memory.lanes[n].used > 0.0 && !memory.lanes[n].rejects();
        let all = (0..memory.lanes.len()).all(takes);
        let ones = if all { S::Scalar::one() } else { ones_in(takes) };
        let mut reached = step.state;
        for (n, lane) in memory.lanes.iter().enumerate() {
            if lane.last {
                reached.t.replace(n, &group.end.extract(n));
            }
        }
        if !all {
            reached = chosen_state(ones, &reached, &group.state);
        }
        let computed = reached;
        let mut next = accept(problem, (&group.state, &group.rates), &mut reached, step.rates)?;
        let ends = |memory: &mut AdaptiveMemory<S>| {
            let trial = Trial { from: &group.state, to: &reached, length: lengths, floor: None };
            check_move(tolerance, problem, &trial, &computed).map(|moved| memory.look_at_ends(problem, &trial, &moved))
        };
        let mut shorter = S::CONSTRAINED && ends(memory)?;
        shorter |= problem.has_input() && memory.look_at_inputs(problem, tolerance, group, (&reached, &next));
        let (ones, all) = if shorter { (memory.hold_back(group, &mut reached, &mut next), false) } else { (ones, all) };
        let floors = memory.floor.as_ref().map(|floor| {
            let to = &problem.in_speeds(&reached);
            tolerance.excesses(&Trial { from: states.0, to, length: lengths, floor: Some(floor) })
        });
        group.take(ones, all, (reached, next));
        memory.judge(problem, group, floors);
        Ok(())
    }

    #[cold]
    fn failed<P: Problem<System = S>>(
        &self,
        (problem, group): (&P, &Group<S>),
        n: usize,
        kind: IntegrationErrorKind,
        memory: &mut AdaptiveMemory<S>,
    ) -> Verdict {
        let lane = &mut memory.lanes[n];
        lane.length = StepLength::part(&kind) * lane.length.min(group.left(n));
        lane.rejected += 1;
        lane.lengths.fail();
        let moves = change(&group.state, &group.rates, &numbers_of::<S::Scalar>(n)) * lane.length;
        let still = moves > 0.0 && moves < 0.5 * S::Scalar::EPSILON;
        let t = group.state.t.extract(n);
        let h = <S::Scalar as Packed>::Single::from_f64(if group.span < 0.0 { -lane.length } else { lane.length });
        let vanishes = lane.length <= smallest::<S::Scalar>(t.lane(0), group.span) || t + h == t;
        let hopeless = || is_hopeless(problem, &group.state, numbers_of::<S::Scalar>(n), (&kind, lane.rejected));
        if still || vanishes || hopeless() { Verdict::Stopped(StopReason::AnyStep(kind)) } else { Verdict::Rejected }
    }

    fn length(&self, lane: usize, memory: &AdaptiveMemory<S>) -> f64 {
        memory.lanes[lane].length
    }

    fn passes_over_decay(&self) -> bool {
        self.method.properties().stiff
    }
}
