//! Flights of what spins fast and moves slowly: a step errs by its order and by rounding, at any ratio of speeds.

use gauss_contact::{ContactErrorKind, ContactLanes, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::prelude::*;

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];

/// A homogeneous ball far from a floor, without weight.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia = 0.4 * m * r * r),
    contact(floor, point = ball.position, radius = r, friction = 0.5),
)]
struct Ball<T> {
    m: T,
    r: T,
}

/// A ball that is lifted from the floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = 0.3, inertia = 4.8e-5),
    force(lift, body = ball, value = [0, 0, 0.6], axes = observer),
    contact(floor, point = ball.position, radius = 0.02, friction = 0.5),
)]
struct Lifted {}

fn ball<T: Real>(m: f64, r: f64) -> BallKernel<T> {
    Ball { m: T::from_f64(m), r: T::from_f64(r) }.kernel().unwrap()
}

/// A body whose moments differ.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(slab, position = pose.position, rotation = pose.rotation, mass = 2, inertia = [0.02, 0.05, 0.06]),
    contact(floor, gap = pose.position[2]),
)]
struct Slab {}

/// The turning of a part of a step, as steps are made in parts.
fn turning(omega: f64, h: f64) -> f64 {
    let x = omega * h;
    x.min((x / 16.0).max(0.2))
}

/// Parts of the way, and of the energy, by which a run may be off: places err by x²/24 of a part, speeds turn by x⁵/720
/// in each, and lean by half of the last at the end; without a memory by x³/12 up to where three attempts agree, to
/// 10⁻⁹ with x⁵/16, and x⁶/32 of the energy goes. Speeds settle to 10⁻¹² of the size that both ends and forces make in
/// each part.
fn allowed(omega: f64, h: f64, t: f64, scheme: StepScheme) -> [f64; 2] {
    let x = turning(omega, h);
    let rounding = 6e-12 * t * omega / x + 1e-9;
    let plain = if scheme == StepScheme::MoreauJean { x.min(0.028) } else { 0.0 };
    let lags = omega * t * (x.powi(4) / 720.0).max(plain.powi(2) / 12.0);
    [x * x / 20.0 + 0.5 * lags + rounding, rounding + omega * t * plain.powi(6) / (32.0 * x)]
}

/// Directions of speeds: across the turning, and askew.
fn start(u: f64, omega: f64, height: f64) -> (Isometry3<f64>, SVector<f64, 6>) {
    let z = SVector::from([0.6 * u, 0.0, 0.8 * u, 0.2 * omega, 0.9 * omega, -0.1_f64.sqrt() * omega * 0.4]);
    (Isometry3::translation(0.0, 0.0, height), z)
}

/// Whether a run is made; where it is, it is as right as its order.
macro_rules! flies_straight {
    ($run:expr, $place:expr, $u:expr, $omega:expr, $h:expr, $t:expr, $how:expr, $what:expr) => {{
        let (u, omega, h, t) = ($u, $omega, $h, $t);
        match $run {
            Ok(run) => {
                let (place, end) = ($place, run.last().unwrap().state);
                let z = SVector::<f64, 6>::from_fn(|i, _| end.z[i]);
                let moved: Vector3<f64> = place(&end.q) - place(&run.start.q);
                let way = Vector3::new(0.6, 0.0, 0.8) * u * t;
                let [of_way, of_energy] = allowed(omega, h, t, $how);
                let off = (moved - way).norm() / way.norm();
                let speed = z.fixed_rows::<3>(0).norm() / u - 1.0;
                let spin = z.fixed_rows::<3>(3).norm() / start(u, omega, 0.0).1.fixed_rows::<3>(3).norm() - 1.0;
                assert!(off < of_way, "{:?}: way off by {off:e}, allowed {of_way:e}", $what);
                assert!(speed.abs() < of_energy, "{:?}: speed off by {speed:e}", $what);
                assert!(spin.abs() < of_energy, "{:?}: turning off by {spin:e}", $what);
                true
            }
            Err(error) => {
                assert!(matches!(error.kind, ContactErrorKind::Stiff { .. }), "{:?}: {error}", $what);
                // A radian in a sixteenth of a step.
                assert!(omega * h > 10.0, "{:?}: {error}", $what);
                false
            }
        }
    }};
}

