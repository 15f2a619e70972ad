//! Every run ends, soon, with a reason: what hung, took a thousand times as many steps as it needs, or ended with a
//! wrong hint.

mod hostile;
mod scenes;

use std::f64::consts::FRAC_PI_2;

use gauss_batch::{Batch, States};
use gauss_runtime::integrate::{Adams, Collocation, DEFAULT_LIMIT, Fixed, RunPart, Summary};
use gauss_runtime::prelude::*;
use gauss_tests::watchdog::within;

use scenes::{Angles, Comet, Inclined, Modified, Moon, Pendulum, Rodrigues, Slider, Spring, one, toy};

/// Seconds in which each of these runs ends, on a slow machine that does other things too.
const SOON: u64 = 60;

type Four = Lanes<f64, 4>;

/// Why a run does not reach its end.
fn refusal<K: GaussSystem>(run: (Trajectory<'_, K>, Option<IntegrationError>)) -> IntegrationError {
    let (path, error) = run;
    let error = error.expect("does not reach the end");
    assert_eq!(error.time, path.last().t.lane(0), "{error}");
    assert!(path.last().q.is_finite(), "the last state is a good one");
    error
}

#[test]
fn at_gimbal_lock_the_chart_is_named() {
    let error = within(SOON, "gimbal lock", || {
        let kernel = Angles { mass: 1.0, inertia: Vector3::new(1.0, 2.0, 2.5) }.kernel().expect("a body");
        let (q, z) = (Vector3::new(0.0, FRAC_PI_2 - 0.07, 0.0), Vector3::new(0.0, 1.0, 0.0));
        let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9);
        let (path, error) = run.attempt(q, z, 0.0..1.0);
        assert!(path.summary().steps + path.summary().rejected < 1000, "{}", path.summary());
        // With a limit it is the same.
        let limited = refusal(run.max_steps(30).attempt(q, z, 0.0..1.0));
        assert!(matches!(limited.kind, IntegrationErrorKind::SingularChart { .. }), "{limited}");
        // Steps over the lock find it between their ends, whatever the regularity there.
        let over = refusal(Simulation::new(&kernel).fixed_step(0.3).attempt(q, z, 0.0..1.0));
        assert_eq!(over.kind, IntegrationErrorKind::SingularChart { regularity: 0.0 });
        error.expect("does not reach the end")
    });
    assert!((error.time - 0.07).abs() < 1e-7, "{error}");
    assert!(matches!(error.kind, IntegrationErrorKind::SingularChart { regularity } if regularity < 1e-7), "{error}");
    assert!(error.to_string().contains("use another sequence of angles, or a chart without singularities"), "{error}");
}

#[test]
fn what_is_stiff_is_told_with_the_remedy_which_works() {
    within(SOON, "a stiff oscillator", || {
        let kernel = Spring { k: 1e12, c: 1e12 }.kernel().expect("a spring");
        let (q, z) = (one(1.0), one(0.0));
        let run = Simulation::new(&kernel);
        for error in [
            refusal(run.adaptive(1e-6, 1e-6).attempt(q, z, 0.0..1.0)),
            refusal(run.taylor(1e-6, 1e-6).attempt(q, z, 0.0..1.0)),
            refusal(run.momentum_form().adaptive(1e-3, 1e-3).attempt(q, z, 0.0..1e6)),
            refusal(run.adaptive(1e-6, 1e-6).max_steps(5000).attempt(q, z, 0.0..1.0)),
            // Steps that are too long overflow.
            refusal(run.fixed_step(1e-3).attempt(q, z, 0.0..1.0)),
        ] {
            let IntegrationErrorKind::Stiff { rate, .. } = error.kind else { panic!("{error}") };
            assert!((rate / 1e12 - 1.0).abs() < 0.01, "{error}");
            assert!(error.to_string().contains("use `Rosenbrock` (with `#[gauss(linearize)]`)"), "{error}");
        }
        let remedy = run.control(Adaptive::by(Rosenbrock, 1e-6, 1e-6)).run(q, z, 0.0..1.0).expect("runs");
        // ẋ = −x, after the first moment.
        assert!((remedy.last().q[0] - (-1.0_f64).exp()).abs() < 1e-5 && remedy.len() < 200, "{}", remedy.summary());
    });
}

