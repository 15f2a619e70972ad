//! The claims of the example `friction_pendulum`, against equations typed by hand and the exact solution of a slider.

#[path = "../friction_pendulum/scene.rs"]
mod scene;

use gauss_runtime::prelude::*;

use scene::{Pendulum, Slider};

/// The torques of gravity, spiral, buffer with its damping, and friction, N m: a uniform rod hangs at rest, angles from
/// there.
fn torques(p: &Pendulum, theta: f64, speed: f64) -> [f64; 4] {
    let lever = -p.rod.center_of_mass.z;
    let beyond = p.limit - theta;
    let root = (beyond * beyond + p.soft * p.soft).sqrt();
    // The rubber is pressed by s = (x + √(x² + w²))/2, and ds/dx is:
    let (pressed, slope) = (0.5 * (beyond + root), 0.5 * (1.0 + beyond / root));
    [
        -p.rod.mass * p.g * lever * theta.sin(),
        -p.spiral * (theta - p.relaxed),
        p.rubber * pressed * slope - p.loss * slope * slope * speed,
        -p.dry * speed / (speed * speed + p.creep * p.creep).sqrt(),
    ]
}

fn acceleration(p: &Pendulum, [theta, speed]: [f64; 2]) -> [f64; 2] {
    [speed, torques(p, theta, speed).iter().sum::<f64>() / p.rod.inertia.m22]
}

/// The classical method of Runge and Kutta, steps of one length.
fn runge_kutta(p: &Pendulum, start: [f64; 2], end: f64, steps: u32) -> [f64; 2] {
    let h = end / f64::from(steps);
    let shifted = |y: [f64; 2], k: [f64; 2], part: f64| [y[0] + part * k[0], y[1] + part * k[1]];
    (0..steps).fold(start, |y, _| {
        let a = acceleration(p, y);
        let b = acceleration(p, shifted(y, a, 0.5 * h));
        let c = acceleration(p, shifted(y, b, 0.5 * h));
        let d = acceleration(p, shifted(y, c, h));
        std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    })
}

#[test]
fn the_forces_are_those_of_the_textbook() {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel().unwrap();
    for n in -20..=20 {
        for speed in [-6.0, -2e-3, 0.0, 1e-3, 0.4] {
            let theta = 0.1 * f64::from(n);
            let (q, z) = (SVector::from([theta]), SVector::from([speed]));
            let expected = torques(&pendulum, theta, speed);
            // A dozen roundings of terms no larger than these; what is pressed is a difference of numbers of size 1
            // where the buffer is hardly touched.
            let size: f64 =
                expected.iter().map(|torque| torque.abs()).sum::<f64>() + pendulum.rubber * theta.abs().max(1.0);
            let rounding = 12.0 * f64::EPSILON * size;
            let names = ["gravity", "spiral", "buffer", "friction"];
            for (name, torque) in names.into_iter().zip(expected) {
                let found = kernel.generalised_force(name, 0.0, &q, &z, &()).unwrap()[0];
                assert!((found - torque).abs() <= rounding, "{name} at {theta}, {speed}: {found} and {torque}");
            }
            let found = kernel.acceleration(0.0, &q, &z, &())[0];
            let expected = acceleration(&pendulum, [theta, speed])[1];
            assert!((found - expected).abs() <= rounding / pendulum.rod.inertia.m22, "{found} and {expected}");
        }
    }
}

#[test]
fn it_swings_as_the_equations_typed_by_hand_do() {
    // Friction over a tenth of a radian per second: then the equations typed by hand can be solved in equal steps.
    let pendulum = Pendulum { creep: 0.1, ..Pendulum::desk() };
    let kernel = pendulum.kernel().unwrap();
    let run = Simulation::new(&kernel).adaptive(1e-11, 1e-11);
    let end = run.run_to_end(SVector::from([1.6]), SVector::from([0.0]), 0.0..2.0).unwrap();
    let [coarse, fine] = [10_000, 20_000].map(|steps| runge_kutta(&pendulum, [1.6, 0.0], 2.0, steps));
    for (found, coarse, fine) in [(end.q[0], coarse[0], fine[0]), (end.z[0], coarse[1], fine[1])] {
        // Halving the steps of a method of order 4 leaves a fifteenth of the difference; the adaptive run makes some
        // thousand errors of 1e-11 of numbers below 10, which swings do not magnify.
        let bound = (coarse - fine).abs() / 15.0 + 1e-7;
        assert!((coarse - fine).abs() < 1e-8, "the reference is not good enough: {coarse} and {fine}");
        assert!((found - fine).abs() < bound, "{found} and {fine}");
    }
}

#[test]
fn at_rest_it_creeps_as_slowly_as_it_is_said_to() {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel().unwrap();
    let theta = 0.06;
    let pull: f64 = torques(&pendulum, theta, 0.0).iter().sum();
    assert!(pull.abs() < pendulum.dry, "friction holds it");
    let creeping = pendulum.creep * pull / (pendulum.dry * pendulum.dry - pull * pull).sqrt();
    let found = kernel.acceleration(0.0, &SVector::from([theta]), &SVector::from([creeping]), &())[0];
    // At that speed the torques balance but for that of the buffer's damping, whose slope is (w/2x)² where nothing
    // touches it.
    let slope = (0.5 * pendulum.soft / (theta - pendulum.limit)).powi(2);
    let bound = pendulum.loss * slope * slope * creeping.abs() + 12.0 * f64::EPSILON * pendulum.rubber;
    assert!((found * pendulum.rod.inertia.m22).abs() < 1.01 * bound, "{found}");
}

/// Lengths in the plane (x, v/ω) are kept along an arc, so that errors of steps add up; each is the tolerance, of
/// numbers up to 1, or where the force jumps, and the error is hard to estimate, up to three times that.
#[test]
fn dry_friction_takes_the_same_from_every_swing() {
    let slider = Slider::desk();
    let kernel = slider.kernel().unwrap();
    let tolerance = 1e-10;
    let run = Simulation::new(&kernel).adaptive(tolerance, tolerance);
    let path = run.run(SVector::from([slider.released()]), SVector::from([0.0]), 0.0..slider.rests()).unwrap();
    let bound = 3.0 * path.len() as f64 * 2.0 * tolerance;
    for s in path.iter() {
        assert!((s.q[0] - slider.exact(s.t)).abs() < bound, "at {}: {} and {}", s.t, s.q[0], slider.exact(s.t));
    }

    // Made smooth, the law is left for |v| of some ε, and the error is of first order in ε.
    let error = |creep: f64| {
        let kernel = slider.smooth(creep).kernel().unwrap();
        let run = Simulation::new(&kernel).adaptive(tolerance, tolerance);
        let path = run.run(SVector::from([slider.released()]), SVector::from([0.0]), 0.0..slider.rests()).unwrap();
        path.iter().map(|s| (s.q[0] - slider.exact(s.t)).abs()).fold(0.0, f64::max)
    };
    let [coarse, fine] = [error(1e-2), error(1e-3)];
    assert!((7.0..14.0).contains(&(coarse / fine)), "{coarse:e} and {fine:e}");
}
