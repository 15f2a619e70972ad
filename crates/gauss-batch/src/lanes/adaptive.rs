//! Embedded pairs in lanes: the decisions of [`Adaptive`] for each of them.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::drive::adaptive::Adaptive;
use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::choice::StepChoice;
use gauss_runtime::integrate::drive::control::check_tolerances;
use gauss_runtime::integrate::drive::logarithms::{exponential, logarithm};
use gauss_runtime::integrate::drive::projection::{accept, check_move};
use gauss_runtime::integrate::drive::search::StepEnds;
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

/// Memory of one lane.
#[derive(Clone, Copy)]
struct AdaptiveLane {
    choice: StepChoice,
    /// Whether the floor is known.
    floored: bool,
    /// Whether the lane makes the present trial, and whether it is to be tried again for where it leads.
    tries: bool,
    leads_away: bool,
}

impl AdaptiveLane {
    /// Whether it tries a step, whose error is small enough.
    fn accepts(&self) -> bool {
        self.tries && !self.choice.rejects()
    }

    fn takes(&self) -> bool {
        self.accepts() && !self.leads_away
    }
}

#[doc(hidden)]
pub struct AdaptiveMemory<S: BatchSystem> {
    lanes: Vec<AdaptiveLane>,
    floor: Option<Floor<S>>,
}

impl<S: BatchSystem> AdaptiveMemory<S> {
    /// The lengths of the steps to try, with their signs and without; lanes that cannot make one are told so.
    #[inline(always)]
    fn lengths(&mut self, group: &mut Group<S>, who: &[bool]) -> (S::Scalar, S::Scalar) {
        let (mut h, mut lengths) = (S::Scalar::zero(), S::Scalar::one());
        let rest = group.end - group.state.t;
        for (n, lane) in self.lanes.iter_mut().enumerate() {
            (lane.tries, lane.leads_away) = (who[n], false);
            if !who[n] {
                continue;
            }
            match lane.choice.propose(group.state.t.extract(n), rest.extract(n)) {
                Ok(signed) => {
                    h.replace(n, &signed);
                    lengths.replace(n, &Real::from_f64(lane.choice.used()));
                }
                Err(kind) => {
                    lane.tries = false;
                    group.verdicts[n] = Verdict::Stopped(StopReason::AnyStep(kind));
                }
            }
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
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.takes()) {
            let made = StepEnds { lane: numbers_of::<S::Scalar>(n).start, before: (&group.state, &group.rates), after };
            lane.leads_away = lane.choice.leads_over_input(problem, &made, tolerance);
            too_long |= lane.leads_away;
        }
        too_long
    }

    /// Looks at where the step of each lane ends; whether it is to end elsewhere in any.
    fn look_at_ends<P: Problem<System = S>>(&mut self, problem: &P, trial: &Trial<'_, S>, moved: &Rates<S>) -> bool {
        let mut too_long = false;
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.takes()) {
            lane.leads_away = lane.choice.ends_beside(problem, trial, moved, numbers_of::<S::Scalar>(n).start);
            too_long |= lane.leads_away;
        }
        too_long
    }

    /// Takes lanes whose step is not taken back to its start; the others are 1.
    #[cold]
    fn hold_back(&self, group: &Group<S>, reached: &mut State<S>, next: &mut Rates<S>) -> S::Scalar {
        let ones = ones_in(|n| self.lanes[n].takes());
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
        let (mut look, mut forget) = (false, false);
        for (part, lanes) in self.lanes.chunks_mut(TOGETHER).enumerate() {
            let excesses = floors.map(|floors| excesses(floors, part * TOGETHER, lanes));
            let (logarithms, growths) = growths(lanes, &excesses);
            for (n, lane) in lanes.iter_mut().enumerate().filter(|(_, lane)| lane.tries) {
                let verdict = &mut group.verdicts[part * TOGETHER + n];
                *verdict = Verdict::Rejected;
                if lane.takes() {
                    let excess = excesses.map_or(0.0, |excesses| excesses[n]);
                    let (taken, again) = lane.choice.take(excess, logarithms[n], growths[n]);
                    forget |= lane.floored;
                    look |= again;
                    lane.floored = again;
                    *verdict = Verdict::Taken(taken, lane.choice.is_last());
                } else if !lane.leads_away {
                    lane.choice.reject();
                }
            }
        }
        if forget {
            self.forget();
        }
        if look {
            self.look(problem, group, |lane| lane.tries && lane.floored);
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
        *value = lane.choice.told(excesses.map_or(0.0, |excesses| excesses[n]));
    }
    // Not `map` of arrays, which compilers leave a call.
    let mut logarithms = [0.0; TOGETHER];
    for n in 0..TOGETHER {
        logarithms[n] = logarithm(values[n]);
    }
    let mut growths = [0.0; TOGETHER];
    for (n, lane) in lanes.iter().enumerate() {
        growths[n] = lane.choice.exponent(logarithms[n]);
    }
    for growth in &mut growths {
        *growth = exponential(*growth);
    }
    (logarithms, growths)
}

