//! An ellipsoid that rolls, and the rattleback of Kane and Levinson.

use gauss_runtime::prelude::*;

/// An ellipsoid of half-axes `a` that rolls on the plane z = 0, O in its centre, e₃ up at rest.
///
/// With γ = Rᵀk₃, the vertical in body axes, its lowest point is at −(aᵢ² γᵢ)/h from O, where h = √Σ aᵢ² γᵢ² is the
/// height of O. That this point rests says what the velocity of O is: those speeds are solved for, and three are left.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, attitude: Rotation),
    speeds(vx, vy, w1, w2, w3),
    kinematics(x = vx, y = vy, attitude = [w1, w2, w3]),
    body(
        stone,
        position = [x, y, sqrt(
            (a.x * (inverse(attitude) * [0, 0, 1]).x).powi(2)
                + (a.y * (inverse(attitude) * [0, 0, 1]).y).powi(2)
                + (a.z * (inverse(attitude) * [0, 0, 1]).z).powi(2)
        )],
        rotation = attitude,
    ),
    constraint(velocity = vx - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).x / stone.position.z),
    constraint(velocity = vy - (attitude * cross([w1, w2, w3], [
        a.x * a.x * (inverse(attitude) * [0, 0, 1]).x,
        a.y * a.y * (inverse(attitude) * [0, 0, 1]).y,
        a.z * a.z * (inverse(attitude) * [0, 0, 1]).z,
    ])).y / stone.position.z),
    independent(w1, w2, w3),
)]
pub struct Rattleback {
    #[gauss(body)]
    pub stone: RigidBody<f64>,
    pub a: Vector3<f64>,
    #[gauss(gravity)]
    pub g: f64,
}

/// m: the half-axes of the stone of T. R. Kane, D. A. Levinson, Int. J. Non-Linear Mechanics 17 (1982) 175–186.
pub const AXES: [f64; 3] = [0.2, 0.03, 0.02];

/// kg m²: the product of inertia that turns its principal axes against those of the ellipsoid.
pub const PRODUCT: f64 = 2e-5;

/// Its mass and moments, for 1 kg: G is 1 cm below O.
#[must_use]
pub fn stone(product: f64) -> RigidBody<f64> {
    let inertia = Matrix3::new(3e-4, product, 0.0, product, 1.7e-3, 0.0, 0.0, 0.0, 1.7e-3);
    RigidBody { mass: 1.0, center_of_mass: Vector3::new(0.0, 0.0, -0.01), inertia }
}

/// Where it is when it touches the plane, by its coordinates.
#[must_use]
pub fn pose((attitude, place): &(UnitQuaternion<f64>, SVector<f64, 2>)) -> Isometry3<f64> {
    let up = attitude.inverse() * Vector3::z();
    let height = Vector3::from(AXES).component_mul(&up).norm();
    Isometry3::from_parts(Translation3::new(place[0], place[1], height), *attitude)
}
