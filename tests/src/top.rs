//! The heavy top that many tests run, in any scalar: derived once.

use gauss_runtime::prelude::*;

/// A body that turns about O, its axes principal.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(motion = fixed_point, taylor)]
pub struct Top<T> {
    /// kg.
    #[gauss(mass)]
    pub mass: T,
    /// m, body axes.
    #[gauss(center_of_mass)]
    pub center: Vector3<T>,
    /// Principal moments about O, kg m².
    #[gauss(inertia)]
    pub inertia: Vector3<T>,
    /// m/s², along −k₃.
    #[gauss(gravity)]
    pub g: T,
}
