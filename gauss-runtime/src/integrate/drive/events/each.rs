//! A list of functions whose zeros are events of a run, or end it.

use alloc::vec::Vec;

use crate::integrate::drive::bounded::{NoBound, RateBound};
use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::drive::search::{Crossing, Function};
use crate::integrate::drive::watched::{Events, Mark, Visit};
use crate::integrate::problem::state::Sample;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// A list of functions of one type after other events: see
/// [`Simulation::until_each`](crate::integrate::Simulation::until_each) and
/// [`Simulation::event_each`](crate::integrate::Simulation::event_each). What bounds a rate stands beside its function.
#[derive(Clone, Debug)]
pub struct Each<E, G, B = NoBound> {
    others: E,
    functions: Vec<(G, Option<B>, Mark)>,
}

impl<E, G, B> Each<E, G, B> {
    /// All of a list after other events; whether each of them ends the run.
    pub(in crate::integrate) fn after(
        others: E,
        crossing: Crossing,
        terminal: bool,
        functions: impl IntoIterator<Item = (G, Option<B>)>,
    ) -> Self {
        let marked = |(function, bound)| (function, bound, Mark::new(crossing, terminal, false));
        Self { others, functions: functions.into_iter().map(marked).collect() }
    }
}

impl<E, G, B> Sealed for Each<E, G, B> {}

impl<S, E, G, B> Events<S> for Each<E, G, B>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    B: RateBound<S>,
{
    const ANY: bool = true;

    fn count(&self) -> usize {
        self.others.count() + self.functions.len()
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
        for (function, _, mark) in &mut self.functions {
            visit(function, mark);
        }
    }

    fn each_bounded(&mut self, visit: &mut Visit<'_, S>) {
        self.others.each_bounded(visit);
        for (function, bound, mark) in &mut self.functions {
            visit(function, bound.as_ref().map(|bound| bound as &dyn RateBound<S>), mark);
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
