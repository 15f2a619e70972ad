//! Adams' methods in lanes: a history of each lane, in the places of one window.

use alloc::boxed::Box;

use super::{Adams, History, begin, multistep, point};
use crate::batch::BatchSystem;
use crate::integrate::drive::cause::Gave;
use crate::integrate::drive::fixed::Advanced;
use crate::integrate::lanes::called::Called;
use crate::integrate::lanes::fixed::{Advance, Lane, March, Trial};
use crate::integrate::lanes::{Group, LaneControl, Verdict, chosen, chosen_rates, chosen_state, number, ones_in};
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::runge_kutta::components::{ComponentsOf, Point};

/// Room for so many derivatives: with those of a vector the nearest cache is not full.
const ROOM: usize = 32;

type PointOf<S> = Point<ComponentsOf<S>, <S as crate::system::GaussSystem>::Speeds>;

/// The vectors of one point in lanes where `ones` is 1, of the other elsewhere.
fn chosen_point<S: BatchSystem>(ones: S::Scalar, new: &PointOf<S>, old: &PointOf<S>) -> PointOf<S> {
    Point {
        components: chosen(ones, &new.components, &old.components),
        variables: chosen(ones, &new.variables, &old.variables),
    }
}

#[doc(hidden)]
pub struct Memory<S: BatchSystem, const K: usize> {
    march: March<S>,
    steps: Box<Steps<S, K>>,
}

/// What makes the steps.
struct Steps<S: BatchSystem, const K: usize> {
    length: f64,
    history: History<ComponentsOf<S>, S::Speeds, K, ROOM>,
    /// The derivatives that came with a step in lanes that begin beside others that do not.
    known: Option<(S::Scalar, Rates<S>)>,
}

impl<S: BatchSystem, const K: usize> Steps<S, K> {
    /// The sums over the history in lanes where `ones` is 1: what stands in others may be of any size.
    fn sums_in(&self, ones: S::Scalar, newest: &PointOf<S>) -> [PointOf<S>; 2] {
        self.history.sums(newest).map(|sum| chosen_point::<S>(ones, &sum, &Point::zero()))
    }

    /// A step that begins the runs of some lanes, or ends them by one of another length.
    #[cold]
    #[inline(never)]
    fn beside<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        h: S::Scalar,
        lanes: &[Lane],
        newest: &PointOf<S>,
    ) -> Result<Advanced<S>, IntegrationErrorKind> {
        let goes_on = |n: usize| {
            let one_length = (number(h, n).abs() - self.length).abs() <= 1e-6 * self.length;
            lanes[n].steps && lanes[n].made + 1 >= K as u64 && one_length
        };
        let begins = |n: usize| lanes[n].steps && !goes_on(n);
        let (some_go_on, some_begin) = ((0..lanes.len()).any(goes_on), (0..lanes.len()).any(begins));
        let (going, beginning) = (ones_in::<S::Scalar>(goes_on), ones_in::<S::Scalar>(begins));
        let problem = &Called(problem);
        if !some_go_on {
            return begin::<S, _, K>(problem, state, rates, h);
        }
        let on = multistep::<S, _, K>(problem, state, rates, going * h, self.sums_in(going, newest))?;
        if !some_begin {
            return Ok((on, None));
        }
        let (begun, known) = begin::<S, _, K>(problem, state, rates, beginning * h)?;
        self.known = known.filter(|_| !S::CONSTRAINED).map(|known| (beginning, known));
        Ok((chosen_state(going, &on, &begun), None))
    }
}

impl<S: BatchSystem, const K: usize> Advance<S> for Steps<S, K> {
    fn settled(&self, made: u64) -> bool {
        made + 1 >= K as u64
    }

    #[inline(always)]
    fn advance<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        trial: &Trial<S::Scalar>,
        lanes: &[Lane],
    ) -> Result<Advanced<S>, IntegrationErrorKind> {
        let newest = point::<S>(&state.q, rates);
        self.history.put(&newest);
        if trial.last || !self.settled(trial.fewest) {
            return self.beside(problem, (state, rates), trial.h, lanes, &newest);
        }
        let sums = match trial.some {
            None => self.history.sums(&newest),
            Some(ones) => self.sums_in(ones, &newest),
        };
        multistep::<S, P, K>(problem, state, rates, trial.h, sums).map(|end| (end, None))
    }

    #[inline(always)]
    fn stands(&mut self, rates: Rates<S>, alone: Option<S::Scalar>) -> Rates<S> {
        if let Some(ones) = alone {
            self.history.put_back(|new, old| chosen_point::<S>(ones, new, old));
        }
        self.history.step();
        match self.known.take() {
            None => rates,
            Some((ones, known)) => chosen_rates(ones, &known, &rates),
        }
    }
}

impl<S: BatchSystem, const K: usize> LaneControl<S> for Adams<S::Scalar, K> {
    type Memory = Memory<S, K>;
    const PACED: bool = false;

    fn memory(&self, span: f64, _: u64) -> Result<Memory<S, K>, IntegrationErrorKind> {
        let march = March::new(self.step, span)?;
        let steps = Box::new(Steps { length: march.length(), history: History::new(), known: None });
        Ok(Memory { march, steps })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        _: &P,
        group: &Group<S>,
        (lane, limit): (usize, u64),
        memory: &mut Memory<S, K>,
    ) -> Result<(), IntegrationErrorKind> {
        memory.march.begin(group, lane, limit)
    }

    #[inline(never)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        memory: &mut Memory<S, K>,
    ) -> Result<(), IntegrationErrorKind> {
        memory.steps.known = None;
        memory.march.attempt(&mut *memory.steps, problem, group, who)
    }

    fn failed(&self, _: &Group<S>, _: usize, kind: IntegrationErrorKind, _: &mut Memory<S, K>) -> Verdict {
        Verdict::Gave(Gave::Step(kind))
    }

    fn length(&self, _: usize, memory: &Memory<S, K>) -> f64 {
        memory.march.length()
    }

    fn passes_over_decay(&self) -> bool {
        false
    }
}
