//! A column of fuel that moves through a body, and the same fuel as particles that are followed on their way.

use gauss_runtime::prelude::*;

/// A hull in space with a column of fuel of the line density ρ on the line from E along d (not through O), which moves
/// toward E with the velocity w relative to the hull and leaves there: its length is l − w t, and its moments about O
/// are those of a uniform rod.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    define(length = l - w * t, mass = rho * length, half = length / 2, square = length * length / 3,
        xx = e1 * e1 + 2 * e1 * half * d1 + square * d1 * d1, yy = e2 * e2 + 2 * e2 * half * d2 + square * d2 * d2,
        xy = e1 * e2 + half * (e1 * d2 + e2 * d1) + square * d1 * d2),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 3, center_of_mass = [0.1, -0.2, 0.3],
        inertia_about_center_of_mass = [2, 3, 4]),
    body(fuel, parent = hull, mass = mass, center_of_mass = [e1 + half * d1, e2 + half * d2, 0],
        inertia = [mass * yy, -mass * xy, 0, mass * xx, 0, mass * (xx + yy)]),
    mass_flow(jet, body = fuel, at = [e1, e2, 0], velocity = [-w * d1, -w * d2, 0]),
)]
struct Column {
    l: f64,
    w: f64,
    rho: f64,
    e1: f64,
    e2: f64,
    d1: f64,
    d2: f64,
}

/// Half the fuel at each of the two points of Gauss, whose moments are those of the rod, moving with w at t = `now`.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    define(length = l - w * now, mass = rho * length / 2,
        near = length * (1 / 2 - sqrt(1 / 12)) - w * (t - now), far = length * (1 / 2 + sqrt(1 / 12)) - w * (t - now)),
    body(hull, position = pose.position, rotation = pose.rotation, mass = 3, center_of_mass = [0.1, -0.2, 0.3],
        inertia_about_center_of_mass = [2, 3, 4]),
    particle(parent = hull, mass = mass, position = [e1 + near * d1, e2 + near * d2, 0]),
    particle(parent = hull, mass = mass, position = [e1 + far * d1, e2 + far * d2, 0]),
)]
struct Followed {
    l: f64,
    w: f64,
    now: f64,
    rho: f64,
    e1: f64,
    e2: f64,
    d1: f64,
    d2: f64,
}

/// Matter that leaves with the velocity that it has pushes nothing at the exit, so that both accelerate alike: in this
/// all terms of the flow come together. Some hundred roundings of terms below 100.
#[test]
fn a_column_of_fuel_moves_its_hull_as_the_particles_do() {
    let (l, w, rho, now) = (2.0, 0.7, 1.5, 0.8);
    let [e1, e2, d1, d2] = [-0.4, 0.3, 0.8, 0.6];
    let column = Column { l, w, rho, e1, e2, d1, d2 }.kernel().unwrap();
    let followed = Followed { l, w, now, rho, e1, e2, d1, d2 }.kernel().unwrap();
    let q = Isometry3::new(Vector3::new(1.0, -0.5, 2.0), Vector3::new(0.4, 0.9, -0.7));
    for z in [[0.0; 6], [2.5, -1.0, 0.7, 1.3, -0.4, 0.9], [0.3, 0.2, -0.1, -2.0, 3.0, 1.0]] {
        let z = SVector::from(z);
        let found = column.acceleration(now, &q, &z, &());
        let expected = followed.acceleration(now, &q, &z, &());
        assert!(z.amax() == 0.0 || expected.amax() > 0.1);
        assert!((found - expected).amax() < 1e-12, "{found} {expected}");
    }
}
