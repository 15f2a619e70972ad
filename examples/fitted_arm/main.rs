//! An arm that is first found and then swung: `cargo run --release --example fitted_arm [-- FOLDER]`.
//!
//! 1. Identification: three runs under known torques are recorded, angles with noise. Six numbers of the arm are those
//!    that fit all three best (Gauss–Newton), with their deviations: derivatives of runs, forward.
//! 2. Design: 120 torques swing the arm up to rest in less than four seconds with as little torque as can be: the
//!    gradient of one cost by all of them, backward, for the price of some tens of runs, whatever their count.
//!
//! The plan is made for the arm that was found, and flown on the true one.

use std::error::Error;
use std::time::Instant;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::{Fixed, RungeKutta};
use gauss_runtime::prelude::*;
use gauss_sensitivity::{Derivatives, Fit, SensitivityError};

mod descent;
mod model;

use descent::{Least, descend};
use model::{DURATION, INTERVALS, Kernel, NAMES, Planned, Recorded, TORQUES, TRUTH, arm};

type Steps = Fixed<f64, RungeKutta<Classical4, 4>>;

/// The steps of plans, s: four between two instants.
const PLANNED: f64 = 1.0 / 64.0;

/// Classical steps.
fn derivatives(step: f64) -> Derivatives<Steps> {
    Derivatives::by(Fixed::by(RungeKutta(Classical4), step))
}

/// A reproducible stream of normally distributed numbers (Box & Muller).
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// The true arm under torques, as its encoders see it.
fn record(torques: [[f64; 2]; 2], noise: &mut Normal) -> Result<Recorded, Box<dyn Error>> {
    let times: Vec<f64> = (0..=100).map(|n| 0.02 * f64::from(n)).collect();
    let mut run = Recorded { torques, times, angles: Vec::new(), deviation: 1e-3 };
    let exact = derivatives(0.005).run(&run, &TRUTH)?;
    run.angles = exact.iter().map(|point| [0, 1].map(|i| point.q[i] + run.deviation * noise.next())).collect();
    Ok(run)
}

fn identify() -> Result<Fit<6>, Box<dyn Error>> {
    let mut noise = Normal(1);
    let torques = [[[6.0, 3.0], [2.0, 5.0]], [[9.0, 2.0], [-3.0, 4.0]], [[-5.0, 6.0], [3.0, 2.5]]];
    let runs = torques.into_iter().map(|torques| record(torques, &mut noise)).collect::<Result<Vec<_>, _>>()?;
    let fit = derivatives(0.01).fit(&runs, &[0.2, 0.2, 0.3, 0.15, 0.3, 0.3])?;
    println!("{:12} {:>9} {:>9} {:>10} {:>16}", "number", "true", "found", "deviation", "error/deviation");
    for (k, deviation) in fit.deviations().into_iter().enumerate() {
        let (truth, found) = (TRUTH[k], fit.numbers[k]);
        println!("{:12} {truth:9.5} {found:9.5} {deviation:10.5} {:16.2}", NAMES[k], (found - truth) / deviation);
    }
    let freedom = 3 * 2 * 101 - 6;
    println!(
        "Gauss–Newton: {} iterations; χ² {:.0} of {freedom} ± {:.0}\n",
        fit.iterations,
        fit.misfit,
        f64::from(2 * freedom).sqrt()
    );
    Ok(fit)
}

/// The plan for an arm with these numbers, by ends that cost more and more.
fn plan(numbers: [f64; 6]) -> Result<(Planned, Least<TORQUES>), Box<dyn Error>> {
    let times = (0..=INTERVALS).map(|n| DURATION * n as f64 / INTERVALS as f64).collect();
    let mut run = Planned { numbers, times, weight: 1.0 };
    let mut least = Least { numbers: [0.1; TORQUES], value: f64::INFINITY, gradients: 0 };
    for weight in [1e2, 1e3, 1e4, 1e5] {
        run.weight = weight;
        let cost = |torques: &[f64; TORQUES]| {
            derivatives(PLANNED).gradient(&run, torques).map(|gradient| (gradient.value, gradient.by_numbers))
        };
        let gradients = least.gradients;
        least = descend(least.numbers, 1e-6, cost)?;
        least.gradients += gradients;
    }
    Ok((run, least))
}

