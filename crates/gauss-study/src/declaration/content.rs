//! The declaration: names, numbers, distributions.

use std::ops::Range;

use serde::Serialize;

use crate::distribution::Distribution;
use crate::draw::Parameter;
use crate::plan::Plan;
use crate::row::{Column, ColumnType, Kind};

/// Declaration of a study: a name and a version of its model, a seed, the number of runs, parameters and results.
///
/// It is kept beside the results; another one does not resume them.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[must_use = "a declaration does nothing before `study`"]
pub struct Declaration {
    /// Version of the format of the folder: another format would be another number.
    format: u32,
    pub(crate) name: String,
    pub(crate) version: String,
    pub(crate) seed: u64,
    pub(crate) runs: u64,
    pub(crate) part: u64,
    pub(crate) plan: Plan,
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

    /// Parameters and results that are numbers or flags, with their units.
    pub(crate) fn numbers(&self) -> Vec<(String, String)> {
        let parameters = self.parameters.iter().map(|parameter| (&parameter.name, &parameter.unit));
        let results = self.columns.iter().filter(|column| column.kind != Kind::Text);
        let all = parameters.chain(results.map(|column| (&column.name, &column.unit)));
        all.map(|(name, unit)| (name.clone(), unit.clone())).collect()
    }

    /// The version of the model, whatever names it. It is for you to change when runs give other numbers: results of
    /// another version are not resumed.
    pub fn version(mut self, version: &str) -> Self {
        version.clone_into(&mut self.version);
        self
    }

    /// Sets how the runs fill the space of the parameters; by default they are independent.
    pub fn plan(mut self, plan: Plan) -> Self {
        self.plan = plan;
        self
    }

    /// Sets the number of runs in a file: the runs that each worker loses at most when it is killed. By default a 256th
    /// of all, 256 at least and 65,536 at most.
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

    pub(crate) fn parts(&self) -> u64 {
        self.runs.div_ceil(self.part)
    }

    pub(crate) fn runs_of(&self, part: u64) -> Range<u64> {
        (part * self.part)..((part + 1) * self.part).min(self.runs)
    }
}
