//! Runs as functions of numbers, which are differentiated.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::error::ParameterError;
use gauss_runtime::integrate::{Crossing, InputSource, IntegrationErrorKind, State, SystemProblem, VelocityForm};
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// The input of a system.
pub type InputOf<S> = <S as GaussSystem>::Input;

/// The configuration q of a system.
pub type ConfigurationOf<S> = <S as GaussSystem>::Configuration;

/// The quasi-velocities z of a system.
pub type SpeedsOf<S> = <S as GaussSystem>::Speeds;

/// Initial state of a run: q and z.
pub type Start<S> = (ConfigurationOf<S>, SpeedsOf<S>);

/// A state of a run, as inputs, events, costs and residuals see it.
pub struct At<'a, S: GaussSystem> {
    /// Number of the [instant](Run::instants), from 0, in costs and residuals. Where an [event](Run::until) ended the
    /// run it is the instant that would have come next. In inputs, events and jumps: the number of the interval between
    /// instants that the state is in, from 0.
    pub number: usize,
    /// Whether the run was ended by its event here; in jumps it is not.
    pub ended: bool,
    /// The system: energies, frames, inverse dynamics.
    pub system: &'a S,
    /// Time.
    pub t: S::Scalar,
    /// Configuration.
    pub q: &'a S::Configuration,
    /// Quasi-velocities.
    pub z: &'a S::Speeds,
}

// Written by hand: deriving would ask the same of the system S, which is only named here.
impl<S: GaussSystem> Clone for At<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: GaussSystem> Copy for At<'_, S> {}

/// A run as a function of P numbers: parameters of bodies, what the initial state is made of, gains of a controller,
/// the values of an input. Each method is written once, for any scalar, as kernels of structs `Arm<T>` are.
///
/// ```
/// use gauss_runtime::prelude::*;
/// use gauss_sensitivity::{Derivatives, Run, Start};
///
/// #[derive(GaussDynamics)]
/// #[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), spring(along = x, stiffness = k))]
/// struct Oscillator<T> {
///     m: T,
///     k: T,
/// }
///
/// /// By mass, stiffness and where it is let go.
/// struct Swing;
///
/// impl Run<3> for Swing {
///     type System<T: Real> = OscillatorKernel<T>;
///
///     fn instants(&self) -> &[f64] {
///         &[0.0, 2.0]
///     }
///
///     fn system<T: Real>(&self, &[m, k, _]: &[T; 3]) -> Result<OscillatorKernel<T>, ParameterError> {
///         Oscillator { m, k }.kernel()
///     }
///
///     fn start<T: Real>(&self, &[_, _, x]: &[T; 3], _: &OscillatorKernel<T>) -> Start<OscillatorKernel<T>> {
///         (SVector::from([x]), SVector::from([T::zero()]))
///     }
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (m, k, x) = (1.3_f64, 2.0_f64, 0.1);
/// let run = Derivatives::adaptive(1e-12, 1e-12).run(&Swing, &[m, k, x])?;
/// // x cos(ωt), ω = √(k/m).
/// let (omega, end) = ((k / m).sqrt(), &run[1]);
/// let by_omega = -x * 2.0 * (2.0 * omega).sin();
/// assert!((end.q_slopes[0][0] + by_omega * 0.5 * omega / m).abs() < 1e-11);
/// assert!((end.q_slopes[0][1] - by_omega * 0.5 * omega / k).abs() < 1e-11);
/// assert!((end.q_slopes[0][2] - (2.0 * omega).cos()).abs() < 1e-11);
/// # Ok(())
/// # }
/// ```
pub trait Run<const P: usize> {
    /// The kernel, in any scalar.
    type System<T: Real>: GaussSystem<Scalar = T, Input: VectorSpace<T>>;

    /// The time at which the run starts, those at which something is asked of it, and that of its end: at least two,
    /// each later than the one before (or each earlier). Steps end at all of them.
    fn instants(&self) -> &[f64];

    /// The system with these numbers.
    ///
    /// # Errors
    /// When no body has them.
    fn system<T: Real>(&self, numbers: &[T; P]) -> Result<Self::System<T>, ParameterError>;

    /// The initial state. Under constraints it satisfies them, by [`project`](GaussSystem::project) of the system
    /// where nothing else does it; its derivatives are projected onto them.
    fn start<T: Real>(&self, numbers: &[T; P], system: &Self::System<T>) -> Start<Self::System<T>>;

    /// The input, where the scene has one: a function of time and state that is smooth between instants.
    /// [`At::number`] tells which of the intervals it is for, so that an input may be held over each. A scene with
    /// inputs that does not write this does not compile.
    fn input<T: Real>(&self, numbers: &[T; P], at: &At<'_, Self::System<T>>) -> InputOf<Self::System<T>> {
        let _ = (numbers, at);
        const { assert!(InputOf::<Self::System<T>>::DIM == 0, "the scene has inputs: write `input`") }
        InputOf::<Self::System<T>>::zero()
    }

    /// The period of a controller that samples: with one, [`input`](Self::input) is asked at the start of the run and
    /// every period after that, and what it gives is held in between, as by
    /// [`Simulation::sampled`](gauss_runtime::integrate::Simulation::sampled); without, it is asked at every time.
    /// Derivatives pass through what each sample makes of the state. Steps end at samples as at instants; the run goes
    /// forward in time. A law has no memory of its own here: an integral is a state of an element, `states(…)`.
    fn period(&self) -> Option<f64> {
        None
    }

