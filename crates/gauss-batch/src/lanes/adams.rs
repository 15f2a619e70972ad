//! Adams' methods in lanes: a history of each lane, in the places of one window.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::integrate::adams::{Adams, History, StartingStates, begin, multistep, point};
use gauss_runtime::integrate::drive::cause::StopReason;
use gauss_runtime::integrate::drive::fixed::Advanced;
use gauss_runtime::integrate::problem::called_equations::CalledEquations;
use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::problem::state::{Rates, State};
use gauss_runtime::integrate::runge_kutta::components::{ComponentsOf, Point};
use gauss_runtime::simd::Packed;
use gauss_runtime::system::GaussSystem;

use super::fixed::{Advance, FixedLane, March, Trial};
use super::system::BatchSystem;
use super::{Group, LaneControl, Sealed, Verdict, chosen, chosen_rates, chosen_state, number, ones_in};

/// Room for so many derivatives: with those of a vector the nearest cache is not full.
const ROOM: usize = 32;

type PointOf<S> = Point<ComponentsOf<S>, <S as GaussSystem>::Speeds>;

/// The vectors of one point in lanes where `ones` is 1, of the other elsewhere.
fn chosen_point<S: BatchSystem>(ones: S::Scalar, new: &PointOf<S>, old: &PointOf<S>) -> PointOf<S> {
    Point {
        components: chosen(ones, &new.components, &old.components),
        variables: chosen(ones, &new.variables, &old.variables),
    }
}

#[doc(hidden)]
pub struct AdamsMemory<S: BatchSystem, const K: usize> {
    march: March<S>,
    steps: Box<Steps<S, K>>,
}

/// Length, history and known starts, from which steps are made.
struct Steps<S: BatchSystem, const K: usize> {
    length: f64,
    history: History<ComponentsOf<S>, S::Speeds, K, ROOM>,
    /// The derivatives that came with a step in some lanes beside others that go another way.
    known: Vec<(S::Scalar, Rates<S>)>,
    /// The first states of lanes that have `looked` ahead, and the derivatives there: after one step, after two, ….
    ahead: Vec<(State<S>, Rates<S>)>,
    looked: Vec<bool>,
}

