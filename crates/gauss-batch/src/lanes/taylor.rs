//! Taylor's method in lanes: one order for all, a length of step for each.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::control::check_tolerances;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::taylor::{Order, SeriesStep, Taylor, expanded, summed};
use gauss_runtime::real::Real;
use gauss_runtime::series::{PowerSeries, TaylorSystem};
use gauss_runtime::simd::Packed;

use super::system::BatchSystem;
use super::{Group, LaneControl, Sealed, Verdict, chosen_state, number, numbers_of, ones_in};

#[doc(hidden)]
pub struct TaylorMemory<S: TaylorSystem> {
    order: Order,
    series: Box<S::Series>,
    lanes: Vec<SeriesStep>,
    /// Which lanes make the present step.
    tries: Vec<bool>,
}

impl<S: TaylorSystem + BatchSystem> TaylorMemory<S> {
    /// The lengths of steps with their signs, as the series asks in each lane; lanes that cannot make one are told so.
    fn lengths(&mut self, control: &Taylor, group: &mut Group<S>, who: &[bool]) -> S::Scalar {
        let mut h = S::Scalar::zero();
        let rest = group.end - group.state.t;
        self.tries.copy_from_slice(who);
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(n, _)| who[*n]) {
            let (times, series) = ((group.state.t.extract(n), rest.extract(n)), (&*self.series, &self.order));
            match lane.propose::<S, _>(control, series, times, numbers_of::<S::Scalar>(n)) {
                Ok(signed) => h.replace(n, &signed),
                Err(kind) => {
                    self.tries[n] = false;
                    group.verdicts[n] = Verdict::Stopped(StopReason::AnyStep(kind));
                }
            }
        }
        h
    }
}

impl Sealed for Taylor {}

impl<S: TaylorSystem + BatchSystem> LaneControl<S> for Taylor {
    type Memory = TaylorMemory<S>;

    fn memory(&self, span: f64, _: u64) -> Result<TaylorMemory<S>, IntegrationErrorKind> {
        check_tolerances(self.relative, self.absolute)?;
        let (order, series) = (Order::first(self), Box::new(S::Series::zero()));
        let width = S::Scalar::WIDTH;
        Ok(TaylorMemory { order, series, lanes: vec![SeriesStep::new(span); width], tries: vec![false; width] })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        _: &P,
        group: &Group<S>,
        (lane, limit): (usize, u64),
        memory: &mut TaylorMemory<S>,
    ) -> Result<(), IntegrationErrorKind> {
        memory.lanes[lane] = SeriesStep::new(number(group.end - group.state.t, lane));
        memory.lanes[lane].begin(self, limit)
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
        let h = memory.lengths(self, group, who);
        let mut reached = summed(problem, group.state.t, &memory.series, order, h);
        let all = memory.tries.iter().all(|&tries| tries);
        let ones = if all { S::Scalar::one() } else { ones_in(|n| memory.tries[n]) };
        let tried = || memory.tries.iter().enumerate().filter(|(_, tries)| **tries).map(|(n, _)| n);
        for n in tried().filter(|&n| memory.lanes[n].is_last()) {
            reached.t.replace(n, &group.end.extract(n));
        }
        if !all {
            reached = chosen_state(ones, &reached, &group.state);
        }
        let next = self.accepted(problem, (&group.state, &group.rates), &mut reached)?;
        group.take(ones, all, (reached, next));
        for n in tried() {
            let lane = &mut memory.lanes[n];
            group.verdicts[n] = Verdict::Taken(lane.take(), lane.is_last());
        }
        memory.order.choose(self, tried().map(|n| &memory.lanes[n]));
        Ok(())
    }

    fn failed<P: Problem<System = S>>(
        &self,
        (problem, group): (&P, &Group<S>),
        n: usize,
        kind: IntegrationErrorKind,
        memory: &mut TaylorMemory<S>,
    ) -> Verdict {
        let again = memory.lanes[n].shorten((problem, &group.state), numbers_of::<S::Scalar>(n), kind);
        again.map_or_else(|kind| Verdict::Stopped(StopReason::AnyStep(kind)), |()| Verdict::Rejected)
    }

    fn length(&self, lane: usize, memory: &TaylorMemory<S>) -> f64 {
        memory.lanes[lane].length()
    }

    fn passes_over_decay(&self) -> bool {
        false
    }
}