impl<M> Sealed for Adaptive<M> {}

impl<S: BatchSystem, M: EstimatingStep<S>> LaneControl<S> for Adaptive<M> {
    type Memory = AdaptiveMemory<S>;

    fn memory(&self, span: f64, _: u64) -> Result<AdaptiveMemory<S>, IntegrationErrorKind> {
        check_tolerances(self.tolerance.relative, self.tolerance.absolute)?;
        let choice = self.choice::<S>(S::SMOOTHNESS, 0.0, span);
        let lane = AdaptiveLane { choice, floored: false, tries: false, leads_away: false };
        Ok(AdaptiveMemory { lanes: vec![lane; S::Scalar::WIDTH], floor: None })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &Group<S>,
        (lane, limit): (usize, u64),
        memory: &mut AdaptiveMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let lanes = (ones_in(|other| other == lane), numbers_of::<S::Scalar>(lane));
        let (from, span) = (number(group.state.t, lane), number(group.end - group.state.t, lane));
        let this = &mut memory.lanes[lane];
        this.choice = self.choice::<S>(problem.system().smoothness(), from, span);
        if core::mem::take(&mut this.floored) {
            memory.forget();
        }
        self.begin_steps(problem, (&group.state, &group.rates), &lanes, limit, &mut memory.lanes[lane].choice)
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
        for (n, lane) in memory.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.tries) {
            look |= lane.choice.judge(largest(errors, n)) && !lane.floored;
        }
        if look {
            // It may be rounding that is too much.
            let asks = |lane: &AdaptiveLane| lane.tries && lane.choice.rejects() && !lane.floored;
            memory.look(problem, group, asks);
            let above = |floor: &Floor<S>| tolerance.errors_above(floor, states, estimates);
            let errors = memory.floor.as_ref().map_or(errors, above);
            for (n, lane) in memory.lanes.iter_mut().enumerate().filter(|(_, lane)| asks(lane)) {
                lane.choice.judge(largest(errors, n));
                lane.floored = true;
            }
        }

        // Lanes that do not take the step stay where they are.
        let all = memory.lanes.iter().all(AdaptiveLane::accepts);
        let ones = if all { S::Scalar::one() } else { ones_in(|n| memory.lanes[n].accepts()) };
        let mut reached = step.state;
        for (n, _) in memory.lanes.iter().enumerate().filter(|(_, lane)| lane.tries && lane.choice.is_last()) {
            reached.t.replace(n, &group.end.extract(n));
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
        let of = (numbers_of::<S::Scalar>(n), group.state.t.extract(n), group.left(n));
        let again = memory.lanes[n].choice.halve(problem, (&group.state, &group.rates), of, kind);
        again.map_or_else(|kind| Verdict::Stopped(StopReason::AnyStep(kind)), |()| Verdict::Rejected)
    }

    fn length(&self, lane: usize, memory: &AdaptiveMemory<S>) -> f64 {
        memory.lanes[lane].choice.length()
    }

    fn passes_over_decay(&self) -> bool {
        self.method.properties().stiff
    }
}
