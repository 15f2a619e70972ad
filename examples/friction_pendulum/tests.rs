//! The claims of the example `friction_pendulum`, against equations typed by hand.

use gauss_contact::{ContactRun, EventKind};
use gauss_runtime::prelude::*;

use crate::scene::Pendulum;

/// The torques of gravity, spiral, buffer with its damping, and friction while it falls or
/// rises, N m: a uniform rod hangs at rest, angles from there.
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
        if speed > 0.0 { -p.dry } else { p.dry },
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
            let names = ["gravity", "spiral", "buffer"];
            for (name, torque) in names.into_iter().zip(expected) {
                let found = kernel.generalised_force(name, 0.0, &q, &z, &()).unwrap()[0];
                assert!((found - torque).abs() <= rounding, "{name} at {theta}, {speed}: {found} and {torque}");
            }
            let found = kernel.acceleration(0.0, &q, &z, &())[0];
            let friction = expected[3];
            let expected = acceleration(&pendulum, [theta, speed])[1] - friction / pendulum.rod.inertia.m22;
            assert!((found - expected).abs() <= rounding / pendulum.rod.inertia.m22, "{found} and {expected}");
        }
    }
}

#[test]
fn it_swings_as_the_equations_typed_by_hand_do() {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-11, 1e-11).run([1.6].into(), [0.0].into(), 0.0..12.0).unwrap();
    let end = run.events()[0].time;
    let [coarse, fine] = [10_000, 20_000].map(|steps| runge_kutta(&pendulum, [1.6, 0.0], end, steps));
    let found = run.at(end).unwrap();
    for (found, coarse, fine) in [(found.q[0], coarse[0], fine[0]), (found.z[0], coarse[1], fine[1])] {
        // Halving the steps of a method of order 4 leaves a fifteenth of the difference; the adaptive run makes some
        // hundred errors of 1e-11 of numbers below 10.
        let bound = (coarse - fine).abs() / 15.0 + 1e-8;
        assert!((coarse - fine).abs() < 1e-8, "the reference is not good enough: {coarse} and {fine}");
        assert!((found - fine).abs() < bound, "{found} and {fine}");
    }
}

#[test]
fn it_stops_where_friction_holds_it() {
    let pendulum = Pendulum::desk();
    let kernel = pendulum.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run([1.6].into(), [0.0].into(), 0.0..12.0).unwrap();
    let (stops, end) = (run.events().last().unwrap(), run.last().unwrap());
    assert_eq!((stops.kind, end.z[0]), (EventKind::Sticks, 0.0));
    assert_eq!(run.at(stops.time).unwrap().q, end.q);
    // What holds it is against all other torques, within the bound.
    let [weight, spiral, buffer, _] = torques(&pendulum, end.q[0], 0.0);
    let held = run.forces(12.0).unwrap()[0];
    assert!((held + weight + spiral + buffer).abs() < 1e-14 && held.abs() < pendulum.dry, "{held}");
}