#[test]
fn what_is_too_fast_is_told_at_once() {
    within(SOON, "an oscillator of 1e150 rad per unit of time", || {
        let kernel = Spring { k: 1e300, c: 0.0 }.kernel().expect("a spring");
        let run = Simulation::new(&kernel);
        for start in [0.0, 3.0] {
            let span = start..start + 1.0;
            for error in [
                refusal(run.adaptive(1e-6, 1e-6).attempt(one(1.0), one(0.0), span.clone())),
                refusal(run.adaptive(1e-6, 1e-6).attempt(one(1e-150), one(1.0), span.clone())),
                refusal(run.taylor(1e-6, 1e-6).attempt(one(1.0), one(0.0), span.clone())),
            ] {
                assert!(matches!(error.kind, IntegrationErrorKind::TooFast { rate, .. } if rate > 1e149), "{error}");
            }
        }
        let top = toy().kernel().expect("a top");
        let spin = Vector3::z() * 1e150;
        let error =
            refusal(Simulation::new(&top).adaptive(1e-9, 1e-9).attempt(UnitQuaternion::identity(), spin, 0.0..1.0));
        assert!(matches!(error.kind, IntegrationErrorKind::TooFast { rate, .. } if rate > 1e149), "{error}");
        // A million turns a second for a year: of which steps can follow some.
        let spin = Vector3::z() * 6e6;
        let error =
            refusal(Simulation::new(&top).adaptive(1e-9, 1e-9).attempt(UnitQuaternion::identity(), spin, 0.0..3e7));
        assert!(matches!(error.kind, IntegrationErrorKind::TooFast { .. }), "{error}");
    });
}

/// A swing of 1e8 s: its steps are too many, which a part of them tells, but the motion is slow. Batches ask the same
/// function.
#[test]
fn a_run_that_is_only_long_is_told_by_its_limit() {
    for span in [0.0..1e8, 1e8..0.0] {
        within(SOON, "an oscillator of 1 rad per unit of time for a long time", || {
            let kernel = Spring { k: 1.0, c: 0.0 }.kernel().expect("a spring");
            let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).max_steps(1_000_000);
            let error = refusal(run.attempt(one(1.0), one(0.0), span));
            assert_eq!(error.kind, IntegrationErrorKind::TooManySteps { limit: 1_000_000 }, "{error}");
            assert!(error.to_string().contains("allow more with `max_steps`"), "{error}");
        });
    }
}

#[test]
fn tolerances_below_rounding_are_met_as_far_as_rounding_lets_them() {
    within(SOON, "tolerances of 1e-300", || {
        let kernel = Spring { k: 1.0, c: 0.0 }.kernel().expect("a spring");
        let run = Simulation::new(&kernel);
        for tolerance in [1e-16, 1e-17, 1e-30, 1e-300, 5e-324] {
            for start in [0.0, 1e3] {
                let span = start..start + 10.0;
                let adaptive = run.adaptive(tolerance, tolerance).run(one(1.0), one(0.0), span.clone()).expect("runs");
                let taylor = run.taylor(tolerance, tolerance).run(one(1.0), one(0.0), span.clone()).expect("runs");
                for path in [adaptive, taylor] {
                    let end = path.last();
                    let error = (end.q[0] - 10.0_f64.cos()).abs().max((end.z[0] + 10.0_f64.sin()).abs());
                    // A few roundings a step, of numbers up to 1, and one of the time.
                    let rounding = f64::EPSILON * (4.0 + start) * path.len() as f64;
                    assert!(error < rounding, "{tolerance:e}: {error:e}, {}", path.summary());
                    assert!(path.len() < 2000, "{}", path.summary());
                    if tolerance < 1e-17 {
                        let Summary { rounded, excess, .. } = *path.summary();
                        assert!(rounded > 0 && excess > 1.0, "{}", path.summary());
                        assert!(path.summary().to_string().contains("times the tolerance"));
                    }
                }
            }
        }
        // Where rounding is no matter it is not spoken of.
        let plain = run.adaptive(1e-12, 1e-12).run(one(1.0), one(0.0), 0.0..10.0).expect("runs");
        assert_eq!((plain.summary().rounded, plain.summary().steps), (0, plain.len() as u64 - 1));
    });
}

