//! Boxes that are tossed, and boxes on slopes: many corners that depend on one another.

use gauss_contact::{ContactErrorKind, ContactRun, EventKind, Impact, Mode};
use gauss_runtime::prelude::*;

use crate::common::numbers;

const G: f64 = 9.81;

/// A homogeneous box on its corners, which is pushed along x by a force that grows.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m,
        inertia = [m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12]),
    force(push, body = hull, value = [growth * t, 0, 0], axes = observer),
    contact(floor, point = hull.position, edges = [a, b, c], friction = mu, restitution = e),
)]
#[derive(Clone, Copy)]
pub struct Crate {
    pub m: f64,
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub mu: f64,
    pub e: f64,
    pub growth: f64,
    #[gauss(gravity)]
    pub g: Vector3<f64>,
}

/// A box that lies flat, turned about the vertical.
fn flat(c: f64, yaw: f64) -> Isometry3<f64> {
    Isometry3::new(Vector3::new(0.0, 0.0, 0.5 * c), Vector3::new(0.0, 0.0, yaw))
}

const BOX: Crate =
    Crate { m: 1.0, a: 0.2, b: 0.3, c: 0.1, mu: 0.5, e: 0.0, growth: 0.0, g: Vector3::new(0.0, 0.0, -G) };

#[test]
fn tossed_boxes_lose_energy_alone_and_none_falls_through() {
    let mut rested = 0;
    for (law, first) in [(Impact::Newton, 0), (Impact::Moreau, 8), (Impact::Poisson, 16)] {
        for seed in first..first + 8 {
            let mut number = numbers(seed + 1000);
            (0..5).for_each(|_| _ = number());
            let mut part = || 0.5 + 0.5 * number();
            let crate_ = Crate {
                m: 10.0_f64.powi(6 * (seed % 3) as i32 - 6),
                a: 0.1 + 0.3 * part(),
                b: 0.1 + 0.3 * part(),
                c: 0.1 + 0.3 * part(),
                mu: part(),
                e: 0.9 * part(),
                ..BOX
            };
            let kernel = crate_.kernel().unwrap();
            let turn = Vector3::from_fn(|_, _| 6.0 * part() - 3.0);
            let start = Isometry3::new(Vector3::new(0.0, 0.0, 0.6), turn);
            let z = SVector::from_fn(|i, _| if i < 3 { 2.0 } else { 8.0 } * (2.0 * part() - 1.0));
            let run = ContactRun::new(&kernel).adaptive(1e-8, 1e-8).law(law);
            let (run, error) = run.attempt(start, z, 0.0..3.0);
            // Newton's law with friction may create energy (T. R. Kane 1984), and says so.
            let known = |kind| matches!(kind, ContactErrorKind::EnergyGrows { .. }) && law == Impact::Newton;
            assert!(error.clone().is_none_or(|error| known(error.kind)), "{law:?} {seed}: {error:?}");
            let energies: Vec<f64> = run.iter().map(|s| kernel.energy(s.t, &s.q, &s.z)).collect();
            let most = energies.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
            // Steps err by 1e-8 of speeds, and rest takes 1e-8 of the largest one away, beside motions that may be ten
            // times as fast.
            for pair in energies.windows(2) {
                assert!(pair[1] <= pair[0] + 1e-7 * most, "{law:?} {seed}: {:e}", (pair[1] - pair[0]) / most);
            }
            assert!(run.iter().all(|s| kernel.gaps(s.t, &s.q).min() > -1e-12), "{law:?} {seed}");
            rested += usize::from(run.last().unwrap().z.amax() == 0.0);
        }
    }
    assert!(rested >= 16, "{rested}");
}

/// The box in the plane of a slope that leans along x.
fn on_slope(angle: f64) -> Crate {
    Crate { g: Vector3::new(G * angle.sin(), 0.0, -G * angle.cos()), ..BOX }
}

