//! Methods of the table with their choice of steps, as one type that a run takes.

use crate::integrate::adams::Adams;
use crate::integrate::choice::error::MethodError;
use crate::integrate::choice::method::{Method, with_methods};
use crate::integrate::choice::step::{Absent, JacobianMethod, MethodPair, MethodPlace, MethodStep, NoTaylor};
use crate::integrate::drive::adaptive::Adaptive;
use crate::integrate::drive::control::{Control, Progress, StepCallback};
use crate::integrate::drive::fixed::Fixed;
use crate::integrate::drive::tolerance::Tolerance;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::{IntegrationError, IntegrationErrorKind};
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::one_step::EstimatingStep;
use crate::integrate::taylor::Taylor;
use crate::real::Real;
use crate::system::GaussSystem;

/// Lengths of the steps of a method that is chosen by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepSetting<T> {
    /// All of one length.
    Equal(T),
    /// Steps as long as a relative and an absolute tolerance allow, and no longer than `largest`.
    Tolerant {
        /// The relative tolerance.
        relative: f64,
        /// The absolute tolerance.
        absolute: f64,
        /// The longest step, where there is one.
        largest: Option<f64>,
    },
}

impl<T> StepSetting<T> {
    /// Steps as long as a relative and an absolute tolerance allow.
    #[must_use]
    pub const fn tolerant(relative: f64, absolute: f64) -> Self {
        Self::Tolerant { relative, absolute, largest: None }
    }
}

impl StepSetting<f64> {
    /// The same in any scalar, for lanes.
    #[must_use]
    pub fn in_scalar<T: Real>(self) -> StepSetting<T> {
        match self {
            Self::Equal(step) => StepSetting::Equal(T::from_f64(step)),
            Self::Tolerant { relative, absolute, largest } => StepSetting::Tolerant { relative, absolute, largest },
        }
    }
}

