//! The events of a run, and what is known of each from step to step.

use crate::integrate::drive::bounded::Bound;
use crate::integrate::drive::departure::RestAtZero;
use crate::integrate::drive::jump::{Jump, JumpFunction, NoJump};
use crate::integrate::drive::schedule::Scheduled;
use crate::integrate::drive::search::{Crossing, Function};
use crate::integrate::problem::state::Sample;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// The state of one event from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    pub(super) crossing: Crossing,
    pub(super) terminal: bool,
    /// Whether the state jumps there.
    pub(super) jumps: bool,
    /// Whether its jump may let the function go on through zero.
    pub(super) through: bool,
    pub(super) value: f64,
    /// Part of the present step at which the next event is, if there is one, with the value there.
    pub(super) next: Option<(f64, f64)>,
    /// Part of the present step at which the last event was, and the value before it.
    pub(super) last: Option<(f64, f64)>,
    /// Whether that is where the run is cut, and whether the state has jumped by it there.
    pub(super) here: bool,
    pub(super) jumped: bool,
    /// Whether a jump has led over it.
    pub(super) passed: bool,
    /// Side and rate of the function before a jump.
    pub(super) cut: Option<JumpApproach>,
    /// The function has not been seen to leave zero.
    pub(super) resting: Option<RestAtZero>,
}

/// Side and rate of a function where the state jumps at its zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct JumpApproach {
    /// The side that it came from.
    pub(super) side: f64,
    /// Per unit of time in the direction of integration.
    pub(super) rate: f64,
    /// Distance beyond zero at which it may be, since zeros are found to a part of the step.
    pub(super) beyond: f64,
}

impl Mark {
    /// Before a run.
    pub(in crate::integrate) const fn new(crossing: Crossing, terminal: bool, through: bool) -> Self {
        Self {
            crossing,
            terminal,
            jumps: false,
            through,
            value: 0.0,
            next: None,
            last: None,
            here: false,
            jumped: false,
            passed: false,
            cut: None,
            resting: None,
        }
    }

    /// Whether the run ends there.
    #[must_use]
    pub fn ends_the_run(&self) -> bool {
        self.terminal
    }

    /// Whether the state jumps there.
    #[must_use]
    pub fn jumps(&self) -> bool {
        self.jumps
    }

    /// Whether the function may go on through zero after a jump.
    #[must_use]
    pub fn may_go_on(&self) -> bool {
        self.through
    }

    /// Whether a jump from one value to another passes through zero as the event does.
    #[must_use]
    pub fn passes(&self, before: f64, after: f64) -> bool {
        self.crossing.between(before, after)
    }

    /// Shows it as one that ends the run where its state jumps.
    #[cfg(feature = "alloc")]
    pub(super) fn ending_at_jumps(&mut self, show: impl FnOnce(&mut Self)) {
        let terminal = self.terminal;
        self.terminal |= self.jumps;
        show(self);
        self.terminal = terminal;
    }

    /// Notes that the run has made the jump, of another state than the one before it.
    pub fn note_jump(&mut self) {
        self.jumped = true;
    }

    /// Before another run.
    pub(in crate::integrate) fn renew(&mut self) {
        *self = Self { jumps: self.jumps, ..Self::new(self.crossing, self.terminal, self.through) };
    }
}

/// A look at an event: its function, the bound of its rate where there is one, its mark.
pub type Visit<'v, S> = dyn FnMut(Function<'_, S>, Bound<'_, S>, &mut Mark) + 'v;

/// The events of a run, in the order in which they were added to the simulation.
pub trait Events<S: GaussSystem>: Sealed {
    /// Whether there are any.
    const ANY: bool;

    /// Their number.
    fn count(&self) -> usize;

    /// Shows every one.
    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark));

    /// Shows every one, with what bounds its rate where something does.
    fn each_bounded(&mut self, visit: &mut Visit<'_, S>) {
        self.each(&mut |function, mark| visit(function, None, mark));
    }

    /// Changes the state as the event of this number does; whether it does.
    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool;

    /// Whether there are controllers that sample.
    const SAMPLED: bool = false;

    /// Shows every controller that samples, in the order in which they were added.
    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        let _ = visit;
    }
}

/// None.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoEvents;

impl Sealed for NoEvents {}

impl<S: GaussSystem> Events<S> for NoEvents {
    const ANY: bool = false;

    fn count(&self) -> usize {
        0
    }

    fn each(&mut self, _: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {}

    fn jump(&mut self, _: usize, _: &mut Sample<S>) -> bool {
        false
    }
}

impl<E: Sealed> Sealed for &mut E {}

impl<S: GaussSystem, E: Events<S>> Events<S> for &mut E {
    const ANY: bool = E::ANY;

    fn count(&self) -> usize {
        (**self).count()
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        (**self).each(visit);
    }

    fn each_bounded(&mut self, visit: &mut Visit<'_, S>) {
        (**self).each_bounded(visit);
    }

    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool {
        (**self).jump(number, state)
    }

    const SAMPLED: bool = E::SAMPLED;

    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        (**self).schedule(visit);
    }
}

/// One event after others, with what becomes of the state there.
#[derive(Clone, Copy, Debug)]
pub struct Watched<E, G, J = NoJump> {
    others: E,
    function: G,
    jump: J,
    mark: Mark,
}

impl<E, G> Watched<E, G> {
    /// One more event after others.
    #[doc(hidden)]
    pub fn after(others: E, crossing: Crossing, terminal: bool, function: G) -> Self {
        Self { others, function, jump: NoJump, mark: Mark::new(crossing, terminal, false) }
    }

    /// Adds a jump, after which the function may go on through zero or has to be led back.
    #[doc(hidden)]
    pub fn then<J>(self, jump: J, through: bool) -> Watched<E, G, JumpFunction<J>> {
        let Self { others, function, mark, .. } = self;
        Watched { others, function, jump: JumpFunction(jump), mark: Mark { jumps: true, through, ..mark } }
    }
}

impl<E, G, J> Sealed for Watched<E, G, J> {}

impl<S, E, G, J> Events<S> for Watched<E, G, J>
where
    S: GaussSystem,
    E: Events<S>,
    G: Fn(S::Scalar, &S::Configuration, &S::Speeds) -> S::Scalar,
    J: Jump<S>,
{
    const ANY: bool = true;

    fn count(&self) -> usize {
        self.others.count() + 1
    }

    fn each(&mut self, visit: &mut dyn FnMut(Function<'_, S>, &mut Mark)) {
        self.others.each(visit);
        visit(&self.function, &mut self.mark);
    }

    fn each_bounded(&mut self, visit: &mut Visit<'_, S>) {
        self.others.each_bounded(visit);
        visit(&self.function, None, &mut self.mark);
    }

    fn jump(&mut self, number: usize, state: &mut Sample<S>) -> bool {
        if number == self.others.count() { self.jump.jump(state) } else { self.others.jump(number, state) }
    }

    const SAMPLED: bool = E::SAMPLED;

    fn schedule(&mut self, visit: &mut dyn FnMut(&mut dyn Scheduled<S>)) {
        self.others.schedule(visit);
    }
}
