//! The claims of the example `falling_plate`, against equations typed by hand, Lamb's ellipsoids, and Chaplygin's
//! equation.

use std::f64::consts::PI;

use gauss_runtime::prelude::*;

use crate::reference;
use crate::scene::{FLUTTERING, IdealPlate, Plate, THICKNESS, TUMBLING, added_mass, places, released};

#[test]
fn the_accelerations_are_those_of_the_paper() {
    for ratio in [FLUTTERING, TUMBLING] {
        let kernel = Plate::new(ratio).kernel().unwrap();
        for n in 1..=200 {
            // States that fill the box [−2, 2]⁴ evenly, by multiples of irrational numbers.
            let spread = |root: f64| 4.0 * ((f64::from(n) * root.sqrt()).fract() - 0.5);
            let [theta, u, v, w] = [2.0, 3.0, 5.0, 7.0].map(spread);
            let pose = Isometry2::new(translation(0.3, -0.7), theta);
            let found = kernel.acceleration(0.0, &pose, &Vector3::new(u, v, w), &());
            let expected = reference::falling_card(ratio, THICKNESS, [0.0, 0.0, theta, u, v, w]);
            for (found, expected) in found.iter().zip(&expected[3..]) {
                // Each is a sum of at most ten terms, of size 20 at most, by an inertia of 0.4 at least.
                assert!((found - expected).abs() < 10.0 * f64::EPSILON * 20.0 / 0.4, "{found} and {expected}");
            }
        }
    }
}

/// A translation in the plane.
fn translation(x: f64, y: f64) -> SVector<f64, 2> {
    SVector::from([x, y])
}

#[test]
fn it_falls_as_the_equations_of_the_paper_say() {
    let (pose, twist) = released();
    let start = [0.0, 0.0, pose.rotation.angle(), twist.x, twist.y, twist.z];
    for ratio in [FLUTTERING, TUMBLING] {
        let kernel = Plate::new(ratio).kernel().unwrap();
        let end = Simulation::new(&kernel).adaptive(1e-10, 1e-10).run_to_end(pose, twist, 0.0..12.0).unwrap();
        let [coarse, fine] = [500, 1000].map(|rate| {
            let typed = |_: f64, y| reference::falling_card(ratio, THICKNESS, y);
            *reference::runge_kutta(typed, start, 1.0 / f64::from(rate), 12 * rate).last().unwrap()
        });
        let found = [end.q.translation.x, end.q.translation.y];
        for (found, (coarse, fine)) in found.iter().zip(coarse.iter().zip(&fine)) {
            // A few hundred steps with errors of 1e-10 of numbers below 10, which grow a few times where the plate
            // glides; the reference is as good as its two runs agree.
            assert!((coarse - fine).abs() < 1e-8, "the reference is not good enough: {coarse} and {fine}");
            assert!((found - fine).abs() < (coarse - fine).abs() + 1e-6, "I* = {ratio}: {found} and {fine}");
        }
    }
}

#[test]
fn a_light_plate_flutters_and_a_heavy_one_tumbles() {
    let (pose, twist) = released();
    let [light, heavy] = [FLUTTERING, TUMBLING].map(|ratio| {
        let kernel = Plate::new(ratio).kernel().unwrap();
        let path = Simulation::new(&kernel).adaptive(1e-7, 1e-7).largest_step(0.2).run(pose, twist, 0.0..60.0).unwrap();
        // Lift does no work, drag and braking take energy, whatever the plate does.
        for s in path.iter() {
            let power = |name: &str| kernel.power(name, s.t, &s.q, &s.z, &()).unwrap();
            assert!(power("drag") <= 0.0 && power("braking") <= 0.0);
            let (speed, spin) = (f64::hypot(s.z.x, s.z.y), s.z.z.abs());
            // The force is at most 2 (C_T V + C_R ω) V, and the two products of its power cancel.
            assert!(power("lift").abs() <= 8.0 * f64::EPSILON * 2.0 * (1.2 * speed + PI * spin) * speed * speed);
        }
        places(&path).into_iter().filter(|(t, _)| *t > 20.0).map(|(_, [.., angle])| angle).collect::<Vec<f64>>()
    });
    let turns = |angles: &[f64]| (angles[angles.len() - 1] - angles[0]).abs() / (2.0 * PI);
    let crossings = light.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    assert!(light.iter().all(|angle| angle.abs() < PI / 2.0), "it does not turn over");
    assert!(crossings >= 4, "it swings to and fro");
    assert!(turns(&heavy) > 2.0, "it turns over and over");
}

