//! Derives kernels and moves one with a group increment, without the standard library and without an allocator.
//!
//! The panic handler is the proof: were std linked by any dependency, there would be two.

#![no_std]
#![forbid(unsafe_code)]
#![deny(warnings)]

use gauss_runtime::prelude::*;

/// Every feature, in coordinates with sines and cosines.
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx))]
pub struct Vehicle {
    /// m.
    #[gauss(mass)]
    pub mass: f64,
    /// c.
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    /// I_O.
    #[gauss(inertia)]
    pub inertia: Matrix3<f64>,
    /// Full.
    #[gauss(added_mass)]
    pub added: Matrix6<f64>,
    /// Along −k₃.
    #[gauss(gravity)]
    pub gravity: f64,
}

/// A top in single precision.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
pub struct Top {
    /// m.
    #[gauss(mass)]
    pub mass: f32,
    /// About the fixed point.
    #[gauss(inertia)]
    pub inertia: Vector3<f32>,
}

/// The acceleration of a vehicle at rest.
///
/// # Errors
/// Parameters that no body has.
pub fn fall(vehicle: &Vehicle) -> Result<[f64; 6], ParameterError> {
    let kernel = vehicle.kernel()?;
    let rest = SVector::<f64, 6>::zeros();
    Ok(kernel.acceleration(0.0, &rest, &rest, &()).data.0[0])
}

/// One explicit Euler step of a top.
///
/// # Errors
/// Parameters that no body has.
pub fn turn(
    top: &Top,
    q: &UnitQuaternion<f32>,
    z: &Vector3<f32>,
    h: f32,
) -> Result<UnitQuaternion<f32>, ParameterError> {
    let kernel = top.kernel()?;
    Ok(q.retract(&kernel.kinematics(0.0, q, z).scale(h)))
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
