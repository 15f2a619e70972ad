//! Steps of one length in lanes: those of [`Fixed`], and of what counts its steps as it does.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::control::StepStatistics;
use gauss_runtime::integrate::drive::fixed::{Advanced, Fixed, steps_between, toward};
use gauss_runtime::integrate::drive::projection::accept;
use gauss_runtime::integrate::problem::called_equations::CalledEquations;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::integrate::step::one_step::OneStep;
use gauss_runtime::real::Real;
use gauss_runtime::simd::Packed;

use super::system::BatchSystem;
use super::{Group, LaneControl, Sealed, Verdict, chosen_state, ones_in};

/// Progress of a lane on its way.
#[derive(Clone, Copy, Default)]
pub(super) struct FixedLane {
    /// Steps that it has made since it began, and how many there are.
    pub(super) made: u64,
    pub(super) all: u64,
    /// Whether it makes the present one.
    pub(super) steps: bool,
}

impl FixedLane {
    fn is_last(&self) -> bool {
        self.made + 1 == self.all
    }
}

/// A step that some lanes make; the others stand still.
pub(super) struct Trial<T> {
    /// Its length, with the sign of the direction; 0 in lanes that stand still.
    pub(super) h: T,
    /// 1 in lanes that make it, where not all of the pack do.
    pub(super) some: Option<T>,
    /// The fewest steps that any of them has made.
    pub(super) fewest: u64,
    /// Whether it is the last one in any of them.
    pub(super) last: bool,
    /// Number of steps that have been made, where it is the same in all lanes that make this one.
    together: Option<u64>,
    /// The times at which the lanes began.
    starts: T,
    end: T,
    /// 1 in lanes that make it, where others that have runs do not.
    alone: Option<T>,
}

/// Maker of steps of one length.
pub(super) trait Advance<S: BatchSystem> {
    /// Whether all lanes go on in the same way once they have made so many steps, but for the last one.
    fn settled(&self, made: u64) -> bool;

    /// A step: the state at its end, and the derivatives there where they came with it.
    fn advance<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        from: (&State<S>, &Rates<S>),
        trial: &Trial<S::Scalar>,
        lanes: &[FixedLane],
    ) -> Result<Advanced<S>, IntegrationErrorKind>;

    /// The step stands, with these derivatives at its end; `alone`: in some lanes that have runs and not in others.
    fn stands(&mut self, rates: Rates<S>, alone: Option<S::Scalar>) -> Rates<S>;
}

/// Lanes on their way by steps of one length.
#[doc(hidden)]
pub struct March<S: BatchSystem> {
    lanes: Vec<FixedLane>,
    starts: S::Scalar,
    length: S::Scalar,
}

impl<S: BatchSystem> March<S> {
    /// Prepares steps of length |step|, in the direction of the span.
    pub(super) fn new(step: S::Scalar, span: f64) -> Result<Self, IntegrationErrorKind> {
        let length = toward(step, span)?;
        Ok(Self { lanes: vec![FixedLane::default(); S::Scalar::WIDTH], starts: S::Scalar::zero(), length })
    }

    pub(super) fn length(&self) -> f64 {
        self.length.lane(0).abs()
    }

    /// A lane has got a state to start from, and may make so many steps.
    pub(super) fn begin(&mut self, group: &Group<S>, lane: usize, limit: u64) -> Result<(), IntegrationErrorKind> {
        let all = steps_between([group.state.t, group.end].map(|t| t.extract(lane)), self.length(), limit)?;
        self.lanes[lane] = FixedLane { made: 0, all, steps: false };
        self.starts.replace(lane, &group.state.t.extract(lane));
        Ok(())
    }

    fn trial(&mut self, group: &Group<S>, who: &[bool]) -> Trial<S::Scalar> {
        // Lanes that stand still are where they are.
        let (mut h, mut starts) = (S::Scalar::zero(), group.state.t);
        let rest = group.end - group.state.t;
        let (mut fewest, mut most, mut last) = (u64::MAX, 0, false);
        for (n, lane) in self.lanes.iter_mut().enumerate() {
            lane.steps = who[n];
            if who[n] {
                h.replace(n, &if lane.is_last() { rest } else { self.length }.extract(n));
                starts.replace(n, &self.starts.extract(n));
                (fewest, most, last) = (fewest.min(lane.made), most.max(lane.made), last | lane.is_last());
            }
        }
        let some = (!who.iter().all(|&steps| steps)).then(|| ones_in(|lane| who[lane]));
        let together = (fewest == most).then_some(fewest);
        Trial { h, some, fewest, last, together, starts, end: group.end, alone: some.filter(|_| group.alone) }
    }

