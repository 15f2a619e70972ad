//! The run of a slider of either law.

use gauss_runtime::prelude::*;

use crate::scene::Slider;

/// A slider of either law.
pub trait Sliding:
    GaussSystem<Scalar = f64, Configuration = SVector<f64, 1>, Speeds = SVector<f64, 1>, Input = ()>
{
}
impl<K: GaussSystem<Scalar = f64, Configuration = SVector<f64, 1>, Speeds = SVector<f64, 1>, Input = ()>> Sliding
    for K
{
}

/// The slider from where it is let go until it rests.
///
/// # Errors
/// When the run ends before.
pub fn slide<'k, K: Sliding>(
    kernel: &'k K,
    slider: &Slider,
    tolerance: f64,
) -> Result<Trajectory<'k, K>, IntegrationError> {
    let run = Simulation::new(kernel).adaptive(tolerance, tolerance);
    run.run(SVector::from([slider.released()]), SVector::from([0.0]), 0.0..slider.rests())
}
