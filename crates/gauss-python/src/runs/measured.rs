//! Time that the same batch takes in Rust: `benches/peers/python_calls.py` compares calls from Python with it.

use std::time::{Duration, Instant};

use gauss_batch::{Batch, States};
use gauss_runtime::prelude::*;

use super::many::Many;
use crate::scene::Scene;
use crate::steps::{configuration, vector};

/// The least time of some rounds for accelerations of all states, written over earlier ones by one thread.
///
/// # Errors
/// A state that is none.
pub fn batch_time<S: Scene>(system: &S::Packed, many: &Many<'_>) -> Result<Duration, String> {
    let mut all = Vec::with_capacity(many.count);
    for i in 0..many.count {
        let [q, z] = many.first(i);
        all.push((configuration(q)?, vector(z)));
    }
    let states = States::<S::Packed>::from_fn(many.count, |i| all[i]);
    // A time is asked for; of contacts there are other methods.
    let batch = Batch::new(system).without_contacts();
    let input =
        |t: <S::Packed as GaussSystem>::Scalar, _: &_, _: &_| many.input.at(t, |number| Real::from_f64(number(0)));
    let batch = batch.input::<S::Packed, _>(input);
    let mut accelerations = batch.accelerations(0.0, &states);
    let mut least = Duration::MAX;
    for _ in 0..15 {
        let begin = Instant::now();
        batch.accelerations_into(0.0, &states, &mut accelerations);
        std::hint::black_box(&accelerations);
        least = least.min(begin.elapsed());
    }
    Ok(least)
}
