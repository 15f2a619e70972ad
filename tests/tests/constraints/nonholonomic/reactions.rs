//! Multipliers as forces: the tension of a thread and the reaction of a hinge against closed forms.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, constrained_laws, laws, position_rates};
use gauss_tests::nonholonomic::precise;
use proptest::prelude::*;

/// A point at the end of a thread, in Cartesian coordinates. The multiplier of the distance is a force, against the
/// tension.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = m, position = [x, y, z]),
    constraint(position = sqrt(x * x + y * y + z * z) - l),
)]
struct Thread {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A rod in a plane with its end in a hinge: the multipliers are the two components of the force on the rod.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, theta),
    body(rod, position = [x, 0, z], rotation = rotation_y(-theta)),
    point(end, body = rod, at = [0, 0, l / 2]),
    constraint(position = end),
)]
struct Hinged {
    #[gauss(body)]
    rod: RigidBody<f64>,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

const G: f64 = 9.81;

fn rod(m: f64, l: f64) -> RigidBody<f64> {
    // Uniform and thin: m l²/12 about G.
    let inertia = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1e-3)) * (m * l * l / 12.0);
    RigidBody { mass: m, center_of_mass: Vector3::zeros(), inertia }
}

#[test]
fn the_thread_of_a_spherical_pendulum_pulls_by_energy_alone() {
    // T = m (v²/l − g z/l), and v² from the energy: T at any height is known from the start.
    let (m, l) = (1.1, 0.8);
    let kernel = Thread { m, l, g: G }.kernel().unwrap();
    let q = SVector::from([0.48, 0.0, -0.64]);
    let z = SVector::from([0.8, 1.5, 0.6]);
    let energy = kernel.energy(0.0, &q, &z);
    let mut largest: f64 = 0.0;
    let check = |sample: &Sample<ThreadKernel>| {
        let height = sample.q[2];
        let tension = 2.0 * (energy - m * G * height) / l - m * G * height / l;
        let found = kernel.multipliers(sample.t, &sample.q, &sample.z, &())[0];
        largest = largest.max((found + tension).abs() / tension.abs().max(m * G));
    };
    let run = Simulation::new(&kernel).control(precise()).observe(check).run_to_end(q, z, 0.0..10.0).unwrap();
    assert!((run.q.norm() - l).abs() < 4.0 * f64::EPSILON);
    // The energy drifts by some roundings a step over about a thousand steps.
    assert!(largest < 1e-12, "{largest:e}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_hinge_carries_the_rod(theta in -3.0..3.0, omega in -4.0..4.0) {
        let (m, l) = (0.9, 1.4);
        let kernel = Hinged { rod: rod(m, l), l, g: G }.kernel().unwrap();
        let (s, c) = f64::sin_cos(theta);
        // The lower end is at −e₃ of the rod, which hangs at θ = 0.
        let q = SVector::from([l / 2.0 * s, -l / 2.0 * c, theta]);
        let z = SVector::from([l / 2.0 * c * omega, l / 2.0 * s * omega, omega]);
        laws(&kernel, 0.0, &q, &z, Time::Absent);
        constrained_laws(&kernel, 0.0, &q, &z);
        position_rates(&kernel, 0.0, &(q * 1.3), &z);
        let acceleration = kernel.acceleration(0.0, &q, &z, &());
        prop_assert!((acceleration[2] + 1.5 * G / l * s).abs() < 1e-12, "{acceleration}");
        // Along the rod towards the hinge m g cos θ + m ω² l/2, across it a quarter of the weight's part.
        let (along, across) = (m * (G * c + omega * omega * l / 2.0), m * G * s / 4.0);
        let force = kernel.multipliers(0.0, &q, &z, &());
        let expected = [-along * s + across * c, along * c + across * s];
        prop_assert!((0..2).all(|k| (force[k] - expected[k]).abs() < 1e-12), "{force} {expected:?}");
    }
}
