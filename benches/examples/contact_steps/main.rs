//! Robots that stand, in steps of a millisecond: what a step costs, and what it does to the laws.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release -p gauss-benches --example contact_steps --features robots`;
//! `python benches/peers/contact_steps.py` has the same robots, feet, gains and steps in MuJoCo.
//!
//! Joints are held by torques `k (angle₀ − angle) − d rate`, taken at the start of each step. ANYmal stands on four
//! spheres, Talos on two soles with four corners each. Printed are the median of batches of 100 steps with the range of
//! the middle half, and over the last of three seconds the worst residual, the lowest gap and the way of the feet.

use std::error::Error;
use std::time::Instant;

use gauss_benches::measure::Spread;
use gauss_contact::{ContactStepper, StepReport};
use gauss_runtime::prelude::*;

/// A quadruped on spheres of 31 mm.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/anymal.urdf", base = floating, gravity = 9.81,
    point(lf, body = LF_KFE_link, at = [0.033, 0.01305, -0.33797]),
    point(lh, body = LH_KFE_link, at = [-0.033, 0.01305, -0.33797]),
    point(rf, body = RF_KFE_link, at = [0.033, -0.01305, -0.33797]),
    point(rh, body = RH_KFE_link, at = [-0.033, -0.01305, -0.33797]),
    contact(lf_foot, point = lf, radius = 0.031, friction = 0.8),
    contact(lh_foot, point = lh, radius = 0.031, friction = 0.8),
    contact(rf_foot, point = rf, radius = 0.031, friction = 0.8),
    contact(rh_foot, point = rh, radius = 0.031, friction = 0.8),
)]
struct Anymal;

/// A biped on the corners of its soles.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/talos.urdf", base = floating, gravity = 9.81, limit = 400000,
    point(left, body = leg_left_6_joint_link, at = [0, 0, -0.107]),
    point(right, body = leg_right_6_joint_link, at = [0, 0, -0.107]),
    contact(left_sole, point = left, edges = [0.2, 0.12, 0], friction = 0.8),
    contact(right_sole, point = right, edges = [0.2, 0.12, 0], friction = 0.8),
)]
struct Talos;

const STEP: f64 = 1e-3;
const BATCH: usize = 100;

/// Whether a robot still stands where it stood.
struct Standing {
    times: Vec<f64>,
    worst: f64,
    lowest: f64,
    way: f64,
    corrections: u32,
    steps: u32,
}

fn stand<K, const U: usize, const Z: usize>(
    kernel: &K,
    (base, angles): (Isometry3<f64>, SVector<f64, U>),
    (stiffness, damping): (SVector<f64, U>, SVector<f64, U>),
    feet: impl Fn(&K::Configuration) -> Vec<f64>,
) -> Result<Standing, Box<dyn Error>>
where
    K: ContactSystem<
            Scalar = f64,
            Configuration = (Isometry3<f64>, SVector<f64, U>),
            Speeds = SVector<f64, Z>,
            Input = SVector<f64, U>,
        >,
{
    let q = (base, angles);
    // From where it touches: down by the lowest gap.
    let gaps = kernel.gaps(0.0, &q);
    let lowest = (0..kernel.contacts().len()).map(|i| gaps.component(i)).fold(f64::INFINITY, f64::min);
    let mut base = base;
    base.translation.z -= lowest;
    let q = (base, angles);
    let mut stepper = ContactStepper::new(kernel, 0.0, q, SVector::zeros())?;
    let mut standing = Standing { times: Vec::new(), worst: 0.0, lowest: 0.0, way: 0.0, corrections: 0, steps: 0 };
    let mut start = Vec::new();
    let count = 3000;
    for batch in 0..count / BATCH {
        if batch * BATCH == 2 * count / 3 {
            start = feet(stepper.configuration());
        }
        let mut reports = [StepReport::default(); BATCH];
        let clock = Instant::now();
        for report in &mut reports {
            let (q, z) = (stepper.configuration().1, stepper.speeds().fixed_rows::<U>(6).into_owned());
            let input = stiffness.component_mul(&(angles - q)) - damping.component_mul(&z);
            *report = stepper.step(STEP, &input)?;
        }
        standing.times.push(1e6 * clock.elapsed().as_secs_f64() / BATCH as f64);
        if !start.is_empty() {
            for report in reports {
                let residual = report.residual;
                standing.worst = standing.worst.max(residual.signorini).max(residual.coulomb).max(residual.dissipation);
                standing.corrections += report.corrections;
                standing.steps += 1;
            }
            let gaps = kernel.gaps(0.0, stepper.configuration());
            (0..kernel.contacts().len()).for_each(|i| standing.lowest = standing.lowest.min(gaps.component(i)));
        }
    }
    let end = feet(stepper.configuration());
    standing.way = end.iter().zip(&start).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    Ok(standing)
}

