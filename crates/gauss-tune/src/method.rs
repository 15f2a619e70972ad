//! Methods and forms that are chosen at run time, as [`Tune::tune`](crate::Tune::tune) does.

use core::fmt;

use gauss_runtime::integrate::{
    Adaptive, Classical4, Collocation, CommutatorFree4, Composed, Composition, Control, DormandPrince5, DormandPrince8,
    Fixed, Form, InputSource, IntegrationError, IntegrationErrorKind, MomentumForm, Problem, Rates, RungeKutta, State,
    StepCallback, VelocityForm, Verner9,
};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// A method with its step or tolerances, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method<T> {
    /// Classical Runge–Kutta steps of order 4 and one length.
    RungeKutta4 {
        /// Their length.
        step: T,
    },
    /// Commutator-free steps of order 4 and one length.
    CommutatorFree4 {
        /// Their length.
        step: T,
    },
    /// Steps of Gauss' collocation of order 6 and one length.
    Gauss6 {
        /// Their length.
        step: T,
    },
    /// The pair of Dormand and Prince of order 5.
    DormandPrince5 {
        /// The relative tolerance of a step.
        relative: f64,
        /// The absolute tolerance of a step.
        absolute: f64,
    },
    /// The pair of Dormand and Prince of order 8.
    DormandPrince8 {
        /// The relative tolerance of a step.
        relative: f64,
        /// The absolute tolerance of a step.
        absolute: f64,
    },
    /// Verner's pair of order 9.
    Verner9 {
        /// The relative tolerance of a step.
        relative: f64,
        /// The absolute tolerance of a step.
        absolute: f64,
    },
    /// Steps of Gauss' collocation of order 4 and one length.
    Gauss4 {
        /// Their length.
        step: T,
    },
    /// Gauss' collocation of order 6, composed to order 8 by Kahan and Li.
    Gauss8 {
        /// The length of a step, of which the collocation makes seventeen.
        step: T,
    },
}

/// What [`Tune::tune`](crate::Tune::tune) varies in a method.
pub(crate) enum Family<T> {
    /// The length of its steps, with whose power `order` the error goes.
    Steps { order: u32, of: fn(T) -> Method<T> },
    /// Its relative and absolute tolerance, which the error is proportional to.
    Tolerances { of: fn(f64, f64) -> Method<T> },
}

impl<T> Method<T> {
    /// All that [`Tune::tune`](crate::Tune::tune) tries, the likely ones first: what they take bounds the search among
    /// the rest.
    pub(crate) const FAMILIES: [Family<T>; 8] = [
        Family::Tolerances { of: |relative, absolute| Self::DormandPrince8 { relative, absolute } },
        Family::Tolerances { of: |relative, absolute| Self::Verner9 { relative, absolute } },
        Family::Tolerances { of: |relative, absolute| Self::DormandPrince5 { relative, absolute } },
        Family::Steps { order: 6, of: |step| Self::Gauss6 { step } },
        Family::Steps { order: 4, of: |step| Self::Gauss4 { step } },
        Family::Steps { order: 8, of: |step| Self::Gauss8 { step } },
        Family::Steps { order: 4, of: |step| Self::RungeKutta4 { step } },
        Family::Steps { order: 4, of: |step| Self::CommutatorFree4 { step } },
    ];
}

/// Calls a method of [`Control`] of the integrator that a [`Method`] stands for.
macro_rules! dispatch {
    ($method:expr, $control:ident => $call:expr) => {
        match *$method {
            Method::RungeKutta4 { step } => {
                let $control = Fixed::by(RungeKutta(Classical4), step);
                $call
            }
            Method::CommutatorFree4 { step } => {
                let $control = Fixed::by(CommutatorFree4, step);
                $call
            }
            Method::Gauss6 { step } => {
                let $control = Fixed::by(Collocation::order_6(), step);
                $call
            }
            Method::DormandPrince5 { relative, absolute } => {
                let $control = Adaptive::by(RungeKutta(DormandPrince5), relative, absolute);
                $call
            }
            Method::DormandPrince8 { relative, absolute } => {
                let $control = Adaptive::by(RungeKutta(DormandPrince8), relative, absolute);
                $call
            }
            Method::Verner9 { relative, absolute } => {
                let $control = Adaptive::by(RungeKutta(Verner9), relative, absolute);
                $call
            }
            Method::Gauss4 { step } => {
                let $control = Fixed::by(Collocation::order_4(), step);
                $call
            }
            Method::Gauss8 { step } => {
                let $control = Fixed::by(Composed::new(&Composition::KAHAN_LI_8, Collocation::order_6()), step);
                $call
            }
        }
    };
}