#[test]
fn boxes_stay_on_slopes_up_to_the_angle_of_friction() {
    for off in [-1e-1, -1e-3, -1e-5, -1e-7] {
        for (yaw, m) in [(0.0, 1.0), (0.3, 1e6), (0.785, 1e-6), (1.4, 1.0)] {
            for tolerance in [1e-6, 1e-9] {
                let angle = 0.5_f64.atan() + off;
                let kernel = Crate { m, ..on_slope(angle) }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run(flat(BOX.c, yaw), SVector::zeros(), 0.0..5.0).unwrap();
                let name = format!("{off:e} {yaw} {tolerance:e}");
                assert!(run.events().is_empty(), "{name}: {:?}", run.events());
                assert_eq!(run.modes(4.0).unwrap()[..4], [Mode::Sticks; 4], "{name}");
                let last = run.last().unwrap();
                // Roundings of roundings are left of speeds, those of lengths of 0.3 in some ten projections of places.
                assert!(last.z.amax() < 1e-60 && last.q.translation.vector.xy().amax() < 1e-14, "{name}");
                // Forces that do it, each within its cone.
                let forces = *run.forces(4.0).unwrap();
                let mut sum = Vector3::zeros();
                for i in 0..4 {
                    let [normal, x, y] = [0, 1, 2].map(|k| forces[3 * i + k]);
                    assert!(x.hypot(y) <= (0.5 + 1e-12) * normal, "{name}: {forces}");
                    sum += Vector3::new(x, y, normal);
                }
                assert!((sum + m * on_slope(angle).g).amax() < 1e-9 * m, "{name}: {sum}");
            }
        }
    }
}

/// The tolerances of runs over slopes.
const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-7, 1e-10];

/// Places down the slope, some roundings off what the weight makes of them.
#[track_caller]
fn slid(found: f64, wanted: f64, end: f64, name: &str) {
    let rounding = 64.0 * f64::EPSILON * 0.5 * G * end * end;
    assert!((found - wanted).abs() < rounding, "{name}: {found:e} {wanted:e}");
}

#[test]
fn boxes_slide_on_slopes_beyond_the_angle_of_friction_by_the_law_at_any_tolerance() {
    for off in [1e-7, 1e-5, 1e-3, 1e-2] {
        for tolerance in TOLERANCES {
            for (yaw, m, size) in [(0.0, 1.0, 1.0), (0.3, 1e6, 1.0), (1.2, 1e-6, 1.0), (0.785, 1.0, 0.1)] {
                let angle = 0.5_f64.atan() + off;
                let slope = on_slope(angle);
                let [a, b, c] = [slope.a, slope.b, slope.c].map(|edge| size * edge);
                let kernel = Crate { m, a, b, c, ..slope }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                let run = run.run(flat(c, yaw), SVector::zeros(), 0.0..5.0).unwrap();
                let wanted = 0.5 * G * (angle.sin() - 0.5 * angle.cos()) * 25.0;
                let last = run.last().unwrap();
                let name = format!("{off:e} {yaw} {m:e} {size} {tolerance:e}");
                slid(last.q.translation.x, wanted, 5.0, &name);
                assert!(last.q.translation.y.abs() < 1e-12 && run.segments().len() == 1, "{name}");
            }
        }
    }
}

#[test]
fn boxes_stop_on_slopes_below_the_angle_of_friction_by_the_law_at_any_tolerance() {
    // From 0.1 m/s to the speeds that count as rest.
    for off in [-1e-1, -3e-3, -1e-4] {
        for tolerance in TOLERANCES {
            for (m, yaw) in [(1.0, 0.0), (1e6, 0.3), (1e-6, 1.2)] {
                let angle = 0.5_f64.atan() + off;
                let kernel = Crate { m, ..on_slope(angle) }.kernel().unwrap();
                let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
                // Velocities are along the axes of the box.
                let z = SVector::from([0.1 * f64::cos(yaw), -0.1 * f64::sin(yaw), 0.0, 0.0, 0.0, 0.0]);
                let slows = G * (0.5 * angle.cos() - angle.sin());
                let (stop, path) = (0.1 / slows, 0.005 / slows);
                let run = run.run(flat(BOX.c, yaw), z, 0.0..1.1 * stop).unwrap();
                let name = format!("{off:e} {m:e} {yaw} {tolerance:e}");
                let stops = run.events().first().unwrap_or_else(|| panic!("{name}"));
                let rest = 1.2 * tolerance + 1e-13;
                assert!((stops.time - stop).abs() < rest / slows, "{name}: {stops:?} {stop}");
                let last = run.last().unwrap();
                let off = (last.q.translation.x - path).abs();
                assert!(off < 0.5 * rest * rest / slows + 1e-13 * (1.0 + stop * stop), "{name}: {off:e}");
                assert!(last.z.amax() < 1e-60, "{name}");
            }
        }
    }
}

/// A box on eight points, and a rod with round ends beside it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose, rod: Pose),
    body(hull, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a),
    body(bar, position = rod.position, rotation = rod.rotation, mass = m, inertia = m * a * a),
    point(head, body = bar, at = [a, 0, 0]),
    point(foot, body = bar, at = [-a, 0, 0]),
    contact(outer, point = hull.position, edges = [a, a, b], friction = mu),
    contact(inner, point = hull.position, edges = [0.5 * a, 0.7 * a, b], friction = mu),
    contact(caps, point = head, end = foot, radius = 0.5 * b, friction = mu),
)]
struct Yard {
    m: f64,
    a: f64,
    b: f64,
    mu: f64,
    #[gauss(gravity)]
    g: Vector3<f64>,
}

