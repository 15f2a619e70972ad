//! The front: choose the steps, then ask for derivatives.

use gauss_runtime::integrate::{Adaptive, DormandPrince8, Fixed, Method, MethodError, RungeKutta, StepSetting};

use crate::adjoint::{Gradient, gradient};
use crate::error::{EnsembleError, SensitivityError};
use crate::fit::{Fit, FitError, fit};
use crate::forward::{Point, follow};
use crate::run::{Cost, Residuals, Run};
use crate::steps::{ExplicitMethod, Steps};

/// The control of steps of one length.
pub type FixedSteps = Fixed<f64, RungeKutta<DormandPrince8, 12>>;

/// Derivatives of runs, by steps that are chosen here.
///
/// They are the exact derivatives of the steps that the values of the run choose, with the lengths of steps held: of
/// what was computed, not of the motion that it approximates, from which they differ by what the tolerances let pass.
#[derive(Clone, Copy, Debug)]
#[must_use = "nothing is done before something is asked"]
pub struct Derivatives<C> {
    steps: C,
    checkpoints: Option<usize>,
}

impl Derivatives<Adaptive> {
    /// Steps as long as the tolerances allow: [`Adaptive::new`].
    pub fn adaptive(relative: f64, absolute: f64) -> Self {
        Self::by(Adaptive::new(relative, absolute))
    }
}

impl Derivatives<FixedSteps> {
    /// Steps of one length: [`Fixed::new`]. A run between two instants that are one step apart is a single step.
    pub fn fixed_step(step: f64) -> Self {
        Self::by(Fixed::new(step))
    }
}

impl Derivatives<ExplicitMethod> {
    /// Steps by a method that is chosen by name, with the bits of [`by`](Self::by) with the method's own type.
    ///
    /// # Errors
    /// [`MethodError`]: the method is no explicit one of one step, or makes no such steps.
    pub fn by_method(method: Method, setting: StepSetting<f64>) -> Result<Self, MethodError> {
        ExplicitMethod::new(method, setting).map(Self::by)
    }
}

impl<C: Steps> Derivatives<C> {
    /// Other [`Steps`].
    pub fn by(steps: C) -> Self {
        Self { steps, checkpoints: None }
    }

    /// The most states that a [`gradient`](Self::gradient) keeps at a time, at least one; where this is not said, the
    /// root of the number of steps, at least eight. Fewer of them cost more steps, and change no bit of the result.
    pub fn checkpoints(self, states: usize) -> Self {
        Self { checkpoints: Some(states.max(1)), ..self }
    }

    /// The states of a run at all its instants, the first one included, with their derivatives by all P numbers:
    /// forward, in dual numbers, four numbers at a time. The last state is that of the event where one ended the run.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn run<R: Run<P>, const P: usize>(
        &self,
        run: &R,
        numbers: &[f64; P],
    ) -> Result<Vec<Point<R::System<f64>, P>>, SensitivityError> {
        follow(run, &self.steps, numbers)
    }

    /// The cost of a run with its derivatives by all P numbers and by the initial state: back through its steps, for
    /// the price of some tens of runs, however many numbers there are.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn gradient<R: Cost<P>, const P: usize>(
        &self,
        run: &R,
        numbers: &[f64; P],
    ) -> Result<Gradient<P>, SensitivityError> {
        gradient(run, &self.steps, numbers, self.checkpoints)
    }

    /// The sum of the costs of several runs with its derivatives by all P numbers. With the feature `rayon` they run
    /// on all threads; the sums are those of one thread, to the bit.
    ///
    /// # Errors
    /// [`EnsembleError`]: the first run that has no derivatives.
    pub fn gradient_of_all<R: Cost<P> + Sync, const P: usize>(
        &self,
        runs: &[R],
        numbers: &[f64; P],
    ) -> Result<(f64, [f64; P]), EnsembleError>
    where
        C: Sync,
    {
        #[cfg(feature = "rayon")]
        let found: Vec<_> = {
            use rayon::prelude::*;
            runs.par_iter().map(|run| self.gradient(run, numbers)).collect()
        };
        #[cfg(not(feature = "rayon"))]
        let found = runs.iter().map(|run| self.gradient(run, numbers));
        let (mut value, mut by_numbers) = (0.0, [0.0; P]);
        for (run, one) in found.into_iter().enumerate() {
            let one = one.map_err(|error| EnsembleError { run, error })?;
            value += one.value;
            by_numbers.iter_mut().zip(one.by_numbers).for_each(|(sum, by)| *sum += by);
        }
        Ok((value, by_numbers))
    }

    /// The numbers that make the sum of the squares of all residuals of some runs least, from a guess: by Gauss and
    /// Newton, with increments halved where they do not help.
    ///
    /// # Errors
    /// [`FitError`].
    pub fn fit<R: Residuals<P, N>, const P: usize, const N: usize>(
        &self,
        runs: &[R],
        guess: &[f64; P],
    ) -> Result<Fit<P>, FitError> {
        fit(runs, &self.steps, guess)
    }
}
