//! Pushes that come and go while nothing moves: what rests notices them, without any help.

use gauss_contact::{ContactErrorKind, ContactRun, ContactSteps, EventKind, StepScheme};
use gauss_runtime::integrate::IntegrationErrorKind;
use gauss_runtime::prelude::*;

/// A block on the ground, pushed along it.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = m, position = [x, 0, z]),
    contact(ground, gap = z, slip = rate(x), friction = mu),
    input(push),
    drive(x = push),
)]
struct Block {
    m: f64,
    mu: f64,
    #[gauss(gravity)]
    g: f64,
}

/// A joint with dry friction, driven.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    dry_friction(brake, slip = rate(x), bound = press),
    input(push, press),
    drive(x = push),
)]
struct Braked {
    m: f64,
}

/// A particle that nothing but an input moves.
#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), input(push), drive(x = push))]
struct Free {
    m: f64,
}

const M: f64 = 2.0;
const MU: f64 = 0.4;
const G: f64 = 9.81;

/// The way of a block that is pushed with `3 exp(−τ²)` times its friction, τ = (t − t₀)/w, in units of μ g w²: it sets
/// off where the push is as large as friction, and its speed is an integral, up to where that has come to 0.
fn way() -> f64 {
    let sets_off = -(3.0_f64.ln()).sqrt();
    let rate = |tau: f64| 3.0 * (-tau * tau).exp() - 1.0;
    let (h, mut tau, mut v, mut x) = (1e-5, sets_off, 0.0_f64, 0.0);
    loop {
        // Simpson's rule for the speed, and a cubic for the way.
        let (a, b, c) = (rate(tau), rate(tau + 0.5 * h), rate(tau + h));
        let next = v + h / 6.0 * (a + 4.0 * b + c);
        if next <= 0.0 {
            return x + 0.5 * v * v / -a;
        }
        x += h * (v + h / 6.0 * (a + 2.0 * b));
        (v, tau) = (next, tau + h);
    }
}

#[test]
fn a_block_that_sticks_is_pushed_by_pulses_of_all_widths() {
    let kernel = Block { m: M, mu: MU, g: G }.kernel().expect("a scene");
    let unit = way();
    for (end, at) in [(10.0, 5.3), (10.0, 1.234), (60.0, 31.7), (0.2, 0.07)] {
        for part in [0.002, 0.005, 0.02, 0.05] {
            for tolerance in [1e-6, 1e-9, 1e-11] {
                let w = part * end;
                let push = move |t: f64, _: &_, _: &_| {
                    let tau: f64 = (t - at) / w;
                    SVector::from([3.0 * MU * M * G * (-tau * tau).exp()])
                };
                let run = ContactRun::new(&kernel).input(push).adaptive(tolerance, tolerance);
                let run = run.run([0.0, 0.0].into(), [0.0, 0.0].into(), 0.0..end).expect("runs");
                let x = run.last().expect("a sample").q[0];
                let wanted = unit * MU * G * w * w;
                let near = 1e3 * tolerance * (1.0 + wanted + MU * G * w) + 1e-5 * wanted;
                assert!((x - wanted).abs() < near, "{end} {at} {part} {tolerance}: {x} {wanted}");
                let kinds = run.events().iter().map(|event| core::mem::discriminant(&event.kind));
                let slides = core::mem::discriminant(&EventKind::Slides([0.0; 3]));
                assert_eq!(kinds.filter(|kind| *kind == slides).count(), 1);
            }
        }
    }
}

#[test]
fn short_pushes_are_seen_where_the_run_is_told_how_short() {
    let kernel = Block { m: M, mu: MU, g: G }.kernel().expect("a scene");
    // A hundredth of what is looked at without a word, and not smooth.
    let (from, w) = (5.3, 4e-4);
    let push =
        move |t: f64, _: &_, _: &_| SVector::from([if (from..from + w).contains(&t) { 3.0 * MU * M * G } else { 0.0 }]);
    let run = ContactRun::new(&kernel).input(push).adaptive(1e-9, 1e-9).input_changes_within(w);
    let run = run.run([0.0, 0.0].into(), [0.0, 0.0].into(), 0.0..10.0).expect("runs");
    // v = 2 μ g w, on the way and until friction has stopped it.
    let wanted = MU * G * w * w + 2.0 * MU * G * w * w;
    let x = run.last().expect("a sample").q[0];
    assert!((x - wanted).abs() < 0.02 * wanted, "{x} {wanted}");

    let run = ContactRun::new(&kernel).input(push).adaptive(1e-9, 1e-9).input_changes_within(-1.0);
    let error = run.run([0.0, 0.0].into(), [0.0, 0.0].into(), 0.0..10.0).err().expect("no time");
    let ContactErrorKind::Integration(error) = error.kind else { panic!("{error}") };
    assert!(matches!(error.kind, IntegrationErrorKind::InvalidStep { .. }));
}

