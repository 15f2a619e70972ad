//! Constraints that are not linear in velocities: C is minimised subject to what they say of accelerations, as Gauss'
//! principle has it (Appell 1911, Chetaev 1932).

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Time, balance, corresponds, laws};
use gauss_tests::nonholonomic::{gains_energy, precise};
use proptest::prelude::*;

/// A point whose speed is constant.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    speeds(vx, vy, vz),
    kinematics(x = vx, y = vy, z = vz),
    particle(mass = m, position = [x, y, z]),
    constraint(velocity = vx * vx + vy * vy + vz * vz - speed * speed),
)]
struct ConstantSpeed {
    m: f64,
    speed: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same condition with a square root, in coordinates on a cylinder.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(r, phi, z),
    particle(mass = m, position = [r * cos(phi), r * sin(phi), z]),
    constraint(velocity = sqrt(rate(r).powi(2) + (r * rate(phi)).powi(2) + rate(z) * rate(z)) - speed),
)]
struct ConstantSpeedAround {
    m: f64,
    speed: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Appell's: ẋ² + ẏ² = k² ż², as by threads around a wheel (Appell 1911; Hamel 1949, § 78).
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = m, position = [x, y, z]),
    constraint(velocity = rate(x).powi(2) + rate(y).powi(2) - (k * rate(z)).powi(2)),
)]
struct AppellHamel {
    m: f64,
    k: f64,
    #[gauss(gravity)]
    g: f64,
}

const G: f64 = 9.81;

#[test]
fn a_point_of_constant_speed_falls_like_a_gudermannian() {
    // With v = c (cos α, 0, sin α): α̇ = −(g/c) cos α, so sin α = −tanh(g t/c) from α = 0.
    let (m, c, duration) = (0.7, 2.0, 0.9);
    let kernel = ConstantSpeed { m, speed: c, g: G }.kernel().unwrap();
    let start = SVector::from([c, 0.0, 0.0]);
    let last = Simulation::new(&kernel).control(precise()).run_to_end(SVector::zeros(), start, 0.0..duration).unwrap();
    let s = G * duration / c;
    let expected = [c / s.cosh(), 0.0, -c * s.tanh()];
    let place = [c * c / G * s.sinh().atan(), 0.0, -c * c / G * s.cosh().ln()];
    // Some hundred steps of a few roundings; a regular motion of length s = 4.
    assert!((last.z - SVector::from(expected)).amax() < 1e-13 * c, "{} {expected:?}", last.z);
    assert!((last.q - SVector::from(place)).amax() < 1e-13 * c, "{} {place:?}", last.q);
    // The force along the path is all of the weight's part along it: 2 λ c = m g sin α.
    let lambda = kernel.multipliers(last.t, &last.q, &last.z, &())[0];
    assert!((2.0 * lambda * c - m * G * last.z[2] / c).abs() < 1e-13 * m * G, "{lambda}");
}

#[test]
fn appells_point_falls_straight() {
    // ẋ ∝ ẏ ∝ ż and z̈ = −g/(1 + k²): a line on the cone, whichever is the sense of ż.
    let (m, k, angle, duration) = (1.3, 0.6, 0.8_f64, 1.5);
    let kernel = AppellHamel { m, k, g: G }.kernel().unwrap();
    let direction = SVector::from([k * angle.cos(), k * angle.sin(), 1.0]);
    let start = direction * -0.4;
    let last = Simulation::new(&kernel).control(precise()).run_to_end(SVector::zeros(), start, 0.0..duration).unwrap();
    let fall = -G / (1.0 + k * k);
    let (expected, place) = (-0.4 + fall * duration, -0.4 * duration + fall * duration * duration / 2.0);
    assert!((last.z - direction * expected).amax() < 1e-13 * expected.abs(), "{}", last.z);
    assert!((last.q - direction * place).amax() < 1e-13 * place.abs(), "{}", last.q);
}

#[test]
fn the_cone_has_an_apex_at_rest() {
    // J = 0 at rest: accelerations are undetermined there, and said to be so.
    let kernel = AppellHamel { m: 1.0, k: 0.6, g: G }.kernel().unwrap();
    let stopped = Simulation::new(&kernel).fixed_step(0.01).run(SVector::zeros(), SVector::zeros(), 0.0..1.0);
    assert!(stopped.unwrap_err().to_string().contains("constraints"), "in words");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn accelerations_are_those_of_a_projection(place in prop::array::uniform3(0.3_f64..2.0), z in prop::array::uniform3(-3.0..3.0)) {
        let (m, z) = (0.7, SVector::from(z));
        let speed = z.norm();
        prop_assume!(speed > 0.3);
        let cartesian = ConstantSpeed { m, speed, g: G }.kernel().unwrap();
        let around = ConstantSpeedAround { m, speed, g: G }.kernel().unwrap();
        // Of the weight, what is along v is taken away.
        let weight = SVector::from([0.0, 0.0, -G]);
        let expected = weight - z * (weight.dot(&z) / speed.powi(2));
        let [r, phi, height] = place;
        let (s, c) = phi.sin_cos();
        let q = SVector::from([r * c, r * s, height]);
        let found = cartesian.acceleration(0.0, &q, &z, &());
        prop_assert!((found - expected).amax() < 1e-13 * G, "{found} {expected}");
        // The constraint does work, 2λv·v, at this rate: m g v_z.
        laws(&cartesian, 0.0, &q, &z, Time::Explicit);
        gains_energy(&cartesian, 0.0, &q, &z, m * G * z[2]);
        balance(&cartesian, 0.0, (&q, &z), &());

        let rates = SVector::from([c * z[0] + s * z[1], (c * z[1] - s * z[0]) / r, z[2]]);
        let cylinder = SVector::from([r, phi, height]);
        laws(&around, 0.0, &cylinder, &rates, Time::Explicit);
        gains_energy(&around, 0.0, &cylinder, &rates, m * G * z[2]);
        balance(&around, 0.0, (&cylinder, &rates), &());
        corresponds(&around, &cartesian, 0.0, (&cylinder, &rates), |_, q, z| {
            let ((s, c), [r, across]) = (q[1].sin_cos(), [q[0], q[0] * z[1]]);
            (SVector::from([r * c, r * s, q[2]]), SVector::from([c * z[0] - s * across, s * z[0] + c * across, z[2]]))
        });
    }
}