#[test]
fn a_ball_that_spins_fast_flies_straight_at_any_speed() {
    let mut made = 0;
    for scheme in SCHEMES {
        for r in [1e-6, 0.02, 1.0] {
            for omega in [20.0, 200.0, 1000.0] {
                for u in [1e-4, 1.0] {
                    for (h, t) in [(1e-3, 2.0), (1.0 / 60.0, 5.0)] {
                        let kernel = ball::<f64>(0.3, r);
                        // Far above the floor, where the way may lean.
                        let (q, z) = start(u, omega, 2.0 * (r + u * t));
                        let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..t);
                        let place = |q: &Isometry3<f64>| q.translation.vector;
                        let what = (scheme, r, omega, u, h);
                        made += usize::from(flies_straight!(run, place, u, omega, h, t, scheme, what));
                    }
                }
            }
        }
    }
    assert!(made >= 60, "{made} of 72");
}

#[test]
fn units_change_no_flight() {
    let (omega, u, h, r) = (200.0, 1e-4, 1e-3, 0.02);
    for scheme in SCHEMES {
        let end = |lengths: f64, masses: f64| {
            let kernel = ball::<f64>(0.3 * masses, r * lengths);
            let (q, z) = start(u * lengths, omega, 2.0 * r * lengths);
            let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..2.0).unwrap();
            let moved = run.last().unwrap().state.q.translation.vector - q.translation.vector;
            moved / lengths
        };
        let plain = end(1.0, 1.0);
        for (lengths, masses) in [(1e6, 1.0), (1e-6, 1.0), (1.0, 1e6), (1.0, 1e-6), (1e-6, 1e6)] {
            let off = (end(lengths, masses) - plain).norm() / plain.norm();
            // Speeds of 2000 parts, each settled to 10⁻¹² of themselves.
            assert!(off < 1e-8, "{scheme:?} {lengths:e} {masses:e} {off:e}");
        }
    }
}

#[test]
fn a_run_of_many_steps_keeps_its_energy() {
    // A part of 1.3 · 10⁻⁸ of it was given in each step by forces at foreseen speeds: by 0.3 % in all.
    let (omega, h) = (20.0, 1e-3);
    let kernel = ball::<f64>(0.3, 0.02);
    for scheme in SCHEMES {
        let (q, z) = start(2.0, omega, 0.04);
        let mut stepper = ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(scheme);
        for _ in 0..100_000 {
            stepper.step(h, &()).unwrap();
        }
        let [before, after] = [&z, stepper.speeds()].map(|z| kernel.kinetic_energy(0.0, &q, z));
        let taken = if scheme == StepScheme::MoreauJean { (omega * h).powi(6) / 32.0 } else { 0.0 };
        assert!((after / before - 1.0).abs() < 1e5 * (2e-12 + taken), "{scheme:?} {:e}", after / before - 1.0);
    }
}

#[test]
fn a_body_whose_moments_differ_goes_its_way_at_second_order() {
    let kernel = Slab {}.kernel().unwrap();
    for scheme in SCHEMES {
        for (omega, h) in [(20.0, 1e-3), (20.0, 5e-3), (100.0, 1e-3)] {
            let (u, t) = (1e-4, 1.0);
            // About the axis of the moment between the others, along which it turns over.
            let z = SVector::from([0.6 * u, 0.0, 0.8 * u, 0.05 * omega, omega, 0.02 * omega]);
            let end = |h: f64| {
                let run = ContactSteps::new(&kernel, h).scheme(scheme);
                run.run(Isometry3::translation(0.0, 0.0, 1.0), z, 0.0..t).unwrap().last().unwrap().state
            };
            let [coarse, half, fine] = [h, h / 2.0, h / 32.0].map(end);
            let turned = |end: &Sample<SlabKernel>| end.q.rotation.angle_to(&fine.q.rotation);
            let off = |end: &Sample<SlabKernel>| {
                let moved = end.q.translation.vector - Vector3::z();
                (moved - Vector3::new(0.6, 0.0, 0.8) * u * t).norm() / (u * t)
            };
            let x = omega * h;
            let way = allowed(omega, h, t, scheme)[0];
            // Per step the turning errs by x³/12 at most, and the axis that is left doubles that a few times.
            assert!(turned(&coarse) < x * x * omega * t, "{scheme:?} {omega} {h}: {:e}", turned(&coarse));
            assert!(off(&coarse) < 2.0 * way, "{scheme:?} {omega} {h}: {:e} {way:e}", off(&coarse));
            // Without a memory errors are smaller from where steps are made again.
            if scheme == StepScheme::Midpoint {
                assert!(turned(&half) < turned(&coarse) / 3.0, "{omega} {h}: {:e}", turned(&half));
                assert!(off(&half) < off(&coarse) / 3.0, "{omega} {h}: {:e} {:e}", off(&half), off(&coarse));
            }
        }
    }
}