#[test]
fn steps_take_the_mean_of_a_push() {
    let kernel = Block { m: M, mu: MU, g: G }.kernel().expect("a scene");
    // As many steps as it lasts, whether its edges are ends of steps, up to rounding, or halfway between them.
    let (w, h) = (0.01, 1e-3);
    for from in [0.1, 0.3, 0.7, 0.3004, 0.3006] {
        let push = move |t: f64, _: &_, _: &_| {
            SVector::from([if (from..from + w).contains(&t) { 3.0 * MU * M * G } else { 0.0 }])
        };
        let steps = ContactSteps::new(&kernel, h).input(push);
        let run = steps.run([0.0, 0.0].into(), [0.0, 0.0].into(), 0.0..1.0).expect("runs");
        // v = 2 μ g w at the end of the push; the step in which the block comes to rest has half of its last speed.
        let (wanted, fastest) = (3.0 * MU * G * w * w, 2.0 * MU * G * w);
        let most = run.iter().map(|step| step.state.z[0]).fold(0.0, f64::max);
        assert!((most - fastest).abs() < 1e-9 * fastest, "{from}: {most} {fastest}");
        let x = run.last().expect("a step").state.q[0];
        assert!((x - wanted).abs() < 0.5 * MU * G * h * h, "{from}: {x} {wanted}");
    }
}

#[test]
fn inputs_of_time_leave_steps_of_second_order() {
    let kernel = Block { m: M, mu: MU, g: G }.kernel().expect("a scene");
    // A block that slides all the time: ẍ = a sin(ω t) − μ g.
    let (a, omega, v, end) = (20.0, 7.0_f64, 9.0, 1.0_f64);
    let push = move |t: f64, _: &_, _: &_| SVector::from([M * a * (omega * t).sin()]);
    let wanted = (v + a / omega) * end - a / (omega * omega) * (omega * end).sin() - 0.5 * MU * G * end * end;
    for scheme in [StepScheme::Midpoint, StepScheme::MoreauJean] {
        let off = |h: f64| {
            let steps = ContactSteps::new(&kernel, h).scheme(scheme).input(push);
            let run = steps.run([0.0, 0.0].into(), [v, 0.0].into(), 0.0..end).expect("runs");
            (run.last().expect("a step").state.q[0] - wanted).abs()
        };
        let order = (off(1e-2) / off(5e-3)).log2();
        // Off by terms of fourth order, (ω h)²/12 of the second.
        assert!((order - 2.0).abs() < 1e-2, "{scheme:?}: {order}");
        // (ω h)²/24 of each step's momentum.
        assert!(off(1e-2) < a / omega * (omega * 1e-2).powi(2) / 12.0);
        let adaptive = ContactSteps::new(&kernel, 0.1).scheme(scheme).input(push).adaptive(1e-6, 1e-6);
        let run = adaptive.run([0.0, 0.0].into(), [v, 0.0].into(), 0.0..end).expect("runs");
        let x = run.last().expect("a step").state.q[0];
        assert!((x - wanted).abs() < 1e-6 * 10.0 * run.len() as f64, "{scheme:?}: {x} {wanted} {}", run.len());
    }
}

#[test]
fn a_brake_that_opens_for_a_moment_lets_go() {
    let kernel = Braked { m: 1.0 }.kernel().expect("a scene");
    for w in [0.02, 0.1, 0.5] {
        let inputs = move |t: f64, _: &_, _: &_| {
            let tau: f64 = (t - 6.1) / w;
            SVector::from([1.0, 2.0 - 1.8 * (-tau * tau).exp()])
        };
        let run = ContactRun::new(&kernel).input(inputs).adaptive(1e-9, 1e-9);
        let run = run.run([0.0].into(), [0.0].into(), 0.0..10.0).expect("runs");
        // It slips where the bound is below 1: from exp(−τ²) = 1/1.8 on.
        let slides = run.events().iter().find(|event| matches!(event.kind, EventKind::Slides(_))).expect("slides");
        assert!((slides.time - (6.1 - w * 1.8_f64.ln().sqrt())).abs() < 1e-8, "{w}: {}", slides.time);
        assert!(run.last().expect("a sample").q[0] > 0.1 * w * w);
    }
}

#[test]
fn a_body_at_rest_without_contacts_is_pushed_too() {
    let kernel = Free { m: 0.5 }.kernel().expect("a scene");
    for end in [1.0, 10.0, 1e4] {
        for part in [0.002, 0.02, 0.05] {
            for place in [0.31, 0.53, 0.69] {
                for tolerance in [1e-6, 1e-9, 1e-12] {
                    let w = part * end;
                    let push = move |t: f64, _: &_, _: &_| {
                        let tau = (t - place * end) / w;
                        SVector::from([(-tau * tau).exp()])
                    };
                    let run = Simulation::new(&kernel).input(push).adaptive(tolerance, tolerance);
                    let run = run.run([0.0].into(), [0.0].into(), 0.0..end).expect("runs");
                    let wanted = w * std::f64::consts::PI.sqrt() / 0.5;
                    let v = run.last().z[0];
                    let near = 100.0 * tolerance * (1.0 + wanted);
                    assert!((v - wanted).abs() < near, "{end} {part} {place} {tolerance}: {v} {wanted}");
                }
            }
        }
    }
}