impl<S: GaussSystem> Control<S> for Method<S::Scalar> {
    fn drive<P: Problem<System = S>>(
        &self,
        problem: &P,
        start: State<S>,
        end: S::Scalar,
        limit: u64,
        emit: &mut StepCallback<'_, S>,
    ) -> Result<State<S>, IntegrationError> {
        dispatch!(self, control => control.drive(problem, start, end, limit, emit))
    }

    fn within<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind> {
        dispatch!(self, control => control.within(problem, state, rates, h))
    }
}

impl<T: Real> fmt::Display for Method<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by_tolerance = |f: &mut fmt::Formatter<'_>, name: &str, relative: f64, absolute: f64| {
            write!(f, "{name}, tolerances {relative:.1e} and {absolute:.1e}")
        };
        let (name, step) = match *self {
            Self::RungeKutta4 { step } => ("Runge–Kutta 4", step),
            Self::CommutatorFree4 { step } => ("commutator-free 4", step),
            Self::Gauss4 { step } => ("Gauss 4", step),
            Self::Gauss6 { step } => ("Gauss 6", step),
            Self::Gauss8 { step } => ("Gauss 6 composed to 8", step),
            Self::DormandPrince5 { relative, absolute } => {
                return by_tolerance(f, "Dormand–Prince 5", relative, absolute);
            }
            Self::DormandPrince8 { relative, absolute } => {
                return by_tolerance(f, "Dormand–Prince 8", relative, absolute);
            }
            Self::Verner9 { relative, absolute } => return by_tolerance(f, "Verner 9", relative, absolute),
        };
        write!(f, "{name}, step {:.3e}", step.lane(0))
    }
}

/// A form of the equations, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EitherForm {
    /// [`VelocityForm`].
    Velocity,
    /// [`MomentumForm`].
    Momentum,
}

/// The same method of the form that is meant.
macro_rules! either {
    ($form:expr, $method:ident($($argument:expr),*)) => {
        match $form {
            EitherForm::Velocity => VelocityForm.$method($($argument),*),
            EitherForm::Momentum => MomentumForm.$method($($argument),*),
        }
    };
}

impl<S: GaussSystem> Form<S> for EitherForm {
    #[inline]
    fn variables(self, system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        either!(self, variables(system, t, q, z))
    }
    #[inline]
    fn speeds(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        either!(self, speeds(system, t, q, y))
    }
    #[inline]
    fn momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, y: &S::Speeds) -> S::Speeds {
        either!(self, momentum(system, t, q, y))
    }
    #[inline]
    fn of_momentum(self, system: &S, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        either!(self, of_momentum(system, t, q, p))
    }
    #[inline]
    fn rates<I: InputSource<S>>(self, system: &S, input: &I, state: &State<S>) -> Rates<S> {
        either!(self, rates(system, input, state))
    }
    #[inline]
    fn both_rates<I: InputSource<S>>(
        self,
        system: &S,
        input: &I,
        state: &State<S>,
        known: &S::Speeds,
    ) -> (S::Speeds, S::Speeds) {
        either!(self, both_rates(system, input, state, known))
    }
    #[inline]
    fn change_of_speeds(self, system: &S, state: &State<S>, change: &Rates<S>) -> Rates<S> {
        either!(self, change_of_speeds(system, state, change))
    }
}

impl fmt::Display for EitherForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Velocity => "velocity",
            Self::Momentum => "momentum",
        })
    }
}
