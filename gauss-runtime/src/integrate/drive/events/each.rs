//! A list of functions whose zeros are events of a run, or end it.

use alloc::vec::Vec;

use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::drive::search::{Crossing, Function};
use crate::integrate::drive::watched::{Events, Mark};
use crate::integrate::problem::state::Sample;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// A list of functions of one type after other events: see
/// [`Simulation::until_each`](crate::integrate::Simulation::until_each) and
/// [`Simulation::event_each`](crate::integrate::Simulation::event_each).
#[derive(Clone, Debug)]
pub struct Each<E, G> {
    others: E,
    functions: Vec<(G, Mark)>,
}

impl<E, G> Each<E, G> {
    /// All of a list after other events; whether each of them ends the run.
    pub(in crate::integrate) fn after(others: E, crossing: Crossing, terminal: bool, functions: Vec<G>) -> Self {
        let marked = |function| (function, Mark::new(crossing, terminal, false));
        Self { others, functions: functions.into_iter().map(marked).collect() }
    }
}

impl<E, G> Sealed for Each<E, G> {}

impl<S, E, G> Events<S> for Each<E, G>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
{
    const ANY: bool = true;

    fn count(&self) -> usize {
        self.others.count() + self.functions.len()
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
        for (function, mark) in &mut self.functions {
            visit(function, mark);
        }
    }

    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool {
        number < self.others.count() && self.others.jump(number, state)
    }

    const SAMPLED: bool = E::SAMPLED;

    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        self.others.schedule(visit);
    }
}