/// Way in which a lane makes a step.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// A step of the Adams method.
    On,
    /// A step of the method that begins runs.
    Begins,
    /// It is known, after so many others.
    Known(usize),
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
        lanes: &[FixedLane],
        newest: &PointOf<S>,
    ) -> Result<Advanced<S>, IntegrationErrorKind> {
        let problem = &CalledEquations(problem);
        self.look_ahead(problem, (state, rates), h, lanes)?;
        let way = |n: usize| {
            let one_length = (number(h, n).abs() - self.length).abs() <= 1e-6 * self.length;
            match lanes[n].made + 1 >= K as u64 {
                true if one_length => Way::On,
                false if self.looked[n] => Way::Known(lanes[n].made as usize),
                _ => Way::Begins,
            }
        };
        let goes = |n: usize, which: Way| lanes[n].steps && way(n) == which;
        let some = |which: Way| (0..lanes.len()).any(|n| goes(n, which));
        let all = |which: Way| (0..lanes.len()).all(|n| goes(n, which));
        let ones = |which: Way| ones_in::<S::Scalar>(|n| goes(n, which));
        // Each way by itself, of which each lane takes its own; those that stand still stay where they are.
        let mut end = *state;
        if some(Way::On) {
            let ones = ones(Way::On);
            let on = multistep::<S, _, K>(problem, state, rates, ones * h, self.sums_in(ones, newest))?;
            end = chosen_state(ones, &on, &end);
        }
        if some(Way::Begins) {
            let ones = ones(Way::Begins);
            let (begun, known) = begin::<S, _, K>(problem, state, rates, ones * h)?;
            if all(Way::Begins) {
                return Ok((begun, known));
            }
            self.known.extend(known.filter(|_| !S::CONSTRAINED).map(|known| (ones, known)));
            end = chosen_state(ones, &begun, &end);
        }
        for (made, (there, known)) in self.ahead.iter().enumerate().filter(|(made, _)| some(Way::Known(*made))) {
            let ones = ones(Way::Known(made));
            self.known.push((ones, *known));
            end = chosen_state(ones, there, &end);
        }
        Ok((end, None))
    }

    /// The first steps of lanes that have made none.
    fn look_ahead<P: Problem<System = S>>(
        &mut self,
        problem: &P,
        (state, rates): (&State<S>, &Rates<S>),
        h: S::Scalar,
        lanes: &[FixedLane],
    ) -> Result<(), IntegrationErrorKind> {
        let starts = |n: usize| lanes[n].steps && lanes[n].made == 0;
        let may = |n: usize| starts(n) && StartingStates::<S, K>::serves(lanes[n].all);
        (0..lanes.len()).filter(|&n| starts(n)).for_each(|n| self.looked[n] = false);
        if !(0..lanes.len()).any(may) {
            return Ok(());
        }
        let ones = ones_in::<S::Scalar>(may);
        match StartingStates::<S, K>::of(problem, state, rates, ones * h) {
            Ok(ahead) => {
                self.ahead.resize(K - 1, (*state, *rates));
                for (made, (state, rates)) in self.ahead.iter_mut().enumerate() {
                    let (there, known) = ahead.after(made);
                    (*state, *rates) = (chosen_state(ones, &there, state), chosen_rates(ones, &known, rates));
                }
                (0..lanes.len()).filter(|&n| may(n)).for_each(|n| self.looked[n] = true);
                Ok(())
            }
            // As a run by itself does.
            Err(_) if lanes.iter().filter(|lane| lane.steps).count() == 1 => Ok(()),
            Err(kind) => Err(kind),
        }
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
        lanes: &[FixedLane],
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
        self.known.drain(..).fold(rates, |rates, (ones, known)| chosen_rates(ones, &known, &rates))
    }
}

impl<T, const K: usize> Sealed for Adams<T, K> {}

impl<S: BatchSystem, const K: usize> LaneControl<S> for Adams<S::Scalar, K> {
    type Memory = AdamsMemory<S, K>;

    fn paced(&self) -> bool {
        false
    }

    fn memory(&self, span: f64, _: u64) -> Result<AdamsMemory<S, K>, IntegrationErrorKind> {
        let march = March::new(self.step, span)?;
        let steps = Box::new(Steps {
            length: march.length(),
            history: History::new(),
            known: Vec::new(),
            ahead: Vec::new(),
            looked: vec![false; S::Scalar::WIDTH],
        });
        Ok(AdamsMemory { march, steps })
    }

    fn begin<P: Problem<System = S>>(
        &self,
        _: &P,
        group: &Group<S>,
        (lane, limit): (usize, u64),
        memory: &mut AdamsMemory<S, K>,
    ) -> Result<(), IntegrationErrorKind> {
        memory.march.begin(group, lane, limit)
    }

    #[inline(never)]
    fn attempt<P: Problem<System = S>>(
        &self,
        problem: &P,
        group: &mut Group<S>,
        who: &[bool],
        memory: &mut AdamsMemory<S, K>,
    ) -> Result<(), IntegrationErrorKind> {
        memory.steps.known.clear();
        memory.march.attempt(&mut *memory.steps, problem, group, who)
    }

    fn failed<P: Problem<System = S>>(
        &self,
        _: (&P, &Group<S>),
        _: usize,
        kind: IntegrationErrorKind,
        _: &mut AdamsMemory<S, K>,
    ) -> Verdict {
        Verdict::Stopped(StopReason::Step(kind))
    }

    fn length(&self, _: usize, memory: &AdamsMemory<S, K>) -> f64 {
        memory.march.length()
    }

    fn passes_over_decay(&self) -> bool {
        false
    }
}