/// At t = 10⁹ times are 10⁻⁷ apart. Steps end at times that are numbers, so that the state has gone as far as the time.
#[test]
fn far_from_zero_the_state_goes_as_far_as_the_time() {
    let kernel = Spring { k: 1.0, c: 0.0 }.kernel().expect("a spring");
    let (run, start, step) = (Simulation::new(&kernel), 1e9, 0.013);
    for span in [64.0, -64.0] {
        for (name, end) in [
            (
                "adaptive",
                run.adaptive(1e-12, 1e-12).largest_step(step).run_to_end(one(1.0), one(0.0), start..start + span),
            ),
            (
                "Taylor",
                run.control(Taylor::new(1e-12, 1e-12).largest_step(step)).run_to_end(
                    one(1.0),
                    one(0.0),
                    start..start + span,
                ),
            ),
        ] {
            let error = (end.expect("runs").q[0] - span.cos()).abs();
            // A tolerance in each of 5000 steps; roundings of the time would be 10⁻⁶.
            assert!(error < 5e-9, "{name}: {error:e}");
        }
    }
    let (top, packs) = (scenes::GenericTop::<f64>::toy().kernel(), scenes::GenericTop::<Four>::toy().kernel());
    let (top, packs) = (top.expect("a top"), packs.expect("tops"));
    let first = |n: usize| (UnitQuaternion::identity(), Vector3::new(0.1 * n as f64, 1.0, 2.0));
    let mut states = States::<scenes::GenericTopKernel<Four>>::from_fn(5, first);
    let ends = Batch::new(&packs).adaptive(1e-12, 1e-12).largest_step(step).run(start..start + 8.0, &mut states);
    assert!(ends.iter().all(Result::is_ok));
    for n in 0..5 {
        let ((q, z), alone) = (first(n), Simulation::new(&top).adaptive(1e-12, 1e-12).largest_step(step));
        let end = alone.run_to_end(q, z, start..start + 8.0).expect("runs");
        assert_eq!((end.q, end.z), states.get(n));
    }
}

/// A wing nut from near its middle axis to where the Rodrigues vector is infinite: derivatives cancel on the way there.
#[test]
fn steps_do_not_chase_rounding_in_coordinates_that_become_singular() {
    let steps = within(SOON, "a wing nut", || {
        let kernel = Rodrigues { mass: 1.0, inertia: Vector3::new(1.0, 2.0, 2.5) }.kernel().expect("a body");
        [1e-10, 1e-12, 1e-13, 1e-14].map(|tolerance| {
            let run = Simulation::new(&kernel).adaptive(tolerance, tolerance);
            let (path, error) = run.attempt(Vector3::zeros(), Vector3::new(0.3, 0.5, 0.3), 0.0..5.0);
            let error = error.expect("it turns by π");
            assert!(matches!(error.kind, IntegrationErrorKind::SingularChart { .. }), "{error}");
            path.summary().steps + path.summary().rejected
        })
    });
    // By order 8 a hundredth of the tolerance takes 1.8 times the steps, a ten thousandth 3.2 times. At 1e-14, 45
    // roundings, the last digits of the controller decide how often a step is tried again near the end, a fifth of all:
    // twice is noise.
    assert!(steps.windows(2).all(|pair| pair[1] < 3 * pair[0]) && steps[3] < 7 * steps[0], "{steps:?}");
}

