//! Derivatives of runs, forward and backward, at a state, of a step and of a chain of them, against differences.

use gauss_runtime::configuration::Configuration;
use gauss_runtime::integrate::{DiscreteLinearization, Feedback, OneStep, Problem, State, SystemProblem};
use gauss_runtime::linearize::Linearization;
use gauss_runtime::prelude::*;
use gauss_sensitivity::Derivatives;

use crate::runs::{Kernel, Q, Z, change, input, made, reference};
use crate::scenes::Scene;

/// The step of central differences: what they leave out is 1e-8 of the third derivative, what they round 1e-11.
const STEP: f64 = 1e-4;

fn difference<S: Scene>(end: impl Fn(f64) -> (Q<S>, Z<S>)) -> Vec<f64> {
    change::<S>(&end(-STEP), &end(STEP)).iter().map(|x| x / (2.0 * STEP)).collect()
}

/// Agreement to the third derivatives of motions whose rates are some ten.
fn agree(what: &str, found: f64, expected: f64, size: f64) {
    assert!((found - expected).abs() < 1e-5 * (1.0 + size), "{what}: {found:e} for {expected:e}");
}

/// Forward slopes beside differences, the gradient of the first speed beside them.
pub fn of_runs<S: Scene>(scene: &S) {
    let derivatives = Derivatives::adaptive(1e-11, 1e-12);
    let forward = derivatives.run(scene, &S::NUMBERS).unwrap();
    let backward = derivatives.gradient(scene, &S::NUMBERS).unwrap();
    for k in 0..2 {
        // A parameter is some ten or hundred.
        let scale = S::NUMBERS[k].abs().max(1.0);
        let expected = difference::<S>(|by| {
            let mut numbers = S::NUMBERS;
            numbers[k] += scale * by;
            reference(scene, &numbers, 1.0)
        });
        let slopes = forward[1].q_slopes.iter().chain(&forward[1].z_slopes).map(|row| scale * row[k]);
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (i, (found, expected)) in slopes.zip(&expected).enumerate() {
            agree(&format!("component {i} by number {k}"), found, *expected, size);
        }
        let first_speed = forward[1].z_slopes[0][k];
        let apart = (backward.by_numbers[k] - first_speed).abs();
        // The same sums in another order, over some hundred steps of a dozen stages.
        assert!(apart < 1e-9 * (1.0 + first_speed.abs()), "backward by {k}: {apart:e}");
    }
}

/// A state with component `i` of its increments changed, those of q before those of z.
fn varied<S: Scene>(q: &Q<S>, z: &Z<S>, i: usize, by: f64) -> (Q<S>, Z<S>) {
    let mut along = <Q<S> as Configuration>::Tangent::zero();
    let (mut faster, of_q) = (*z, <<Q<S> as Configuration>::Tangent as VectorSpace<f64>>::DIM);
    if i < of_q {
        along.set_component(i, by);
    } else {
        faster.set_component(i - of_q, z.component(i - of_q) + by);
    }
    (q.retract(&along), faster)
}

/// A state on the way, where nothing is zero.
fn on_the_way<S: Scene>(scene: &S) -> (Kernel<S>, Q<S>, Z<S>) {
    let (kernel, ..) = made(scene, &S::NUMBERS);
    let (q, z) = reference(scene, &S::NUMBERS, 0.3);
    (kernel, q, z)
}

/// Derivatives of the rates by the state. The input is held.
pub fn at_a_state<S: Scene, const D: usize, const U: usize>(scene: &S)
where
    Kernel<S>: LinearizedSystem<Linearization = Linearization<f64, D, U>>,
{
    let (kernel, q, z) = on_the_way(scene);
    let u = input(scene, &kernel)(0.3, &q, &z);
    let found = kernel.linearize(0.3, &q, &z, &u);
    let rates = |(q, z): (Q<S>, Z<S>)| {
        let velocity = kernel.configuration_rates(0.3, &q, &z, &u);
        let acceleration = kernel.acceleration(0.3, &q, &z, &u);
        let of_q = <<Q<S> as Configuration>::Tangent as VectorSpace<f64>>::DIM;
        SVector::<f64, D>::from_fn(
            |i, _| {
                if i < of_q { velocity.component(i) } else { acceleration.component(i - of_q) }
            },
        )
    };
    for j in 0..D {
        let expected = (rates(varied::<S>(&q, &z, j, STEP)) - rates(varied::<S>(&q, &z, j, -STEP))) / (2.0 * STEP);
        for i in 0..D {
            agree(&format!("rate {i} by {j}"), found.by_state[(i, j)], expected[i], expected.amax());
        }
    }
}

/// Steps of 0.02 s with the input held, before states are brought back onto constraints.
fn stepped<S: Scene>(scene: &S, kernel: &Kernel<S>, (q, z): (Q<S>, Z<S>), steps: usize) -> (Q<S>, Z<S>) {
    let held = input(scene, kernel)(0.3, &q, &z);
    let held = Feedback(move |_, _: &Q<S>, _: &Z<S>| held);
    let problem = SystemProblem { system: kernel, form: VelocityForm, input: held };
    let mut state = State { t: 0.3, q, y: z };
    for _ in 0..steps {
        state = CommutatorFree4.step(&problem, &state, &problem.rates(&state), 0.02).unwrap().state;
    }
    (state.q, state.y)
}

fn compare<S: Scene, const D: usize, const U: usize>(scene: &S, steps: usize)
where
    Kernel<S>: LinearizedSystem<Linearization = Linearization<f64, D, U>>,
{
    let (kernel, q, z) = on_the_way(scene);
    let u = input(scene, &kernel)(0.3, &q, &z);
    let step = |t: f64, q: &Q<S>, z: &Z<S>| -> DiscreteLinearization<Kernel<S>, D, U> {
        CommutatorFree4.step_linearized(&kernel, t, q, z, &u, 0.02).unwrap()
    };
    let mut found = step(0.3, &q, &z);
    for _ in 1..steps {
        let next = step(found.t, &found.q, &found.z);
        found = found.then(&next);
    }
    for j in 0..D {
        let expected = difference::<S>(|by| stepped(scene, &kernel, varied::<S>(&q, &z, j, by), steps));
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (i, expected) in expected.iter().enumerate() {
            agree(&format!("{i} by {j}"), found.by_state[(i, j)], *expected, size);
        }
    }
}

/// Derivatives of a step itself.
pub fn of_a_step<S: Scene, const D: usize, const U: usize>(scene: &S)
where
    Kernel<S>: LinearizedSystem<Linearization = Linearization<f64, D, U>>,
{
    compare(scene, 1);
}

/// Those of ten steps, one after another.
pub fn along_a_run<S: Scene, const D: usize, const U: usize>(scene: &S)
where
    Kernel<S>: LinearizedSystem<Linearization = Linearization<f64, D, U>>,
{
    compare(scene, 10);
}
