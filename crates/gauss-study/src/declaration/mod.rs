//! What a study is: its seed, its parameters, its results.

mod check;
mod kept;

use rayon::prelude::*;
use serde::Serialize;

use crate::distribution::Distribution;
use crate::draw::{Draw, Parameter};
use crate::error::DeclarationError;
use crate::plan::{Axis, Plan};
use crate::row::{Column, ColumnType, Kind, Row};
use crate::study::{Study, caught};

/// What a study is: a name and a version of its model, a seed, how many runs, parameters and results.
///
/// It is kept beside the results; another one does not resume them.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[must_use = "a declaration does nothing before `study`"]
pub struct Declaration {
    /// Of the folder: another format would be another number.
    format: u32,
    pub(crate) name: String,
    pub(crate) version: String,
    pub(crate) seed: u64,
    pub(crate) runs: u64,
    pub(crate) part: u64,
    plan: Plan,
    pub(crate) parameters: Vec<DeclaredParameter>,
    pub(crate) columns: Vec<DeclaredColumn>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeclaredParameter {
    pub name: String,
    pub unit: String,
    pub distribution: Distribution,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeclaredColumn {
    pub name: String,
    pub unit: String,
    pub kind: Kind,
}

/// Runs of a part where nothing else is said: a share of all, so that progress is seen, and no more than some
/// megabytes.
const PARTS: u64 = 256;
const LEAST: u64 = 256;
const MOST: u64 = 65_536;

impl Declaration {
    /// A study of so many runs.
    pub fn new(name: &str, seed: u64, runs: u64) -> Self {
        let part = runs.div_ceil(PARTS).clamp(LEAST, MOST);
        let (name, version, plan) = (name.to_owned(), String::new(), Plan::Random);
        Self { format: 1, name, version, seed, runs, part, plan, parameters: Vec::new(), columns: Vec::new() }
    }

    /// The version of the model, whatever names it. It is for you to change when runs give other numbers: results of
    /// another version are not resumed.
    pub fn version(mut self, version: &str) -> Self {
        version.clone_into(&mut self.version);
        self
    }

    /// How the runs fill the space of the parameters; by default they are independent.
    pub fn plan(mut self, plan: Plan) -> Self {
        self.plan = plan;
        self
    }

    /// How many runs a file holds: what is lost at most, of each worker, when it is killed. By default a 256th of all,
    /// 256 at least and 65,536 at most.
    pub fn runs_per_part(mut self, runs: u64) -> Self {
        self.part = runs;
        self
    }

    /// Adds a parameter; the unit is text, `""` where there is none.
    pub fn parameter(&mut self, name: &str, unit: &str, distribution: Distribution) -> Parameter {
        self.parameters.push(DeclaredParameter { name: name.to_owned(), unit: unit.to_owned(), distribution });
        Parameter(self.parameters.len() - 1)
    }

    /// Adds a column of numbers; the unit is text, `""` where there is none.
    pub fn number(&mut self, name: &str, unit: &str) -> Column<f64> {
        self.column(name, unit)
    }

    /// Adds a column of whole numbers.
    pub fn integer(&mut self, name: &str) -> Column<i64> {
        self.column(name, "")
    }

    /// Adds a column of yes or no.
    pub fn flag(&mut self, name: &str) -> Column<bool> {
        self.column(name, "")
    }

    /// Adds a column of words.
    pub fn text(&mut self, name: &str) -> Column<String> {
        self.column(name, "")
    }

    fn column<T: ColumnType>(&mut self, name: &str, unit: &str) -> Column<T> {
        self.columns.push(DeclaredColumn { name: name.to_owned(), unit: unit.to_owned(), kind: T::KIND });
        Column::new(self.columns.len() - 1)
    }

    /// The study, a run of which is a function of its sample.
    ///
    /// What it returns as an error, or panics with, is the cause in its row, and the other runs go on.
    ///
    /// # Errors
    /// All mistakes of the declaration.
    pub fn study<'a, E: std::fmt::Display>(
        self,
        run: impl Fn(&Draw, &mut Row) -> Result<(), E> + Send + Sync + 'a,
    ) -> Result<Study<'a>, DeclarationError> {
        self.study_in_blocks(1, move |samples, rows| {
            samples.iter().zip(rows).try_for_each(|(sample, row)| run(sample, row))
        })
    }

    /// The same by blocks of up to `width` neighbouring runs, for runs that share vectors as those of `gauss-batch` do.
    /// Which runs are in a block depends on the declaration alone. A block that fails or panics is repeated run by run.
    ///
    /// # Errors
    /// All mistakes of the declaration.
    pub fn study_in_blocks<'a, E: std::fmt::Display>(
        self,
        width: usize,
        run: impl Fn(&[Draw], &mut [Row]) -> Result<(), E> + Send + Sync + 'a,
    ) -> Result<Study<'a>, DeclarationError> {
        let sampler = self.sampler()?;
        let run = move |samples: &[Draw], rows: &mut [Row]| run(samples, rows).map_err(|error| error.to_string());
        Ok(Study::new(self, sampler, width.max(1), Box::new(run)))
    }

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
    /// Of a sweep: how many runs a number stays, and how many there are.
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

    /// What becomes of all runs, in the order of their numbers, on all threads and in memory: for studies of a size that
    /// needs no files.
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
