//! Taylor's method in lanes: one order for all, a length of step for each.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::control::{check_tolerances, longest, smallest, to_a_number, unresolved};
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::{IntegrationErrorKind, RunPart};
use gauss_runtime::integrate::taylor::{Order, ShortenedStep, Taylor, expanded, summed};
use gauss_runtime::real::Real;
use gauss_runtime::series::{PowerSeries, TaylorSystem};
use gauss_runtime::simd::Packed;

use super::system::BatchSystem;
use super::{Group, LaneControl, Sealed, Verdict, chosen_state, number, numbers_of, ones_in};

/// Memory of one lane.
#[derive(Clone, Copy)]
struct TaylorLane {
    /// About the length of the last step; 0 before the first.
    guess: f64,
    /// ln of the lengths at the orders that are compared, and how much rounding is beyond the tolerance.
    lengths: [f64; 2],
    excess: f64,
    last: bool,
    tries: bool,
    shortened: ShortenedStep,
}

#[doc(hidden)]
pub struct TaylorMemory<S: TaylorSystem> {
    order: Order,
    series: Box<S::Series>,
    lanes: Vec<TaylorLane>,
    longest: f64,
}

impl<S: TaylorSystem> TaylorMemory<S>
where
    S: BatchSystem,
{
    /// The lengths of steps with their signs, as the series asks in each lane; lanes that cannot make one are told so.
    fn lengths(&mut self, control: &Taylor, group: &mut Group<S>, who: &[bool]) -> S::Scalar {
        let direction = if group.span < 0.0 { -1.0 } else { 1.0 };
        let mut h = S::Scalar::zero();
        let rest = group.end - group.state.t;
        for (n, lane) in self.lanes.iter_mut().enumerate() {
            lane.tries = false;
            if !who[n] {
                continue;
            }
            let guess = direction * lane.guess;
            let numbers = numbers_of::<S::Scalar>(n);
            (lane.lengths, lane.excess) = control.lengths::<S>(&self.series, self.order.judged(), guess, numbers);
            let length = Real::exp(lane.lengths[1]);
            let mut gave = |kind| group.verdicts[n] = Verdict::Stopped(StopReason::AnyStep(kind));
            // A NaN among the coefficients makes no length; where they are all zero the system is at rest.
            if length.is_nan() {
                gave(IntegrationErrorKind::NonFinite { part: RunPart::Derivative });
                continue;
            }
            let (length, left) = ((length * lane.shortened.part()).min(self.longest), number(rest, n).abs());
            lane.last = length >= left * 0.999;
            let t = group.state.t.extract(n);
            let signed = if lane.last { rest.extract(n) } else { to_a_number(t, direction * length) };
            if t + signed == t || !lane.last && length <= smallest::<S::Scalar>(t.lane(0), group.span) {
                let unresolved = unresolved::<S::Scalar>(length, t.lane(0), group.span);
                gave(lane.shortened.reason().unwrap_or(unresolved));
                continue;
            }
            (lane.guess, lane.tries) = (length, true);
            h.replace(n, &signed);
        }
        h
    }

    /// The order for the next step, where it is to be chosen: what is better for most lanes.
    fn choose(&mut self, control: &Taylor) {
        let (mut sum, mut count) = ([0.0; 2], 0.0);
        for lane in self.lanes.iter().filter(|lane| lane.tries && lane.guess < self.longest) {
            sum = [sum[0] + lane.lengths[0], sum[1] + lane.lengths[1]];
            count += 1.0;
        }
        if count > 0.0 {
            let better = self.order.better(sum.map(|lengths| lengths / count));
            if better != self.order.value() {
                self.order = Order::new(control, better);
            }
        }
    }
}

impl Sealed for Taylor {}

impl<S: TaylorSystem + BatchSystem> LaneControl<S> for Taylor {
    type Memory = TaylorMemory<S>;

    fn memory(&self, span: f64, limit: u64) -> Result<TaylorMemory<S>, IntegrationErrorKind> {
        check_tolerances(self.relative, self.absolute)?;
        let longest = if span == 0.0 { 0.0 } else { longest(self.largest_step, span, limit)? };
        let shortened = ShortenedStep::default();
        let lane = TaylorLane { guess: 0.0, lengths: [0.0; 2], excess: 0.0, last: false, tries: false, shortened };
        let (order, series) = (Order::new(self, self.first_order()), Box::new(S::Series::zero()));
        Ok(TaylorMemory { order, series, lanes: vec![lane; S::Scalar::WIDTH], longest })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        _: &P,
        _: &Group<S>,
        (lane, _): (usize, u64),
        memory: &mut TaylorMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        (memory.lanes[lane].guess, memory.lanes[lane].shortened) = (0.0, ShortenedStep::default());
        Ok(())
    }

    #[inline(never)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        memory: &mut TaylorMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        let order = memory.order.value();
        expanded(problem, &group.state, order, &mut memory.series);
        let guesses: Vec<f64> = memory.lanes.iter().map(|lane| lane.guess).collect();
        let h = memory.lengths(self, group, who);
        let mut reached = summed(problem, group.state.t, &memory.series, order, h);
        let takes = |n: usize| memory.lanes[n].tries;
        let all = (0..memory.lanes.len()).all(takes);
        let ones = if all { S::Scalar::one() } else { ones_in(takes) };
        for (n, lane) in memory.lanes.iter().enumerate() {
            if lane.tries && lane.last {
                reached.t.replace(n, &group.end.extract(n));
            }
        }
        if !all {
            reached = chosen_state(ones, &reached, &group.state);
        }
        let checked = self.accepted(problem, (&group.state, &group.rates), &mut reached);
        let next = checked.inspect_err(|_| {
            // As if nothing had been tried.
            memory.lanes.iter_mut().zip(&guesses).for_each(|(lane, &guess)| lane.guess = guess);
        })?;
        group.take(ones, all, (reached, next));
        for (n, lane) in memory.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.tries) {
            group.verdicts[n] = Verdict::Taken(lane.shortened.taken(lane.excess), lane.last);
        }
        if self.order.is_none() {
            memory.choose(self);
        }
        Ok(())
    }

    fn failed<P: Problem<System = S>>(
        &self,
        (problem, group): (&P, &Group<S>),
        n: usize,
        kind: IntegrationErrorKind,
        memory: &mut TaylorMemory<S>,
    ) -> Verdict {
        let again = memory.lanes[n].shortened.again((problem, &group.state), numbers_of::<S::Scalar>(n), kind);
        if again { Verdict::Rejected } else { Verdict::Stopped(StopReason::AnyStep(kind)) }
    }

    fn length(&self, lane: usize, memory: &TaylorMemory<S>) -> f64 {
        memory.lanes[lane].guess
    }

    fn passes_over_decay(&self) -> bool {
        false
    }
}
