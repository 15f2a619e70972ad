//! The energy of steps with impacts: none comes from nowhere, and what a step errs by is in its report.

use gauss_contact::{ContactStepper, StepScheme};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::common::numbers;

/// A box on its corners.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m,
        inertia = [m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12]),
    contact(floor, point = hull.position, edges = [a, b, c], friction = mu, restitution = e),
)]
struct Hull {
    m: f64,
    a: f64,
    b: f64,
    c: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Two rods on a hinge, whose mass matrix changes with the angle between them.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, a, b),
    body(one, position = [x, y, 0], rotation = rotation_z(a), mass = m, center_of_mass = [0.25, 0, 0],
        inertia_about_center_of_mass = [0, m / 48, m / 48]),
    body(two, parent = one, position = [0.5, 0, 0], rotation = rotation_z(b), mass = 3 * m,
        center_of_mass = [0.25, 0, 0], inertia_about_center_of_mass = [0, m / 16, m / 16]),
    point(tip, body = two, at = [0.5, 0, 0]),
    contact(foot, point = [x, y, 0], plane = [0, 1, 0], friction = mu, restitution = e),
    contact(knee, point = two.position, plane = [0, 1, 0], friction = mu, restitution = e),
    contact(hand, point = tip, plane = [0, 1, 0], friction = mu, restitution = e),
)]
struct Rods {
    m: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// All that steps gain in 2 s, as a part of a scale of energy. A step with an impact that is made as a whole gains no
/// more than it tells.
fn gains<K: ContactSystem<Scalar = f64, Input = ()>>(
    kernel: &K,
    (q, z): (K::Configuration, K::Speeds),
    (h, scheme, scale): (f64, StepScheme, f64),
) -> f64 {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z).unwrap().scheme(scheme);
    let mut gains = 0.0;
    while stepper.time() < 2.0 {
        let energy =
            |stepper: &ContactStepper<'_, K>| kernel.energy(stepper.time(), stepper.configuration(), stepper.speeds());
        let before = energy(&stepper);
        // Two spikes on one spot may have no solution; that is said.
        let Ok(report) = stepper.step(h, &()) else { break };
        let gained = energy(&stepper) - before;
        gains += gained.max(0.0) / scale;
        // Rates of energy are differences: half of the digits of what weight does in the step.
        let told = report.unexplained != 0.0 && report.parts == 0;
        assert!(!told || gained <= report.unexplained + 1e-8 * scale, "{gained:e} {report:?}");
    }
    gains
}

/// Steps of 1 ms and of 1/60 s, without friction and without loss, which is the hardest, with neither, and with both.
#[test]
fn impacts_gain_little_and_tell_it() {
    let mut number = numbers(4711);
    for n in 0..48 {
        let mut part = || 0.5 + 0.5 * number();
        let (scheme, h) = ([StepScheme::Midpoint, StepScheme::MoreauJean][n % 2], [1e-3, 1.0 / 60.0][n / 2 % 2]);
        let (mu, e) = [(0.0, 1.0), (0.0, part()), (part(), 0.0), (part(), 0.9 * part())][n / 4 % 4];
        let m = 10.0_f64.powi([-6, 0, 6][n / 16]);
        let name = format!("{n}: {scheme:?}, h {h}, μ {mu}, e {e}");

        let (a, b, c) = (0.1 + 0.3 * part(), 0.1 + 0.3 * part(), 0.1 + 0.3 * part());
        let hull = Hull { m, a, b, c, mu, e, g: 9.81 }.kernel().unwrap();
        let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.7), Vector3::from_fn(|_, _| 3.0 * part()));
        let z = SVector::from_fn(|i, _| if i < 3 { 2.0 } else { 10.0 } * (2.0 * part() - 1.0));
        let of_hull = gains(&hull, (pose, z), (h, scheme, hull.energy(0.0, &pose, &z)));

        let rods = Rods { m, mu, e, g: Vector3::new(0.0, -9.81, 0.0) }.kernel().unwrap();
        let q = SVector::from([0.0, 1.3, 6.0 * part(), 4.0 * part()]);
        let z = SVector::from_fn(|i, _| if i < 2 { 1.0 } else { 4.0 } * (2.0 * part() - 1.0));
        let of_rods = gains(&rods, (q, z), (h, scheme, rods.energy(0.0, &q, &z).max(m * 4.0 * 9.81 * 1.3)));

        // Steps without a memory are not made in parts: they tell.
        if scheme == StepScheme::Midpoint {
            // An impact gains a thousandth of what is left at most, or is confined to a sixteenth of a step; in the air
            // speeds are off by a millionth a step.
            assert!(of_hull < 1e-2, "{name}: {of_hull}");
            // Rods gain in the air as well where they turn by ωh a step, with ω of 10 to 40 rad/s.
            let bound = if h > 1e-2 { 0.5 } else { 0.05 };
            assert!(of_rods < bound, "{name}: {of_rods}");
        }
    }
}
