//! Boxes on slopes at the angle of friction itself, where rounding decides whether they stay, and next to it.

use gauss_contact::ContactRun;
use gauss_runtime::prelude::*;

const G: f64 = 9.81;
const END: f64 = 5.0;

/// A cube on its corners, of which four touch.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, pose = pose, mass = m, inertia = [inertia, inertia, inertia]),
    contact(floor, point = hull.position, edges = [edge, edge, edge], friction = mu),
)]
struct Cube {
    m: f64,
    mu: f64,
    edge: f64,
    inertia: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

/// Numbers one after the other, of so many.
fn choices(mut state: u64) -> impl FnMut(usize) -> usize {
    move |count| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count
    }
}

/// Places the cube on a slope that leans by so much more than the angle of friction, and lets it go.
#[track_caller]
fn slides_as_it_has_to(mu: f64, beyond: f64, choose: &mut impl FnMut(usize) -> usize) {
    let edge = [1e-3, 0.1, 1.0, 10.0][choose(4)];
    let m = [1.0, 1e-6, 1e6][choose(3)];
    let inertia = m * edge * edge * [1.0 / 6.0, 0.166_666_666_666_666_7, 0.2, 0.1][choose(4)];
    // One that leans by more than 45° across an edge tips over.
    let yaw = [0.0, 0.3, 0.785, 1.3][if mu < 1.0 || beyond < 1e-15 { choose(4) } else { 1 + choose(3) }];
    let tolerance = [1e-6, 1e-8, 1e-9, 1e-10][choose(4)];
    let angle = mu.atan() + beyond;
    let g = Vector3::new(G * angle.sin(), 0.0, -G * angle.cos());
    let kernel = Cube { m, mu, edge, inertia, g }.kernel().unwrap();
    let start = Isometry3::new(Vector3::new(0.0, 0.0, 0.5 * edge), Vector3::new(0.0, 0.0, yaw));
    let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).max_steps(200);
    let (run, error) = run.attempt(start, SVector::zeros(), 0.0..END);
    let name = format!("{mu} {beyond:e} {edge} {m:e} {inertia:e} {yaw} {tolerance:e}");
    assert!(error.is_none(), "{name}: {error:?}");
    let found = run.last().unwrap().q.translation;
    let wanted = 0.5 * G * (angle.sin() - mu * angle.cos()).max(0.0) * END * END;
    // Whether forces hold is known to 16 roundings of 256 (1 + 12) ε of the twelve forces: 10⁻¹¹ of each, of which a
    // row has some.
    let known = 1e-10 * 0.5 * G * END * END;
    assert!((found.x - wanted).abs() < known && found.y.abs() < known, "{name}: {found:?} {wanted:e}");
}

#[test]
fn cubes_at_the_angle_of_friction_stay_or_slide_as_slowly_as_roundings() {
    let mut choose = choices(1);
    for mu in [0.1, 0.2, 0.25, 0.3, 0.5, 0.7, 0.75, 1.0] {
        for roundings in [-4.0, -1.0, 0.0, 1.0, 4.0] {
            (0..3).for_each(|_| slides_as_it_has_to(mu, roundings * f64::EPSILON * mu, &mut choose));
        }
    }
}

#[test]
fn cubes_next_to_the_angle_of_friction_slide_by_the_law() {
    let mut choose = choices(2);
    for mu in [0.1, 0.2, 0.25, 0.3, 0.5, 0.7, 0.75, 1.0] {
        for size in [1e-14, 1e-13, 1e-12, 3e-12, 1e-11, 2e-11, 5e-11, 1e-10, 3e-10, 1e-9, 1e-8, 1e-7] {
            slides_as_it_has_to(mu, -size, &mut choose);
            slides_as_it_has_to(mu, size, &mut choose);
        }
    }
}
