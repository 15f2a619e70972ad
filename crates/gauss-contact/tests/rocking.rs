//! Impacts that alternate between contacts and pile up, and landings that no fall to zero tells of.
//!
//! A program of its own, which runs as optimised as in releases too: LLVM has lost a coordinate there (`moved_by`).

use std::f64::consts::FRAC_PI_4;

use gauss_contact::{ContactErrorKind, ContactRun, ContactTrajectory, EventKind, Impact, Mode};
use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

#[path = "laws/common.rs"]
#[allow(dead_code, reason = "scenes of the other tests")]
mod common;
#[path = "laws/rod.rs"]
mod rod;

use common::numbers;
use rod::Rod;

const G: f64 = 9.81;

/// A rectangle in its plane on its corners.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, a),
    body(block, position = [x, 0, z], rotation = rotation_y(a), mass = m, inertia = m * (b * b + h * h) / 12),
    contact(floor, point = block.position, edges = [b, 0, h], friction = mu, restitution = e),
)]
struct Block {
    m: f64,
    b: f64,
    h: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// The same as a body in space, with a depth: four corners rock in pairs.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(block, position = pose.position, rotation = pose.rotation, mass = m,
        inertia = [m * (d * d + h * h) / 12, m * (b * b + h * h) / 12, m * (b * b + d * d) / 12]),
    contact(floor, point = block.position, edges = [b, d, h], friction = mu, restitution = e),
)]
struct Tower {
    m: f64,
    b: f64,
    d: f64,
    h: f64,
    mu: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// Width over height, and when a block of height 1 that starts at half of its angle is at rest: quarter periods
/// ∫ dθ/ω with ω² = 2p²(cos(α − θ₀) − cos(α − θ)), p² = 3g/4R, each swing with (1 − 3/2 sin²α) of the rate before; of
/// the swings below 10⁻⁹ the geometric series.
const RESTS: [(f64, f64); 2] = [(0.25, 5.615_454_993_217), (0.5, 1.581_549_147_266)];

/// The centre of a block that stands on one corner at half of the angle to its diagonal.
fn leaning(b: f64, h: f64) -> (f64, f64, f64) {
    let angle = 0.5 * (b / h).atan();
    let (sine, cosine) = angle.sin_cos();
    (-0.5 * (b * cosine - h * sine), 0.5 * (b * sine + h * cosine), angle)
}

/// No gap below zero by more than √ε of the size, no energy gained beyond the tolerance.
#[track_caller]
fn keeps<K: ContactSystem<Scalar = f64>>(kernel: &K, run: &ContactTrajectory<'_, K>, size: f64, tolerance: f64) {
    let (mut energy, mut most) = (f64::INFINITY, 0.0_f64);
    for s in run.iter() {
        let gaps = kernel.gaps(s.t, &s.q);
        assert!((0..kernel.contacts().len()).all(|i| gaps.component(i) > -1e-11 * size), "{} {gaps:?}", s.t);
        let now = kernel.energy(s.t, &s.q, &s.z);
        most = most.max(now.abs());
        assert!(now <= energy + 10.0 * tolerance * most, "{}: {energy} {now}", s.t);
        energy = now;
    }
}

/// The time of rest by the last event of rest, with what it leaves out.
#[track_caller]
fn rest<K: ContactSystem>(run: &ContactTrajectory<'_, K>) -> (f64, f64) {
    let rests = run.events().iter().find_map(|event| match event.kind {
        EventKind::Rests { remaining, .. } => Some((event.time + remaining, remaining)),
        _ => None,
    });
    rests.unwrap_or_else(|| panic!("{:?}", run.events().last()))
}

#[test]
fn housners_blocks_come_to_rest_when_the_series_of_their_impacts_ends() {
    for (ratio, wanted) in RESTS {
        for mu in [0.55, 1.0, 1.3, 5.0] {
            for tolerance in [1e-6, 1e-9, 1e-12] {
                let kernel = Block { m: 1.0, b: ratio, h: 1.0, mu, e: 0.0, g: G }.kernel().unwrap();
                let (x, z, angle) = leaning(ratio, 1.0);
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run(SVector::from([x, z, angle]), SVector::zeros(), 0.0..7.0).unwrap();
                let (ends, remaining) = rest(&run);
                // The last flights are some ten roundings high: they are known to a hundredth.
                let bound = 0.01 * remaining + 10.0 * tolerance;
                assert!((ends - wanted).abs() < bound, "{ratio} {mu} {tolerance:e}: {:e}", ends - wanted);
                let last = run.last().unwrap();
                assert_eq!(last.z.amax(), 0.0);
                assert_eq!(run.modes(6.5).unwrap()[..2], [Mode::Sticks; 2]);
                keeps(&kernel, &run, 1.0, tolerance);
            }
        }
    }
}

#[test]
fn steps_of_low_flights_are_made_again_no_oftener_than_others() {
    // Flights down to some roundings. In each step some eight functions are looked at: at some fifty states as they
    // leave zero, and at some thirty that the method makes in seven stages as they come to it.
    for (ratio, e) in [(0.25, 0.0), (0.5, 0.0), (0.4, 0.3)] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let kernel = Block { m: 1.0, b: ratio, h: 1.0, mu: 0.8, e, g: G }.kernel().unwrap();
            let (x, z, angle) = leaning(ratio, 1.0);
            let evaluations = std::cell::Cell::new(0_u64);
            let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
            let run = run.input(|_, _, _| evaluations.set(evaluations.get() + 1));
            let run = run.run(SVector::from([x, z, angle]), SVector::zeros(), 0.0..7.0).unwrap();
            let steps: u64 = run.segments().iter().map(|segment| segment.trajectory().summary().steps).sum();
            let each = evaluations.get() / steps;
            assert!(each < 8 * (50 + 30 * 7), "{ratio} {e} {tolerance:e}: {each}");
        }
    }
}

