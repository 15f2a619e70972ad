//! Derivatives of runs against closed forms, differences, other code for the same, and one another.

mod closed_forms;
mod ensembles;
mod events;
mod groups;
mod linkages;
mod memory;
mod mistakes;

use gauss_runtime::prelude::*;

/// The derivatives of a function of numbers by central differences of sixth order with steps of these lengths. What is
/// left out is h⁶/140 of a seventh derivative; roundings of the function come over h.
fn differences<const P: usize, const N: usize>(
    numbers: &[f64; P],
    step: f64,
    function: impl Fn(&[f64; P]) -> [f64; N],
) -> [[f64; P]; N] {
    let mut slopes = [[0.0; P]; N];
    for k in 0..P {
        let at = |n: f64| {
            let mut moved = *numbers;
            moved[k] += n * step;
            function(&moved)
        };
        for (n, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
            let (after, before) = (at(n), at(-n));
            for i in 0..N {
                slopes[i][k] += weight * (after[i] - before[i]) / (60.0 * step);
            }
        }
    }
    slopes
}

/// Holds derivatives to central differences by two steps, this one and its half. What the half leaves out is 1/64 of
/// what the whole does, so about 1/63 of what they differ by: four times that is allowed, and the rounding of the
/// function over the half step, of which the weights of the differences make less than two.
fn hold<const P: usize, const N: usize>(
    found: [[f64; P]; N],
    numbers: &[f64; P],
    step: f64,
    rounding: f64,
    function: impl Fn(&[f64; P]) -> [f64; N],
) {
    let coarse = differences(numbers, step, &function);
    let fine = differences(numbers, 0.5 * step, &function);
    for i in 0..N {
        for k in 0..P {
            let allowed = (fine[i][k] - coarse[i][k]).abs() / 16.0 + 4.0 * rounding / step;
            let off = (found[i][k] - fine[i][k]).abs();
            assert!(off <= allowed, "{i} by {k}: {} {}, {off:e} > {allowed:e}", found[i][k], fine[i][k]);
        }
    }
}

/// A number in any scalar.
fn number<T: Real>(x: f64) -> T {
    T::from_f64(x)
}
