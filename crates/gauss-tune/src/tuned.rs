//! What was measured, and why nothing could be.

use core::fmt;

use gauss_runtime::integrate::IntegrationError;
use gauss_runtime::real::Real;

use crate::method::{EitherForm, Method};

/// A method on the user's scene, with what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Candidate<T> {
    /// The method, with its step or tolerances.
    pub method: Method<T>,
    /// The variables that it integrates.
    pub form: EitherForm,
    /// The largest error in units of the one wanted: at most 1 when it meets that.
    pub error: f64,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps, without rejected ones.
    pub steps: u64,
    /// The time of a run in seconds, the shortest of a few; `None` without a clock.
    pub seconds: Option<f64>,
    pub(crate) operations: u64,
}

impl<T> Candidate<T> {
    pub(crate) fn cost(&self) -> f64 {
        self.seconds.unwrap_or(self.operations as f64)
    }
}

/// A method of your own on the user's scene, with what was measured: see [`Tune::tune_steps`](crate::Tune::tune_steps).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Measured<C> {
    /// The method, with its setting.
    pub control: C,
    /// The largest error in units of the one wanted: at most 1 when it meets that.
    pub error: f64,
    /// Evaluations of the equations of motion, as far as they ask for the input: once each.
    pub evaluations: u64,
    /// Steps, without rejected ones.
    pub steps: u64,
    /// The time of a run in seconds, the shortest of a few; `None` without a clock, or when the error is not met.
    pub seconds: Option<f64>,
}

/// The result of [`Tune::tune`](crate::Tune::tune).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tuned<T> {
    /// The cheapest that meets the wanted error.
    pub best: Candidate<T>,
    /// Every method in every form at the coarsest setting that meets the error, the cheapest first; then those that did
    /// not meet it, or would have at many times the cost, with the last that was tried.
    pub candidates: Vec<Candidate<T>>,
    /// How far the two reference runs are apart, in units of the wanted error.
    pub disagreement: f64,
}

impl<T: Real> fmt::Display for Tuned<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:<58} {:<9} {:>8} {:>12} {:>10} {:>10}",
            "method", "form", "error", "evaluations", "steps", "seconds"
        )?;
        for Candidate { method, form, error, evaluations, steps, seconds, .. } in &self.candidates {
            write!(f, "\n{:<58} {form:<9} {error:>8.1e} {evaluations:>12} {steps:>10} ", format!("{method}"))?;
            match seconds {
                Some(seconds) => write!(f, "{seconds:>10.2e}")?,
                None => write!(f, "{:>10}", "-")?,
            }
        }
        write!(f, "\nerrors in units of the one wanted; two references are {:.1e} apart", self.disagreement)
    }
}

/// Why nothing could be chosen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum TuneError {
    /// Tolerances must be finite, not negative, and not both zero.
    InvalidTolerance,
    /// No two runs agree to a tenth of the error wanted: it is below what rounding allows, the motion is chaotic on the
    /// interval, or no run reaches the end.
    NoReference {
        /// How far apart the best two were, in units of the wanted error; infinite when there were none.
        disagreement: f64,
        /// What stopped the last run, if anything did.
        stopped: Option<IntegrationError>,
    },
    /// No candidate meets the error.
    NoCandidate,
}

impl fmt::Display for TuneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidTolerance => f.write_str("tolerances must be finite, not negative, not both 0"),
            Self::NoReference { disagreement, stopped } => {
                write!(
                    f,
                    "no two runs agree well enough to measure errors by: they are {disagreement:.1e} of the wanted error apart"
                )?;
                stopped.as_ref().map_or(Ok(()), |error| write!(f, "; {error}"))
            }
            Self::NoCandidate => f.write_str("no method meets the wanted error in a reasonable number of steps"),
        }
    }
}

impl core::error::Error for TuneError {}
