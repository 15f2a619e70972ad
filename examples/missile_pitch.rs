//! A missile in pitch, whose coefficients are tables of angle of attack, Mach number and fin:
//! `cargo run --release --example missile_pitch`.
//!
//! The numbers are the polynomials of a benchmark of control theory (R. T. Reichert, *Dynamic scheduling of
//! modern-robust-control autopilot designs for missiles*, IEEE Control Systems Magazine 12, 1992), at 20,000 ft, in SI
//! units; here they are put on a grid first, as wind tunnels give them. The same missile by the polynomials themselves
//! flies beside it.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::*;

// ANCHOR: tables
/// Angle of attack and fin in degrees.
const ALPHA: [f64; 25] = steps(-24.0, 2.0);
const MACH: [f64; 4] = [1.5, 2.25, 3.0, 4.0];
const FIN: [f64; 3] = [-30.0, 0.0, 30.0];

/// Coefficients of the force along −e₂ without fins, and of the moment.
const NORMAL: [[f64; 4]; 25] = normal();
const MOMENT: [[[f64; 3]; 4]; 25] = moment();

/// A missile in its plane of pitch: O is its centre of mass, e₁ forward, e₂ upward. Its weight is left out, as in the
/// benchmark.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    motion = planar,
    chart = left_invariant,
    input(fin),
    define(
        v = body.body_velocity,
        alpha = -atan2(v.y, v.x) * 180 / pi,
        mach = sqrt(v.x * v.x + v.y * v.y) / sound,
        load = 0.7 * pressure * mach * mach * area,
    ),
    table(normal, axes = [ALPHA, MACH], values = NORMAL, kind = cubic),
    table(moment, axes = [ALPHA, MACH, FIN], values = MOMENT, kind = cubic),
    force(air, body = body, axes = body, value = load * [-0.3, 0.034 * fin - normal(alpha, mach), 0]),
    torque(tail, body = body, value = [0, 0, load * diameter * moment(alpha, mach, fin)]),
)]
struct Missile {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    /// Of the air, Pa.
    pressure: f64,
    /// Speed of sound, m/s.
    sound: f64,
    area: f64,
    diameter: f64,
}
// ANCHOR_END: tables

/// The same by the polynomials.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    motion = planar,
    chart = left_invariant,
    input(fin),
    define(
        v = body.body_velocity,
        alpha = -atan2(v.y, v.x) * 180 / pi,
        mach = sqrt(v.x * v.x + v.y * v.y) / sound,
        load = 0.7 * pressure * mach * mach * area,
        normal = (0.000103 * alpha * alpha - 0.00945 * abs(alpha) - 0.1696 * (2 - mach / 3)) * alpha,
        moment = (0.000215 * alpha * alpha - 0.0195 * abs(alpha) + 0.051 * (8 * mach / 3 - 7)) * alpha - 0.206 * fin,
    ),
    force(air, body = body, axes = body, value = load * [-0.3, 0.034 * fin - normal, 0]),
    torque(tail, body = body, value = [0, 0, load * diameter * moment]),
)]
struct ByPolynomials {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: f64,
    pressure: f64,
    sound: f64,
    area: f64,
    diameter: f64,
}

const fn steps<const N: usize>(first: f64, step: f64) -> [f64; N] {
    let mut axis = [first; N];
    let mut i = 0;
    while i < N {
        axis[i] = first + step * i as f64;
        i += 1;
    }
    axis
}

const fn normal() -> [[f64; 4]; 25] {
    let mut values = [[0.0; 4]; 25];
    let mut i = 0;
    while i < 100 {
        let (alpha, mach) = (ALPHA[i / 4], MACH[i % 4]);
        values[i / 4][i % 4] = (0.000103 * alpha * alpha - 0.00945 * alpha.abs() - 0.1696 * (2.0 - mach / 3.0)) * alpha;
        i += 1;
    }
    values
}

const fn moment() -> [[[f64; 3]; 4]; 25] {
    let mut values = [[[0.0; 3]; 4]; 25];
    let mut i = 0;
    while i < 300 {
        let (alpha, mach, fin) = (ALPHA[i / 12], MACH[i / 3 % 4], FIN[i % 3]);
        values[i / 12][i / 3 % 4][i % 3] =
            (0.000215 * alpha * alpha - 0.0195 * alpha.abs() + 0.051 * (8.0 * mach / 3.0 - 7.0)) * alpha - 0.206 * fin;
        i += 1;
    }
    values
}