#[test]
fn steps_with_a_tolerance_keep_it_for_slow_speeds_too() {
    for scheme in SCHEMES {
        for (r, omega, u) in [(0.02, 200.0, 1e-4), (1.0, 20.0, 1e-4), (1e-6, 200.0, 1.0)] {
            let kernel = ball::<f64>(0.3, r);
            let (q, z) = start(u, omega, 2.0 * r);
            let steps = ContactSteps::new(&kernel, 1e-2).scheme(scheme).adaptive(1e-6, 1e-9 * u);
            let run = steps.run(q, z, 0.0..1.0).unwrap();
            let end = run.samples.last().unwrap().state;
            let moved = end.q.translation.vector - q.translation.vector;
            let off = (moved - Vector3::new(0.6, 0.0, 0.8) * u).norm() / u;
            // Each step may err by the tolerance, which goes with the height and the way.
            assert!(
                off * u < 1e-6 * (2.0 * r + 2.0 * u) * run.statistics.accepted as f64,
                "{scheme:?} {r} {omega} {u}: {off:e}"
            );
        }
    }
}

#[test]
fn a_contact_that_presses_nothing_is_a_flight() {
    let kernel = Lifted {}.kernel().unwrap();
    for scheme in SCHEMES {
        for x in [1e-3, 0.02, 0.1, 0.19] {
            let h = 1e-3;
            let end = |height: f64| {
                let (q, z) = (Isometry3::translation(0.0, 0.0, height), start(1.0, x / h, 0.0).1);
                // Along the floor, on which it lies without a rate or near which it flies.
                let z = SVector::from([z[0], 0.5, 0.0, z[3], z[4], z[5]]);
                let mut stepper = ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(scheme);
                assert_eq!(stepper.modes()[0].is_closed(), height == 0.02);
                assert_eq!(stepper.step(h, &()).unwrap().closed, 0);
                *stepper.speeds()
            };
            let off = (end(0.02) - end(0.020_001)).amax();
            // Speeds of up to 190 rad/s that settle to 10⁻¹². Means that differ as ends and time do are x³/12 apart.
            assert!(off < 1e-12 * (1.0 + x / h), "{scheme:?} {x} {off:e}");
        }
    }
}

#[test]
fn lanes_that_fly_have_the_bits_of_single_steps() {
    type Four = Lanes<f64, 4>;
    let (kernel, wide) = (ball::<f64>(0.3, 0.02), ball::<Four>(0.3, 0.02));
    let one = |i: usize| {
        let (q, z) = start([1e-4, 1.0, 1e-4, 5.0][i], [200.0, 20.0, 0.0, 900.0][i], 0.04);
        ContactStepper::new(&kernel, 0.0, q, z).unwrap()
    };
    let mut singles: Vec<_> = (0..4).map(one).collect();
    let mut lanes = ContactLanes::of(&wide, (0..4).map(one).collect()).unwrap();
    for n in 0..300 {
        let outcomes: Vec<_> = lanes.step(1e-3, &()).to_vec();
        for (lane, single) in singles.iter_mut().enumerate() {
            assert_eq!(outcomes[lane], single.step(1e-3, &()), "{n} {lane}");
            assert_eq!(single.speeds(), lanes.steppers()[lane].speeds(), "{n} {lane}");
            assert_eq!(single.configuration(), lanes.steppers()[lane].configuration(), "{n} {lane}");
        }
    }
}
