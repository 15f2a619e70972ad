//! Runs by every method, alone, in lanes, on threads and by hand.

use gauss_batch::{Batch, BatchSystem, States};
use gauss_runtime::configuration::Configuration;
use gauss_runtime::integrate::{
    Adams, Control, Feedback, Fixed, OneStep, Problem, State, StepOutcome, SystemProblem, VelocityForm,
};
use gauss_runtime::prelude::*;
use gauss_runtime::simd::{Lanes, Packed};
use gauss_sensitivity::{At, InputOf};

use crate::scenes::Scene;

pub type Kernel<S, T = f64> = <S as gauss_sensitivity::Run<2>>::System<T>;
pub type Q<S, T = f64> = <Kernel<S, T> as GaussSystem>::Configuration;
/// The input of a scene's kernel.
pub type U<S, T = f64> = InputOf<Kernel<S, T>>;
pub type Z<S, T = f64> = <Kernel<S, T> as GaussSystem>::Speeds;

/// The kernel of a scene, with its start.
pub fn made<S: Scene>(scene: &S, numbers: &[f64; 2]) -> (Kernel<S>, Q<S>, Z<S>) {
    let kernel = scene.system(numbers).unwrap();
    let (q, z) = scene.start(numbers, &kernel);
    (kernel, q, z)
}

/// The input of a scene.
pub fn input<'a, S: Scene, T: Real>(
    scene: &'a S,
    system: &'a Kernel<S, T>,
) -> impl Fn(T, &Q<S, T>, &Z<S, T>) -> U<S, T> + Copy + 'a {
    move |t, q, z| {
        let at = At { number: 0, ended: false, system, t, q, z };
        scene.input(&S::NUMBERS.map(T::from_f64), &at)
    }
}

/// The end of a run.
fn end_by<S: Scene, C: Control<Kernel<S>>>(scene: &S, numbers: &[f64; 2], control: C, end: f64) -> (Q<S>, Z<S>) {
    let (kernel, q, z) = made(scene, numbers);
    let run = Simulation::new(&kernel).input(input(scene, &kernel)).control(control);
    let end = run.run_to_end(q, z, 0.0..end).unwrap();
    (end.q, end.z)
}

/// The state of a run at a tolerance of 1e-12.
pub fn reference<S: Scene>(scene: &S, numbers: &[f64; 2], end: f64) -> (Q<S>, Z<S>) {
    end_by(scene, numbers, Adaptive::new(1e-12, 1e-13), end)
}

/// The change from a state to another: of q, then of z.
pub fn change<S: Scene>(from: &(Q<S>, Z<S>), to: &(Q<S>, Z<S>)) -> Vec<f64> {
    let (moved, faster) = (from.0.difference(&to.0), to.1.add_scaled(-1.0, &from.1));
    let of_q = <<Q<S> as Configuration>::Tangent as VectorSpace<f64>>::DIM;
    let of_z = <Z<S> as VectorSpace<f64>>::DIM;
    (0..of_q).map(|i| moved.component(i)).chain((0..of_z).map(|i| faster.component(i))).collect()
}