#[test]
fn a_block_rocks_alike_in_other_units_and_in_space() {
    let (ratio, wanted) = RESTS[1];
    for (m, size) in [(1e-6, 1e-3), (1e6, 1.0), (1.0, 1e3)] {
        let unit = f64::sqrt(size);
        let (x, z, angle) = leaning(ratio * size, size);
        let flat = Block { m, b: ratio * size, h: size, mu: 0.8, e: 0.0, g: G }.kernel().unwrap();
        let run = ContactRun::new(&flat).adaptive(1e-10, 1e-10);
        let run = run.run(SVector::from([x, z, angle]), SVector::zeros(), 0.0..2.0 * unit).unwrap();
        let (ends, remaining) = rest(&run);
        assert!(
            (ends - wanted * unit).abs() < 0.01 * remaining + 1e-8 * unit,
            "{m} {size}: {:e}",
            ends - wanted * unit
        );
        assert_eq!(run.last().unwrap().z.amax(), 0.0);
        keeps(&flat, &run, size, 1e-10);

        let deep = Tower { m, b: ratio * size, d: 0.7 * size, h: size, mu: 0.8, e: 0.0, g: G }.kernel().unwrap();
        let start = Isometry3::new(Vector3::new(x, 0.0, z), Vector3::new(0.0, angle, 0.0));
        let run = ContactRun::new(&deep).adaptive(1e-10, 1e-10);
        let run = run.run(start, SVector::zeros(), 0.0..2.0 * unit).unwrap();
        let (ends, remaining) = rest(&run);
        assert!(
            (ends - wanted * unit).abs() < 0.01 * remaining + 1e-8 * unit,
            "{m} {size}: {:e}",
            ends - wanted * unit
        );
        assert_eq!(run.last().unwrap().z.amax(), 0.0);
        let closed = run.modes(1.9 * unit).unwrap().iter().filter(|mode| mode.is_closed()).count();
        assert_eq!(closed, 4);
        keeps(&deep, &run, size, 1e-10);
    }
}

#[test]
fn blocks_that_bounce_rock_and_slide_end_on_their_face_or_side() {
    let mut number = numbers(41);
    for n in 0..60 {
        let (b, mu, e) = (0.2 + 0.5 * number().abs(), 0.1 + 1.2 * number().abs(), [0.0, 0.2, 0.5][n % 3]);
        let law = [Impact::Newton, Impact::Moreau, Impact::Poisson][n / 3 % 3];
        let kernel = Block { m: 1.0, b, h: 1.0, mu, e, g: G }.kernel().unwrap();
        let start = SVector::from([0.0, 0.5_f64.hypot(0.5 * b) + 0.1, 0.9 * b.atan() * number()]);
        let z = SVector::from([0.5 * number(), 0.0, 0.5 * number()]);
        let (run, error) = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).law(law).attempt(start, z, 0.0..12.0);
        // Newton's law with friction may create energy, and a slender block may meet Painlevé's paradox in earnest.
        let known = |kind: &ContactErrorKind| {
            matches!(kind, ContactErrorKind::EnergyGrows { .. } if law == Impact::Newton)
                || mu > 1.0 && matches!(kind, ContactErrorKind::Inconsistent | ContactErrorKind::Indeterminate)
        };
        assert!(error.as_ref().is_none_or(|error| known(&error.kind)), "{n} {law:?} b {b} mu {mu} e {e}: {error:?}");
        keeps(&kernel, &run, 1.0, 1e-8);
        if error.is_none() {
            let last = run.last().unwrap();
            assert_eq!(last.z.amax(), 0.0, "{n} {law:?} b {b} mu {mu} e {e}: {:?}", run.modes(12.0));
        }
    }
}

