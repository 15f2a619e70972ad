//! Runs of ellipsoids on a table: at rest, and rocking with the periods of small angles.

use gauss_contact::{ContactRun, Mode};
use gauss_runtime::prelude::*;

const G: f64 = 9.81;
/// The semi-axes, how far G is below the centre of the ellipsoid, the mass, moments about G.
const SEMI_AXES: [f64; 3] = [0.2, 0.12, 0.1];
const BELOW: f64 = 0.02;
const MASS: f64 = 1.5;
const MOMENTS: [f64; 3] = [0.006, 0.014, 0.016];

/// A pebble; O is in the middle of the ellipsoid.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(stone, position = pose.position, rotation = pose.rotation, mass = 1.5, center_of_mass = [0, 0, -0.02],
        inertia_about_center_of_mass = i),
    contact(table, point = stone.position, semi_axes = [0.2, 0.12, 0.1], friction = mu),
)]
struct Pebble {
    i: Vector3<f64>,
    mu: f64,
    #[gauss(gravity)]
    g: f64,
}

fn pebble(mu: f64) -> PebbleKernel {
    Pebble { i: MOMENTS.into(), mu, g: G }.kernel().unwrap()
}

/// Turned about a horizontal axis of its own, at the height at which it touches.
fn tilted(axis: usize, angle: f64) -> Isometry3<f64> {
    let rotation = UnitQuaternion::new(Vector3::ith(axis, angle));
    let up = rotation.inverse() * Vector3::z();
    Isometry3::from_parts(Translation3::new(0.3, -0.1, up.component_mul(&Vector3::from(SEMI_AXES)).norm()), rotation)
}

#[test]
fn what_lies_on_its_shortest_axis_rests() {
    let kernel = pebble(0.4);
    let start = tilted(0, 0.0);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..2.0).unwrap();
    let end = run.last().unwrap();
    assert!(run.events().is_empty() && end.q == start && end.z.amax() == 0.0, "{} {}", end.q, end.z);
    let forces = run.forces(1.0).unwrap().vectors();
    let [force] = forces.as_slice() else { panic!("one contact") };
    assert!((force.force - Vector3::z() * (MASS * G)).amax() < 1e-13, "{}", force.force);
    assert!((force.point - Vector3::new(0.3, -0.1, 0.0)).amax() < 1e-15);
}

/// About a horizontal axis, with ρ the radius of curvature across it at the lowest point and l the height of G: the
/// centre of the ellipsoid is at c + (ρ − c) θ²/2, so the potential is m g (ρ − l) θ²/2. What rolls turns about its
/// lowest point, with I + m l²; without friction G goes up and down, and I is all of the inertia.
#[test]
fn small_rocking_has_known_periods() {
    let [a, b, c] = SEMI_AXES;
    let low = c - BELOW;
    // The axis, and the semi-axis across it.
    for (axis, across) in [(1, a), (0, b)] {
        for mu in [0.8, 0.0] {
            let kernel = pebble(mu);
            let rolled = if mu > 0.0 { MASS * low * low } else { 0.0 };
            let rate = (MASS * G * (across * across / c - low) / (MOMENTS[axis] + rolled)).sqrt();
            let quarter = 0.25 * std::f64::consts::TAU / rate;
            let angle = 1e-3;
            let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12);
            let run = run.run(tilted(axis, angle), SVector::zeros(), 0.0..8.0 * quarter).unwrap();
            let about = |t: f64| run.at(t).unwrap().q.rotation.scaled_axis()[axis] / angle;
            // Periods differ from those of small angles by angle² times a number of order one; after five quarters and
            // two periods.
            assert!((about(5.0 * quarter)).abs() < 100.0 * angle * angle, "{} {mu}", about(5.0 * quarter));
            assert!((about(8.0 * quarter) - 1.0).abs() < 100.0 * angle * angle, "{} {mu}", about(8.0 * quarter));
            let mode = run.modes(quarter).unwrap()[0];
            assert_eq!(mode == Mode::Sticks, mu > 0.0, "{mode:?}");
            // A wrong curvature, or a wrong inertia, is seen.
            assert!((about(1.1 * quarter)).abs() > 0.1);
        }
    }
}
