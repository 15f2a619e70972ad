//! Steps of stiff dampers between stops: a speed that forces would turn back within a step leads to no stop that the
//! motion does not reach.

use gauss_contact::{ContactErrorKind, ContactLanes, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::prelude::*;

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];

/// A slider in a damper between two walls, pushed by a force.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    damping = 0.5 * c * rate(x) * rate(x),
    drive(x = push),
    contact(behind, gap = x + back, restitution = e),
    contact(ahead, gap = front - x, restitution = e),
)]
struct Slider {
    m: f64,
    c: f64,
    push: f64,
    back: f64,
    front: f64,
    e: f64,
}

/// A finger on a hinge with a damper and stops.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = m, position = [l * cos(angle), l * sin(angle), 0]),
    damping = 0.5 * c * rate(angle) * rate(angle),
    range(stops, along = angle, from = -1, to = 1),
)]
struct Finger<T> {
    m: T,
    l: T,
    c: T,
}

fn finger<T: Real>(c: T) -> FingerKernel<T> {
    Finger { m: T::from_f64(0.01), l: T::from_f64(0.0231), c }.kernel().unwrap()
}

/// A slider that is braked by the square of its speed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    drive(x = -k * abs(rate(x)) * rate(x)),
    range(stops, along = x, from = -1, to = 1),
)]
struct Dragged {
    m: f64,
    k: f64,
}

/// A slider with dry friction, whose law is smooth.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    drive(x = -f * tanh(rate(x) / 0.001)),
    range(stops, along = x, from = -1, to = 1),
)]
struct Rubbed {
    m: f64,
    f: f64,
}

/// The place of a slider at the end, or that it was refused for its speed; no stop may do work where none is reached.
macro_rules! end_of {
    ($kernel:expr, $scheme:expr, $h:expr, $v:expr, $steps:expr) => {{
        let (kernel, v) = (&$kernel, SVector::from([$v]));
        let steps = ContactSteps::new(kernel, $h).scheme($scheme);
        match steps.run(SVector::zeros(), v, 0.0..f64::from($steps) * $h) {
            Ok(run) => {
                let energy = kernel.kinetic_energy(0.0, &SVector::zeros(), &v);
                let work: f64 = run.iter().map(|step| step.report.work.abs()).sum();
                assert!(work <= energy, "stops do a work of {work:e} where there is {energy:e}");
                Some(run.last().unwrap().state.q[0])
            }
            Err(error) => {
                assert!(matches!(error.kind, ContactErrorKind::Stiff { speed: 0, .. }), "{error}");
                None
            }
        }
    }};
}

#[test]
fn a_damped_slider_comes_to_no_wall_behind_it() {
    let (m, v) = (0.05, 1.0);
    for scheme in SCHEMES {
        for c in [10.0, 40.0, 100.0, 500.0, 1e3, 1e4, 1e5, 1e6] {
            for h in [1e-4, 1e-3, 1.0 / 60.0, 0.1] {
                for back in [0.01, 1.0, 1e3] {
                    let kernel = Slider { m, c, push: 0.0, back, front: 1e3, e: 0.0 }.kernel().unwrap();
                    let Some(end) = end_of!(kernel, scheme, h, v, 20) else {
                        assert!(c * h / m > 16.0, "{scheme:?} {c} {h} {back}");
                        continue;
                    };
                    let exact = v * m / c * (1.0 - (-c * 20.0 * h / m).exp());
                    // What it goes in an eighth of a step, and steps of second order on what is followed whole.
                    let near = v * h / 8.0 + 0.02 * exact;
                    assert!((end - exact).abs() < near, "{scheme:?} {c} {h} {back}: {end} {exact}");
                }
            }
        }
    }
}

#[test]
fn a_door_is_not_shut_by_its_damper() {
    for scheme in SCHEMES {
        for v in [-1.0, 1.0] {
            for (m, h) in [(0.9, 1.0 / 60.0), (0.1, 1.0 / 60.0), (0.1, 0.1)] {
                let kernel = Slider { m, c: 1e3, push: 0.0, back: 0.5, front: 1.0, e: 0.0 }.kernel().unwrap();
                if let Some(end) = end_of!(kernel, scheme, h, v, 60) {
                    assert!((end - v * m / 1e3).abs() < h / 16.0, "{scheme:?} {v} {m} {h}: {end}");
                }
            }
        }
    }
}

