//! Laws of contact by which the cube comes to rest, each with its derivatives in dual numbers.

use std::error::Error;

use gauss_contact::{ContactRun, ContactStepper, StepScheme};
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::prelude::*;

use crate::model::{Cube, EDGE, G, MASS, Number, Numbers, Throw, WATCHED};

type Found = Result<Number, Box<dyn Error>>;
/// Where the cube comes to rest.
pub type Law = fn(&Numbers) -> Found;

/// Coulomb's friction and impacts, and laws in their place.
pub const LAWS: [(&str, Law); 5] =
    [("events", events), ("steps", steps), ("relaxed", relaxed), ("soft", soft), ("springs", springs)];

/// The length of steps, s.
pub const STEP: f64 = 2e-3;

/// Coulomb's law from event to event: times of impacts and stops have their derivatives.
fn events(numbers: &Numbers) -> Found {
    let (kernel, push) = (Throw::cube(numbers).kernel()?, numbers[3]);
    let (q, z) = Throw::start(numbers);
    let run = ContactRun::new(&kernel).input(move |_, _, _| [push].into()).adaptive(1e-10, 1e-10);
    let run = run.run(q, z, Number::constant(0.0)..Number::constant(WATCHED))?;
    Ok(run.last().ok_or("no end")?.q[0])
}

/// Coulomb's law in steps: derivatives of each step, one after the other.
fn steps(numbers: &Numbers) -> Found {
    let plain = Cube { m: MASS, a: EDGE, mu: numbers[2].value, g: G }.kernel()?;
    // Of parameters, friction is number 0 of a step.
    let dual = Throw::cube(&[numbers[0], numbers[1], Number::variable(numbers[2].value, 0), numbers[3]]).kernel()?;
    let (q, z) = Throw::start(numbers);
    let mut by_numbers = SMatrix::<f64, 6, 4>::from_fn(|row, k| if row < 3 { q[row] } else { z[row - 3] }.slopes[k]);
    let value = |x: Number| x.value;
    let mut stepper = ContactStepper::new(&plain, 0.0, q.map(value), z.map(value))?.scheme(StepScheme::MoreauJean);
    for _ in 0..(WATCHED / STEP).round() as usize {
        let input = [numbers[3].value].into();
        let step = stepper.step_with_derivatives::<_, 4, 6, 1, 1>(STEP, &input, &dual)?;
        let slopes = |number: Number| SMatrix::<f64, 1, 4>::from(number.slopes);
        by_numbers =
            step.by_state * by_numbers + step.by_parameters * slopes(numbers[2]) + step.by_input * slopes(numbers[3]);
    }
    Ok(Number { value: stepper.configuration()[0], slopes: core::array::from_fn(|k| by_numbers[(0, k)]) })
}

/// What a convex law is made of.
#[derive(Clone, Copy)]
enum Convex {
    /// M. Anitescu 2006: gaps are to open by ġ ≥ μ|s|, which makes the problem convex.
    Relaxed,
    /// The same with impulses that cost something, and a spring and a damper for what gaps do, as of MuJoCo (E. Todorov
    /// 2014), with its usual numbers: an impedance of 0.9, a time of 0.02 s.
    Soft,
}

fn relaxed(numbers: &Numbers) -> Found {
    convex(numbers, Convex::Relaxed)
}

fn soft(numbers: &Numbers) -> Found {
    convex(numbers, Convex::Soft)
}

/// Sweeps of a convex problem.
const SWEEPS: usize = 60;

