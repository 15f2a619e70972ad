//! The parameters of one run.

use std::ops::Index;

use crate::streams::{Purpose, Stream};

/// A parameter of a study, by which a run asks for its number: made by
/// [`Declaration::parameter`](crate::Declaration::parameter).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter(pub(crate) usize);

/// The parameters of one run, a function of the study's seed and the run's number alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    pub(crate) seed: u64,
    pub(crate) run: u64,
    pub(crate) values: Vec<f64>,
}

impl Draw {
    /// The seed of the study.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The number of the run, from 0.
    #[must_use]
    pub fn run(&self) -> u64 {
        self.run
    }

    /// All parameters in the order of their declaration.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Random numbers of this run under a name of their own, for what is drawn while it runs, as noise of a sensor.
    #[must_use]
    pub fn stream(&self, name: &str) -> Stream {
        Stream::new(self.seed, Purpose::Within, name, self.run)
    }
}

/// # Panics
/// When the parameter is another study's and this one has fewer.
impl Index<Parameter> for Draw {
    type Output = f64;

    fn index(&self, parameter: Parameter) -> &f64 {
        &self.values[parameter.0]
    }
}
