//! A rocket that burns its fuel and turns, beside RocketPy's simulation of the same flight and what was measured:
//! `cargo run --release --example rocket`.
//!
//! The flight is that of Bella Lui (EPFL Rocket Team, Kaltbrunn 2020). Its numbers, the thrust of its motor, and the
//! results beside which it flies are those of the validation in RocketPy's repository (MIT licence; Ceotto et al.,
//! *RocketPy: six degree-of-freedom rocket trajectory simulator*, Journal of Aerospace Engineering 34, 2021). There the
//! air is that of the day, with wind, and the rocket leaves a rail; here it is the standard atmosphere, still.

use std::error::Error;
use std::f64::consts::PI;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

// ANCHOR: rocket
/// Thrust of the motor AeroTech K828FJ, N over s.
const THRUST: [[f64; 2]; POINTS] = [
    [0.00, 0.00],
    [0.01, 1112.06],
    [0.02, 1238.60],
    [0.04, 1303.79],
    [0.06, 1135.06],
    [0.08, 1077.54],
    [0.13, 1031.53],
    [0.20, 1016.19],
    [0.50, 993.18],
    [0.65, 1004.68],
    [1.00, 985.51],
    [1.08, 974.01],
    [1.19, 974.01],
    [1.42, 954.83],
    [1.51, 935.66],
    [1.69, 912.65],
    [1.75, 885.81],
    [1.83, 893.48],
    [1.89, 843.63],
    [1.95, 774.60],
    [2.00, 667.23],
    [2.15, 444.82],
    [2.20, 364.29],
    [2.23, 260.76],
    [2.27, 184.06],
    [2.33, 111.21],
    [2.39, 49.85],
    [2.50, 0.00],
    [2.60, 0.00],
    [2.70, 0.00],
];
const POINTS: usize = 30;
/// The part of the propellant that is left: as much of it burns as there is thrust.
const LEFT: [[f64; 2]; POINTS] = left();

/// A rocket in the plane, upright at pitch 0: O is its centre of mass without propellant, e₂ points to its nose. The
/// propellant is a body that varies, fixed in the hull, and leaves by the nozzle.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, height, pitch),
    table(thrust, points = THRUST),
    table(left, points = LEFT, kind = hermite),
    body(hull, position = [x, height, 0], rotation = rotation_z(pitch), mass = dry, inertia = [about, 0.06, about]),
    body(grain, parent = hull, position = [0, -1, 0], mass = propellant * left(t),
        inertia_about_center_of_mass = [0.02 * left(t), 0.001 * left(t), 0.02 * left(t)]),
    mass_flow(motor, body = grain, at = [0, -0.1356, 0], thrust = [0, thrust(t), 0]),
    gravity = [0, -9.81, 0],
    // The standard atmosphere from 407 m above the sea; forces of nose, fins and boat tail by Barrowman.
    define(
        density = 1.225 * powf(1 - 2.25577e-5 * (407 + height), 4.2559),
        v = hull.body_velocity,
        spin = hull.body_angular_velocity.z,
        speed = sqrt(v.x * v.x + v.y * v.y + 1e-12),
        load = density * area * speed / 2,
    ),
    force(drag, body = hull, value = [0, -0.43 * load * v.y, 0]),
    force(nose, body = hull, at = [0, 1.43, 0], value = [-2 * load * (v.x - 1.43 * spin), 0, 0]),
    force(fins, body = hull, at = [0, -0.871, 0], value = [-10.28 * load * (v.x + 0.871 * spin), 0, 0]),
    force(boat_tail, body = hull, at = [0, -1.11, 0], value = [0.5 * load * (v.x + 1.11 * spin), 0, 0]),
)]
struct Rocket {
    dry: f64,
    propellant: f64,
    about: f64,
    area: f64,
}

const fn left() -> [[f64; 2]; POINTS] {
    let mut left = [[0.0; 2]; POINTS];
    let mut impulse = 0.0;
    let mut i = POINTS - 1;
    while i > 0 {
        left[i] = [THRUST[i][0], impulse];
        impulse += 0.5 * (THRUST[i][0] - THRUST[i - 1][0]) * (THRUST[i][1] + THRUST[i - 1][1]);
        i -= 1;
    }
    left[0] = [THRUST[0][0], impulse];
    while i < POINTS {
        left[i][1] /= impulse;
        i += 1;
    }
    left
}
// ANCHOR_END: rocket

fn main() -> Result<(), Box<dyn Error>> {
    // Three grains of 782.4 kg/m³, tubes of 152.4 mm.
    let propellant = 782.4 * 3.0 * 0.1524 * PI * (0.042_799_f64.powi(2) - 0.033_147_f64.powi(2));
    let kernel = Rocket { dry: 18.227, propellant, about: 0.782_67, area: PI * 0.078_f64.powi(2) }.kernel()?;
    // 1° from upright.
    let start = SVector::from([0.0, 0.0, -PI / 180.0]);
    let flies = |t: f64, z: &SVector<f64, 3>| if t < 1.0 { 1.0 } else { z[1] };
    let simulation = Simulation::new(&kernel).adaptive(1e-9, 1e-9).until(Crossing::Falling, |t, _, z| flies(t, z));
    let run = simulation.run(start, SVector::zeros(), 0.0..20.0)?;
    let end = run.last();
    let times = (0..=500).map(|n| end.t * f64::from(n) / 500.0);
    let flight = run.at_times(times)?;
    let fastest = flight.iter().map(|s| s.z[1]).fold(0.0, f64::max);
    println!("                        here   RocketPy   measured");
    let rows = [
        ("apogee / m", end.q[1], 461.03, 458.97),
        ("time of it / s", end.t, 10.61, 10.56),
        ("fastest / (m/s)", fastest, 86.18, 90.0),
    ];
    for (name, here, there, measured) in rows {
        println!("{name:<16} {here:11.2} {there:10.2} {measured:10.2}");
        // The air of the day, the rail and the wind are what differs.
        if (here - there).abs() > 0.01 * there {
            return Err(format!("{name} is not that of RocketPy").into());
        }
    }
    let shapes = [Shape::cylinder(0.078, 2.4).at(&Isometry3::rotation(Vector3::x() * (PI / 2.0)))];
    let page = Playback::of_samples("A rocket that burns its fuel", flight)
        .body("hull", |s| Isometry3::new(Vector3::new(s.q[0], s.q[1], 0.0), Vector3::z() * s.q[2]), shapes)
        .trace("hull", [0.0; 3])
        .up([0.0, 1.0, 0.0])
        .from_the_side()
        .follow("hull")
        .curve("height / m", "hull", |s| s.q[1])
        .curve("speed / (m/s)", "hull", |s| s.z[0].hypot(s.z[1]))
        .curve("pitch / °", "hull", |s| s.q[2].to_degrees());
    write_page("rocket", &page.si())
}