#[test]
fn rods_that_bounce_come_to_rest_by_every_law_and_can_be_cut_anywhere() {
    let mut number = numbers(8);
    for n in 0..40 {
        let law = [Impact::Newton, Impact::Moreau, Impact::Poisson, Impact::Sequential][n % 4];
        let m = [1.0, 1e-6, 1e6][n % 3];
        let (mu, e) = (0.8 * number().abs(), 0.1 + 0.8 * number().abs());
        let mut rod = Rod { m, j: 0.08 * m, l: 0.5, mu, e, g: G };
        let mut q = SVector::from([0.0, 0.7, 1.5 * number()]);
        let mut z = SVector::from([number(), 0.0, 3.0 * number()]);
        if n < 4 {
            (rod.mu, rod.e) = (0.4, 0.3);
            q[2] = 0.881_000_819_973_394_7;
            z = SVector::from([-0.240_370_836_565_607_32, 0.0, 0.007_170_765_747_249_952]);
        }
        let kernel = rod.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-12, 1e-12).law(law);
        // Newton's law with friction may create energy (T. R. Kane 1984), and says so.
        let newton = matches!(law, Impact::Newton | Impact::Sequential);
        let known = |kind: &ContactErrorKind| newton && matches!(kind, ContactErrorKind::EnergyGrows { .. });
        let (whole, error) = run.attempt(q, z, 0.0..3.0);
        assert!(error.as_ref().is_none_or(|error| known(&error.kind)), "{n} {law:?} mu {mu} e {e}: {error:?}");
        keeps(&kernel, &whole, 1.0, 1e-10);
        // From each start of a segment on.
        for segment in whole.segments().iter().step_by(7) {
            let from = segment.trajectory().first();
            let (_, error) = run.attempt(from.q, from.z, from.t..from.t + 0.5);
            assert!(error.as_ref().is_none_or(|error| known(&error.kind)), "{n} {law:?} at {}: {error:?}", from.t);
        }
    }
}

/// A particle between two walls that come nearer.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    contact(left, gap = x - v * t, restitution = e),
    contact(right, gap = w - v * t - x, restitution = e),
)]
struct Between {
    m: f64,
    v: f64,
    w: f64,
    e: f64,
}

#[test]
fn walls_that_close_on_a_particle_are_not_passed() {
    for e in [0.0, 0.5, 0.9, 1.0] {
        for v in [0.1, 1.0] {
            for (m, w) in [(1.0, 1.0), (1e-6, 1e3)] {
                for tolerance in [1e-6, 1e-10] {
                    let kernel = Between { m, v, w, e }.kernel().unwrap();
                    let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance).max_events(2000);
                    let start = (SVector::from([0.4 * w]), SVector::from([0.3 * v]));
                    let (run, error) = run.attempt(start.0, start.1, 0.0..w / v);
                    // They meet at w/2v; nothing moves then that agrees with both.
                    let error = error.expect("there is no motion");
                    assert!(error.time <= 0.5 * w / v * (1.0 + 1e-6), "{e} {v} {error}");
                    assert!(error.contact.is_some() || !matches!(error.kind, ContactErrorKind::NonFinite), "{error}");
                    for s in run.iter() {
                        let gaps = kernel.gaps(s.t, &s.q);
                        assert!(gaps.min() > -1e-9 * w, "{e} {v} {w} {tolerance:e}: {} {gaps} {error}", s.t);
                    }
                }
            }
        }
    }
}

