//! What the energy–momentum method keeps of a top typed by hand, over up to 10⁵ steps.

use gauss_long_runs::steps;
use gauss_runtime::integrate::{
    Compensated, Composed, Composition, EnergyMomentum, Feedback, OneStep, Simulation, State, SystemProblem,
};
use gauss_runtime::prelude::*;

use crate::testing::FreeTop;
use crate::testing::order::{NONE, TOP, Torque, WEIGHT, march, start_by_momentum, start_by_velocity};

fn method() -> EnergyMomentum<f64> {
    EnergyMomentum::new()
}

type TopState = State<FreeTop<f64>>;

fn in_space(state: &TopState) -> Vector3<f64> {
    state.q * state.y
}

/// |slope| of a line through the deviations of evenly spaced samples, per step.
fn slope(samples: &[f64], steps: u32) -> f64 {
    let n = samples.len() as f64;
    let mean = samples.iter().sum::<f64>() / n;
    let middle = 0.5 * (n - 1.0);
    let (mut over, mut under) = (0.0, 0.0);
    for (i, sample) in samples.iter().enumerate() {
        over += (i as f64 - middle) * (sample - mean);
        under += (i as f64 - middle).powi(2);
    }
    (over / under).abs() * n / f64::from(steps)
}

/// The largest deviation of what is kept is a walk of roundings, and has no slope beyond that of a walk.
fn stays<const K: usize>(
    method: &impl OneStep<FreeTop<f64>>,
    input: Feedback<Torque>,
    kept: impl Fn(&TopState) -> [f64; K],
    h: f64,
    roundings: f64,
) {
    let steps = steps(100_000);
    let every = steps / 100;
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input };
    let mut state = start_by_momentum();
    let first = kept(&state);
    let mut deviations = [const { Vec::new() }; K];
    for _ in 0..steps / every {
        state = march(method, &problem, &state, f64::from(every) * h, every);
        for (all, (now, then)) in deviations.iter_mut().zip(kept(&state).into_iter().zip(first)) {
            all.push(now - then);
        }
    }
    let walk = roundings * f64::EPSILON * f64::from(steps).sqrt();
    for all in &deviations {
        let worst = all.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        assert!(worst < walk, "{worst:e} {walk:e}");
        // A walk that ends at w has a slope of about w over its steps.
        assert!(slope(all, steps) < walk / f64::from(steps), "{:e}", slope(all, steps));
    }
}

/// The energy of [`WEIGHT`], and momentum in space.
fn heavy(state: &TopState) -> [f64; 2] {
    let z = TOP.velocity(0.0, &state.q, &state.y);
    let up = state.q.inverse() * Vector3::z();
    [TOP.kinetic_energy(0.0, &state.q, &z) + 0.6 * up[2], in_space(state)[2]]
}

#[test]
fn free_bodies_keep_energy_and_momentum() {
    let kept = |state: &TopState| {
        let z = TOP.velocity(0.0, &state.q, &state.y);
        let l = in_space(state);
        [TOP.kinetic_energy(0.0, &state.q, &z), l[0], l[1], l[2]]
    };
    stays(&method(), NONE, kept, 0.05, 4.0);
}

#[test]
fn heavy_bodies_keep_energy_and_the_vertical_momentum() {
    stays(&method(), WEIGHT, heavy, 0.05, 4.0);
    // Nine steps in one, each with its rounding.
    stays(&Composed::new(&Composition::KAHAN_LI_6, method()), WEIGHT, heavy, 0.2, 12.0);
}

/// V = (e₃·k)² + ½ (e₁·k)³: neither linear in the axes nor smooth enough for few points, and still symmetric about k.
const CURVED: Feedback<Torque> = Feedback(|_, q, _| {
    let up = q.inverse() * Vector3::z();
    // Torque up × ∂V/∂up.
    let slope = Vector3::new(1.5 * up[0] * up[0], 0.0, 2.0 * up[2]);
    up.cross(&slope).into()
});

fn curved(state: &TopState) -> [f64; 2] {
    let z = TOP.velocity(0.0, &state.q, &state.y);
    let up = state.q.inverse() * Vector3::z();
    let potential = up[2] * up[2] + 0.5 * up[0].powi(3);
    [TOP.kinetic_energy(0.0, &state.q, &z) + potential, in_space(state)[2]]
}

#[test]
fn other_potentials_are_kept_with_more_points() {
    stays(&EnergyMomentum::<f64, 6>::with_points(), CURVED, curved, 0.05, 4.0);
    // With two points momentum is kept as well, energy to order h⁴ and without drift.
    stays(&method(), CURVED, |state| [curved(state)[1]], 0.05, 4.0);
    let problem = SystemProblem { system: &TOP, form: MomentumForm, input: CURVED };
    let largest = |h: f64| {
        let (mut state, mut halves) = (start_by_momentum(), [0.0_f64; 2]);
        let steps = (400.0 / h) as u32;
        for n in 0..steps {
            state = march(&method(), &problem, &state, h, 1);
            let worst = &mut halves[usize::from(2 * n >= steps)];
            *worst = worst.max((curved(&state)[0] - curved(&start_by_momentum())[0]).abs());
        }
        assert!(halves[1] < 1.5 * halves[0], "{halves:?}");
        halves[0]
    };
    let order = (largest(0.2) / largest(0.1)).log2();
    assert!((order - 4.0).abs() < 0.5, "{order}");
}

/// Carried, increments make less rounding.
#[test]
fn carried_increments_make_less_rounding() {
    let run = |control| Simulation::new(&TOP).input_from(NONE).momentum_form().control(control);
    let (start, n) = (start_by_velocity(), f64::from(steps(100_000)));
    let end = run(Compensated::by(method(), 0.05)).run_to_end(start.q, start.y, 0.0..0.05 * n).expect("runs");
    let drift = (end.q * end.p - start.q * TOP.momentum(0.0, &start.q, &start.y)).amax();
    // One rounding of q and p at the end, and a walk of √n h ε.
    assert!(drift < (4.0 + 0.05 * 4.0 * n.sqrt()) * f64::EPSILON, "{drift:e}");
}
