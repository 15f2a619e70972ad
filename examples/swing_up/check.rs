//! Second derivatives of steps against differences of first ones, and what they take.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use gauss_examples::ddp::{Matrix, Plant, Vector};

use crate::model::{Scalar, parts};
use crate::second::Second;

/// Central differences of ∂(end) at this distance leave out its square, and keep ε over it.
const APART: f64 = 1e-5;

/// ∂(end) of the stages is that of `step_linearized`, and ∂²(weights · end) what differences of it give.
pub fn second_order<K: Scalar<N, D, U>, const N: usize, const D: usize, const U: usize>(
    plant: &Second<'_, K, N>,
    x: &Vector<D>,
    u: &Vector<U>,
) -> Result<(), Box<dyn Error>> {
    let x = x + Vector::from_fn(|k, _| 0.02 * (k as f64).cos());
    let weights = Vector::<D>::from_fn(|k, _| 1.0 + 0.1 * k as f64);
    let (own, exact) = (plant.expansion(&x, u), plant.0.expansion(&x, u));
    let apart = (own.by_state - exact.by_state).amax().max((own.by_input - exact.by_input).amax());
    if apart > 1e-12 * exact.by_state.amax() {
        return Err(format!("the stages of a step have derivatives that are {apart:.1e} off").into());
    }
    let found = plant.curvature(&own.stages, u, &weights);
    let slopes = |x: Vector<D>, u: Vector<U>| {
        let end = plant.0.expansion(&x, &u);
        (end.by_state.tr_mul(&weights), end.by_input.tr_mul(&weights))
    };
    let (mut by_state, mut mixed, mut by_input) =
        (Matrix::<D, D>::zeros(), Matrix::<U, D>::zeros(), Matrix::<U, U>::zeros());
    for k in 0..D {
        let aside = Vector::from_fn(|i, _| if i == k { APART } else { 0.0 });
        let (there, back) = (slopes(x + aside, *u), slopes(x - aside, *u));
        by_state.set_column(k, &((there.0 - back.0) / (2.0 * APART)));
        mixed.set_column(k, &((there.1 - back.1) / (2.0 * APART)));
    }
    for k in 0..U {
        let aside = Vector::from_fn(|i, _| if i == k { APART } else { 0.0 });
        by_input.set_column(k, &((slopes(x, u + aside).1 - slopes(x, u - aside).1) / (2.0 * APART)));
    }
    let apart = (found.by_state - by_state).amax();
    let apart = apart.max((found.by_input_and_state - mixed).amax()).max((found.by_input - by_input).amax());
    let size = found.by_state.amax().max(exact.by_state.amax());
    // Slopes are known to some 1e2 ε of their size.
    if apart > 1e-8 * size {
        return Err(format!("second derivatives of a step are {apart:.1e} of {size:.1e} off").into());
    }
    Ok(())
}

/// Microseconds of `linearize`, of `hessian`, and of differences of `linearize` in its place.
pub fn times<K: Scalar<N, D, U>, const N: usize, const D: usize, const U: usize>(
    kernel: &K,
    x: &Vector<D>,
    u: &Vector<U>,
) {
    let (q, z) = parts::<N, D>(x);
    let weights = Vector::<D>::repeat(1.0);
    let linearize = || kernel.linearize(0.0, black_box(&q), black_box(&z), black_box(u));
    let first = microseconds(|| black_box(linearize()));
    let second = microseconds(|| black_box(kernel.hessian(0.0, black_box(&q), black_box(&z), u, black_box(&weights))));
    let differences = 2.0 * (D + U) as f64 * first;
    println!(
        "`linearize` {first:.2} µs, `hessian` {second:.2}, {} `linearize` in its place {differences:.2}\n",
        2 * (D + U)
    );
}

/// The least of some means.
fn microseconds<T>(f: impl Fn() -> T) -> f64 {
    const CALLS: u32 = 500;
    let mean = || {
        let start = Instant::now();
        (0..CALLS).for_each(|_| drop(f()));
        1e6 * start.elapsed().as_secs_f64() / f64::from(CALLS)
    };
    (0..15).map(|_| mean()).fold(f64::INFINITY, f64::min)
}