/// A particle above a floor that goes up and down.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, h),
    particle(mass = m, position = [x, 0, h]),
    contact(table, gap = h - v * t - a * sin(w * t), slip = rate(x), friction = 0.3, restitution = e),
)]
struct Lifted {
    m: f64,
    v: f64,
    a: f64,
    w: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A ball above a floor that rises.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(lift, gap = pose.position.z - r - v * t, restitution = e),
)]
struct Risen {
    m: f64,
    r: f64,
    v: f64,
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn bounces_on_a_lift_end_when_those_on_a_floor_do() {
    // √(2h/g)(1 + e)/(1 − e), by Galileo.
    let wanted = 3.0 * (2.0 / G).sqrt();
    for (m, v) in [(1.0, 0.0), (1.0, 0.1), (1e6, 1.0), (1e-6, 10.0), (1.0, -0.5), (1.0, -10.0)] {
        for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
            let check = |name: &str, rest: f64, (gap, rate): (f64, f64)| {
                // Times are known to roundings of a place of v t over the rate at the last impact, 1e-7 at least.
                let bound = 1e-13 + 32.0 * f64::EPSILON * (1.0 + v.abs() * wanted) / 1e-7_f64.max(tolerance);
                assert!((rest - wanted).abs() < bound, "{name} {v} {tolerance:e}: {:e}", rest - wanted);
                let rounding = 16.0 * f64::EPSILON * (1.0 + 3.0 * v.abs());
                assert!(gap.abs() < rounding && rate.abs() < rounding, "{name} {v} {tolerance:e}: {gap:e} {rate:e}");
            };
            let kernel = Lifted { m, v, a: 0.0, w: 1.0, e: 0.5, g: G }.kernel().unwrap();
            let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
            let run = run.run([0.0, 1.0].into(), [6.0, v].into(), 0.0..3.0).unwrap();
            let last = run.last().unwrap();
            check("particle", rest(&run).0, (last.q[1] - 3.0 * v, last.z[1] - v));
            // Impulses and weight of the whole time slow it down by μ g t, as on a floor.
            let stop = run.events().last().unwrap();
            let off = stop.time - 6.0 / (0.3 * G);
            assert!(
                stop.kind == EventKind::Sticks && off.abs() < 1e-6 + 10.0 * tolerance,
                "{v} {tolerance:e}: {off:e}"
            );
            let kernel = Risen { m, r: 0.1, v, e: 0.5, g: G }.kernel().unwrap();
            let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
            let z = SVector::from([0.0, 0.0, v, 0.0, 0.0, 0.0]);
            let run = run.run(Isometry3::translation(0.0, 0.0, 1.1), z, 0.0..3.0).unwrap();
            let last = run.last().unwrap();
            check("ball", rest(&run).0, (last.q.translation.z - 0.1 - 3.0 * v, last.z[2] - v));
        }
    }
}

#[test]
fn a_table_that_is_shaken_is_not_passed_at_any_tolerance() {
    for (a, w) in [(0.1, 3.0), (0.01, 20.0), (0.001, 60.0), (0.05, 20.0)] {
        for e in [0.0, 0.3, 0.5, 0.8] {
            for k in 3..13 {
                let tolerance = 10.0_f64.powi(-k);
                let kernel = Lifted { m: 0.2, v: 0.0, a, w, e, g: G }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run([0.0, 1.0].into(), SVector::zeros(), 0.0..5.0);
                let run = run.unwrap_or_else(|error| panic!("{a} {w} {e} {tolerance:e}: {error}"));
                assert!(run.iter().all(|s| kernel.gaps(s.t, &s.q)[0] > -1e-12), "{a} {w} {e} {tolerance:e}");
                // Bounces of what keeps much may go on.
                if a * w * w < G && (e < 0.5 || run.modes(5.0).unwrap()[0].is_closed()) {
                    let last = run.last().unwrap();
                    let off = [last.q[1] - a * (5.0 * w).sin(), last.z[1] - a * w * (5.0 * w).cos()];
                    assert!(off.iter().all(|off| off.abs() < 1e-13 * w), "{a} {w} {e} {tolerance:e}: {off:?}");
                }
            }
        }
    }
}

#[test]
fn a_block_turned_up_on_a_corner_falls_back_from_heights_of_rounding_too() {
    // From rest on one corner, the other one above the floor by some roundings or less.
    for k in 0..40 {
        let angle = 1e-18 * 3.0_f64.powi(k);
        if angle > 0.1 * FRAC_PI_4 {
            break;
        }
        let kernel = Block { m: 1.0, b: 0.25, h: 1.0, mu: 0.5, e: 0.0, g: G }.kernel().unwrap();
        let (sine, cosine) = angle.sin_cos();
        let (x, z) = (-0.5 * (0.25 * cosine - sine), 0.5 * (0.25 * sine + cosine));
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
        let run = run.run([x, z, angle].into(), SVector::zeros(), 0.0..6.0);
        let run = run.unwrap_or_else(|error| panic!("{angle:e}: {error}"));
        keeps(&kernel, &run, 1.0, 1e-9);
        assert_eq!(run.last().unwrap().z.amax(), 0.0, "{angle:e}");
    }
}
