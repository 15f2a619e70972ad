//! The same motions followed by every filter, and what their errors say.

use std::error::Error;

use gauss_runtime::prelude::*;

use crate::filter::{Moment, Transition, follow};
use crate::model::{LOOKS, SpacecraftKernel, Truth};

/// Looks after which a filter has settled.
pub const SETTLED: usize = 20;

/// Components of the error, and of the state: the degrees of freedom of its normalised square.
pub const DIMENSION: f64 = 6.0;

/// All motions as one filter follows them.
pub struct Followed {
    pub transition: Transition,
    pub runs: Vec<Vec<Moment>>,
}

/// Means over the motions after a look.
#[derive(Clone, Copy, Debug)]
pub struct AfterLook {
    pub t: f64,
    /// Root of the mean square of |σ|, rad, and what the filter takes it for.
    pub attitude: (f64, f64),
    /// Root of the mean square of |δω|, rad/s, and what the filter takes it for.
    pub rate: (f64, f64),
    /// Mean of the normalised error squared.
    pub normalised: f64,
}

impl Followed {
    /// Follows them.
    ///
    /// # Errors
    /// When a filter breaks down.
    pub fn new(kernel: &SpacecraftKernel, motions: &[Truth], transition: Transition) -> Result<Self, Box<dyn Error>> {
        let runs = motions.iter().map(|truth| follow(kernel, truth, transition)).collect::<Result<_, _>>()?;
        Ok(Self { transition, runs })
    }

    /// One for each look.
    pub fn after_looks(&self) -> Vec<AfterLook> {
        let updates: Vec<Vec<&Moment>> =
            self.runs.iter().map(|run| run.iter().filter(|m| m.updated).collect()).collect();
        let mean = |look: usize, value: &dyn Fn(&Moment) -> f64| {
            updates.iter().map(|run| value(run[look])).sum::<f64>() / updates.len() as f64
        };
        let square = |v: &Vector6<f64>, from: usize| v.fixed_rows::<3>(from).norm_squared();
        let of_look = |look: usize| {
            let root = |from: usize| {
                let error = mean(look, &|m| square(&m.error, from)).sqrt();
                (error, mean(look, &|m| square(&m.deviations, from)).sqrt())
            };
            AfterLook {
                t: updates[0][look].t,
                attitude: root(0),
                rate: root(3),
                normalised: mean(look, &|m| m.normalised),
            }
        };
        (0..LOOKS).map(of_look).collect()
    }

    /// The normalised error squared, on average over all looks after the filter has settled, and the standard error of
    /// that: motions are independent of one another, looks are not.
    pub fn settled(&self) -> (f64, f64) {
        let of_run = |run: &Vec<Moment>| {
            let looks = run.iter().filter(|m| m.updated).skip(SETTLED);
            looks.map(|m| m.normalised).sum::<f64>() / (LOOKS - SETTLED) as f64
        };
        let means: Vec<f64> = self.runs.iter().map(of_run).collect();
        let count = means.len() as f64;
        let mean = means.iter().sum::<f64>() / count;
        let variance = means.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
        (mean, (variance / count).sqrt())
    }
}

/// Ends of the interval in which 95 % of all means of `count` normalised errors lie when filters know how wrong they
/// are: χ² of that many times six degrees of freedom, by the approximation of Wilson and Hilferty (*The distribution of
/// chi-square*, Proc. Natl. Acad. Sci. 17, 1931), which is good to four digits here.
pub fn interval(count: usize) -> (f64, f64) {
    // The share of a normal distribution within ±1.96 is 95 %.
    let spread = 2.0 / (9.0 * count as f64 * DIMENSION);
    let end = |deviations: f64| DIMENSION * (1.0 - spread + deviations * spread.sqrt()).powi(3);
    (end(-1.96), end(1.96))
}