/// About an axis the columns of ∂ω/∂q̇ stay perpendicular, and the parameters become infinite all the same. The kernels
/// are one in `f64` and one in packs; the turn about an axis has this rate, and ends at this time.
fn ends_where_parameters_are_infinite<S, L>(name: &str, (kernel, pack): (&S, &L), (rate, singular): (f64, f64))
where
    S: TaylorSystem<Scalar = f64, Configuration = Vector3<f64>, Speeds = Vector3<f64>, Input = ()>,
    L: TaylorSystem<Scalar = Four, Configuration = Vector3<Four>, Speeds = Vector3<Four>, Input = ()> + Sync,
{
    let check = |method: &str, time: f64, kind: &IntegrationErrorKind| {
        assert!(matches!(kind, IntegrationErrorKind::SingularChart { .. }), "{name}, {method}: {kind}");
        // Within five steps of one length.
        assert!((time - singular).abs() < 0.05, "{name}, {method}: {time}");
    };
    let run = Simulation::new(kernel);
    let axes = [Vector3::x(), Vector3::y(), -Vector3::z(), Vector3::new(0.6, 0.0, 0.8)];
    for axis in &axes[..3] {
        let (q, z, span) = (Vector3::zeros(), axis * rate, 0.0..10.0);
        for (method, error) in [
            ("adaptive", run.adaptive(1e-9, 1e-9).attempt(q, z, span.clone()).1),
            ("momenta", run.momentum_form().adaptive(1e-9, 1e-9).attempt(q, z, span.clone()).1),
            ("loose", run.adaptive(1e-4, 1e-4).attempt(q, z, span.clone()).1),
            ("fixed", run.fixed_step(0.01).attempt(q, z, span.clone()).1),
            ("Taylor", run.taylor(1e-9, 1e-9).attempt(q, z, span.clone()).1),
            ("Adams", run.control(Adams::<_, 8>::new(0.01)).attempt(q, z, span.clone()).1),
            ("implicit", run.control(Fixed::by(Collocation::order_4(), 0.01)).attempt(q, z, span.clone()).1),
        ] {
            let error = error.unwrap_or_else(|| panic!("{name}, {method}: passes"));
            check(method, error.time, &error.kind);
        }
    }
    let states = || States::<L>::from_fn(3, |n| (Vector3::zeros(), axes[n] * rate));
    let batch = || Batch::new(pack);
    for (method, ends) in [
        ("adaptive lanes", batch().adaptive(1e-9, 1e-9).run(0.0..10.0, &mut states())),
        ("Taylor lanes", batch().taylor(1e-9, 1e-9).run(0.0..10.0, &mut states())),
        ("Adams lanes", batch().control(Adams::<_, 8>::new(Four::splat(0.01))).run(0.0..10.0, &mut states())),
    ] {
        for end in ends {
            let error = end.expect_err("does not pass");
            check(method, error.time, &error.kind);
        }
    }
    // It vanishes with the distance, and is 1 where the body is not turned.
    let regularity = |time: f64| {
        let end = run.taylor(1e-14, 1e-14).run_to_end(Vector3::zeros(), axes[0] * rate, 0.0..time).expect("regular");
        kernel.regularity(end.t, &end.q)
    };
    assert_eq!(kernel.regularity(0.0, &Vector3::zeros()), 1.0);
    let quarter = std::f64::consts::FRAC_PI_2 / singular;
    for left in [1.0, 0.1, 1e-3, 1e-5] {
        // Coordinates and time are rounded at 1 beside what is left.
        let found = regularity(singular - left);
        assert!((found / (quarter * left).sin() - 1.0).abs() < 1e-13 / left + 1e-12, "{name}: {found} at {left}");
    }
}

#[test]
fn parameters_that_become_infinite_are_named_by_every_method() {
    within(SOON, "turns about an axis", || {
        let (moments, pi) = (Vector3::new(1.0, 2.0, 2.5), std::f64::consts::PI);
        let (one, packs) = (Four::splat(1.0), moments.map(Four::splat));
        let single = Rodrigues { mass: 1.0, inertia: moments }.kernel().expect("a body");
        let pack = Rodrigues { mass: one, inertia: packs }.kernel().expect("a body");
        ends_where_parameters_are_infinite("Rodrigues", (&single, &pack), (0.5, pi));
        let single = Modified { mass: 1.0, inertia: moments }.kernel().expect("a body");
        let pack = Modified { mass: one, inertia: packs }.kernel().expect("a body");
        ends_where_parameters_are_infinite("modified", (&single, &pack), (0.25, 2.0 * pi));
    });
}

/// A full turn is one point of the rotations: a motion past it at a distance of 10⁻³ goes on.
#[test]
fn what_stays_at_a_distance_from_infinite_parameters_runs() {
    within(SOON, "a turn past the singularity", || {
        let ball = Modified { mass: 1.0, inertia: Vector3::new(1.0, 1.0, 1.0) }.kernel().expect("a body");
        let tilt = UnitQuaternion::new(Vector3::y() * 1e-3);
        let turned = |t: f64| tilt * UnitQuaternion::new(Vector3::x() * t);
        let parameters = |turn: UnitQuaternion<f64>| turn.imag() / (1.0 + turn.scalar());
        let q = parameters(tilt);
        let z = ball.speeds(0.0, &q, &SVector::from([0.0, 0.0, 0.0, 1.0, 0.0, 0.0]));
        let run = Simulation::new(&ball);
        for (method, end) in [
            ("adaptive", run.adaptive(1e-13, 1e-13).run_to_end(q, z, 0.0..9.0).expect("passes")),
            ("Taylor", run.taylor(1e-13, 1e-13).run_to_end(q, z, 0.0..9.0).expect("passes")),
        ] {
            // Parameters grow to 4000 and shrink again: velocities there are known to a tolerance times that.
            let error = (end.q - parameters(turned(9.0))).amax();
            assert!(error < 1e-8, "{method}: {error:e}");
        }
    });
}