/// Slugs, feet and pounds of the benchmark.
const PRESSURE: f64 = 973.3 * 47.880_26;
const SOUND: f64 = 1036.4 * 0.3048;
const AREA: f64 = 0.44 * 0.3048 * 0.3048;
const DIAMETER: f64 = 0.75 * 0.3048;
const MASS: f64 = 13.98 * 14.593_903;
const INERTIA: f64 = 182.5 * 1.355_818;

/// Steady flight at an angle of attack, and the fins that turn back to it.
struct Trim {
    /// Speeds (u, v, r) and fin at which forces along e₂ and moments are in balance.
    speeds: Vector3<f64>,
    fin: f64,
    /// Normal acceleration, in units of 9.81 m/s².
    pull: f64,
    /// Product of the two eigenvalues of (v, r), 1/s²: below 0 the airframe alone is unstable.
    stiffness: f64,
    gains: [f64; 2],
}

/// How fast and how well damped the fins turn it, 1/s and 1.
const TURNS: (f64, f64) = (12.0, 0.8);

/// The equations, whatever they are written by.
trait Airframe:
    LinearizedSystem<
        Scalar = f64,
        Configuration = Isometry2<f64>,
        Speeds = Vector3<f64>,
        Input = SVector<f64, 1>,
        Linearization = Linearization<f64, 6, 1>,
    >
{
}

impl Airframe for MissileKernel {}
impl Airframe for ByPolynomialsKernel {}

/// Angle of attack in degrees, and Mach number.
fn flow(z: &Vector3<f64>) -> (f64, f64) {
    ((-z.y).atan2(z.x).to_degrees(), z.x.hypot(z.y) / SOUND)
}

/// From the derivatives of the equations.
fn trim(kernel: &impl Airframe, alpha: f64, mach: f64) -> Trim {
    let level = Isometry2::identity();
    let (sine, cosine) = alpha.to_radians().sin_cos();
    let mut speeds = Vector3::new(cosine, -sine, 0.0) * mach * SOUND;
    let mut fin = 0.0;
    // The moment is linear in the fin and does not depend on r: one step is enough but for rounding.
    for _ in 0..3 {
        let input = SVector::from([fin]);
        let moment = kernel.acceleration(0.0, &level, &speeds, &input)[2];
        fin -= moment / kernel.linearize(0.0, &level, &speeds, &input).by_input[(5, 0)];
    }
    let input = SVector::from([fin]);
    let pull = kernel.acceleration(0.0, &level, &speeds, &input)[1];
    speeds[2] = pull / speeds[0];
    let linear = kernel.linearize(0.0, &level, &speeds, &input);
    let a = linear.by_state.fixed_view::<2, 2>(4, 4).into_owned();
    let b = linear.by_input.fixed_view::<2, 1>(4, 0).into_owned();
    // Ackermann's formula.
    let (omega, damping) = TURNS;
    let wanted = a * a + 2.0 * damping * omega * a + omega * omega * SMatrix::identity();
    let reached = SMatrix::<f64, 2, 2>::from_columns(&[b, a * b]).try_inverse().unwrap_or_default();
    let gains = (reached * wanted).row(1).into_owned();
    Trim { speeds, fin, pull: pull / 9.81, stiffness: a.determinant(), gains: [gains[0], gains[1]] }
}

/// The angle of attack that is asked for.
fn wanted(t: f64) -> f64 {
    let step = |at: f64| 0.5 * (1.0 + ((t - at) / 0.05).tanh());
    15.0 * step(0.3) - 25.0 * step(1.2) + 10.0 * step(2.1)
}

/// The fins that `model` has turn it to that: at the Mach number of the moment, with the gains of that trim.
fn fins(model: &impl Airframe, t: f64, z: &Vector3<f64>) -> SVector<f64, 1> {
    let trim = trim(model, wanted(t), flow(z).1);
    let away = z - trim.speeds;
    SVector::from([trim.fin - trim.gains[0] * away.y - trim.gains[1] * away.z])
}

/// Times of a flight, s.
const TIMES: usize = 601;

