//! Contacts of kernels: gaps against geometry, W and D against one another and the mass matrix, b against the rates of
//! `contact_rates` along the motion, charts against one another.

use gauss_runtime::contact::{Contact, ContactDynamics};
use gauss_runtime::forces::Columns;
use gauss_runtime::prelude::*;

/// A ball on a plane: friction along two tangents.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation),
    contact(floor, gap = ball.position.z - r, slip = [
        dot(ball.velocity + cross(ball.angular_velocity, [0, 0, -r]), [1, 0, 0]),
        dot(ball.velocity + cross(ball.angular_velocity, [0, 0, -r]), [0, 1, 0])
    ], friction = mu, restitution = e),
)]
struct Ball {
    #[gauss(body)]
    ball: RigidBody<f64>,
    #[gauss(gravity)]
    g: f64,
    r: f64,
    mu: f64,
    e: f64,
}

fn ball() -> Ball {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.4, 0.5, 0.6));
    let ball = RigidBody { mass: 2.0, center_of_mass: Vector3::new(0.01, -0.02, 0.03), inertia };
    Ball { ball, g: 9.81, r: 0.3, mu: 0.4, e: 0.7 }
}

/// A double pendulum with stops.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    define(elbow = [l * sin(a), 0, -l * cos(a)]),
    particle(mass = 1, position = elbow),
    particle(mass = m, position = elbow + [l * sin(b), 0, -l * cos(b)]),
    range(a, from = -low, to = high, restitution = e),
    range(knee, along = b - a, from = 0),
    input(torque),
    drive(a = torque),
)]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
    low: f64,
    high: f64,
    e: f64,
}

#[test]
fn a_list_of_contacts() {
    assert_eq!(BallKernel::CONTACTS, [Contact::new("floor", 0, 2)]);
    let names = ["a_from", "a_to", "knee_from"].into_iter().enumerate();
    let all: Vec<Contact> = names.map(|(k, name)| Contact::new(name, k, 0)).collect();
    assert_eq!(PendulumKernel::CONTACTS, all);
}

#[test]
fn a_ball() {
    let kernel = ball().kernel().unwrap();
    let q = Isometry3::new(Vector3::new(1.0, 2.0, 0.5), Vector3::new(0.2, 0.3, -0.4));
    assert!((kernel.gaps(0.0, &q)[0] - 0.2).abs() < 1e-15);
    assert_eq!((kernel.friction(0.0, &q, &SVector::zeros(), &())[0], kernel.restitution()[0]), (0.4, 0.7));
    laws(&kernel, &q, &SVector::from([0.3, -0.2, 0.5, 1.0, -0.7, 0.4]), &());
}

/// D = W A⁻¹Wᵀ and what else holds among the methods, at one state.
fn laws<const N: usize, const R: usize, S>(kernel: &S, q: &S::Configuration, z: &SVector<f64, N>, input: &S::Input)
where
    S: ContactSystem<
            Scalar = f64,
            Speeds = SVector<f64, N>,
            MassMatrix = SMatrix<f64, N, N>,
            ContactRows = SVector<f64, R>,
            ContactColumns = SMatrix<f64, N, R>,
            Delassus = SMatrix<f64, R, R>,
        >,
{
    let ContactDynamics { acceleration, bias: _, response, .. } = kernel.contact_dynamics(0.0, q, z, input);
    let transposed = kernel.contact_jacobian(0.0, q);
    // Numbers of order ten and some hundreds of roundings.
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-11 * (1.0 + a.abs()), "{a} against {b}");
    let pairs = |a: &[f64], b: &[f64]| a.iter().zip(b).for_each(|(a, b)| close(*a, *b));
    pairs(acceleration.as_slice(), kernel.acceleration(0.0, q, z, input).as_slice());
    pairs((kernel.mass_matrix(0.0, q) * response.columns).as_slice(), transposed.as_slice());
    pairs((transposed.transpose() * response.columns).as_slice(), response.delassus.as_slice());
    assert_eq!(response.delassus, response.delassus.transpose());
    let alone = kernel.contact_response(0.0, q);
    pairs(alone.columns.as_slice(), response.columns.as_slice());
    pairs(alone.delassus.as_slice(), response.delassus.as_slice());
    assert_eq!(transposed.nth(0), Some(transposed.column(0).into_owned()));
    // The rates are affine in z, with W.
    let more = SVector::from_fn(|k, _| 0.3 - 0.2 * k as f64);
    let difference = kernel.contact_rates(0.0, q, &(z + more)) - kernel.contact_rates(0.0, q, z);
    pairs(difference.as_slice(), (transposed.transpose() * more).as_slice());
}
