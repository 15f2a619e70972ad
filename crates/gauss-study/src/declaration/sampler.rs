//! From the declaration to the parameters of each run.

use rayon::prelude::*;

use super::check;
use super::content::{Declaration, DeclaredParameter};
use crate::distribution::Distribution;
use crate::draw::Draw;
use crate::error::DeclarationError;
use crate::panics::caught;
use crate::plan::Axis;

impl Declaration {
    /// The parameters of its runs, without a study.
    ///
    /// # Errors
    /// All mistakes of the declaration.
    pub fn sampler(&self) -> Result<Sampler, DeclarationError> {
        let mistakes = check::mistakes(self);
        if !mistakes.is_empty() {
            return Err(DeclarationError { mistakes });
        }
        let random = |parameter: &&DeclaredParameter| check::is_random(&parameter.distribution);
        let count = self.parameters.iter().filter(random).count();
        let (mut place, mut stride) = (0, 1_u64);
        let axes = self.parameters.iter().map(|DeclaredParameter { name, distribution, .. }| {
            let source = if let Some(steps) = distribution.steps() {
                let before = stride;
                stride = stride.saturating_mul(steps);
                Source::Steps { stride: before, steps }
            } else if check::is_random(distribution) {
                place += 1;
                Source::Axis(Axis::new(self.plan, (self.seed, self.runs), name, (place - 1, count)))
            } else {
                Source::Steps { stride: 1, steps: 1 }
            };
            (name.clone(), distribution.clone(), source)
        });
        Ok(Sampler { seed: self.seed, runs: self.runs, axes: axes.collect() })
    }
}

/// The parameters of the runs of a study.
#[derive(Clone, Debug)]
pub struct Sampler {
    seed: u64,
    runs: u64,
    axes: Vec<(String, Distribution, Source)>,
}

#[derive(Clone, Debug)]
enum Source {
    Axis(Axis),
    /// Steps of a sweep: the number of runs that a value stays, and the number of values.
    Steps {
        stride: u64,
        steps: u64,
    },
}

impl Sampler {
    /// The parameters of run `run`: a function of the seed and that number.
    #[must_use]
    pub fn sample(&self, run: u64) -> Draw {
        let value = |(name, distribution, source): &(String, Distribution, Source)| match source {
            Source::Axis(axis) => distribution.at(axis.at(self.seed, name, run)),
            Source::Steps { stride, steps } => distribution.step(run / stride % steps),
        };
        Draw { seed: self.seed, run, values: self.axes.iter().map(value).collect() }
    }

    /// Results of a function of all runs, in the order of their numbers, on all threads and in memory: for studies of a
    /// size that needs no files.
    ///
    /// A run that fails or panics is its cause.
    pub fn map<T: Send, E: std::fmt::Display>(
        &self,
        run: impl Fn(&Draw) -> Result<T, E> + Sync,
    ) -> Vec<Result<T, String>> {
        let one = |number| caught(|| run(&self.sample(number)).map_err(|error| error.to_string()));
        (0..self.runs).into_par_iter().map(one).collect()
    }
}
