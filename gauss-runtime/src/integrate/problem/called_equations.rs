//! Equations that are called.

use core::cell::Cell;

use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::state::{Rates, State};
use crate::system::GaussSystem;

/// Equations that each stage of a step calls. Put into every stage, those of vectors make a step longer than the
/// nearest cache of instructions; what a call costs is shared by the lanes. And where steps are few, those that are
/// made often are left as the only ones into which compilers put the equations.
pub struct CalledEquations<'a, P>(pub &'a P);

type Scalar<P> = <<P as Problem>::System as GaussSystem>::Scalar;
type Configuration<P> = <<P as Problem>::System as GaussSystem>::Configuration;
type Speeds<P> = <<P as Problem>::System as GaussSystem>::Speeds;
type Input<P> = <<P as Problem>::System as GaussSystem>::Input;

impl<P: Problem> Problem for CalledEquations<'_, P> {
    type System = P::System;
    const LEAVES_CONTACTS_OUT: bool = P::LEAVES_CONTACTS_OUT;

    #[inline(always)]
    fn system(&self) -> &P::System {
        self.0.system()
    }

    #[inline(always)]
    fn input(&self, t: Scalar<P>, q: &Configuration<P>, z: &Speeds<P>) -> Input<P> {
        self.0.input(t, q, z)
    }

    #[inline(always)]
    fn variables(&self, t: Scalar<P>, q: &Configuration<P>, z: &Speeds<P>) -> Speeds<P> {
        self.0.variables(t, q, z)
    }

    #[inline(always)]
    fn of_momentum(&self, t: Scalar<P>, q: &Configuration<P>, p: &Speeds<P>) -> Speeds<P> {
        self.0.of_momentum(t, q, p)
    }

    #[inline(always)]
    fn speeds(&self, t: Scalar<P>, q: &Configuration<P>, y: &Speeds<P>) -> Speeds<P> {
        self.0.speeds(t, q, y)
    }

    #[inline(always)]
    fn momentum(&self, t: Scalar<P>, q: &Configuration<P>, y: &Speeds<P>) -> Speeds<P> {
        self.0.momentum(t, q, y)
    }

    #[inline(never)]
    fn rates(&self, state: &State<P::System>) -> Rates<P::System> {
        self.0.rates(state)
    }

    #[inline(always)]
    fn both_rates(&self, state: &State<P::System>, known: &Speeds<P>) -> (Speeds<P>, Speeds<P>) {
        self.0.both_rates(state, known)
    }

    #[inline(always)]
    fn change_of_speeds(&self, state: &State<P::System>, change: &Rates<P::System>) -> Rates<P::System> {
        self.0.change_of_speeds(state, change)
    }

    #[inline(always)]
    fn has_input(&self) -> bool {
        self.0.has_input()
    }

    fn hides_action(&self) -> bool {
        self.0.hides_action()
    }

    fn action(&self, state: &State<P::System>, rates: Option<&Rates<P::System>>) -> Speeds<P> {
        self.0.action(state, rates)
    }

    #[inline(always)]
    fn held(&self) -> Option<&Cell<Input<P>>> {
        self.0.held()
    }
}