fn fly<K: Airframe>(kernel: &K, model: &MissileKernel) -> Result<Vec<Sample<K>>, Box<dyn Error>> {
    let run = Simulation::new(kernel).input(|t, _q: &_, z: &_| fins(model, t, z)).adaptive(1e-8, 1e-8);
    let start = Vector3::new(3.0 * SOUND, 0.0, 0.0);
    let times = (0..TIMES).map(|n| 3.0 * n as f64 / (TIMES - 1) as f64);
    Ok(run.run(Isometry2::identity(), start, 0.0..3.0)?.at_times(times)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, inertia, pressure, sound) = (MASS, INERTIA, PRESSURE, SOUND);
    let table = Missile { mass, inertia, pressure, sound, area: AREA, diameter: DIAMETER }.kernel()?;
    let formula = ByPolynomials { mass, inertia, pressure, sound, area: AREA, diameter: DIAMETER }.kernel()?;
    println!("                 by tables                          by polynomials");
    println!("Mach  alpha/°   fin/°   pull/g  stiffness/(1/s²)   fin/°   pull/g  stiffness/(1/s²)");
    for mach in [2.0, 3.0, 3.8] {
        for alpha in [1.0, 5.0, 11.0, 19.0] {
            let [a, b] = [trim(&table, alpha, mach), trim(&formula, alpha, mach)];
            println!(
                "{mach:4.1} {alpha:8.0} {:8.3} {:8.3} {:12.3} {:12.3} {:8.3} {:12.3}",
                a.fin, a.pull, a.stiffness, b.fin, b.pull, b.stiffness
            );
            // Only b |α| α is no cubic: a spline of steps h is off by 0.1 b h² at most, next to the jump of its second
            // derivative. Of the moment's coefficient 0.206 are a degree of the fin.
            let [of_moment, of_normal] = [0.0195, 0.00945].map(|b| 0.1 * b * 4.0);
            let (of_fin, load) = (of_moment / 0.206, 0.7 * PRESSURE * mach * mach * AREA / (MASS * 9.81));
            if (a.fin - b.fin).abs() > of_fin || (a.pull - b.pull).abs() > load * (of_normal + 0.034 * of_fin) {
                return Err("the tables are not those of the polynomials".into());
            }
        }
    }

    let flights = (fly(&table, &table)?, fly(&formula, &table)?);
    let alpha = |z: &Vector3<f64>| flow(z).0;
    let apart = flights.0.iter().zip(&flights.1).map(|(a, b)| (alpha(&a.z) - alpha(&b.z)).abs()).fold(0.0, f64::max);
    let end = &flights.0[TIMES - 1];
    println!("both flights: angles of attack differ by {apart:.4}° at most; in the end Mach {:.2}", flow(&end.z).1);
    // Of the moment's coefficient 0.0078 are 5 °/s² at Mach 3, which turn by 1/ω² of that: 0.04°, and more in passing.
    if apart > 0.1 {
        return Err("the missile by tables flies another way".into());
    }
    write_page("missile_pitch", &page(&table, flights.0)?)
}

fn page(kernel: &MissileKernel, flight: Vec<Sample<MissileKernel>>) -> Result<Playback<MissileKernel>, Box<dyn Error>> {
    let fin = |s: &Sample<MissileKernel>| fins(kernel, s.t, &s.z);
    let body = [
        Shape::cylinder(DIAMETER / 2.0, 3.6).at(&(Isometry3::rotation(Vector3::y() * std::f64::consts::FRAC_PI_2))),
        Shape::cuboid([0.4, 0.02, 0.9]).at(&Isometry3::translation(-1.6, 0.0, 0.0)),
    ];
    let page = Playback::of_samples("A missile whose coefficients are tables turns as it is asked to", flight).si();
    Ok(page
        .body("missile", |s| kernel.pose(s.t, &s.q), body)
        .arrow("force of the air", 2e-5, |s| {
            let pose = kernel.pose(s.t, &s.q);
            let force = kernel.acceleration(s.t, &s.q, &s.z, &fin(s)) * MASS;
            (pose.translation.vector, pose.rotation * Vector3::new(0.0, force.y + MASS * s.z.z * s.z.x, 0.0))
        })
        .curve("alpha / °", "flown", |s| flow(&s.z).0)
        .curve("alpha / °", "asked", |s| wanted(s.t))
        .curve("fin / °", "fin", |s| fin(s)[0])
        .curve("Mach", "Mach", |s| flow(&s.z).1)
        .from_above()
        .follow("missile"))
}