#[test]
fn steps_do_not_chase_rounding_in_momenta() {
    within(SOON, "a sleeping top in momenta", || {
        let top = Inclined::toy().kernel().expect("a top");
        // A little slower than is stable, a milliradian from upright, where angles and their momenta are nearly
        // singular.
        let spin = (0.98_f64 * 4.0 * 0.2 * 0.4 * 9.81).sqrt() / 0.05;
        let tilted = Isometry3::from_parts(Translation3::identity(), UnitQuaternion::new(Vector3::x() * 1e-3));
        let q = top.configuration(&tilted).expect("regular");
        let z = top.speeds(0.0, &q, &SVector::from([0.0, 0.0, 0.0, 0.0, 0.0, spin]));
        let run = Simulation::new(&top);
        let exact = run.adaptive(1e-14, 1e-14).run_to_end(q, z, 0.0..12.0).expect("runs");
        let mut coarse = f64::INFINITY;
        for tolerance in [1e-10, 1e-12, 1e-13, 1e-14] {
            let velocities = run.adaptive(tolerance, tolerance).run(q, z, 0.0..12.0).expect("runs");
            let momenta = run.momentum_form().adaptive(tolerance, tolerance).run(q, z, 0.0..12.0).expect("runs");
            assert!(momenta.len() < 2 * velocities.len(), "{tolerance:e}: {} {}", momenta.len(), velocities.len());
            // What cancels is p − (…) cos θ over sin² θ: a part ε of momenta over 1e-6, in some hundred steps.
            let error = (momenta.last().q - exact.q).amax();
            let told = momenta.summary().excess.max(1.0) * tolerance * 1e3;
            assert!(error < 1e-8 && error < told, "{tolerance:e}: {error:e}, {}", momenta.summary());
            coarse = coarse.min(error);
        }
        assert!(coarse < 1e-9, "{coarse:e}");
    });
}

#[test]
fn what_overflows_is_an_error() {
    let kernel = Pendulum { g: 9.81 }.kernel().expect("a pendulum");
    let run = Simulation::new(&kernel);
    let fast = |z: f64| {
        [
            refusal(run.adaptive(1e-6, 1e-6).attempt(one(1.0), one(z), 0.0..1.0)),
            refusal(run.fixed_step(0.1).attempt(one(1.0), one(z), 0.0..1.0)),
            refusal(run.taylor(1e-6, 1e-6).attempt(one(1.0), one(z), 0.0..1.0)),
        ]
    };
    for error in fast(1e300) {
        assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::InitialState }, "{error}");
        assert!(error.to_string().contains("so large that squares overflow"), "{error}");
    }
    // It grows on the way: a force that pushes away from the middle.
    let kernel = Slider { friction: 0.0 }.kernel().expect("a slider");
    let away = |_: f64, q: &SVector<f64, 1>, _: &SVector<f64, 1>| q * 1e4;
    let error = refusal(Simulation::new(&kernel).input(away).fixed_step(0.01).attempt(one(1.0), one(0.0), 0.0..10.0));
    assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step }, "{error}");
    // e^(100 t) has a square that overflows when 200 t > 709.
    assert!((3.5..3.6).contains(&error.time), "{error}");
}

/// Attraction is infinite there: no run begins at a centre, or passes through it.
#[test]
fn at_a_centre_of_attraction_runs_end() {
    within(SOON, "at the centre", || {
        let comet = Comet { mu: 1.0 }.kernel().expect("a comet");
        let run = Simulation::new(&comet);
        let (centre, away, still) = (SVector::zeros(), SVector::from([1.0, 0.0]), SVector::zeros());
        let moon = Moon { mass: 1.0, inertia: Vector3::new(1e-3, 1e-3, 1e-3), mu: 1.0 }.kernel().expect("a moon");
        let body = Simulation::new(&moon);
        let pose = |x: f64| Isometry3::translation(x, 0.0, 0.0);
        for error in [
            refusal(run.adaptive(1e-9, 1e-9).attempt(centre, still, 0.0..2.0)),
            refusal(run.fixed_step(0.125).attempt(centre, still, 0.0..2.0)),
            refusal(body.adaptive(1e-9, 1e-9).attempt(pose(0.0), SVector::zeros(), 0.0..2.0)),
            refusal(body.fixed_step(0.125).attempt(pose(0.0), SVector::zeros(), 0.0..2.0)),
        ] {
            assert!(matches!(error.kind, IntegrationErrorKind::NonFinite { .. }), "{error}");
            assert_eq!(error.time, 0.0, "{error}");
        }
        // From rest at a distance of 1 it is there after π/√8.
        let met = std::f64::consts::PI / 8.0_f64.sqrt();
        for error in [
            refusal(run.adaptive(1e-9, 1e-9).attempt(away, still, 0.0..2.0)),
            refusal(body.adaptive(1e-9, 1e-9).attempt(pose(1.0), SVector::zeros(), 0.0..2.0)),
        ] {
            assert!((error.time - met).abs() < 1e-2, "{error}");
        }
    });
}

