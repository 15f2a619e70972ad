//! What a gradient takes.

use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, InputOf, Run, Start};

use super::number;

/// A pendulum with a motor.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]),
    gravity = [0, 0, -9.81],
    input(torque),
    drive(angle = torque),
)]
struct Pendulum<T> {
    m: T,
    l: T,
}

/// By P torques, each held over its part of the run.
struct Driven<const P: usize> {
    instants: Vec<f64>,
}

impl<const P: usize> Driven<P> {
    fn new(end: f64) -> Self {
        Self { instants: (0..=P).map(|n| end * n as f64 / P as f64).collect() }
    }
}

impl<const P: usize> Run<P> for Driven<P> {
    type System<T: Real> = PendulumKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.instants
    }

    fn system<T: Real>(&self, _: &[T; P]) -> Result<PendulumKernel<T>, ParameterError> {
        Pendulum { m: number(1.0), l: number(0.5) }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; P], _: &PendulumKernel<T>) -> Start<PendulumKernel<T>> {
        (SVector::from([T::from_f64(0.4)]), SVector::from([T::zero()]))
    }

    fn input<T: Real>(&self, numbers: &[T; P], at: &At<'_, PendulumKernel<T>>) -> InputOf<PendulumKernel<T>> {
        SVector::from([numbers[at.number]])
    }
}

impl<const P: usize> Cost<P> for Driven<P> {
    fn cost<T: Real>(&self, numbers: &[T; P], at: &At<'_, PendulumKernel<T>>) -> T {
        if at.number == P { at.q[0] * at.z[0] } else { numbers[at.number] * at.q[0] }
    }
}

fn torques<const P: usize>() -> [f64; P] {
    std::array::from_fn(|k| 0.3 * (k as f64).sin())
}

#[test]
fn the_number_of_checkpoints_changes_no_bit() {
    let run = Driven::<7>::new(7.0);
    let derivatives = Derivatives::fixed_step(0.02);
    let usual = derivatives.gradient(&run, &torques()).expect("swings");
    assert_eq!((usual.effort.steps, usual.effort.states), (350, 18));
    for states in [1, 2, 3, 5, 40, 350, 100_000] {
        let gradient = derivatives.checkpoints(states).gradient(&run, &torques()).expect("swings");
        assert_eq!((gradient.value, gradient.by_numbers), (usual.value, usual.by_numbers), "{states}");
        assert_eq!((&gradient.by_q, &gradient.by_z), (&usual.by_q, &usual.by_z), "{states}");
        assert!(gradient.effort.states <= states);
        if states >= 350 {
            assert_eq!(gradient.effort.repeated, 349);
        }
    }
}

/// Memory grows like the root of the number of steps, but for the eight bytes of the time of each.
#[test]
fn memory_is_that_of_few_states_and_one_step() {
    let take = |end: f64| {
        let run = Driven::<1>::new(end);
        Derivatives::fixed_step(0.01).gradient(&run, &[0.1]).expect("swings").effort
    };
    let (short, long) = (take(10.0), take(160.0));
    assert_eq!((short.steps, long.steps), (1000, 16_000));
    assert_eq!((short.states, long.states), (31, 126));
    // No step is made more than three times: (31 + 3)!/(31! 3!) and (126 + 3)!/(126! 3!) are more than the steps.
    for effort in [short, long] {
        assert!(effort.repeated <= 3 * effort.steps, "{effort:?}");
    }
    // A state is t, q, z, 24 bytes, and the input that a controller may hold there, 16.
    let rest = |effort: gauss_sensitivity::Effort| effort.bytes - 8 * effort.steps - 40 * effort.states;
    assert_eq!(rest(short), rest(long));
    // The tape of one step: twelve stages of a kernel of some twenty operations, 32 bytes each with its adjoint.
    assert!(rest(long) < 32 * 12 * 60, "{}", rest(long));
    println!("16000 steps: {long:?}; all states alone would be {} bytes", 24 * long.steps);
}

/// Three hundred numbers take the steps of three, and a tape that is longer by them alone.
#[test]
fn the_price_does_not_grow_with_the_count_of_numbers() {
    // Binary fractions: four steps between instants, and four hundred.
    let (derivatives, end) = (Derivatives::fixed_step(1.0 / 128.0), 300.0 / 32.0);
    let few = derivatives.gradient(&Driven::<3>::new(end), &torques()).expect("swings").effort;
    let many = derivatives.gradient(&Driven::<300>::new(end), &torques()).expect("swings");
    let effort = many.effort;
    assert_eq!((few.steps, few.repeated, few.states), (effort.steps, effort.repeated, effort.states));
    // A node of 24 bytes and an adjoint, and eight bytes of an instant.
    assert_eq!(effort.bytes - few.bytes, 297 * (32 + 8));
    // Forward, by each of them.
    let points = derivatives.run(&Driven::<300>::new(end), &torques()).expect("swings");
    let end = &points[300];
    for k in [0, 150, 299] {
        let of_end = end.q_slopes[0][k] * end.z[0] + end.q[0] * end.z_slopes[0][k];
        let on_the_way: f64 = (0..300).map(|n| torques::<300>()[n] * points[n].q_slopes[0][k]).sum();
        let expected = of_end + on_the_way + points[k].q[0];
        // 1200 steps of some hundred roundings, which a stable motion keeps; sums of 300 numbers.
        assert!((many.by_numbers[k] - expected).abs() < 1e-11, "{k}: {} {expected}", many.by_numbers[k]);
    }
}