#[test]
fn a_wall_that_is_reached_stops_what_is_damped() {
    for scheme in SCHEMES {
        for (c, h) in [(10.0, 1e-3), (100.0, 1e-3), (1e3, 1e-3), (1e3, 2e-3), (1e3, 0.01), (1e4, 0.1)] {
            let (m, v) = (0.05, 1.0);
            // A third of the way that it would go, and pushed to it from rest.
            for (push, v, front) in [(0.0, v, 0.3 * m / c), (c, 0.0, 0.3 * h), (c, 0.0, 2.5 * h), (c, 1.0, 2.5 * h)] {
                let kernel = Slider { m, c, push, back: 1.0, front, e: 0.0 }.kernel().unwrap();
                let (q, z) = (SVector::zeros(), SVector::from([v]));
                let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..40.0 * h);
                match run.map(|run| run.last().unwrap().state) {
                    Ok(end) => assert!((end.q[0] - front).abs() < 1e-9 && end.z[0] == 0.0, "{c} {h} {front}: {end:?}"),
                    // Too long for the damper, whatever it does to places first.
                    Err(error) => {
                        let is_stiff = matches!(error.kind, ContactErrorKind::Stiff { speed: 0, .. });
                        assert!(is_stiff && c * h / m > 16.0, "{scheme:?} {c} {h} {push} {front} {error}");
                    }
                }
            }
        }
    }
}

#[test]
fn forces_that_are_not_linear_lead_to_no_stop() {
    for scheme in SCHEMES {
        for h in [1e-3, 0.01, 0.1] {
            for m in [0.05, 1.0] {
                let kernel = Dragged { m, k: 100.0 }.kernel().unwrap();
                if let Some(end) = end_of!(kernel, scheme, h, 5.0, 20) {
                    let exact = m / 100.0 * (1.0 + 100.0 * 5.0 / m * 20.0 * h).ln();
                    // It never turns back, and goes no farther than by its first speed in a step.
                    assert!(end > 0.0 && end < exact + 5.0 * h, "{scheme:?} {h} {m}: {end} {exact}");
                }
                let kernel = Rubbed { m, f: 100.0 }.kernel().unwrap();
                if let Some(end) = end_of!(kernel, scheme, h, 5.0, 20) {
                    let t = (20.0 * h).min(5.0 * m / 100.0);
                    let exact = 5.0 * t - 100.0 / m * t * t / 2.0;
                    // By what it goes in a sixteenth of a step.
                    assert!((end - exact).abs() < 5.0 * h / 16.0 + 1e-4, "{scheme:?} {h} {m}: {end} {exact}");
                }
            }
        }
    }
}

#[test]
fn a_finger_stays_between_its_stops_in_lanes_as_alone() {
    type Eight = Lanes<f64, 8>;
    let dampings = [0.05, 0.01, 0.1, 1e-3, 0.5, 5.0, 1e-4, 0.2];
    let inertia = 0.01 * 0.0231 * 0.0231;
    for scheme in SCHEMES {
        for v in [5.0, -5.0, 50.0] {
            let kernels = dampings.map(finger::<f64>);
            let wide = finger(Eight::from_fn(|i| dampings[i]));
            let stepper = |i: usize| {
                let stepper = ContactStepper::new(&kernels[i], 0.0, SVector::zeros(), SVector::from([v])).unwrap();
                stepper.scheme(scheme)
            };
            let mut singles: Vec<_> = (0..8).map(stepper).collect();
            let mut lanes = ContactLanes::of(&wide, (0..8).map(stepper).collect()).unwrap();
            for n in 0..100 {
                let outcomes: Vec<_> = lanes.step(1e-2, &()).to_vec();
                for (lane, single) in singles.iter_mut().enumerate() {
                    assert_eq!(outcomes[lane], single.step(1e-2, &()), "{n} {lane}");
                    let other = &lanes.steppers()[lane];
                    assert_eq!((single.configuration(), single.speeds()), (other.configuration(), other.speeds()));
                }
            }
            for (lane, single) in singles.iter_mut().enumerate() {
                let exact = inertia * v / dampings[lane];
                if exact.abs() > 1.0 {
                    continue;
                }
                match single.step(1e-2, &()) {
                    Ok(_) => {
                        let end = single.configuration()[0];
                        assert!((end - exact).abs() < v.abs() * 1e-2 / 8.0, "{scheme:?} {v} {lane}: {end} {exact}");
                    }
                    Err(error) => {
                        assert!(matches!(error.kind, ContactErrorKind::Stiff { speed: 0, .. }), "{error}");
                        assert!(dampings[lane] * 1e-2 / inertia > 16.0, "{scheme:?} {v} {lane} {error}");
                    }
                }
            }
        }
    }
}
