//! The physics of the example `quadrotor`.

use crate::model::{Quadrotor, QuadrotorKernel, Seen, pilot, wanted};
use crate::newton_euler;
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

fn seen(q: &Isometry3<f64>, z: &SVector<f64, 6>) -> Seen {
    Seen {
        position: q.translation.vector,
        velocity: Vector3::new(z[0], z[1], z[2]),
        rotation: q.rotation.to_rotation_matrix().into_inner(),
        omega: Vector3::new(z[3], z[4], z[5]),
    }
}

/// The gust comes early, so that a short flight meets it on the figure of eight.
fn craft() -> Quadrotor {
    Quadrotor { gust_time: 3.2, ..Quadrotor::crazyflie() }
}

const FLIGHT: f64 = 4.0;

fn flight(kernel: &QuadrotorKernel, step: f64) -> Trajectory<'_, QuadrotorKernel> {
    let control = |t: f64, q: &Isometry3<f64>, z: &SVector<f64, 6>| SVector::from(pilot(&craft(), t, &seen(q, z)));
    let run = Simulation::new(kernel).adaptive(1e-10, 1e-12).input(control).largest_step(step);
    run.run(Isometry3::identity(), SVector::zeros(), 0.0..FLIGHT).unwrap()
}

#[test]
fn four_rotors_carry_the_weight_at_the_speed_of_hovering() {
    let craft = Quadrotor { gust: Vector3::zeros(), ..craft() };
    let hover = SVector::from([craft.hover_speed(); 4]);
    let kernel = craft.kernel().unwrap();
    let acceleration = kernel.acceleration(0.0, &Isometry3::identity(), &SVector::zeros(), &hover);
    // Four lifts against a weight: ten roundings of g; the torques about e₁ and e₂ cancel up to roundings of a·mg/4
    // over the inertia, some 2·10² rad/s².
    let levers = craft.a * craft.mass * craft.g / craft.inertia.min();
    assert!(acceleration.norm() <= 10.0 * f64::EPSILON * (craft.g + levers), "{acceleration}");
}

#[test]
fn newton_and_euler_by_hand_fly_the_same_way() {
    let kernel = craft().kernel().unwrap();
    let path = flight(&kernel, 0.01);
    // Steps of h and h/2 of a method of order 4: the difference of the two, over 15, is the error of the finer.
    let (h, steps) = (1.0 / 512.0, 2048);
    let coarse = newton_euler::fly(&craft(), h, steps);
    let fine = newton_euler::fly(&craft(), 0.5 * h, 2 * steps);
    let (mut apart, mut error) = (0.0_f64, 0.0_f64);
    for n in (0..=steps).step_by(64) {
        let sample = path.at(n as f64 * h).unwrap();
        let (ours, hand) = (seen(&sample.q, &sample.z), fine[2 * n]);
        apart = apart.max((ours.position - hand.position).norm() + (ours.rotation - hand.rotation).norm());
        let halved = (coarse[n].position - hand.position).norm() + (coarse[n].rotation - hand.rotation).norm();
        error = error.max(halved / 15.0);
    }
    // Twice the hand's own error, and that of the run: 10⁻¹⁰ in each of at most 10³ steps, which the pilot takes back.
    assert!(apart <= 2.0 * error + 1e-7 && error < 1e-6, "{apart:e} against {error:e}");
    let gone = (path.last().q.translation.vector - wanted(FLIGHT).position).norm();
    assert!(gone < 0.3, "the pilot has lost the craft: {gone} m");
}

#[test]
fn energy_is_what_rotors_and_air_supplied() {
    let kernel = craft().kernel().unwrap();
    let control = |t: f64, q: &Isometry3<f64>, z: &SVector<f64, 6>| SVector::from(pilot(&craft(), t, &seen(q, z)));
    let balance = power_balance(&kernel, &flight(&kernel, 0.005), control);
    let end = balance.last();
    // The climb alone is m g · 1 m = 0.26 J. The estimate has the size of the error of the quadrature.
    assert!(end.energy > 0.2, "{balance}");
    assert!(balance.largest_residual() <= 10.0 * end.uncertainty.max(1e-12), "{balance}");

    // Power by hand at the end: force by velocity, torque by angular velocity.
    let s = path_end(&kernel);
    let input = control(s.t, &s.q, &s.z);
    let now = seen(&s.q, &s.z);
    let lift = |n: f64, x: f64, y: f64| {
        let hub = now.rotation * (now.omega.cross(&Vector3::new(x, y, 0.0))) + now.velocity;
        (now.rotation * Vector3::z()).dot(&hub) * craft().k * n * n
    };
    let a = craft().a;
    let by_hand = [lift(input[0], a, -a), lift(input[1], -a, -a), lift(input[2], -a, a), lift(input[3], a, a)];
    for (name, power) in ["front_right", "back_right", "back_left", "front_left"].into_iter().zip(by_hand) {
        let generated = kernel.power(name, s.t, &s.q, &s.z, &input).unwrap();
        // A dozen products and sums of size |v| mg.
        assert!((generated - power).abs() <= 20.0 * f64::EPSILON * 0.3 * now.velocity.norm(), "{name}");
    }
}

fn path_end(kernel: &QuadrotorKernel) -> Sample<QuadrotorKernel> {
    *flight(kernel, 0.01).last()
}