    /// The times at the end of a trial, so many steps later: multiples of the length, not sums of it.
    #[inline(always)]
    fn times(&self, trial: &Trial<S::Scalar>, later: u64) -> S::Scalar {
        let number = |made: u64| (made + later + 1) as f64;
        let count = match trial.together {
            Some(made) => S::Scalar::from_f64(number(made)),
            None => self.lanes.iter().enumerate().fold(S::Scalar::zero(), |mut count, (n, lane)| {
                count.replace(n, &Real::from_f64(number(lane.made)));
                count
            }),
        };
        let mut times = count.fma(trial.h, trial.starts);
        if trial.last {
            for (n, _) in self.lanes.iter().enumerate().filter(|(_, lane)| lane.steps && lane.is_last()) {
                times.replace(n, &trial.end.extract(n));
            }
        }
        times
    }

    /// A step, or as many as all lanes make in the same way, where nobody looks at the states between.
    #[inline(always)]
    pub(super) fn attempt<P: Problem<System = S>>(
        &mut self,
        method: &mut impl Advance<S>,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
    ) -> Result<(), IntegrationErrorKind> {
        group.steps = 1;
        let trial = self.trial(group, who);
        let stepping = || self.lanes.iter().filter(|lane| lane.steps);
        let several = group.unseen && !group.alone && !trial.last && method.settled(trial.fewest);
        let before_the_last = stepping().map(|lane| lane.all - lane.made - 1).min().unwrap_or(1);
        let steps = if several { before_the_last } else { 1 };

        let (mut state, mut rates) = (group.state, group.rates);
        let mut made = 0;
        while made < steps {
            match self.step(method, problem, (&state, &rates), &trial, made) {
                Ok(next) => (state, rates) = next,
                Err(kind) if made == 0 => return Err(kind),
                // It is tried again.
                Err(_) => break,
            }
            made += 1;
        }
        group.steps = made;
        group.take(trial.alone.unwrap_or(S::Scalar::one()), trial.alone.is_none(), (state, rates));
        for (n, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.steps) {
            group.verdicts[n] = Verdict::Taken(StepStatistics::default(), lane.is_last());
            lane.made += made;
        }
        Ok(())
    }

    #[inline(always)]
    fn step<P: Problem<System = S>>(
        &self,
        method: &mut impl Advance<S>,
        problem: &P,
        from: (&State<S>, &Rates<S>),
        trial: &Trial<S::Scalar>,
        later: u64,
    ) -> Result<(State<S>, Rates<S>), IntegrationErrorKind> {
        let (mut next, known) = method.advance(problem, from, trial, &self.lanes)?;
        next.t = self.times(trial, later);
        if let Some(ones) = trial.alone {
            next = chosen_state(ones, &next, from.0);
        }
        let rates = accept(problem, from, &mut next, known)?;
        Ok((next, method.stands(rates, trial.alone)))
    }
}

/// A method of one step remembers nothing.
struct One<'a, M>(&'a M);

impl<S: BatchSystem, M: OneStep<S>> Advance<S> for One<'_, M> {
    fn settled(&self, _: u64) -> bool {
        true
    }

    #[inline(always)]
    fn advance<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        trial: &Trial<S::Scalar>,
        _: &[FixedLane],
    ) -> Result<Advanced<S>, IntegrationErrorKind> {
        self.0.step(&CalledEquations(problem), state, rates, trial.h).map(|step| (step.state, step.rates))
    }

    #[inline(always)]
    fn stands(&mut self, rates: Rates<S>, _: Option<S::Scalar>) -> Rates<S> {
        rates
    }
}

impl<T, M> Sealed for Fixed<T, M> {}

impl<S: BatchSystem, M: OneStep<S>> LaneControl<S> for Fixed<S::Scalar, M> {
    type Memory = March<S>;

    fn paced(&self) -> bool {
        false
    }

    fn memory(&self, span: f64, _: u64) -> Result<March<S>, IntegrationErrorKind> {
        March::new(self.step, span)
    }

    fn begin<P: Problem<System = S>>(
        &self,
        _: &P,
        group: &Group<S>,
        (lane, limit): (usize, u64),
        march: &mut March<S>,
    ) -> Result<(), IntegrationErrorKind> {
        march.begin(group, lane, limit)
    }

    #[inline(never)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        march: &mut March<S>,
    ) -> Result<(), IntegrationErrorKind> {
        march.attempt(&mut One(&self.method), problem, group, who)
    }

    fn failed<P: Problem<System = S>>(
        &self,
        _: (&P, &Group<S>),
        _: usize,
        kind: IntegrationErrorKind,
        _: &mut March<S>,
    ) -> Verdict {
        Verdict::Stopped(StopReason::Step(kind))
    }

    fn length(&self, _: usize, march: &March<S>) -> f64 {
        march.length()
    }

    fn passes_over_decay(&self) -> bool {
        self.method.properties().stiff
    }
}
