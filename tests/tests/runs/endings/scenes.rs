//! Scenes on which runs could end badly.

use gauss_runtime::prelude::*;
use gauss_tests::top::Top;

/// One coordinate, or one speed.
pub fn one(x: f64) -> SVector<f64, 1> {
    SVector::from([x])
}

/// A body in yaw, pitch and roll.
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zyx), motion = fixed_point)]
pub struct Angles {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
}

/// A body in Rodrigues' vector, which is infinite at half a turn.
#[derive(GaussDynamics)]
#[gauss(chart = jet(rodrigues), motion = fixed_point, taylor)]
pub struct Rodrigues<T> {
    #[gauss(mass)]
    pub mass: T,
    #[gauss(inertia)]
    pub inertia: Vector3<T>,
}

/// The same in modified parameters, which are infinite at a full turn.
#[derive(GaussDynamics)]
#[gauss(chart = jet(modified_rodrigues), motion = fixed_point, taylor)]
pub struct Modified<T> {
    #[gauss(mass)]
    pub mass: T,
    #[gauss(inertia)]
    pub inertia: Vector3<T>,
}

/// A heavy top in ω.
pub fn toy() -> Top<f64> {
    Top { mass: 1.0, center: Vector3::z() * 0.4, inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 }
}

/// A free one in any scalar.
#[derive(GaussDynamics)]
#[gauss(motion = fixed_point)]
pub struct GenericTop<T> {
    #[gauss(mass)]
    pub mass: T,
    #[gauss(inertia)]
    pub inertia: Vector3<T>,
}

impl<T: Real> GenericTop<T> {
    pub fn toy() -> Self {
        let f = T::from_f64;
        Self { mass: f(1.0), inertia: Vector3::new(f(0.2), f(0.2), f(0.05)) }
    }
}

/// The same in precession, nutation and spin.
#[derive(GaussDynamics)]
#[gauss(chart = jet(euler_zxz), motion = fixed_point)]
pub struct Inclined {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(center_of_mass)]
    pub center: Vector3<f64>,
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    #[gauss(gravity)]
    pub g: f64,
}

impl Inclined {
    pub fn toy() -> Self {
        let Top { mass, center, inertia, g } = toy();
        Self { mass, center, inertia, g }
    }
}

/// A unit mass on a spring with a damper.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    taylor,
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    spring(along = x, stiffness = k, damping = c),
)]
pub struct Spring {
    pub k: f64,
    pub c: f64,
}

/// A pendulum of length 1 and mass 1.
#[derive(GaussDynamics)]
#[gauss(
    taylor,
    coordinates(angle),
    particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
    spring(bearing, along = angle, stiffness = 0, damping = 0.125),
)]
pub struct Pendulum {
    #[gauss(gravity)]
    pub g: f64,
}

/// A unit mass on the floor, on a curve of the user's, drawn by a force.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x, y),
    particle(mass = 1, position = [x, y, 0]),
    constraint(position = y - a * sin(x)),
    input(push),
    drive(x = push),
)]
pub struct Bead {
    pub a: f64,
}

/// A pendulum of length 1 and mass 1 that a motor drives.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(angle),
    particle(mass = 1, position = [sin(angle), 0, -cos(angle)]),
    input(torque),
    drive(angle = torque),
)]
pub struct Driven {
    #[gauss(gravity)]
    pub g: f64,
}

/// A body in the field of a point that it can meet, in coordinates and in a chart.
#[derive(GaussDynamics)]
#[gauss(coordinates(x, y), particle(mass = 1, position = [x, y, 0]), central_gravity(mu = mu))]
pub struct Comet {
    pub mu: f64,
}

/// The same with extent.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid, central_gravity(mu = mu))]
pub struct Moon {
    #[gauss(mass)]
    pub mass: f64,
    #[gauss(inertia)]
    pub inertia: Vector3<f64>,
    pub mu: f64,
}

/// A unit mass that rubs on the floor and is pulled.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = 1, position = [x, 0, 0]),
    input(pull),
    drive(x = pull - friction * signum(rate(x))),
)]
pub struct Slider {
    pub friction: f64,
}
