//! Nanoseconds per evaluation of generated code.
//!
//! Batches of all candidates take turns, so that a change of the processor's clock hits each of them alike. A batch
//! evaluates 256 different states of the motion, each passed through `black_box`: loading and storing a state is part
//! of the time.

use std::hint::black_box;
use std::time::Instant;

use gauss_runtime::chart::ChartError;
use gauss_runtime::description::OperationCount;

use crate::measure::Fleet;
use crate::simulate::{Moment, Run, Vessel};
use crate::statistics::quartiles;

/// One generated function.
#[derive(Clone, Debug)]
pub struct Timing {
    /// The chart as its users know it.
    pub name: &'static str,
    /// The method of [`GaussSystem`].
    pub method: &'static str,
    /// What one evaluation computes.
    pub operations: OperationCount,
    /// Quartiles over the batches, in ns per evaluation.
    pub quartiles: [f64; 3],
}

/// A function to be timed: one call is one batch.
struct Candidate<'k> {
    name: &'static str,
    method: &'static str,
    operations: OperationCount,
    batch: Box<dyn Fn() + 'k>,
    times: Vec<f64>,
}

/// States in a batch: few enough to stay in the first-level cache, enough that no two neighbours are predicted from
/// each other.
const STATES: usize = 256;

/// Times ż, ṗ and z(p) in every chart, at states of the given run; three results a chart, in this order.
///
/// # Errors
/// When a state of the run is singular in a chart.
pub fn time(fleet: &Fleet, run: &Run, batches: usize) -> Result<Vec<Timing>, ChartError> {
    let mut candidates = Vec::new();
    add(&mut candidates, "Kirchhoff", &fleet.kirchhoff, run)?;
    add(&mut candidates, "Newton–Euler", &fleet.newton_euler, run)?;
    add(&mut candidates, "hybrid", &fleet.hybrid, run)?;
    add(&mut candidates, "Lagrange (ψ, θ, φ)", &fleet.lagrange, run)?;

    // The first tenth warms up caches, branch predictors and the clock.
    for round in 0..batches + batches / 10 {
        for candidate in &mut candidates {
            let start = Instant::now();
            (candidate.batch)();
            let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / STATES as f64;
            if round >= batches / 10 {
                candidate.times.push(nanoseconds);
            }
        }
    }

    let finish = |candidate: Candidate<'_>| {
        let Candidate { name, method, operations, times, .. } = candidate;
        Timing { name, method, operations, quartiles: quartiles(times) }
    };
    Ok(candidates.into_iter().map(finish).collect())
}

fn add<'k, K: Vessel>(
    candidates: &mut Vec<Candidate<'k>>,
    name: &'static str,
    kernel: &'k K,
    run: &Run,
) -> Result<(), ChartError> {
    let state = |moment: &Moment| {
        let q = kernel.configuration(&moment.pose)?;
        let z = kernel.speeds(moment.t, &q, &moment.twist);
        Ok((moment.t, q, z, kernel.momentum(moment.t, &q, &z)))
    };
    let moments = run.moments.iter().cycle().take(STATES);
    let states: Vec<_> = moments.map(state).collect::<Result<_, ChartError>>()?;

    let (momenta, inverse) = (states.clone(), states.clone());
    let acceleration = move || {
        for (t, q, z, _) in &states {
            black_box(black_box(kernel).acceleration(black_box(*t), black_box(q), black_box(z), &()));
        }
    };
    let momentum_rate = move || {
        for (t, q, _, p) in &momenta {
            black_box(black_box(kernel).momentum_rate(black_box(*t), black_box(q), black_box(p), &()));
        }
    };
    let velocity = move || {
        for (t, q, _, p) in &inverse {
            black_box(black_box(kernel).velocity(black_box(*t), black_box(q), black_box(p)));
        }
    };
    let mut push = |method, operations, batch| {
        candidates.push(Candidate { name, method, operations, batch, times: Vec::new() });
    };
    push("acceleration", K::OPERATIONS.acceleration, Box::new(acceleration) as Box<dyn Fn() + 'k>);
    push("momentum_rate", K::OPERATIONS.momentum_rate, Box::new(momentum_rate));
    push("velocity", K::OPERATIONS.velocity, Box::new(velocity));
    Ok(())
}