#[test]
fn boxes_on_many_points_and_rods_slide_by_the_law_too() {
    let (end, b) = (2.0, 0.2);
    for (off, m) in [(1e-6, 1.0), (1e-3, 1e-6), (1e-2, 1e6)] {
        for tolerance in TOLERANCES {
            let angle = 0.5_f64.atan() + off;
            let kernel = Yard { m, a: 0.5, b, mu: 0.5, g: on_slope(angle).g }.kernel().unwrap();
            let run = ContactRun::new(&kernel).adaptive(tolerance, tolerance);
            let start = (flat(b, 0.4), Isometry3::translation(0.0, 3.0, 0.5 * b));
            let run = run.run(start, SVector::zeros(), 0.0..end).unwrap();
            let wanted = 0.5 * G * (angle.sin() - 0.5 * angle.cos()) * end * end;
            let (hull, rod) = run.last().unwrap().q;
            for (name, place) in [("box", hull), ("rod", rod)] {
                slid(place.translation.x, wanted, end, &format!("{name} {off:e} {m:e} {tolerance:e}"));
            }
        }
    }
}

#[test]
fn a_box_that_is_pushed_harder_and_harder_begins_to_slide_at_the_bound_of_all_corners() {
    for (m, yaw) in [(1.0, 0.0), (1.0, 0.4), (1e6, 0.4), (1e-6, 1.1)] {
        let growth = 2.0 * m * G;
        let kernel = Crate { m, mu: 0.3, growth, ..BOX }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
        let run = run.run(flat(BOX.c, yaw), SVector::zeros(), 0.0..0.5).unwrap();
        let first = run.events().iter().find(|event| matches!(event.kind, EventKind::Slides(_)));
        let first = first.unwrap_or_else(|| panic!("{:?}", run.events()));
        // At μ m g; then x = 2g (t − t₀)³/6. The most that cones leave is known to 1e-9 of the forces.
        assert!((first.time - 0.15).abs() < 1e-8, "{m} {yaw}: {:e}", first.time - 0.15);
        let last = run.last().unwrap();
        let wanted = 2.0 * G * 0.35_f64.powi(3) / 6.0;
        assert!((last.q.translation.x - wanted).abs() < 1e-6, "{m} {yaw}: {} {wanted}", last.q.translation);
    }
}

#[test]
fn a_box_that_is_pushed_high_tips_over_its_edge_before_it_slides() {
    // Pushed at its centre with more than m g a/c: it tips where μ is more.
    let kernel = Crate { a: 0.1, c: 0.4, mu: 0.9, growth: 2.0 * G, ..BOX }.kernel().unwrap();
    let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9);
    let run = run.run(flat(0.4, 0.0), SVector::zeros(), 0.0..0.2).unwrap();
    let first = run.events().first().expect("tips");
    assert!(first.kind == EventKind::Leaves && (first.time - 0.125).abs() < 1e-7, "{first:?}");
    let closed = run.modes(0.15).unwrap().iter().filter(|mode| mode.is_closed()).count();
    assert_eq!(closed, 2, "{:?}", run.events());
}

/// A particle in a notch of two walls that lean back by an angle, pushed in or out by gravity.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = m, position = [x, 0, z]),
    contact(left, gap = x * cos(lean) + z * sin(lean), slip = rate(z * cos(lean) - x * sin(lean)), friction = mu),
    contact(right, gap = z * sin(lean) - x * cos(lean), slip = rate(z * cos(lean) + x * sin(lean)), friction = mu),
)]
struct Notch {
    m: f64,
    mu: f64,
    lean: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn what_two_walls_could_hold_by_squeezing_moves_unless_it_presses_them() {
    let at = |lean: f64, g: f64, m: f64| {
        let kernel = Notch { m, mu: 0.5, lean, g }.kernel().unwrap();
        let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(SVector::zeros(), SVector::zeros(), 0.0..1.0);
        run.map(|run| run.last().unwrap().q)
    };
    for m in [1.0, 1e-6, 1e6] {
        // Upright walls that it touches, and a notch that is steeper than the angle of friction: pulled out.
        for (lean, g) in [(0.0, G), (0.0, -G), (0.2, -G)] {
            let q = at(lean, g, m).unwrap();
            assert!((q[1] + 0.5 * g).abs() < 1e-8 && q[0].abs() < 1e-12, "{lean} {g} {m}: {q}");
        }
        // Pushed in it stays, whatever the friction.
        assert!(at(0.2, G, m).unwrap().amax() < 1e-12);
    }
}