pub fn apart<S: Scene>(a: &(Q<S>, Z<S>), b: &(Q<S>, Z<S>)) -> f64 {
    change::<S>(a, b).iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The same end by steps that are made one at a time.
fn end_by_steps<S: Scene, C: Control<Kernel<S>>>(scene: &S, control: C) -> (Q<S>, Z<S>) {
    let (kernel, q, z) = made(scene, &S::NUMBERS);
    let run = Simulation::new(&kernel).input(input(scene, &kernel)).control(control);
    let mut run = run.stepper(q, z, 0.0..1.0).unwrap();
    while run.step().unwrap() != StepOutcome::End {}
    let end = run.state();
    (end.q, end.z)
}

/// A run is as near to the reference as its method promises, and has the bits of its steps.
fn check<S: Scene, C: Control<Kernel<S>> + Copy>(scene: &S, control: C, bound: f64) {
    let (end, expected) = (end_by(scene, &S::NUMBERS, control, 1.0), reference(scene, &S::NUMBERS, 1.0));
    let away = apart::<S>(&end, &expected);
    assert!(away < bound, "{away:e}");
    assert_eq!(apart::<S>(&end_by_steps(scene, control), &end), 0.0);
}

/// Orders 8 and 4 with h ω ≤ 0.2 and 0.02: errors of (hω)^p over some hundred steps.
pub fn steps<S: Scene>(scene: &S) {
    check(scene, Fixed::new(0.01), 1e-9);
    check(scene, Fixed::by(RungeKutta(Classical4), 1e-3), 1e-6);
}

/// Order 10 with h ω ≤ 0.04, of what has no corners: ten steps would remember one.
pub fn several_steps<S: Scene>(scene: &S) {
    check(scene, Adams::<_, 10>::new(2e-3), 1e-8);
}

/// Some ten to hundred steps of the tolerance.
pub fn adaptive<S: Scene>(scene: &S) {
    check(scene, Adaptive::new(1e-9, 1e-10), 1e-7);
    check(scene, Adaptive::by(RungeKutta(DormandPrince5), 1e-8, 1e-9), 1e-5);
}

/// Power series at 1e-11, a dozen steps.
pub fn series<S: Scene<System<f64>: TaylorSystem>>(scene: &S) {
    check(scene, Taylor::new(1e-11, 1e-12), 1e-9);
}

/// Rosenbrock's method at 1e-8, some hundred steps.
pub fn stiff<S: Scene<System<f64>: LinearizedSystem>>(scene: &S)
where
    Rosenbrock: gauss_runtime::integrate::EstimatingStep<Kernel<S>>,
{
    check(scene, Adaptive::by(Rosenbrock, 1e-8, 1e-9), 1e-5);
}

/// Order 6 with h ω ≤ 0.2.
pub fn implicit<S: Scene>(scene: &S) {
    check(scene, Fixed::by(Collocation::order_6(), 0.01), 1e-7);
}

/// A step by hand after another, brought back onto constraints, gives the bits of a run; so do those of a stepper.
pub fn by_hand<S: Scene>(scene: &S) {
    let (kernel, q, z) = made(scene, &S::NUMBERS);
    let problem = SystemProblem { system: &kernel, form: VelocityForm, input: Feedback(input(scene, &kernel)) };
    let mut state = State { t: 0.0, q, y: z };
    for _ in 0..8 {
        let method = RungeKutta(DormandPrince8);
        state = method.step(&problem, &state, &problem.rates(&state), 0.125).unwrap().state;
        (state.q, state.y) = kernel.project(state.t, &state.q, &state.y).unwrap();
    }
    let expected = end_by(scene, &S::NUMBERS, Fixed::new(0.125), 1.0);
    // Sums of lengths are exact; a projection is asked for what the run has asked for.
    assert_eq!(apart::<S>(&(state.q, state.y), &expected), 0.0);
    assert_eq!(apart::<S>(&end_by_steps(scene, Fixed::new(0.125)), &expected), 0.0);
}

/// States within a run, to its tolerance.
pub fn between<S: Scene>(scene: &S) {
    let (kernel, q, z) = made(scene, &S::NUMBERS);
    let path = Simulation::new(&kernel).input(input(scene, &kernel)).adaptive(1e-10, 1e-11).run(q, z, 0.0..1.0);
    let path = path.unwrap();
    for t in [0.0, 0.1234, 0.5, 0.87654, 1.0] {
        let at = path.at(t).unwrap();
        let expected = reference(scene, &S::NUMBERS, if t > 0.0 { t } else { 1e-300 });
        let apart = apart::<S>(&(at.q, at.z), &expected);
        assert!(apart < 1e-7, "{t}: {apart:e}");
    }
}

type Four = Lanes<f64, 4>;

/// Lanes, and threads of them, have the bits of single runs. Under constraints the projection goes on until all lanes
/// are done: they are the same to rounding, that of some hundred steps of some hundred terms.
pub fn lanes_and_threads<S: Scene>(scene: &S)
where
    Kernel<S, Four>:
        BatchSystem<Configuration: Packed<Single = Q<S>> + Send, Speeds: Packed<Single = Z<S>> + Send> + Sync,
    Q<S>: Send + PartialEq,
    Z<S>: Send + PartialEq,
{
    let [parameter, size] = S::NUMBERS;
    let start = |i: usize| made(scene, &[parameter, size * (1.0 + 0.05 * i as f64)]);
    let wide = scene.system(&S::NUMBERS.map(Four::splat)).unwrap();
    let starts = States::<Kernel<S, Four>>::from_fn(6, |i| {
        let (_, q, z) = start(i);
        (q, z)
    });
    let control = Adaptive::new(1e-9, 1e-10);
    let batch = Batch::new(&wide).input(input(scene, &wide)).control(control);
    let (mut alone, mut on_threads) = (starts.clone(), starts);
    let runs = batch.run(0.0..1.0, &mut alone);
    let runs_on_threads = batch.run_on_all_threads(0.0..1.0, &mut on_threads);
    for (i, (run, other)) in runs.iter().zip(&runs_on_threads).enumerate() {
        let (kernel, q, z) = start(i);
        let single = Simulation::new(&kernel).input(input(scene, &kernel)).control(control);
        let single = single.run_to_end(q, z, 0.0..1.0).unwrap();
        assert_eq!(run.as_ref().unwrap().summary, single.summary, "lane {i}");
        assert_eq!(other.as_ref().unwrap().summary, single.summary, "lane {i}");
        assert!(alone.get(i) == on_threads.get(i), "lane {i} on threads");
        let apart = apart::<S>(&alone.get(i), &(single.q, single.z));
        let allowed = if Kernel::<S>::CONSTRAINED { 1e4 * f64::EPSILON } else { 0.0 };
        assert!(apart <= allowed, "lane {i}: {apart:e}");
    }
}
