//! A list of functions whose zeros are events of a run, or end it.

use alloc::vec::Vec;

use crate::integrate::drive::bounded::{NoBound, RateBound};
use crate::integrate::drive::jump::{JumpFunction, NoJump};
use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::drive::search::{Crossing, Function};
use crate::integrate::drive::watched::{Events, Mark, NoEvents, Visit};
use crate::integrate::problem::state::Sample;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// The effect of the events of a list on the state, by their place in the list.
#[doc(hidden)]
pub trait ListJump<S: GaussSystem>: Sealed {
    /// Changes it; whether it does.
    fn jump(&mut self, place: usize, state: &mut Sample<S>) -> bool;
}

impl<S: GaussSystem> ListJump<S> for NoJump {
    fn jump(&mut self, _: usize, _: &mut Sample<S>) -> bool {
        false
    }
}

impl<S: GaussSystem, J: FnMut(usize, &mut Sample<S>) -> bool> ListJump<S> for JumpFunction<J> {
    fn jump(&mut self, place: usize, state: &mut Sample<S>) -> bool {
        (self.0)(place, state)
    }
}

/// A list of functions of one type after other events: see
/// [`Simulation::until_each`](crate::integrate::Simulation::until_each) and
/// [`Simulation::event_each`](crate::integrate::Simulation::event_each). What bounds a rate stands beside its function.
#[derive(Clone, Debug)]
pub struct Each<E, G, B = NoBound, J = NoJump> {
    others: E,
    functions: Vec<(G, Option<B>, Mark)>,
    jump: J,
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
        Self { others, functions: functions.into_iter().map(marked).collect(), jump: NoJump }
    }
}

impl<G> Each<NoEvents, G> {
    /// A list in which each function has a direction of its own; whether it ends the run, whether the state jumps
    /// there, and whether it may go on through zero after that.
    #[doc(hidden)]
    pub fn of(functions: impl IntoIterator<Item = (G, Crossing, [bool; 3])>) -> Self {
        let marked = |(function, crossing, [terminal, jumps, through]): (G, Crossing, [bool; 3])| {
            (function, None, Mark { jumps, ..Mark::new(crossing, terminal, through) })
        };
        Self { others: NoEvents, functions: functions.into_iter().map(marked).collect(), jump: NoJump }
    }

    /// Adds jumps: a function of the place in the list and the state, which tells whether it has changed that.
    #[doc(hidden)]
    pub fn then<J>(self, jump: J) -> Each<NoEvents, G, NoBound, JumpFunction<J>> {
        let Self { others, functions, .. } = self;
        Each { others, functions, jump: JumpFunction(jump) }
    }
}

impl<E, G, B, J> Sealed for Each<E, G, B, J> {}

impl<S, E, G, B, J> Events<S> for Each<E, G, B, J>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    B: RateBound<S>,
    J: ListJump<S>,
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
        match number.checked_sub(self.others.count()) {
            Some(place) => self.jump.jump(place, state),
            None => self.others.jump(number, state),
        }
    }

    const SAMPLED: bool = E::SAMPLED;

    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        self.others.schedule(visit);
    }
}
