//! Drag in flight, up to forces that take a hundred times the momentum in a step: steps are right or refused.

use gauss_contact::{ContactErrorKind, ContactStepper, ContactSteps, StepScheme};
use gauss_runtime::prelude::*;

const SCHEMES: [StepScheme; 2] = [StepScheme::Midpoint, StepScheme::MoreauJean];

/// A particle braked by the square of its speed, far from a floor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y, z),
    particle(mass = m, position = [x, y, z]),
    drive(x = -d * sqrt(powi(rate(x), 2) + powi(rate(y), 2) + powi(rate(z), 2)) * rate(x),
        y = -d * sqrt(powi(rate(x), 2) + powi(rate(y), 2) + powi(rate(z), 2)) * rate(y),
        z = -d * sqrt(powi(rate(x), 2) + powi(rate(y), 2) + powi(rate(z), 2)) * rate(z)),
    contact(floor, gap = z),
)]
struct Dragged {
    m: f64,
    d: f64,
}

/// The same with a crate that lies on a table.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, 0, 0]),
    particle(mass = 2, position = [0, y, 0]),
    drive(x = -d * abs(rate(x)) * rate(x), y = -19.62),
    contact(wall, gap = x),
    contact(table, gap = y),
)]
struct Beside {
    m: f64,
    d: f64,
}

/// The part of a speed that is left after steps of which each has `c = d v h/m` at the first speed v.
fn exact(c: f64, steps: usize) -> f64 {
    1.0 / (1.0 + c * steps as f64)
}

/// How far that may be from the part that steps leave. Of a part with c′ = c/16 a step of second order with the curve
/// of the speed leaves less than `1/(1 + c′) + 0.12 c′²/(1 + c′)²`; what is off then is forgotten, since 1/v grows
/// evenly.
fn near(c: f64, steps: usize) -> f64 {
    0.12 * exact(c, steps)
}

macro_rules! is_braked {
    ($kernel:expr, $start:expr, $scheme:expr, $h:expr, $c:expr) => {{
        let (kernel, (q, z), c) = (&$kernel, $start, $c);
        match ContactSteps::new(kernel, $h).scheme($scheme).run(q, z, 0.0..20.0 * $h) {
            Ok(run) => {
                let mut before = z[0];
                for (n, step) in run.iter().enumerate() {
                    let (now, left) = (step.state.z[0], step.state.z[0] / z[0]);
                    assert!(left > 0.0 && now <= before, "{:?} {c} {n}: {left}", $scheme);
                    let off = left - exact(c, n + 1);
                    assert!(off.abs() < near(c, n + 1), "{:?} {c} {} {n}: {left} {}", $scheme, $h, exact(c, n + 1));
                    before = now;
                }
                true
            }
            Err(error) => {
                assert!(matches!(error.kind, ContactErrorKind::Stiff { speed, .. } if speed < 3), "{error}");
                assert!(c > 50.0, "{:?} {c} {}: {error}", $scheme, $h);
                false
            }
        }
    }};
}

#[test]
fn square_drag_brakes_as_it_should_or_is_refused() {
    for scheme in SCHEMES {
        for c in [0.1, 1.0, 5.0, 20.0, 100.0, 1e4] {
            for (h, m, v) in [(1e-3, 0.05, 10.0), (1.0 / 60.0, 2.0, 1.0), (1e-3, 1e-6, 1e-6), (1.0 / 60.0, 1e6, 1e4)] {
                let kernel = Dragged { m, d: c * m / (v * h) }.kernel().unwrap();
                let start = (SVector::from([0.0, 0.0, 1e3 * v]), SVector::from([0.6 * v, 0.0, 0.8 * v]));
                is_braked!(kernel, start, scheme, h, c);
                let kernel = Beside { m, d: c * m / (v * h) }.kernel().unwrap();
                let start = (SVector::from([0.0, 0.0]), SVector::from([v, 0.0]));
                is_braked!(kernel, start, scheme, h, c);
            }
        }
    }
}

/// A slider in a damper before a wall that gives back half of its speed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    damping = 0.5 * c * rate(x) * rate(x),
    contact(wall, gap = x, restitution = 0.5),
)]
struct Bouncing {
    m: f64,
    c: f64,
}

#[test]
fn what_is_damped_and_bounces_gains_nothing() {
    let (m, v) = (0.2, 3.0);
    for scheme in SCHEMES {
        for c in [0.0, 0.1, 1.0, 10.0, 100.0, 1e4] {
            for h in [1e-3, 1.0 / 60.0] {
                for part in [0.01, 0.3, 0.6, 0.99] {
                    let kernel = Bouncing { m, c: c * m / h }.kernel().unwrap();
                    let (q, z) = (SVector::from([part * v * h]), SVector::from([-v]));
                    let mut stepper = ContactStepper::new(&kernel, 0.0, q, z).unwrap().scheme(scheme);
                    let mut before = v;
                    for n in 0..40 {
                        let approach = stepper.speeds()[0];
                        if let Err(error) = stepper.step(h, &()) {
                            let is_stiff = matches!(error.kind, ContactErrorKind::Stiff { speed: 0, .. });
                            assert!(is_stiff && c > 16.0, "{scheme:?} {c} {h} {part} {n}: {error}");
                            break;
                        }
                        let (x, now) = (stepper.configuration()[0], stepper.speeds()[0]);
                        // What is left at last is rounding of places.
                        let rests = now.abs() <= before + 1e-12 * v && x >= -1e-12 * v;
                        assert!(rests, "{scheme:?} {c} {h} {part} {n}: {x} {now:e} {before:e}");
                        // Newton's law passes on half of the speed that arrives, and the damper takes of it.
                        assert!(
                            now <= -0.5 * approach.min(0.0) + approach.max(0.0) + 1e-12,
                            "{c} {h} {part} {n} {now}"
                        );
                        before = now.abs();
                    }
                }
            }
        }
    }
}