/// In an ideal fluid the impulse is that of the weight (Kirchhoff), and the angle obeys an equation of its own
/// (Chaplygin).
#[test]
fn in_an_ideal_fluid_the_impulse_is_that_of_the_weight() {
    let plate = IdealPlate::new(FLUTTERING);
    let kernel = plate.kernel().unwrap();
    let (pose, _) = released();
    let (tolerance, duration) = (1e-10, 5.0);
    let path =
        Simulation::new(&kernel).adaptive(tolerance, tolerance).run(pose, Vector3::zeros(), 0.0..duration).unwrap();
    let weight = (plate.mass - plate.displaced) * plate.g;
    assert!((weight - PI).abs() < 1e-14, "the unit of speed");
    let masses = [plate.mass + plate.added[0], plate.mass + plate.added[1], plate.inertia + plate.added[5]];
    // Each step may err by the tolerance, in z by up to its size; impulses are masses times that.
    let size = path.iter().map(|s| s.z.amax()).fold(1.0, f64::max);
    let bound = path.len() as f64 * tolerance * (1.0 + size) * masses[1];
    for s in path.iter() {
        let impulse = kernel.space_momentum(s.t, &s.q, &s.z);
        assert!(impulse[0].abs() < bound && (impulse[1] + weight * s.t).abs() < bound, "{impulse} at {}", s.t);
    }
    let [coarse, fine] = [500, 1000].map(|rate| {
        let typed = |t, y| reference::chaplygin(masses, weight, t, y);
        let start = [pose.rotation.angle(), 0.0];
        reference::runge_kutta(typed, start, 1.0 / f64::from(rate), 5 * rate).last().unwrap()[0]
    });
    let angle = path.last().q.rotation.angle();
    assert!((angle - fine).abs() < (coarse - fine).abs() + bound, "{angle} and {fine}");
}

/// Lamb's α₀ of an ellipsoid with half-axes a, b, c (Hydrodynamics, § 114): abc ∫₀^∞ dλ/((a² + λ) Δ), Δ² = (a² + λ)(b²
/// + λ)(c² + λ).
fn alpha(a: f64, b: f64, c: f64) -> f64 {
    // With λ = eˣ the integrand vanishes like eˣ and e^(−3x/2) at the ends, where the trapezoidal rule is as good as
    // can be.
    let h = 0.05;
    let integrand = |n: i32| {
        let l = (h * f64::from(n)).exp();
        let [a, b, c] = [a, b, c].map(|axis| axis * axis + l);
        l / (a * (a * b * c).sqrt())
    };
    a * b * c * h * (-800..=1200).map(integrand).sum::<f64>()
}

#[test]
fn the_added_mass_is_that_of_a_very_long_ellipsoid() {
    let (a, b, c) = (1.0, THICKNESS, 1e4);
    let (alpha, beta) = (alpha(a, b, c), alpha(b, a, c));
    // § 114, § 115: over the displaced mass, and over the moment of inertia of the displaced fluid. Slices of an
    // ellipsoid are similar to each other, so the quotients are those of the cylinder but for (a/c)² ln(c/a).
    let along = alpha / (2.0 - alpha);
    let across = beta / (2.0 - beta);
    let (difference, sum) = (a * a - b * b, a * a + b * b);
    let about = difference * difference * (beta - alpha) / (2.0 * difference + sum * (alpha - beta)) / sum;
    let cylinder = added_mass(b);
    let displaced = PI * a * b;
    let moment = 0.25 * displaced * sum;
    // The denominators are differences of numbers of size 2 that leave 2b/(a + b): b/a magnifies what (a/c)² makes of
    // them.
    let bound = (a / c).powi(2) * (c / a).ln() * (a / b).powi(2);
    for (ellipsoid, cylinder) in
        [(along, cylinder[0] / displaced), (across, cylinder[1] / displaced), (about, cylinder[5] / moment)]
    {
        assert!((ellipsoid / cylinder - 1.0).abs() < bound, "{ellipsoid} and {cylinder}, {bound:e}");
    }
}
