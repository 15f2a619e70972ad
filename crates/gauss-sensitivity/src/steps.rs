//! Methods whose steps are differentiated.

use std::ops::ControlFlow;

use gauss_runtime::integrate::drive::observer::Observer;
use gauss_runtime::integrate::{
    Adaptive, Coefficients, CommutatorFree4, Control, Crossing, DEFAULT_LIMIT, Fixed, InputSource, IntegrationError,
    IntegrationErrorKind, Method, MethodControl, MethodError, MethodStep, Problem, Rates, RungeKutta, Sample,
    Simulation, State, StepSetting, SystemProblem, VelocityForm,
};
use gauss_runtime::system::GaussSystem;

mod sealed {
    pub trait Sealed {}
}

/// Explicit methods with their choice of steps: [`Fixed`] and [`Adaptive`] by [`RungeKutta`], [`Fixed`] by
/// [`CommutatorFree4`], and whatever of these is chosen by name, an [`ExplicitMethod`].
///
/// Implicit methods are not among them: their iterations end where values have converged, and derivatives may not
/// have.
pub trait Steps: sealed::Sealed {
    /// One step, brought onto the constraints where there are any.
    #[doc(hidden)]
    fn step<S: GaussSystem, P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<State<S>, IntegrationErrorKind>;

    /// Carries a state to a time, by steps as long as they are chosen: `reached` is told the times at which they end,
    /// and whether the state jumps there. Where the function of an event passes through zero it jumps, or the run ends
    /// there; whether it did.
    #[doc(hidden)]
    fn drive<S, I, E, J>(
        &self,
        problem: SystemProblem<'_, S, VelocityForm, I>,
        state: State<S>,
        end: f64,
        event: Event<E, J>,
        reached: &mut dyn FnMut(f64, bool),
    ) -> Result<(State<S>, bool), IntegrationError>
    where
        S: GaussSystem<Scalar = f64>,
        I: InputSource<S>,
        E: Fn(f64, &S::Configuration, &S::Speeds) -> f64,
        J: FnMut(&mut Sample<S>);

    /// The same after steps of about this length, where there were any.
    #[doc(hidden)]
    #[must_use]
    fn after(&self, length: Option<f64>) -> Self;
}

/// The function of an event, and its jump, with whether the function may go on.
type Event<E, J> = (Option<(Crossing, E)>, Option<(J, bool)>);

/// The times at which steps end, and those of jumps.
struct TimeObserver<'a>(&'a mut dyn FnMut(f64, bool));

impl<S: GaussSystem<Scalar = f64>> Observer<S> for TimeObserver<'_> {
    fn see(&mut self, sample: &Sample<S>) {
        (self.0)(sample.t, false);
    }

    fn event(&mut self, _: usize, sample: &Sample<S>) {
        (self.0)(sample.t, true);
    }
}

/// [`Steps::drive`] by a control.
fn drive_by<S, C, I, E, J>(
    control: C,
    problem: SystemProblem<'_, S, VelocityForm, I>,
    state: State<S>,
    end: f64,
    (event, jump): Event<E, J>,
    reached: &mut dyn FnMut(f64, bool),
) -> Result<(State<S>, bool), IntegrationError>
where
    S: GaussSystem<Scalar = f64>,
    C: Control<S>,
    I: InputSource<S>,
    E: Fn(f64, &S::Configuration, &S::Speeds) -> f64,
    J: FnMut(&mut Sample<S>),
{
    let Some((crossing, function)) = event else {
        let each = &mut |state: &State<S>, _: &Rates<S>, _| {
            reached(state.t, false);
            ControlFlow::Continue(())
        };
        return control.drive(&problem, state, end, DEFAULT_LIMIT, each).map(|end| (end, false));
    };
    let SystemProblem { system, input, .. } = problem;
    let run = Simulation::new(system).input_from(input).control(control);
    let (q, z, interval) = (state.q, state.y, state.t..end);
    let end = match jump {
        None => {
            let seen = |sample: &Sample<S>| reached(sample.t, false);
            run.observe(seen).until(crossing, function).run_to_end(q, z, interval)?
        }
        Some((jump, true)) => {
            let run = run.event(crossing, function).then_through(jump);
            run.observe_by(TimeObserver(reached)).run_to_end(q, z, interval)?
        }
        Some((jump, false)) => {
            run.event(crossing, function).then(jump).observe_by(TimeObserver(reached)).run_to_end(q, z, interval)?
        }
    };
    Ok((State { t: end.t, q: end.q, y: end.z }, end.stopped_by.is_some()))
}

/// An explicit method of one step that is chosen by name, with its choice of steps:
/// [`Derivatives::by_method`](crate::Derivatives::by_method).
#[derive(Clone, Copy, Debug)]
pub struct ExplicitMethod {
    method: MethodStep,
    control: MethodControl<f64>,
}

impl ExplicitMethod {
    pub(crate) fn new(method: Method, setting: StepSetting<f64>) -> Result<Self, MethodError> {
        let explicit = MethodStep::of(method).filter(|_| method.is_explicit_step());
        Ok(Self { method: explicit.ok_or(MethodError::Implicit(method))?, control: method.control(setting)? })
    }
}

/// Implements [`Steps`] for types that have a method as a field `method`: with the control that makes the steps, and
/// the same after steps of about a length.
macro_rules! steps {
    ($([$($generics:tt)*] $control:ty: |$self:ident, $length:ident| $by:expr, $after:expr;)+) => {$(
        impl<$($generics)*> sealed::Sealed for $control {}

        impl<$($generics)*> Steps for $control {
            fn step<S: GaussSystem, P: Problem<System = S>>(
                &self,
                problem: &P,
                state: &State<S>,
                rates: &Rates<S>,
                h: S::Scalar,
            ) -> Result<State<S>, IntegrationErrorKind> {
                Fixed::by(self.method, h).within(problem, state, rates, h)
            }

            fn drive<S, I, E, J>(
                &$self,
                problem: SystemProblem<'_, S, VelocityForm, I>,
                state: State<S>,
                end: f64,
                event: Event<E, J>,
                reached: &mut dyn FnMut(f64, bool),
            ) -> Result<(State<S>, bool), IntegrationError>
            where
                S: GaussSystem<Scalar = f64>,
                I: InputSource<S>,
                E: Fn(f64, &S::Configuration, &S::Speeds) -> f64,
                J: FnMut(&mut Sample<S>),
            {
                drive_by($by, problem, state, end, event, reached)
            }

            fn after(&$self, $length: Option<f64>) -> Self {
                $after
            }
        }
    )+};
}

steps! {
    [C: Coefficients<N> + Copy, const N: usize] Fixed<f64, RungeKutta<C, N>>: |self, _length| *self, *self;
    [] Fixed<f64, CommutatorFree4>: |self, _length| *self, *self;
    [C: Coefficients<N> + Copy, const N: usize] Adaptive<RungeKutta<C, N>>: |self, length| *self, {
        length.map_or(*self, |length| self.first_step(length))
    };
    [] ExplicitMethod: |self, length| self.control, {
        let after = |length| Self { control: self.control.first_step(length), ..*self };
        length.map_or(*self, after)
    };
}
