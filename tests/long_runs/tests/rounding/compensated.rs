//! How rounding errors grow with the number of steps, carried and not.

use gauss_long_runs::steps;
use gauss_runtime::integrate::{Collocation, Compensated, Fixed, Simulation, Tableau};
use gauss_runtime::prelude::*;
use gauss_runtime::system::Smoothness;

use crate::testing::order::{NONE, TOP, start_by_velocity};
use crate::testing::oscillator::{ForceLaw, Oscillator};

/// No force beside the spring.
struct Nothing;

impl ForceLaw for Nothing {
    const SMOOTHNESS: Smoothness = Smoothness::Smooth;
    fn force(_: f64, _: f64) -> f64 {
        0.0
    }
}

type One = SVector<f64, 1>;

const SPRING: Oscillator<Nothing> = Oscillator::new(0.0);

fn undriven(_: f64, _: &One, _: &One) -> f64 {
    0.0
}

/// A power of two, so that times and the coefficients ½ cost no rounding.
const STEP: f64 = 1.0 / 64.0;

/// (x, ẋ) after n steps of the classical method of order 4 without rounding. A step multiplies x − iẋ by P(ih), the
/// exponential's Taylor polynomial; `log P(ih) = ih + log(1 − r)`, `r = e^{−ih} Σ_{k>4} (ih)^k/k!`, has no
/// cancellation.
fn exact_numbers(x: f64, v: f64, n: f64) -> [f64; 2] {
    let (mut power, mut rest, mut factorial) = ([1.0, 0.0], [0.0, 0.0], 1.0);
    for k in 1..16 {
        power = [-STEP * power[1], STEP * power[0]];
        factorial *= f64::from(k);
        if k > 4 {
            rest = [rest[0] + power[0] / factorial, rest[1] + power[1] / factorial];
        }
    }
    let (sine, cosine) = STEP.sin_cos();
    let r = [rest[0] * cosine + rest[1] * sine, rest[1] * cosine - rest[0] * sine];
    // |r| is 8e-12: log(1 − r) = −r − r²/2 with nothing left.
    let growth = -r[0] - 0.5 * (r[0] * r[0] - r[1] * r[1]);
    let lag = -r[1] - r[0] * r[1];
    // The angles n h and n·lag are turned by one after the other: the first is exact.
    let turn = |[x, v]: [f64; 2], angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        [x * cosine + v * sine, v * cosine - x * sine]
    };
    turn(turn([x, v], n * STEP), n * lag).map(|c| c * (n * growth).exp())
}

/// Root mean square over eight starts of the error of x and ẋ after n steps, carried and not.
fn rounding(n: u32) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for start in 0..8 {
        let (v, x) = (0.3 + 0.7 * f64::from(start)).sin_cos();
        let exact = exact_numbers(x, v, f64::from(n));
        let (q, z, end) = (SVector::from([x]), SVector::from([v]), f64::from(n) * STEP);
        let run = Simulation::new(&SPRING).input(undriven);
        let carried = run.control(Compensated::with(&Tableau::RK4, STEP)).run_to_end(q, z, 0.0..end).expect("runs");
        let plain = run.control(Fixed::with(&Tableau::RK4, STEP)).run_to_end(q, z, 0.0..end).expect("runs");
        for (square, end) in squares.iter_mut().zip([carried, plain]) {
            *square += (end.q[0] - exact[0]).powi(2) + (end.z[0] - exact[1]).powi(2);
        }
    }
    squares.map(|square| (square / 8.0_f64).sqrt())
}

/// What is to be expected of errors that are independent of each other: each of n increments is of the size h and has
/// one rounding ε or so, and the last sum is rounded.
fn expected(n: u32) -> f64 {
    f64::EPSILON * (1.0 + STEP * f64::from(n).sqrt())
}

#[test]
fn rounding_grows_like_the_root_of_the_number_of_steps() {
    for n in [1 << 12, 1 << 14, steps(1 << 18)] {
        let [carried, plain] = rounding(n);
        assert!(carried < expected(n), "{n}: {carried:e}");
        assert!(plain > 20.0 * carried, "{n}: {carried:e}, not carried {plain:e}");
    }
}

/// Gauss' method keeps quadratic integrals but for rounding: in the momentum form T and |p|².
#[test]
fn quadratic_integrals_are_kept_to_rounding() {
    let start = start_by_velocity();
    let p0 = TOP.momentum(0.0, &start.q, &start.y);
    let energy = TOP.kinetic_energy(0.0, &start.q, &start.y);
    let n = steps(1 << 16);
    let run = Simulation::new(&TOP).input_from(NONE).momentum_form();
    let end = run.control(Compensated::by(Collocation::order_6(), STEP));
    let end = end.run_to_end(start.q, start.y, 0.0..f64::from(n) * STEP).expect("runs");
    // Of T and |p|² the relative error is twice that of p.
    let errors =
        [TOP.kinetic_energy(0.0, &end.q, &end.z) / energy - 1.0, end.p.norm_squared() / p0.norm_squared() - 1.0];
    assert!(errors.iter().all(|error| error.abs() < 2.0 * expected(n)), "{errors:?}");
    let norm: f64 = end.q.coords.norm_squared();
    assert!((norm - 1.0).abs() <= 4.0 * f64::EPSILON, "{norm}");
}

/// Coefficients of many digits and a step that is not a power of two: each product would be rounded the same way in
/// every step.
#[test]
fn rounded_coefficients_do_not_add_up() {
    let start = start_by_velocity();
    let energy = TOP.kinetic_energy(0.0, &start.q, &start.y);
    let n = steps(1 << 19);
    let run = Simulation::new(&TOP).input_from(NONE).control(Compensated::with(&Tableau::DORMAND_PRINCE_8, 1.0 / 60.0));
    let end = run.run_to_end(start.q, start.y, 0.0..f64::from(n) / 60.0).expect("runs");
    let error = TOP.kinetic_energy(0.0, &end.q, &end.z) / energy - 1.0;
    // As above, the increment's rounding as often as it has stages.
    let rounding = f64::EPSILON * (1.0 + (12.0 * f64::from(n)).sqrt() / 60.0);
    assert!(error.abs() < rounding, "{error:e} {rounding:e}");
}

/// What holds the norm of an attitude is rounded with the step and not after it: momentum in space walks, and does not
/// drift.
#[test]
fn attitudes_do_not_drift() {
    let start = start_by_velocity();
    let momentum = start.q * TOP.momentum(0.0, &start.q, &start.y);
    let n = steps(1 << 18);
    let run = Simulation::new(&TOP).input_from(NONE).momentum_form();
    let run = run.control(Fixed::by(Collocation::order_6(), STEP));
    let end = run.run_to_end(start.q, start.y, 0.0..f64::from(n) * STEP).expect("runs");
    let error = (end.q * end.p - momentum).norm() / momentum.norm();
    // A step rounds four components by ε/4 or less each, in ways that do not repeat.
    let rounding = f64::EPSILON * f64::from(n).sqrt();
    assert!(error < rounding, "{error:e} {rounding:e}");
}