    /// A function that ends the run where it passes through zero in a direction; none, where this is not written. The
    /// answer is `Some` for all states or for none, always with the same direction. The state and the time there have
    /// derivatives where the function passes at a rate.
    fn until<T: Real>(&self, numbers: &[T; P], at: &At<'_, Self::System<T>>) -> Option<(Crossing, T)> {
        let _ = (numbers, at);
        None
    }

    /// The configuration and the speeds from which the run goes on at the event of [`until`](Self::until), in the place
    /// of ending there: a bounce, a blow, a switch. The answer is `Some` for all states or for none; under constraints
    /// it is brought onto them. Derivatives pass through the jump and its time. What jumps have to be is told at
    /// [`Simulation::then`](gauss_runtime::integrate::Simulation::then): a function of the configuration is turned
    /// back, but for [`goes_through`](Self::goes_through).
    fn jump<T: Real>(&self, numbers: &[T; P], at: &At<'_, Self::System<T>>) -> Option<Start<Self::System<T>>> {
        let _ = (numbers, at);
        None
    }

    /// Whether the function of the event may go on through zero after a jump, as at a gate that kicks.
    fn goes_through(&self) -> bool {
        false
    }
}

/// A run with a cost: the sum of one number for each instant.
pub trait Cost<const P: usize>: Run<P> {
    /// Computes the contribution of an instant to the cost, the first one included; 0 where nothing is asked.
    fn cost<T: Real>(&self, numbers: &[T; P], at: &At<'_, Self::System<T>>) -> T;
}

/// A run with R residuals for each instant: what was measured less what the run gives, over the standard deviation of
/// the measurement.
pub trait Residuals<const P: usize, const R: usize>: Run<P> {
    /// The residuals of an instant, the first one included; zeros where nothing was measured.
    fn residuals<T: Real>(&self, numbers: &[T; P], at: &At<'_, Self::System<T>>) -> [T; R];
}

/// Input of a system in one interval between instants.
pub(crate) struct Fed<'a, R: Run<P>, T: Real, const P: usize> {
    pub(crate) run: &'a R,
    pub(crate) numbers: &'a [T; P],
    pub(crate) system: &'a R::System<T>,
    pub(crate) number: usize,
    /// The input that a controller that samples holds.
    pub(crate) held: Option<InputOf<R::System<T>>>,
}

// Written by hand: deriving would ask the same of what is only named here.
impl<R: Run<P>, T: Real, const P: usize> Clone for Fed<'_, R, T, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Run<P>, T: Real, const P: usize> Copy for Fed<'_, R, T, P> {}

impl<T: Real, R: Run<P>, const P: usize> InputSource<R::System<T>> for Fed<'_, R, T, P> {
    fn input(&self, t: T, q: &ConfigurationOf<R::System<T>>, z: &SpeedsOf<R::System<T>>) -> InputOf<R::System<T>> {
        self.held.unwrap_or_else(|| self.run.input(self.numbers, &self.at(t, q, z)))
    }
}

impl<'a, T: Real, R: Run<P>, const P: usize> Fed<'a, R, T, P> {
    /// A state in the interval.
    pub(crate) fn at(
        &self,
        t: T,
        q: &'a ConfigurationOf<R::System<T>>,
        z: &'a SpeedsOf<R::System<T>>,
    ) -> At<'a, R::System<T>> {
        At { number: self.number, ended: false, system: self.system, t, q, z }
    }

    /// Samples a state: its input is held from there on.
    pub(crate) fn sample(&mut self, state: &State<R::System<T>>) {
        self.held = Some(self.run.input(self.numbers, &self.at(state.t, &state.q, &state.y)));
    }

    /// The state after the jump of the event, if it has one; else the state.
    pub(crate) fn jumped(&self, state: &State<R::System<T>>) -> Result<State<R::System<T>>, IntegrationErrorKind> {
        let Some((q, z)) = self.run.jump(self.numbers, &self.at(state.t, &state.q, &state.y)) else {
            return Ok(*state);
        };
        consistent(self.system, state.t, (q, z))
    }

    /// The function that ends the run; NaN where there is none.
    pub(crate) fn until(&self, t: T, q: &ConfigurationOf<R::System<T>>, z: &SpeedsOf<R::System<T>>) -> T {
        let found = self.run.until(self.numbers, &self.at(t, q, z));
        found.map_or(T::from_f64(f64::NAN), |(_, value)| value)
    }
}

/// The state after a jump, on the constraints where there are any.
pub(crate) fn consistent<S: GaussSystem>(
    system: &S,
    t: S::Scalar,
    (q, z): Start<S>,
) -> Result<State<S>, IntegrationErrorKind> {
    if !S::CONSTRAINED {
        return Ok(State { t, q: q.renormalise(), y: z });
    }
    let projected = system.project(t, &q, &z);
    let (q, y) = projected.map_err(|error| IntegrationErrorKind::Projection { error })?;
    Ok(State { t, q, y })
}

/// The equations of a run in one interval between instants.
pub(crate) type Equations<'a, R, T, const P: usize> =
    SystemProblem<'a, <R as Run<P>>::System<T>, VelocityForm, Fed<'a, R, T, P>>;

/// Equations of the first interval.
pub(crate) fn equations<'a, R: Run<P>, T: Real, const P: usize>(
    run: &'a R,
    numbers: &'a [T; P],
    system: &'a R::System<T>,
) -> Equations<'a, R, T, P> {
    SystemProblem::new(system).input_from(Fed { run, numbers, system, number: 0, held: None })
}