/// What a gradient costs beside a run, and whether it is that of differences.
fn price(run: &Planned, torques: &[f64; TORQUES]) -> Result<bool, Box<dyn Error>> {
    let derivatives = derivatives(PLANNED);
    let kernel = arm(&run.numbers)?;
    let start = (SVector::from([-std::f64::consts::FRAC_PI_2, 0.0]), SVector::from([0.0; 2]));
    let steps = Fixed::by(RungeKutta(Classical4), PLANNED);
    let timed = |work: &mut dyn FnMut() -> Result<(), Box<dyn Error>>| {
        let begin = Instant::now();
        (0..20).try_for_each(|_| work()).map(|()| begin.elapsed().as_secs_f64() / 20.0 * 1e6)
    };
    let plain = timed(&mut || {
        let input = |t: f64, _: &_, _: &_| {
            let n = ((t * INTERVALS as f64 / DURATION) as usize).min(INTERVALS - 1);
            SVector::from([torques[2 * n], torques[2 * n + 1]])
        };
        Simulation::new(&kernel).input(input).control(steps).run_to_end(start.0, start.1, 0.0..DURATION)?;
        Ok(())
    })?;
    let gradient = derivatives.gradient(run, torques)?;
    let backward = timed(&mut || Ok(derivatives.gradient(run, torques).map(|_| ())?))?;
    let effort = gradient.effort;
    println!(
        "a run takes {plain:.0} µs, a gradient by {TORQUES} numbers {backward:.0} µs: {:.1} runs, not {}",
        backward / plain,
        TORQUES + 1
    );
    println!(
        "{} steps, {} more to come back to them, {} states and {} bytes kept",
        effort.steps, effort.repeated, effort.states, effort.bytes
    );
    // Central differences by a step and its double: what the step leaves out is a third of what they differ by. The
    // cost is known to the rounding of a state at its end, squared and weighted: 1e-9 at most, over the step.
    let mut right = true;
    for k in [0, 37, TORQUES - 1] {
        let at = |by: f64| {
            let mut moved = *torques;
            moved[k] += by;
            derivatives.gradient(run, &moved).map(|gradient| gradient.value)
        };
        let slope = |step: f64| Ok::<_, SensitivityError>((at(step)? - at(-step)?) / (2.0 * step));
        let (fine, coarse) = (slope(1e-4)?, slope(2e-4)?);
        right &= (fine - gradient.by_numbers[k]).abs() < (fine - coarse).abs() + 1e-9 / 1e-4;
    }
    Ok(right)
}

/// The true arm under the plan.
fn fly(kernel: &Kernel, run: &Planned, torques: &[f64; TORQUES]) -> Result<Vec<Sample<Kernel>>, Box<dyn Error>> {
    let mut path = Vec::new();
    let (mut q, mut z) = (SVector::from([-std::f64::consts::FRAC_PI_2, 0.0]), SVector::from([0.0; 2]));
    for (n, pair) in run.times.windows(2).enumerate() {
        let held = SVector::from([torques[2 * n], torques[2 * n + 1]]);
        let part = Simulation::new(kernel).input(|_, _, _| held).fixed_step(PLANNED).run(q, z, pair[0]..pair[1])?;
        path.extend(part.iter().skip(usize::from(n > 0)).copied());
        (q, z) = (part.last().q, part.last().z);
    }
    Ok(path)
}

fn page(path: &[Sample<Kernel>]) -> Playback<Kernel> {
    let turned = |angle: f64| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
    let link = |length: f64| Shape::rod([0.0; 3], [length, 0.0, 0.0], 0.025);
    Playback::of_samples("An arm that was identified swings up", path.to_vec())
        .up([0.0, 1.0, 0.0])
        .body("upper", move |s| Isometry3::from_parts(Translation3::identity(), turned(s.q[0])), [link(0.4)])
        .body(
            "lower",
            move |s| {
                let elbow = turned(s.q[0]) * Vector3::new(0.4, 0.0, 0.0);
                Isometry3::from_parts(elbow.into(), turned(s.q[0] + s.q[1]))
            },
            [link(0.35)],
        )
        .trace("lower", [0.35, 0.0, 0.0])
        .curve("angles / rad", "shoulder", |s| s.q[0])
        .curve("angles / rad", "elbow", |s| s.q[1])
}

fn picture(path: &[Sample<Kernel>], torques: &[f64; TORQUES]) -> Result<String, Box<dyn Error>> {
    let stairs = |first: usize| {
        (0..INTERVALS).flat_map(move |n| {
            let [from, to] = [n, n + 1].map(|n| DURATION * n as f64 / INTERVALS as f64);
            [(from, torques[2 * n + first]), (to, torques[2 * n + first])]
        })
    };
    let most = torques.iter().fold(0.0_f64, |most, torque| most.max(torque.abs())).ceil();
    let angle = |i: usize| path.iter().map(move |s| (s.t, s.q[i]));
    let time = || ("time, s", 0.0..DURATION);
    let names = ["shoulder", "elbow"];
    let lines = |of: [Vec<(f64, f64)>; 2]| {
        of.into_iter().enumerate().map(|(k, points)| Line::new(names[k], COLOURS[k], points)).collect()
    };
    let efforts =
        Plot::new("torques of the plan", time(), ("N m", -most..most), lines([0, 1].map(|k| stairs(k).collect())));
    let angles =
        Plot::new("angles of the true arm", time(), ("rad", -4.0..4.0), lines([0, 1].map(|k| angle(k).collect())));
    sheet("An arm that was identified swings up", (1100, 560), &[vec![efforts, angles]])
}

fn main() -> Result<(), Box<dyn Error>> {
    let fit = identify()?;
    let (run, least) = plan(fit.numbers)?;
    println!(
        "a plan of {TORQUES} torques: {} gradients; ∫ torque² dt and the end together {:.2}",
        least.gradients, least.value
    );
    let right = price(&run, &least.numbers)?;
    let path = fly(&arm(&TRUTH)?, &run, &least.numbers)?;
    let end = path.last().ok_or("no path")?;
    let missing = [end.q[0] - std::f64::consts::FRAC_PI_2, end.q[1], end.z[0], end.z[1]];
    println!("on the true arm the end is {missing:.4?} (rad, rad/s) from upright and at rest");
    write("fitted_arm", &picture(&path, &least.numbers)?)?;
    write_page("fitted_arm", &page(&path))?;
    let true_to = (0..6).all(|k| (fit.numbers[k] - TRUTH[k]).abs() < 4.0 * fit.deviations()[k]);
    let arrives = missing.iter().all(|missing| missing.abs() < 0.1);
    if right && true_to && arrives { Ok(()) } else { Err("the arm is not what was claimed".into()) }
}
