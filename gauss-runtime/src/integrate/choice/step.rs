//! Methods of one step of the table, as one type.

use crate::integrate::choice::method::{Method, with_methods};
use crate::integrate::drive::adaptive::Adaptive;
use crate::integrate::lie_group::commutator_free::CommutatorFree4;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::rosenbrock::Rosenbrock;
use crate::integrate::runge_kutta::components::RungeKutta;
use crate::integrate::runge_kutta::tableau::{Classical4, DormandPrince5, DormandPrince8, Verner9};
use crate::integrate::step::one_step::{EstimatingStep, OneStep, Properties, Step};
use crate::integrate::structure::collocation::Collocation;
use crate::integrate::taylor::Taylor;
use crate::linearize::LinearizedSystem;
use crate::system::GaussSystem;

/// Place in a choice of methods for one that needs a clause: the method itself, or [`Absent`].
pub trait MethodPlace<M>: Copy {
    /// The method in its place; none where there is no place.
    fn put(method: M) -> Option<Self>;
}

/// No place for a method that needs a clause: of this type there is no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {}

/// No place for Taylor's method: a control of which there is no value.
pub type NoTaylor = Adaptive<Absent>;

impl MethodPlace<JacobianMethod> for Absent {
    fn put(_: JacobianMethod) -> Option<Self> {
        None
    }
}

impl MethodPlace<JacobianMethod> for JacobianMethod {
    fn put(method: JacobianMethod) -> Option<Self> {
        Some(method)
    }
}

impl MethodPlace<Taylor> for NoTaylor {
    fn put(_: Taylor) -> Option<Self> {
        None
    }
}

impl MethodPlace<Taylor> for Taylor {
    fn put(method: Taylor) -> Option<Self> {
        Some(method)
    }
}

impl<S: GaussSystem> OneStep<S> for Absent {
    fn properties(&self) -> Properties {
        match *self {}
    }

    fn step<P: Problem<System = S>>(
        &self,
        _: &P,
        _: &State<S>,
        _: &Rates<S>,
        _: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        match *self {}
    }
}

impl<S: GaussSystem> EstimatingStep<S> for Absent {
    fn estimate_order(&self) -> f64 {
        match *self {}
    }
}

/// The three enums of the table: methods that need Jacobians, all that estimate their errors, all methods of one step.
macro_rules! one_step {
    (
        pairs { $(
            $(#[$about:meta])+ $pair:ident $name:literal $order:literal $clause:literal [$($word:literal),*]
                $explicit:ident: $value:expr => $type:ty;
        )+ }
        jacobians { $(
            $(#[$jacobian_about:meta])+ $jacobian:ident $jacobian_name:literal $jacobian_order:literal
                $jacobian_clause:literal [$($jacobian_word:literal),*] $implicit:ident:
                $jacobian_value:expr => $jacobian_type:ty;
        )+ }
        singles { $(
            $(#[$single_about:meta])+ $single:ident $single_name:literal $single_order:literal $single_clause:literal
                [$($single_word:literal),*] $single_explicit:ident: $single_value:expr;
        )+ }
        $($others:tt)*
    ) => {
        /// A method of the table that needs the derivatives of the equations, which `#[gauss(linearize)]` brings.
        #[derive(Clone, Copy, Debug)]
        #[non_exhaustive]
        pub enum JacobianMethod {
            $($(#[$jacobian_about])+ $jacobian($jacobian_type),)+
        }

        impl JacobianMethod {
            /// The method of a row; none where the row has no such method.
            #[must_use]
            pub const fn of(method: Method) -> Option<Self> {
                match method {
                    $(Method::$jacobian => Some(Self::$jacobian($jacobian_value)),)+
                    _ => None,
                }
            }
        }

        one_step!(@ [S: LinearizedSystem] JacobianMethod { $($jacobian(method) => *method;)+ });
        one_step!(@estimates [S: LinearizedSystem] JacobianMethod { $($jacobian)+ });

        /// A method of the table that estimates its error; `R` is [`JacobianMethod`], where derivatives may be asked
        /// for.
        #[derive(Clone, Copy, Debug)]
        #[non_exhaustive]
        pub enum MethodPair<R = Absent> {
            $($(#[$about])+ $pair($type),)+
            /// A method that needs derivatives.
            Jacobian(R),
        }

        impl<R: MethodPlace<JacobianMethod>> MethodPair<R> {
            /// The method of a row; none where the row has no such method, or there is no place for it.
            #[must_use]
            pub fn of(method: Method) -> Option<Self> {
                match method {
                    $(Method::$pair => $value.map(Self::$pair),)+
                    other => JacobianMethod::of(other).and_then(R::put).map(Self::Jacobian),
                }
            }
        }

        one_step!(@ [S: GaussSystem, R: EstimatingStep<S>] MethodPair<R> {
            $($pair(method) => *method;)+
            Jacobian(method) => *method;
        });
        one_step!(@estimates [S: GaussSystem, R: EstimatingStep<S>] MethodPair<R> { $($pair)+ Jacobian });

        /// A method of the table that makes single steps.
        #[derive(Clone, Copy, Debug)]
        #[non_exhaustive]
        pub enum MethodStep<R = Absent> {
            /// A method that estimates its error.
            Pair(MethodPair<R>),
            $($(#[$single_about])+ $single,)+
        }

        impl<R: MethodPlace<JacobianMethod>> MethodStep<R> {
            /// The method of a row; none where the row has no such method, or there is no place for it.
            #[must_use]
            pub fn of(method: Method) -> Option<Self> {
                match method {
                    $(Method::$single => Some(Self::$single),)+
                    pair => MethodPair::of(pair).map(Self::Pair),
                }
            }
        }

        one_step!(@ [S: GaussSystem, R: EstimatingStep<S>] MethodStep<R> {
            Pair(pair) => *pair;
            $($single => $single_value;)+
        });
    };
    (@ [$($generics:tt)+] $methods:ty { $($variant:ident $(($method:ident))? => $value:expr;)+ }) => {
        impl<$($generics)+> OneStep<S> for $methods {
            fn properties(&self) -> Properties {
                match self {
                    $(Self::$variant $(($method))? => OneStep::<S>::properties(&$value),)+
                }
            }

            #[inline]
            fn step<P: Problem<System = S>>(
                &self,
                problem: &P,
                state: &State<S>,
                rates: &Rates<S>,
                h: S::Scalar,
            ) -> Result<Step<S>, IntegrationErrorKind> {
                match self {
                    $(Self::$variant $(($method))? => $value.step(problem, state, rates, h),)+
                }
            }
        }
    };
    (@estimates [$($generics:tt)+] $methods:ty { $($variant:ident)+ }) => {
        impl<$($generics)+> EstimatingStep<S> for $methods {
            fn estimate_order(&self) -> f64 {
                match self {
                    $(Self::$variant(method) => EstimatingStep::<S>::estimate_order(method),)+
                }
            }

            #[inline]
            fn step_and_estimates<P: Problem<System = S>>(
                &self,
                problem: &P,
                state: &State<S>,
                rates: &Rates<S>,
                h: S::Scalar,
            ) -> Result<(Step<S>, Option<Rates<S>>), IntegrationErrorKind> {
                match self {
                    $(Self::$variant(method) => method.step_and_estimates(problem, state, rates, h),)+
                }
            }
        }
    };
}

with_methods!(one_step);
