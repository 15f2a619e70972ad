//! Methods whose steps are differentiated.

use std::ops::ControlFlow;

use gauss_runtime::integrate::{
    Adaptive, Coefficients, CommutatorFree4, Control, Crossing, DEFAULT_LIMIT, Fixed, InputSource, IntegrationError,
    IntegrationErrorKind, Problem, Rates, RungeKutta, Sample, Simulation, State, SystemProblem, VelocityForm,
};
use gauss_runtime::system::GaussSystem;

mod sealed {
    pub trait Sealed {}
}

/// Explicit methods with their choice of steps: [`Fixed`] and [`Adaptive`] by [`RungeKutta`], [`Fixed`] by
/// [`CommutatorFree4`].
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

    /// From a state to a time, by steps as long as they are chosen: `reached` is told the times at which they end.
    /// Where the function of an event passes through zero the run ends there; whether it did.
    #[doc(hidden)]
    fn drive<S: GaussSystem<Scalar = f64>, I: InputSource<S>, E: Fn(f64, &S::Configuration, &S::Speeds) -> f64>(
        &self,
        problem: SystemProblem<'_, S, VelocityForm, I>,
        state: State<S>,
        end: f64,
        event: Option<(Crossing, E)>,
        reached: &mut dyn FnMut(f64),
    ) -> Result<(State<S>, bool), IntegrationError>;

    /// The same after steps of about this length, where there were any.
    #[doc(hidden)]
    #[must_use]
    fn after(&self, length: Option<f64>) -> Self;
}

/// [`Steps::drive`] by a control.
fn drive_by<S, C, I, E>(
    control: C,
    problem: SystemProblem<'_, S, VelocityForm, I>,
    state: State<S>,
    end: f64,
    event: Option<(Crossing, E)>,
    reached: &mut dyn FnMut(f64),
) -> Result<(State<S>, bool), IntegrationError>
where
    S: GaussSystem<Scalar = f64>,
    C: Control<S>,
    I: InputSource<S>,
    E: Fn(f64, &S::Configuration, &S::Speeds) -> f64,
{
    let Some((crossing, function)) = event else {
        let each = &mut |state: &State<S>, _: &Rates<S>, _| {
            reached(state.t);
            ControlFlow::Continue(())
        };
        return control.drive(&problem, state, end, DEFAULT_LIMIT, each).map(|end| (end, false));
    };
    let SystemProblem { system, input, .. } = problem;
    let run = Simulation::new(system).input_from(input).observe(|sample: &Sample<S>| reached(sample.t));
    let run = run.until(crossing, function).control(control);
    let end = run.run_to_end(state.q, state.y, state.t..end)?;
    Ok((State { t: end.t, q: end.q, y: end.z }, end.stopped_by.is_some()))
}

macro_rules! steps {
    ($([$($generics:tt)*] $control:ty: |$self:ident, $length:ident| $after:expr;)+) => {$(
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

            fn drive<S: GaussSystem<Scalar = f64>, I: InputSource<S>, E: Fn(f64, &S::Configuration, &S::Speeds) -> f64>(
                &self,
                problem: SystemProblem<'_, S, VelocityForm, I>,
                state: State<S>,
                end: f64,
                event: Option<(Crossing, E)>,
                reached: &mut dyn FnMut(f64),
            ) -> Result<(State<S>, bool), IntegrationError> {
                drive_by(*self, problem, state, end, event, reached)
            }

            fn after(&$self, $length: Option<f64>) -> Self {
                $after
            }
        }
    )+};
}

steps! {
    [C: Coefficients<N> + Copy, const N: usize] Fixed<f64, RungeKutta<C, N>>: |self, _length| *self;
    [] Fixed<f64, CommutatorFree4>: |self, _length| *self;
    [C: Coefficients<N> + Copy, const N: usize] Adaptive<RungeKutta<C, N>>: |self, length| {
        length.map_or(*self, |length| self.first_step(length))
    };
}