#[test]
fn other_ends_have_their_own_reasons() {
    within(SOON, "what breaks or cannot be", || {
        let kernel = Slider { friction: 0.5 }.kernel().expect("a slider");
        // An input that breaks is not stiff, nor too fast.
        let broken = |t: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| one(if t > 1.0 { f64::NAN } else { 0.0 });
        let run = Simulation::new(&kernel).input(broken);
        for error in [
            refusal(run.adaptive(1e-9, 1e-9).attempt(one(1.0), one(3.0), 0.0..3.0)),
            refusal(run.fixed_step(0.125).attempt(one(1.0), one(3.0), 0.0..3.0)),
        ] {
            assert_eq!(error.kind, IntegrationErrorKind::NonFinite { part: RunPart::Step }, "{error}");
        }
        // Dry friction that holds: no motion agrees with a force that jumps.
        let quiet = |_: f64, _: &SVector<f64, 1>, _: &SVector<f64, 1>| one(0.2);
        let (path, error) =
            Simulation::new(&kernel).input(quiet).adaptive(1e-9, 1e-9).attempt(one(1.0), one(0.01), 0.0..3.0);
        let error = error.expect("it rests");
        assert!(path.summary().steps < 200_000, "{}", path.summary());
        assert!(matches!(error.kind, IntegrationErrorKind::StepTooSmall { .. }), "{error}");
        assert!(error.to_string().contains("dry friction at rest: use a smooth law"), "{error}");
    });
}

#[test]
fn what_is_out_of_reach_is_refused_before_the_first_step() {
    let kernel = Spring { k: 1.0, c: 0.0 }.kernel().expect("a spring");
    let run = Simulation::new(&kernel);
    let (q, z) = (one(1.0), one(0.0));
    for kind in [
        refusal(run.fixed_step(1e-300).attempt(q, z, 0.0..1.0)).kind,
        refusal(run.adaptive(1e-6, 1e-6).largest_step(1e-300).attempt(q, z, 0.0..1.0)).kind,
        refusal(run.control(Taylor::new(1e-6, 1e-6).largest_step(1e-300)).attempt(q, z, 0.0..1.0)).kind,
    ] {
        assert!(matches!(kind, IntegrationErrorKind::TooManySteps { .. }), "{kind:?}");
    }
    let longest = run.adaptive(1e-6, 1e-6).largest_step(f64::NAN);
    assert!(matches!(refusal(longest.attempt(q, z, 0.0..1.0)).kind, IntegrationErrorKind::InvalidStep { .. }));
    let whole = refusal(run.fixed_step(0.1).attempt(q, z, -1e308..1e308));
    assert_eq!(whole.kind, IntegrationErrorKind::InvalidInterval);
    // Steps that are many, but not too many.
    let end = run.fixed_step(1e-6).run_to_end(q, z, 0.0..1.0).expect("runs");
    assert_eq!((end.summary.steps, end.stopped_by), (1_000_000, None));
    // A batch has no other limit.
    let top = scenes::GenericTop::<Four>::toy().kernel().expect("a top");
    let mut states =
        States::<scenes::GenericTopKernel<Four>>::from_fn(5, |_| (UnitQuaternion::identity(), Vector3::z()));
    let error =
        Batch::new(&top).advance(&RungeKutta(DormandPrince8), 1e-300, 0.0..1.0, &mut states).expect_err("refused");
    assert_eq!(error.failures.len(), 5);
    assert_eq!(error.failures[0].kind, IntegrationErrorKind::TooManySteps { limit: DEFAULT_LIMIT });
}
