//! The two forms of the equations of motion, seen by an integrator as one: `q̇ = q·V(t, q, y)`, `ẏ = f(t, q, y)`.
//!
//! The velocity form takes y = z; the momentum form takes y = p, and keeps what the momenta keep (in the
//! right-invariant chart without forces ṗ is zero, so every integrator keeps the momentum to the last bit).

use super::input::InputSource;
use super::state::{Rates, State};
use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::GaussSystem;

/// The variables y that are integrated together with the configuration: speeds or momenta.
pub trait Form<S: GaussSystem>: Copy {
    /// Whether [contacts](GaussSystem::HAS_CONTACTS) are left out on purpose: see [`WithoutContacts`].
    const LEAVES_CONTACTS_OUT: bool = false;

    /// y of a state given by its quasi-velocities.
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds;

    /// The quasi-velocities z of y.
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds;

    /// The momenta p of y.
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds;

    /// y of a state given by its momenta.
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds;

    /// V and ẏ.
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S>;

    /// (ż, ṗ), one of which is the known ẏ.
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds);

    /// A change of (q, y) that ends in `state`, as one of (q, z): what errors of steps are measured in.
    #[inline(always)]
    fn change_of_speeds(self, system: &S, state: &State<S>, change: &Rates<S>) -> Rates<S> {
        let _ = (system, state);
        *change
    }
}

/// y = z: integrate the quasi-velocities by `acceleration`.
#[derive(Clone, Copy, Debug, Default)]
pub struct VelocityForm;

/// y = p: integrate the momenta by `momentum_rate`.
#[derive(Clone, Copy, Debug, Default)]
pub struct MomentumForm;

/// Another form, of a scene whose [contacts](GaussSystem::HAS_CONTACTS) are left out on purpose: its gaps become
/// negative, and nothing touches.
#[derive(Clone, Copy, Debug, Default)]
pub struct WithoutContacts<F>(pub F);

impl<S: GaussSystem> Form<S> for VelocityForm {
    #[inline(always)]
    fn variables(self, _: &S, _: S::Scalar, _: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        *z
    }

    #[inline(always)]
    fn speeds(self, _: &S, _: S::Scalar, _: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        *y
    }

    #[inline(always)]
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        system.momentum(t, q, y)
    }

    #[inline(always)]
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        system.velocity(t, q, p)
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        let State { t, q, y } = state;
        let input = input.input(*t, q, y);
        Rates {
            configuration: system.configuration_rates(*t, q, y, &input),
            variables: system.acceleration(*t, q, y, &input),
        }
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        let State { t, q, y } = state;
        let (input, p) = (input.input(*t, q, y), system.momentum(*t, q, y));
        (*known, system.momentum_rate(*t, q, &p, &input))
    }
}

impl<S: GaussSystem> Form<S> for MomentumForm {
    #[inline(always)]
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        system.momentum(t, q, z)
    }

    #[inline(always)]
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        system.velocity(t, q, y)
    }

    #[inline(always)]
    fn momentum(self, _: &S, _: S::Scalar, _: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        *y
    }

    #[inline(always)]
    fn of_momentum(self, _: &S, _: S::Scalar, _: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        *p
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        let State { t, q, y } = state;
        let z = system.velocity(*t, q, y);
        let input = input.input(*t, q, &z);
        Rates {
            configuration: system.configuration_rates(*t, q, &z, &input),
            variables: system.momentum_rate(*t, q, y, &input),
        }
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        let State { t, q, y } = state;
        let z = system.velocity(*t, q, y);
        let input = input.input(*t, q, &z);
        (system.acceleration(*t, q, &z, &input), *known)
    }

    /// Near a singular place of a chart the same momenta at another q are other speeds.
    #[inline(always)]
    fn change_of_speeds(self, system: &S, state: &State<S>, change: &Rates<S>) -> Rates<S> {
        let (State { t, q, y }, back) = (state, -S::Scalar::one());
        let before = (q.retract(&change.configuration.scale(back)), y.add_scaled(back, &change.variables));
        let speeds = system.velocity(*t, &before.0, &before.1);
        let variables = system.velocity(*t, q, y).add_scaled(back, &speeds);
        Rates { configuration: change.configuration, variables }
    }
}

impl<S: GaussSystem, F: Form<S>> Form<S> for WithoutContacts<F> {
    const LEAVES_CONTACTS_OUT: bool = true;

    #[inline(always)]
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.0.variables(system, t, q, z)
    }

    #[inline(always)]
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.0.speeds(system, t, q, y)
    }

    #[inline(always)]
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        self.0.momentum(system, t, q, y)
    }

    #[inline(always)]
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        self.0.of_momentum(system, t, q, p)
    }

    #[inline(always)]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        self.0.rates(system, input, state)
    }

    #[inline(always)]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        self.0.both_rates(system, input, state, known)
    }

    #[inline(always)]
    fn change_of_speeds(self, system: &S, state: &State<S>, change: &Rates<S>) -> Rates<S> {
        self.0.change_of_speeds(system, state, change)
    }
}
