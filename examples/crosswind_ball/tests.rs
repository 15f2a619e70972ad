//! The physics of the example `crosswind_ball`.

use crate::model::{Ball, acceleration, fly, fly_by_hand};
use gauss_runtime::prelude::*;

/// 10⁻¹¹ of a state of size 30 is the tolerance of each of some 700 steps; errors of velocities grow with the time.
fn tolerance(seconds: f64) -> f64 {
    1e-11 * 30.0 * 700.0 * (1.0 + seconds)
}

#[test]
fn a_dropped_ball_follows_the_hyperbolic_tangent() {
    let ball = Ball::football(Vector3::zeros());
    let kernel = ball.kernel().unwrap();
    let path = fly(&kernel, Vector3::zeros(), Vector3::zeros(), 3.0).unwrap();
    let (terminal, tau) = (ball.terminal_speed(), ball.terminal_speed() * ball.total_mass() / ball.heaviness());
    for s in path.iter() {
        let fallen = terminal * tau * (s.t / tau).cosh().ln();
        assert!((s.z[2] + terminal * (s.t / tau).tanh()).abs() <= tolerance(3.0), "at {} s", s.t);
        assert!((s.q.translation.vector.z + fallen).abs() <= tolerance(3.0), "at {} s", s.t);
    }
}

#[test]
fn without_air_it_flies_a_parabola() {
    let air = Vector6::zeros();
    let ball = Ball { added_mass: air, displaced_mass: 0.0, c: 0.0, l: 0.0, ..Ball::football(Vector3::zeros()) };
    let start = Vector3::new(20.0, 1.0, 15.0);
    let kernel = ball.kernel().unwrap();
    let path = fly(&kernel, start, Vector3::new(0.0, 30.0, 10.0), 3.0).unwrap();
    for s in path.iter() {
        let exact = start * s.t - Vector3::z() * (0.5 * ball.g * s.t * s.t);
        // Poses move along screws, not parabolas, because the ball spins.
        let apart = (s.q.translation.vector - exact).norm();
        assert!(apart <= tolerance(3.0), "{apart:e} at {} s", s.t);
    }
}

#[test]
fn the_mass_point_by_hand_flies_the_same_way() {
    let ball = Ball::football(Vector3::new(-3.0, 8.0, 0.5));
    let (start, omega) = (Vector3::new(21.0, 1.0, 15.0), Vector3::new(5.0, -30.0, -40.0));
    let kernel = ball.kernel().unwrap();
    let path = fly(&kernel, start, omega, 2.0).unwrap();
    let (coarse, fine) = (fly_by_hand(&ball, start, omega, 0.01, 200), fly_by_hand(&ball, start, omega, 0.005, 400));
    for n in (0..=200).step_by(10) {
        let s = path.at((0.01 * n as f64).min(2.0)).unwrap();
        let (x, v) = fine[2 * n];
        // The error of the finer steps of a method of order 4 is a fifteenth of what halving changes; twice that.
        let halved = (coarse[n].0 - x).norm() + (coarse[n].1 - v).norm();
        let apart = (s.q.translation.vector - x).norm() + (s.z.fixed_rows::<3>(0) - v).norm();
        assert!(apart <= 2.0 * halved / 15.0 + tolerance(2.0), "{apart:e} at {} s", s.t);
        // The equations themselves, at the states of the run. The momentum of the added mass is balanced in turning
        // axes, where ω × v of some 10³ m/s² comes in and goes out again: a dozen roundings of that.
        let exact = acceleration(&ball, s.t, &s.z.fixed_rows::<3>(0).into_owned(), &omega);
        let generated = kernel.acceleration(s.t, &s.q, &s.z, &());
        let turned = (s.q.rotation * s.z.fixed_rows::<3>(3).into_owned() - omega).norm();
        // The spin in space is kept up to the tolerance of the run, in front of l v/m, about 7 m/s² for 50 rad/s.
        let rounding = 12.0 * f64::EPSILON * omega.norm() * v.norm() + turned;
        let off = (generated.fixed_rows::<3>(0) - exact).norm();
        assert!(off <= rounding, "{off:e} against {rounding:e} at {} s", s.t);
    }
}

#[test]
fn drag_takes_and_the_magnus_force_only_turns() {
    // In calm air both forces are known by their powers.
    let ball = Ball::football(Vector3::zeros());
    let kernel = ball.kernel().unwrap();
    let z = SVector::from([21.0, 1.0, 15.0, 5.0, -30.0, -40.0]);
    let speed = Vector3::<f64>::new(21.0, 1.0, 15.0).norm();
    let power = |name| kernel.power(name, 0.0, &Isometry3::identity(), &z, &()).unwrap();
    let taken = ball.c * speed.powi(3);
    assert!((power("drag") + taken).abs() <= 10.0 * f64::EPSILON * taken);
    assert!(power("magnus").abs() <= 10.0 * f64::EPSILON * ball.l * 51.0 * speed * speed);
}