/// Steps whose impulses make ½ PᵀDP + bᵀP least in the cones |P_T| ≤ μ P_N.
fn convex(numbers: &Numbers, law: Convex) -> Found {
    let kernel = Throw::cube(numbers).kernel()?;
    let (mut q, mut z) = Throw::start(numbers);
    let (mu, push, h) = (numbers[2], [numbers[3]].into(), Number::constant(STEP));
    let zero = Number::constant(0.0);
    for _ in 0..(WATCHED / STEP).round() as usize {
        let dynamics = kernel.contact_dynamics(zero, &q, &z, &push);
        let free = z + dynamics.acceleration * h;
        let (gaps, rates) = (kernel.gaps(zero, &q), kernel.contact_rates(zero, &q, &free));
        let before = kernel.contact_rates(zero, &q, &z);
        let d = &dynamics.response.delassus;
        let (mut b, mut softer) = (rates, [zero; 8]);
        for i in 0..4 {
            match law {
                Convex::Relaxed => b[2 * i] += gaps[i] / h,
                Convex::Soft => {
                    let (impedance, time) = (0.9, 0.02);
                    let damping = Number::constant(2.0 / (impedance * time));
                    let stiffness = Number::constant(1.0 / (impedance * time).powi(2));
                    for row in [2 * i, 2 * i + 1] {
                        b[row] += h * damping * before[row] - before[row];
                        softer[row] = d[(row, row)] * Number::constant((1.0 - impedance) / impedance);
                    }
                    b[2 * i] += h * stiffness * gaps[i];
                }
            }
        }
        // MuJoCo knows contacts that touch; the relaxation all that may.
        let acts = |i: usize| matches!(law, Convex::Relaxed) || gaps[i].value <= 0.0;
        let mut impulses = SVector::<Number, 8>::repeat(zero);
        for _ in 0..SWEEPS {
            for i in (0..4).filter(|i| acts(*i)) {
                let [normal, tangent] = [2 * i, 2 * i + 1].map(|row| {
                    let rate = (0..8).fold(b[row] + softer[row] * impulses[row], |u, j| u + d[(row, j)] * impulses[j]);
                    impulses[row] - rate / (d[(2 * i, 2 * i)] + d[(2 * i + 1, 2 * i + 1)] + softer[row])
                });
                (impulses[2 * i], impulses[2 * i + 1]) = nearest(normal, tangent, mu);
            }
        }
        z = (0..8).fold(free, |z, row| z + dynamics.response.columns.column(row) * impulses[row]);
        q += z * h;
    }
    Ok(q[0])
}

/// The point of the cone |t| ≤ μ n that is nearest.
fn nearest(n: Number, t: Number, mu: Number) -> (Number, Number) {
    let size = t.abs();
    if size.value <= mu.value * n.value {
        return (n, t);
    }
    if mu.value * size.value <= -n.value {
        return (Number::constant(0.0), Number::constant(0.0));
    }
    let pressed = (n + mu * size) / (Number::constant(1.0) + mu * mu);
    (pressed, mu * pressed * t.signum())
}

/// Springs and dampers in the place of contacts, and friction that grows with the slip up to its bound: smooth but for
/// the gap, in steps a tenth as long.
fn springs(numbers: &Numbers) -> Found {
    let kernel = Throw::cube(numbers).kernel()?;
    let (mut q, mut z) = Throw::start(numbers);
    let (mu, push) = (numbers[2], [numbers[3]].into());
    let number = Number::constant;
    let (zero, h, stiffness, damping, creep) =
        (number(0.0), number(0.1 * STEP), number(2e4), number(200.0), number(1e-2));
    for _ in 0..(10.0 * WATCHED / STEP).round() as usize {
        let dynamics = kernel.contact_dynamics(zero, &q, &z, &push);
        let (gaps, rates) = (kernel.gaps(zero, &q), kernel.contact_rates(zero, &q, &z));
        let mut forces = SVector::<Number, 8>::repeat(zero);
        for i in (0..4).filter(|i| gaps[*i].value < 0.0) {
            let pressed = (-stiffness * gaps[i] - damping * rates[2 * i]).max(zero);
            let slip = rates[2 * i + 1];
            forces[2 * i] = pressed;
            forces[2 * i + 1] = -mu * pressed * slip / (slip * slip + creep * creep).sqrt();
        }
        let columns = &dynamics.response.columns;
        z += (0..8).fold(dynamics.acceleration, |sum, row| sum + columns.column(row) * forces[row]) * h;
        q += z * h;
    }
    Ok(q[0])
}

/// The derivative by one number as differences of the law itself have it.
pub fn difference(law: Law, throw: &Throw, k: usize) -> Result<f64, Box<dyn Error>> {
    let at = |by: f64| {
        let mut numbers = throw.numbers.map(Number::constant);
        numbers[k].value += by;
        law(&numbers).map(|x| x.value)
    };
    // Heights and speeds of zero have one side alone.
    let by = 1e-4;
    if throw.numbers[k] == 0.0 { Ok((at(by)? - at(0.0)?) / by) } else { Ok((at(by)? - at(-by)?) / (2.0 * by)) }
}
