//! A thrown body of uncertain inertia and spin.

use gauss_runtime::nalgebra::Unit;
use gauss_runtime::prelude::*;

/// An oval ball: weight, and drag that is larger across its long axis e₁ than along it.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, drag(quadratic = drag))]
pub struct Oval<T> {
    #[gauss(mass)]
    pub mass: T,
    #[gauss(inertia)]
    pub inertia: Vector3<T>,
    #[gauss(gravity)]
    pub g: T,
    /// N/(m/s)² along the axes of the body, N m/(rad/s)² about them.
    pub drag: Vector6<T>,
}

/// What varies from throw to throw: the moments of inertia in kg m² and the angular velocity in rad/s, body axes.
pub const MEAN: [f64; 6] = [0.0019, 0.0032, 0.0033, 14.0, 0.7, 0.4];
/// Standard deviations; all six are independent.
pub const DEVIATIONS: [f64; 6] = [6e-5, 1e-4, 1e-4, 0.7, 0.12, 0.12];

/// Seconds of flight.
pub const FLIGHT: f64 = 1.6;
/// Seconds of a step.
pub const STEP: f64 = 0.01;

/// The kernel of a throw, in any scalar.
///
/// # Errors
/// When no body has the moments of inertia.
pub fn kernel<T: Real>(throw: &[T; 6]) -> Result<OvalKernel<T>, ParameterError> {
    let number = T::from_f64;
    let [first, second, third, ..] = *throw;
    let drag = [0.0016, 0.0068, 0.0068, 1e-7, 4e-6, 4e-6].map(number);
    let inertia = Vector3::new(first, second, third);
    Oval { mass: number(0.41), inertia, g: number(9.81), drag: SVector::from(drag) }.kernel()
}

/// The state at the start: thrown at 21 m/s and 33° along the long axis, a little raised and turned aside.
pub fn start<T: Real>(throw: &[T; 6]) -> (Isometry3<T>, SVector<T, 6>) {
    let turn = UnitQuaternion::from_euler_angles(0.0, -0.68, 0.05);
    let velocity = turn.inverse() * Vector3::new(33.0_f64.to_radians().cos(), 0.0, 33.0_f64.to_radians().sin()) * 21.0;
    let number = T::from_f64;
    let rotation = Unit::new_unchecked(Quaternion::from(turn.coords.map(number)));
    let pose = Isometry3 { rotation, translation: Translation3 { vector: Vector3::from([0.0, 0.0, 1.8].map(number)) } };
    let [.., x, y, z] = *throw;
    (pose, SVector::from([number(velocity.x), number(velocity.y), number(velocity.z), x, y, z]))
}

/// Where it is, seen from above: along the throw and aside, in metres.
pub fn place<T: Real>(pose: &Isometry3<T>) -> [T; 2] {
    [pose.translation.vector[0], pose.translation.vector[1]]
}