/// The control of a method that is chosen by name, with its controls and their memories; see [`control`].
macro_rules! control {
    (
        pairs { $($pairs:tt)+ }
        jacobians { $($jacobians:tt)+ }
        singles { $($singles:tt)+ }
        multisteps { $(
            $(#[$about:meta])+ $multi:ident $name:literal $order:literal $clause:literal [$($word:literal),*]
                $explicit:ident: $multi_value:expr => $multi_type:ty;
        )+ }
        series { $(
            $(#[$series_about:meta])+ $series:ident $series_name:literal $series_order:literal $series_clause:literal
                [$($series_word:literal),*] $series_explicit:ident: $series_value:expr => $series_type:ty;
        )+ }
    ) => {
        impl<T: Real, R: MethodPlace<JacobianMethod>, P: MethodPlace<Taylor>> MethodControl<T, R, P> {
            /// The control of a method with such steps.
            ///
            /// # Errors
            /// [`MethodError`]: the method makes no such steps, or needs a clause that there is no place for.
            pub fn new(method: Method, setting: StepSetting<T>) -> Result<Self, MethodError> {
                let (made, otherwise) = match (method, setting) {
                    $((Method::$multi, StepSetting::Equal(step)) => return Ok(Self::$multi($multi_value(step))),)+
                    $((Method::$series, StepSetting::Tolerant { relative, absolute, largest }) => {
                        let control: Option<$series_type> = ($series_value)(relative, absolute, largest);
                        (control.map(Self::$series), None)
                    })+
                    (_, StepSetting::Equal(step)) => {
                        let refused = (!method.takes_length()).then_some(MethodError::NoLength(method));
                        (MethodStep::of(method).map(|method| Self::Fixed(Fixed::by(method, step))), refused)
                    }
                    (_, StepSetting::Tolerant { relative, absolute, largest }) => {
                        let refused = (!method.keeps_tolerances()).then_some(MethodError::NoEstimate(method));
                        let by = |pair| Adaptive {
                            largest_step: largest,
                            ..Adaptive::by(pair, relative, absolute)
                        };
                        (MethodPair::of(method).map(|pair| Self::Adaptive(by(pair))), refused)
                    }
                };
                let clause = || MethodError::Clause(method, method.clause().unwrap_or_default());
                made.ok_or_else(|| otherwise.unwrap_or_else(clause))
            }
        }

        control! { @
            /// Steps of one length, by any method of one step.
            Fixed: Fixed<T, MethodStep<R>>;
            /// Steps as long as tolerances allow, by a method that estimates its error.
            Adaptive: Adaptive<MethodPair<R>>;
            $($(#[$about])+ $multi: $multi_type;)+
            $($(#[$series_about])+ $series: $series_type;)+
        }
    };
    (@ $($(#[$about:meta])+ $kind:ident: $type:ty;)+) => {
        /// The control of a run by a method that was chosen by name: made by [`Method::control`].
        ///
        /// A run by it has the bits of one by the method's own type, and asks once for each call of
        /// [`advance`](Control::advance), and for each step, which method it is. `R` and `P` are
        /// [`JacobianMethod`] and [`Taylor`] where the system is one of
        /// [`LinearizedSystem`](crate::linearize::LinearizedSystem), and [`TaylorSystem`](crate::series::TaylorSystem).
        #[derive(Clone, Copy, Debug)]
        pub enum MethodControl<T, R = Absent, P = NoTaylor> {
            $($(#[$about])+ $kind($type),)+
        }

        /// The memory of a run by a [`MethodControl`], with the control that remembers it.
        pub enum MethodMemory<S, T, R, P>
        where
            S: GaussSystem<Scalar = T>,
            T: Real,
            R: EstimatingStep<S>,
            P: Control<S>,
        {
            $($(#[$about])+ $kind($type, <$type as Control<S>>::StepMemory),)+
        }

        impl<S: GaussSystem<Scalar = T>, T: Real, R: EstimatingStep<S> + Copy, P: Control<S> + Copy> Clone
            for MethodMemory<S, T, R, P>
        {
            fn clone(&self) -> Self {
                match self {
                    $(Self::$kind(control, memory) => Self::$kind(*control, memory.clone()),)+
                }
            }
        }

        impl<S, T, R, P> Control<S> for MethodControl<T, R, P>
        where
            S: GaussSystem<Scalar = T>,
            T: Real,
            R: EstimatingStep<S> + Copy,
            P: Control<S> + Copy,
        {
            type StepMemory = MethodMemory<S, T, R, P>;

            fn start<E: Problem<System = S>>(
                &self,
                problem: &E,
                start: State<S>,
                end: T,
                limit: u64,
                emit: &mut StepCallback<'_, S>,
            ) -> Result<Progress<S, Self::StepMemory>, IntegrationError> {
                match *self {
                    $(Self::$kind(control) => {
                        let run = control.start(problem, start, end, limit, emit)?;
                        Ok(run.with(|memory| MethodMemory::$kind(control, memory)))
                    })+
                }
            }

            fn advance<E: Problem<System = S>>(
                &self,
                problem: &E,
                run: &mut Progress<S, Self::StepMemory>,
                emit: &mut StepCallback<'_, S>,
            ) -> Result<(), IntegrationError> {
                let Progress { state, rates, end, ended, memory } = run;
                match memory {
                    $(MethodMemory::$kind(control, memory) => {
                        let (state_before, rates_before) = (*state, *rates);
                        let mut own = Progress {
                            state: state_before,
                            rates: rates_before,
                            end: *end,
                            ended: *ended,
                            memory: memory.clone(),
                        };
                        let outcome = control.advance(problem, &mut own, emit);
                        (*state, *rates, *ended, *memory) = (own.state, own.rates, own.ended, own.memory);
                        outcome
                    })+
                }
            }

            fn tolerance(&self) -> Option<Tolerance> {
                match self {
                    $(Self::$kind(control) => Control::<S>::tolerance(control),)+
                }
            }

            fn within<E: Problem<System = S>>(
                &self,
                problem: &E,
                state: &State<S>,
                rates: &Rates<S>,
                h: T,
            ) -> Result<State<S>, IntegrationErrorKind> {
                match self {
                    $(Self::$kind(control) => control.within(problem, state, rates, h),)+
                }
            }

            #[expect(non_snake_case, reason = "each has the name of its control")]
            fn along<E: Problem<System = S>>(
                &self,
                problem: &E,
                state: &State<S>,
                rates: &Rates<S>,
            ) -> impl FnMut(T) -> Result<State<S>, IntegrationErrorKind> {
                let long = self.long_steps();
                $(let mut $kind = match self {
                    Self::$kind(control) if long => Some(control.along(problem, state, rates)),
                    _ => None,
                };)+
                let (state, rates) = (*state, *rates);
                move |h| {
                    $(if let Some(along) = &mut $kind {
                        return along(h);
                    })+
                    self.within(problem, &state, &rates, h)
                }
            }

            fn long_steps(&self) -> bool {
                match self {
                    $(Self::$kind(control) => Control::<S>::long_steps(control),)+
                }
            }
        }
    };
}

with_methods!(control);

impl<T: Real, R, P> MethodControl<T, R, P> {
    /// The length of the first step: see [`Adaptive::first_step`], whose steps alone are chosen by it.
    #[must_use]
    pub fn first_step(mut self, length: f64) -> Self {
        if let Self::Adaptive(control) = &mut self {
            control.first_step = Some(length);
        }
        self
    }

    /// The time within which inputs change: see [`Adaptive::input_changes_within`], of whose steps alone it is asked.
    #[must_use]
    pub fn input_changes_within(mut self, time: f64) -> Self {
        if let Self::Adaptive(control) = &mut self {
            control.input_changes = Some(time);
        }
        self
    }
}

impl Method {
    /// The control of this method with such steps, for [`Simulation::control`](crate::integrate::Simulation::control):
    /// without a word of others one for all systems, of which none has to say a clause.
    ///
    /// # Errors
    /// [`MethodError`]: the method makes no such steps, or needs a clause that there is no place for.
    pub fn control<T: Real, R: MethodPlace<JacobianMethod>, P: MethodPlace<Taylor>>(
        self,
        setting: StepSetting<T>,
    ) -> Result<MethodControl<T, R, P>, MethodError> {
        MethodControl::new(self, setting)
    }
}
