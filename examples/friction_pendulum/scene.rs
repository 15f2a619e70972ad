//! What is modelled.

use gauss_runtime::prelude::*;

/// A rod that hangs from a pivot with dry friction, a spiral spring, and a rubber buffer on one side.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(theta),
    frames(rod),
    body(rod, rotation = rotation_y(theta)),
    spring(spiral, along = theta, stiffness = spiral, length = relaxed),
    stop(buffer, along = theta, least = limit, stiffness = rubber, width = soft, damping = loss),
    dry_friction(theta, bound = dry),
)]
pub struct Pendulum {
    /// O is the pivot.
    #[gauss(body)]
    pub rod: RigidBody<f64>,
    /// M, N m.
    pub dry: f64,
    /// Stiffness of the spiral spring, N m/rad.
    pub spiral: f64,
    /// Angle at which it is without torque, rad.
    pub relaxed: f64,
    /// Angle of the buffer, rad.
    pub limit: f64,
    /// Its stiffness, N m/rad.
    pub rubber: f64,
    /// Angle over which it sets in, rad.
    pub soft: f64,
    /// Its damping, N m s/rad.
    pub loss: f64,
    #[gauss(gravity)]
    pub g: f64,
}

/// Length of the rod, m.
pub const LENGTH: f64 = 0.5;

impl Pendulum {
    /// A uniform rod of 0.2 kg: a desk model.
    #[must_use]
    pub fn desk() -> Self {
        let (mass, length) = (0.2, LENGTH);
        let rod = RigidBody {
            mass,
            center_of_mass: Vector3::new(0.0, 0.0, -0.5 * length),
            inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)) * (mass * length * length / 3.0),
        };
        Self { rod, dry: 0.015, spiral: 0.08, relaxed: 0.4, limit: -0.5, rubber: 30.0, soft: 0.01, loss: 0.05, g: 9.81 }
    }
}
