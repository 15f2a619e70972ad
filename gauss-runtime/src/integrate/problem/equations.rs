//! Equations that a method integrates, whatever the form and the input: `q̇ = q·V(t, q, y)`, `ẏ = f(t, q, y)`.

use core::cell::Cell;

use super::form::{Form, VelocityForm, WithoutContacts};
use super::input::{InputSource, NoInput};
use super::state::{Rates, Sample, State};
use crate::system::GaussSystem;

type Scalar<P> = <<P as Problem>::System as GaussSystem>::Scalar;
type Configuration<P> = <<P as Problem>::System as GaussSystem>::Configuration;
type Speeds<P> = <<P as Problem>::System as GaussSystem>::Speeds;
type Input<P> = <<P as Problem>::System as GaussSystem>::Input;

/// The equations of motion as a method sees them: those of a system, in the variables y of one form, under an input.
pub trait Problem {
    /// System that moves.
    type System: GaussSystem;

    /// Whether the equations leave out [contacts](GaussSystem::HAS_CONTACTS) on purpose.
    const LEAVES_CONTACTS_OUT: bool = false;

    /// The system.
    fn system(&self) -> &Self::System;

    /// The input at time t in the state (q, z).
    fn input(&self, t: Scalar<Self>, q: &Configuration<Self>, z: &Speeds<Self>) -> Input<Self>;

    /// y of a state given by its quasi-velocities.
    fn variables(&self, t: Scalar<Self>, q: &Configuration<Self>, z: &Speeds<Self>) -> Speeds<Self>;

    /// y of a state given by its momenta.
    fn of_momentum(&self, t: Scalar<Self>, q: &Configuration<Self>, p: &Speeds<Self>) -> Speeds<Self>;

    /// The quasi-velocities z of y.
    fn speeds(&self, t: Scalar<Self>, q: &Configuration<Self>, y: &Speeds<Self>) -> Speeds<Self>;

    /// The momenta p of y.
    fn momentum(&self, t: Scalar<Self>, q: &Configuration<Self>, y: &Speeds<Self>) -> Speeds<Self>;

    /// V and ẏ at a state.
    fn rates(&self, state: &State<Self::System>) -> Rates<Self::System>;

    /// (ż, ṗ) at a state, one of which is the known ẏ.
    fn both_rates(&self, state: &State<Self::System>, known: &Speeds<Self>) -> (Speeds<Self>, Speeds<Self>);

    /// A change of (q, y) that ends in `state`, as one of (q, z).
    #[inline(always)]
    fn change_of_speeds(&self, state: &State<Self::System>, change: &Rates<Self::System>) -> Rates<Self::System> {
        let _ = state;
        *change
    }

    /// Whether there is an input, which may change with the time alone.
    #[inline(always)]
    fn has_input(&self) -> bool {
        core::mem::size_of::<Input<Self>>() > 0
    }

    /// Whether constraints that come and go hide what acts on the system from ẏ.
    fn hides_action(&self) -> bool {
        false
    }

    /// The action on the system in a state, for looks at the input between the stages of a step: ẏ, whose rates may be
    /// known; where it is hidden, ẏ without the constraints that hide it.
    fn action(&self, state: &State<Self::System>, rates: Option<&Rates<Self::System>>) -> Speeds<Self> {
        rates.map_or_else(|| self.rates(state).variables, |rates| rates.variables)
    }

    /// The part of the input that controllers hold, where there are some that sample: a run makes a step end where that
    /// changes.
    fn held(&self) -> Option<&Cell<Input<Self>>> {
        None
    }

    /// The state at time t with the quasi-velocities z.
    #[inline(always)]
    fn state(&self, t: Scalar<Self>, q: Configuration<Self>, z: &Speeds<Self>) -> State<Self::System> {
        State { t, q, y: self.variables(t, &q, z) }
    }

    /// The state with z in the place of y, in which errors of steps are measured.
    #[inline(always)]
    fn in_speeds(&self, state: &State<Self::System>) -> State<Self::System> {
        let State { t, q, y } = *state;
        State { t, q, y: self.speeds(t, &q, &y) }
    }

    /// Both velocities and momenta of a state.
    #[inline(always)]
    fn sample(&self, state: &State<Self::System>) -> Sample<Self::System> {
        let State { t, q, y } = *state;
        Sample { t, q, z: self.speeds(t, &q, &y), p: self.momentum(t, &q, &y) }
    }
}

/// The problem of a kernel: its equations in one of two forms, with the source of its input.
#[derive(Debug)]
pub struct SystemProblem<'k, S, F = VelocityForm, I = NoInput> {
    /// The kernel.
    pub system: &'k S,
    /// Velocity or momentum form.
    pub form: F,
    /// The source of the inputs.
    pub input: I,
}

// Written by hand: the system is only borrowed, and need not be `Copy`.
impl<S, F: Copy, I: Copy> Copy for SystemProblem<'_, S, F, I> {}

impl<S, F: Clone, I: Clone> Clone for SystemProblem<'_, S, F, I> {
    fn clone(&self) -> Self {
        Self { system: self.system, form: self.form.clone(), input: self.input.clone() }
    }
}

impl<'k, S> SystemProblem<'k, S> {
    /// In velocity form and without inputs.
    pub fn new(system: &'k S) -> Self {
        Self { system, form: VelocityForm, input: NoInput }
    }
}

impl<'k, S, F, I> SystemProblem<'k, S, F, I> {
    /// The same in another form.
    pub fn form<G>(self, form: G) -> SystemProblem<'k, S, G, I> {
        SystemProblem { system: self.system, form, input: self.input }
    }

    /// The same with [contacts](GaussSystem::HAS_CONTACTS) left out on purpose, as if all gaps stayed open.
    pub fn without_contacts(self) -> SystemProblem<'k, S, WithoutContacts<F>, I> {
        SystemProblem { system: self.system, form: WithoutContacts(self.form), input: self.input }
    }

    /// The same under another input.
    pub fn input_from<J>(self, input: J) -> SystemProblem<'k, S, F, J> {
        SystemProblem { system: self.system, form: self.form, input }
    }
}

impl<S: GaussSystem, F: Form<S>, I: InputSource<S>> Problem for SystemProblem<'_, S, F, I> {
    type System = S;
    const LEAVES_CONTACTS_OUT: bool = F::LEAVES_CONTACTS_OUT;

    #[inline(always)]
    fn system(&self) -> &S {
        self.system
    }
    #[inline(always)]
    fn input(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Input {
        self.input.input(t, q, z)
    }
    #[inline(always)]
    fn variables(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.form.variables(self.system, t, q, z)
    }
    #[inline(always)]
    fn of_momentum(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        self.form.of_momentum(self.system, t, q, p)
    }
    #[inline(always)]
    fn speeds(&self, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.form.speeds(self.system, t, q, y)
    }
    #[inline(always)]
    fn momentum(&self, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.form.momentum(self.system, t, q, y)
    }
    #[inline(always)]
    fn rates(&self, state: &State<S>) -> Rates<S> {
        self.form.rates(self.system, &self.input, state)
    }
    #[inline(always)]
    fn both_rates(&self, state: &State<S>, known: &S::Speeds) -> (S::Speeds, S::Speeds) {
        self.form.both_rates(self.system, &self.input, state, known)
    }
    #[inline(always)]
    fn change_of_speeds(&self, state: &State<S>, change: &Rates<S>) -> Rates<S> {
        self.form.change_of_speeds(self.system, state, change)
    }
    #[inline(always)]
    fn held(&self) -> Option<&Cell<S::Input>> {
        self.input.held()
    }
}
