//! Plans by which the runs of a study fill the unit cube of its parameters.

mod joe_kuo;
mod permutation;
mod sobol;

use serde::Serialize;

use crate::streams::{Purpose, Stream, unit};
use permutation::Permutation;
use sobol::Directions;

/// Plan by which the runs of a study fill the space of its parameters. In every plan run i is a function of the seed
/// and i.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Plan {
    /// Runs that are independent of each other. A parameter more changes no number of the others.
    #[default]
    Random,
    /// Latin hypercube: of each parameter all runs together have one number in each of as many parts of equal
    /// probability; which run has which is random (McKay, Beckman, Conover 1979). A parameter more changes no number of
    /// the others; another number of runs changes all.
    LatinHypercube,
    /// A Sobol' sequence with the direction numbers of Joe and Kuo (2008), shifted at random (a digital shift by the
    /// seed). A parameter's dimension is its place in the declaration: what is declared later changes nothing. Up to
    /// 100 parameters; powers of two of runs fill evenly.
    Sobol,
    /// Saltelli's scheme over a Sobol' sequence, for [sensitivities](crate::sensitivity): of each point j of the
    /// sequence the runs j (d + 2) to j (d + 2) + d + 1 are A, A with the first parameter of B, …, A with the last
    /// parameter of B, and B. It is the order that SALib reads with `calc_second_order=False`. Up to 50 parameters.
    Saltelli,
}

impl Plan {
    /// Largest number of random parameters that it can fill.
    pub(crate) fn most(self) -> usize {
        match self {
            Self::Random | Self::LatinHypercube => usize::MAX,
            Self::Sobol => sobol::DIMENSIONS,
            Self::Saltelli => sobol::DIMENSIONS / 2,
        }
    }

    /// Number of runs that belong together.
    pub(crate) fn group(self, dimensions: usize) -> u64 {
        if self == Self::Saltelli { dimensions as u64 + 2 } else { 1 }
    }
}

/// The numbers of one parameter.
#[derive(Clone, Debug)]
pub enum Axis {
    Random,
    Latin(Permutation),
    /// A shift.
    Sobol(Directions, u64),
    /// A and B, the place among the parameters and how many there are.
    Saltelli([(Directions, u64); 2], u64, u64),
}

impl Axis {
    /// Axis of the parameter with a name, number `place` of so many random ones.
    pub fn new(plan: Plan, (seed, runs): (u64, u64), name: &str, (place, count): (usize, usize)) -> Self {
        let mut shifts = Stream::new(seed, Purpose::Shift, name, 0);
        let mut dimension = |number: usize| (Directions::new(number), shifts.bits());
        match plan {
            Plan::Random => Self::Random,
            Plan::LatinHypercube => {
                let mut keys = Stream::new(seed, Purpose::Strata, name, 0);
                Self::Latin(Permutation::new(runs, || keys.bits()))
            }
            Plan::Sobol => {
                let (directions, shift) = dimension(place);
                Self::Sobol(directions, shift)
            }
            Plan::Saltelli => Self::Saltelli([dimension(place), dimension(count + place)], place as u64, count as u64),
        }
    }

    /// Between 0 and 1, both excluded.
    pub fn at(&self, seed: u64, name: &str, run: u64) -> f64 {
        let random = || Stream::new(seed, Purpose::Parameter, name, run).uniform();
        match self {
            Self::Random => random(),
            // A number below its stratum's end may be rounded to it: of the last one that is 1.
            Self::Latin(strata) => ((strata.at(run) as f64 + random()) / strata.len() as f64).min(1.0 - f64::EPSILON),
            Self::Sobol(directions, shift) => unit(directions.at(run) ^ shift),
            Self::Saltelli(points, place, count) => {
                let (point, role) = (run / (count + 2), run % (count + 2));
                let (directions, shift) = &points[usize::from(role == count + 1 || role == place + 1)];
                unit(directions.at(point) ^ shift)
            }
        }
    }
}
