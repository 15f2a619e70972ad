//! Equality up to what rounding can do, on random bodies and states.

use std::cell::Cell;

use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::Bounded;
use super::parameters::{Parameters, parameters};
use super::states::{Motion, State, state};

/// What the issue of accuracy is settled by: agreement to this, relative to the terms that enter.
const ACCURACY: f64 = 1e-12;

/// How many results had a bound below [`ACCURACY`], so that agreement within the bounds proves agreement to it.
///
/// The bounds add up worst cases over some hundreds of operations (10² to 10³ ε, 2e-14 to 2e-13) and grow with the
/// conditioning of the body's mass matrix and the nearness of singular points; there, agreement is asserted to the
/// bound.
#[derive(Debug, Default)]
pub struct Tally {
    sharp: Cell<u32>,
    total: Cell<u32>,
}

impl Tally {
    /// Notes results that agreed, and the size of the terms that entered them.
    pub fn count(&self, values: &[Bounded], scale: f64) {
        let sharp = values.iter().all(|value| value.bound <= ACCURACY * scale);
        self.sharp.set(self.sharp.get() + u32::from(sharp));
        self.total.set(self.total.get() + 1);
    }
}

/// Runs a check on random bodies and states of a motion; at least the given share of its results must be sharp.
///
/// The share of all bodies and states is meant, of which a run sees a sample: it is refuted by a sample that is five
/// standard deviations short of it, which chance alone makes of one run in three million.
pub fn explore(
    motion: Motion,
    least_share: f64,
    check: impl Fn(&Parameters, &State, &Tally) -> Result<(), TestCaseError>,
) {
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::default() });
    let tally = Tally::default();
    let outcome = runner.run(&(parameters(), state(motion)), |(parameters, state)| check(&parameters, &state, &tally));
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
    let (sharp, total) = (f64::from(tally.sharp.get()), f64::from(tally.total.get()));
    let chance = 5.0 * (total * least_share * (1.0 - least_share)).sqrt();
    assert!(
        sharp >= least_share * total - chance,
        "{sharp} of {total} results have bounds below {ACCURACY:e}, fewer than the share of {least_share} explains"
    );
}

/// Every pair is equal up to the bounds of both.
pub fn equal(what: &str, left: &[Bounded], right: &[Bounded]) -> Result<(), TestCaseError> {
    if left.len() != right.len() {
        return Err(TestCaseError::fail(format!("{what}: {} components against {}", left.len(), right.len())));
    }
    for (i, (a, b)) in left.iter().zip(right).enumerate() {
        // Written so that a NaN fails.
        let within = (a.value - b.value).abs() <= a.bound + b.bound;
        if !within {
            return Err(TestCaseError::fail(format!(
                "{what}: component {i} is {:e} and {:e}; they differ by {:e}, rounding explains {:e}",
                a.value,
                b.value,
                a.value - b.value,
                a.bound + b.bound
            )));
        }
    }
    Ok(())
}

/// Every number is zero up to its bound.
pub fn zero(what: &str, values: &[Bounded]) -> Result<(), TestCaseError> {
    equal(what, values, &vec![Bounded::measured(0.0, 0.0); values.len()])
}

/// The largest magnitude.
pub fn largest(values: &[Bounded]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.value.abs()))
}
