//! Numbers from measurements: the least squares of Gauss and Newton.

use std::error::Error;
use std::fmt;

use gauss_runtime::nalgebra::{Cholesky, Const, SMatrix, SVector};

use crate::error::EnsembleError;
use crate::forward::{Rows, misfit, residuals};
use crate::run::Residuals;
use crate::steps::Steps;

/// The numbers that fit best.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fit<const P: usize> {
    /// The numbers.
    pub numbers: [f64; P],
    /// Their covariance, (JᵀJ)⁻¹ with J the derivatives of all residuals: right where residuals are in standard
    /// deviations.
    pub covariance: SMatrix<f64, P, P>,
    /// The sum of the squares of all residuals: about their number less P where residuals are in standard deviations.
    pub misfit: f64,
    /// Number of times that the derivatives were computed.
    pub iterations: usize,
}

impl<const P: usize> Fit<P> {
    /// The standard deviation of each number.
    #[must_use]
    pub fn deviations(&self) -> [f64; P] {
        std::array::from_fn(|k| self.covariance[(k, k)].sqrt())
    }
}

/// Why nothing fits.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FitError {
    /// A run has no derivatives.
    Run(EnsembleError),
    /// The measurements do not tell the numbers: some change of them changes no residual.
    Undetermined,
    /// No better numbers are found, and these are not the best either.
    NotConverged {
        /// Number of times that the derivatives were computed.
        iterations: usize,
        /// The sum of the squares of all residuals.
        misfit: f64,
    },
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Run(error) => error.fmt(f),
            Self::Undetermined => {
                f.write_str("the measurements do not tell the numbers: hold some of them, or measure another motion")
            }
            Self::NotConverged { iterations, misfit } => write!(
                f,
                "no better fit is found after {iterations} iterations, at a sum of squares of {misfit:e}: begin nearer"
            ),
        }
    }
}

impl Error for FitError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        if let Self::Run(error) = self { Some(error) } else { None }
    }
}

/// Iterations after which a fit is given up.
const MOST_ITERATIONS: usize = 50;
/// Halvings of an increment that does not make the fit better.
const MOST_HALVINGS: i32 = 20;
/// The fit ends where the next increment promises to take no more than this part of the sum of squares, which is that
/// of a number moved by a thousandth of its deviation where there are as many residuals as numbers.
const PROMISE: f64 = 1e-6;
/// Or changes no number by more than this part of it.
const CHANGE: f64 = 1e-9;

/// JᵀJ, −Jᵀr and rᵀr of all residuals.
struct Normal<const P: usize> {
    matrix: SMatrix<f64, P, P>,
    right: SVector<f64, P>,
    misfit: f64,
}

impl<const P: usize> Normal<P> {
    fn of<M: Residuals<P, R>, C: Steps, const R: usize>(
        runs: &[M],
        steps: &C,
        numbers: &[f64; P],
    ) -> Result<Self, FitError> {
        let mut sum = Self { matrix: SMatrix::zeros(), right: SVector::zeros(), misfit: 0.0 };
        for (run, model) in runs.iter().enumerate() {
            let rows: Vec<Rows<P, R>> =
                residuals(model, steps, numbers).map_err(|error| FitError::Run(EnsembleError { run, error }))?;
            for (values, slopes) in rows {
                for (value, slopes) in values.into_iter().zip(slopes) {
                    let slopes = SVector::from(slopes);
                    sum.matrix.ger(1.0, &slopes, &slopes, 1.0);
                    sum.right.axpy(-value, &slopes, 1.0);
                    sum.misfit += value * value;
                }
            }
        }
        Ok(sum)
    }

    /// The factors of JᵀJ with each number in units of what the residuals tell of it, and these units.
    fn factors(&self) -> Result<(Cholesky<f64, Const<P>>, SVector<f64, P>), FitError> {
        let units = SVector::<f64, P>::from_fn(|k, _| self.matrix[(k, k)].sqrt().recip());
        let scaled = SMatrix::from_fn(|i, k| self.matrix[(i, k)] * units[i] * units[k]);
        let factors = Cholesky::new(scaled).ok_or(FitError::Undetermined)?;
        // A pivot is what is left of 1: below that it is rounding of P² products.
        let least = (0..P).map(|k| factors.l_dirty()[(k, k)].powi(2)).fold(1.0, f64::min);
        let told = units.iter().all(|unit| unit.is_finite()) && least > 4.0 * (P * P) as f64 * f64::EPSILON;
        if told { Ok((factors, units)) } else { Err(FitError::Undetermined) }
    }
}

/// The sum of squares of all runs; infinite where one of them does not get to its end.
fn misfit_of_all<M: Residuals<P, R>, C: Steps, const P: usize, const R: usize>(
    runs: &[M],
    steps: &C,
    numbers: &[f64; P],
) -> f64 {
    runs.iter().map(|run| misfit(run, steps, numbers).unwrap_or(f64::INFINITY)).sum()
}

/// The numbers that make the sum of the squares of all residuals least, from a guess.
pub(crate) fn fit<M: Residuals<P, R>, C: Steps, const P: usize, const R: usize>(
    runs: &[M],
    steps: &C,
    guess: &[f64; P],
) -> Result<Fit<P>, FitError> {
    let (mut numbers, mut first) = (SVector::from(*guess), 0.0);
    for iterations in 1..=MOST_ITERATIONS {
        let normal = Normal::of(runs, steps, &numbers.into())?;
        let (factors, units) = normal.factors()?;
        let change = factors.solve(&normal.right.component_mul(&units)).component_mul(&units);
        let promised = change.dot(&normal.right);
        let small = (0..P).all(|k| change[k].abs() <= CHANGE * numbers[k].abs());
        let misfit = normal.misfit;
        first = misfit.max(first);
        let found = |numbers: SVector<f64, P>| {
            let inverse = factors.inverse();
            let covariance = SMatrix::from_fn(|i, k| inverse[(i, k)] * units[i] * units[k]);
            Ok(Fit { numbers: numbers.into(), covariance, misfit, iterations })
        };
        if promised <= PROMISE * misfit || small {
            return found(numbers);
        }
        let better = (0..MOST_HALVINGS).map(|n| numbers + change * 0.5_f64.powi(n)).find(|trial| {
            // In the limit of small increments all that is promised comes true.
            misfit_of_all(runs, steps, &(*trial).into()) < misfit
        });
        match better {
            Some(better) => numbers = better,
            // All that is left of what there was is rounding: residuals have half of its digits.
            None if misfit <= f64::EPSILON * first => return found(numbers),
            None => return Err(FitError::NotConverged { iterations, misfit }),
        }
    }
    let misfit = misfit_of_all(runs, steps, &numbers.into());
    Err(FitError::NotConverged { iterations: MOST_ITERATIONS, misfit })
}