fn report(name: &str, standing: &Standing) {
    let time = Spread::of(standing.times.clone());
    println!(
        "{name}: {:.2} µs a step ({:.2} to {:.2}); residual {:.0e} m/s, lowest gap {:.0e} m, feet move {:.0e} m in a \
         second; {:.2} corrections a step",
        time.median,
        time.lower,
        time.upper,
        standing.worst,
        standing.lowest,
        standing.way,
        f64::from(standing.corrections) / f64::from(standing.steps)
    );
}

/// Places of contacts.
fn places<K: ContactSystem<Scalar = f64>>(kernel: &K, q: &K::Configuration) -> Vec<f64> {
    let frames = (0..kernel.contacts().len()).filter_map(|i| kernel.contact_frame(i, 0.0, q));
    frames.flat_map(|frame| [frame.point.x, frame.point.y, frame.point.z]).collect()
}

/// All robots, or those that are named.
fn is_wanted(name: &str) -> bool {
    let mut names = std::env::args().skip(1).peekable();
    names.peek().is_none() || names.any(|wanted| wanted == name)
}

fn main() -> Result<(), Box<dyn Error>> {
    if is_wanted("anymal") {
        anymal()?;
    }
    if is_wanted("talos") {
        talos()?;
    }
    Ok(())
}

fn anymal() -> Result<(), Box<dyn Error>> {
    let kernel = Anymal.kernel()?;
    let leg = |side: f64| [0.0, 0.6 * side, -1.1 * side];
    // In the order of the file: left fore, left hind, right fore, right hind.
    let angles: Vec<f64> = [1.0, -1.0, 1.0, -1.0].into_iter().flat_map(leg).collect();
    let start = (Isometry3::translation(0.0, 0.0, 0.6), SVector::<f64, 12>::from_column_slice(&angles));
    let gains = (SVector::repeat(200.0), SVector::repeat(4.0));
    report("ANYmal", &stand(&kernel, start, gains, |q| places(&kernel, q))?);
    println!("  {}", AnymalKernel::OPERATIONS.impulse_dynamics);
    Ok(())
}

fn talos() -> Result<(), Box<dyn Error>> {
    let kernel = Talos.kernel()?;
    let mut angles = SVector::<f64, 32>::zeros();
    for leg in [0, 6] {
        (angles[leg + 2], angles[leg + 3], angles[leg + 4]) = (-0.4, 0.8, -0.4);
    }
    let gain = |i: usize| match i {
        0..14 => [2000.0, 20.0],
        21 | 29 => [5.0, 0.05],
        14..30 => [100.0, 1.0],
        _ => [20.0, 0.2],
    };
    let gains = (SVector::from_fn(|i, _| gain(i)[0]), SVector::from_fn(|i, _| gain(i)[1]));
    let start = (Isometry3::translation(0.0, 0.0, 1.1), angles);
    report("Talos", &stand(&kernel, start, gains, |q| places(&kernel, q))?);
    println!("  {}", TalosKernel::OPERATIONS.impulse_dynamics);
    Ok(())
}
