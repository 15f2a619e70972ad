//! Kinematics, rates and derivatives: against the matrix of a linear system.

use super::*;
use gauss_tests::laws::forced_laws;

#[test]
fn states_stand_still_in_kinematics_alone() {
    let kernel = Servo::ordinary().kernel().unwrap();
    let (a, b) = matrix(&Servo::ordinary());
    let (q, z, input) = (SVector::from([0.1, -0.4, 0.2]), SVector::from([0.5]), SVector::from([3.0]));
    assert_eq!(kernel.kinematics(0.0, &q, &z), SVector::from([0.5, 0.0, 0.0]));
    let expected = a * SVector::from([0.1, -0.4, 0.2, 0.5]) + b * 3.0;
    let rates = kernel.configuration_rates(0.0, &q, &z, &input);
    let evaluated = kernel.evaluate(0.0, &q, &z, &input);
    // A few roundings of terms up to 70.
    let near = |found: f64, row: usize| assert!((found - expected[row]).abs() < 1e-13, "{found} for {}", expected[row]);
    (0..3).for_each(|row| near(rates[row], row));
    (0..3).for_each(|row| near(evaluated.velocity[row], row));
    near(evaluated.acceleration[0], 3);
    assert_eq!(<ServoKernel<f64> as DescribedSystem>::COORDINATE_NAMES, ["x", "force", "seen"]);
    // Increments of states are differences.
    let other = SVector::from([0.4, 0.5, 0.6]);
    assert_eq!(q.retract(&q.difference(&other)), other);
}

#[test]
fn linearize_is_the_matrix() {
    let servo = Servo::<f64>::ordinary();
    let (a, b) = matrix(&servo);
    let kernel = Servo::ordinary().kernel().unwrap();
    let (q, z, input) = (SVector::from([0.1, -0.4, 0.2]), SVector::from([0.5]), SVector::from([3.0]));
    let linear = kernel.linearize(0.0, &q, &z, &input);
    // Roundings of entries up to 27.
    assert!((linear.by_state - a).amax() < 1e-14, "{}", linear.by_state - a);
    assert!((linear.by_input - b).amax() < 1e-14 && linear.by_time.amax() == 0.0);
    // Inverse dynamics: −(force − gain seen) by the states.
    let inverse = kernel.linearize_inverse(0.0, &q, &z, &SVector::from([0.3]), &input);
    let by_configuration = SVector::<f64, 3>::from([servo.k, -1.0, servo.gain]);
    assert!((inverse.by_configuration.transpose() - by_configuration).amax() < 1e-14);
}

/// Parameters one by one, by hand.
#[test]
fn parameters_move_rates_of_states() {
    let kernel = Servo::ordinary().kernel().unwrap();
    let (q, z, input) = (SVector::from([0.1, -0.4, 0.2]), SVector::from([0.5]), SVector::from([3.0]));
    let found = kernel.by_parameters(0.0, &q, &z, &input);
    let Servo { m, k, c, lag, tau, gain } = Servo::<f64>::ordinary();
    let (force, seen, v) = (q[1], q[2], z[0]);
    let acceleration = (-k * q[0] - c * v + force - gain * seen) / m;
    // Columns in the order of the fields: ∂(ẋ, force˙, seen˙, v̇).
    let expected = [
        [0.0, 0.0, 0.0, -acceleration / m],
        [0.0, 0.0, 0.0, -q[0] / m],
        [0.0, 0.0, 0.0, -v / m],
        [0.0, -(3.0 - force) / (lag * lag), 0.0, 0.0],
        [0.0, 0.0, -(v - seen) / (tau * tau), 0.0],
        [0.0, 0.0, 0.0, -seen / m],
    ];
    for (column, expected) in expected.iter().enumerate() {
        for (row, expected) in expected.iter().enumerate() {
            let found = found[(row, column)];
            // A few roundings of numbers up to 1400.
            assert!((found - expected).abs() < 1e-12, "{row} {column}: {found} for {expected}");
        }
    }
}

#[test]
fn energy_is_balanced_and_forces_are_those_of_the_elements() {
    let kernel = Servo::ordinary().kernel().unwrap();
    for (q, z, u) in [([0.1, -0.4, 0.2], 0.5, 3.0), ([-1.0, 7.0, -2.0], -3.0, 0.0)] {
        forced_laws(&kernel, 0.3, (&SVector::from(q), &SVector::from([z])), &SVector::from([u]));
    }
    let run = Simulation::new(&kernel).input(|t, _: &_, _: &_| SVector::from([f64::sin(5.0 * t)]));
    let run = run.adaptive(1e-11, 1e-11).run(SVector::from([0.1, 0.0, 0.0]), SVector::from([0.0]), 0.0..4.0).unwrap();
    let balance =
        gauss_runtime::monitor::power_balance(&kernel, &run, |t, _: &_, _: &_| SVector::from([f64::sin(5.0 * t)]));
    // A state has no energy: what the motor supplies is all that comes in. The tolerance over 4 units, and the
    // quadrature.
    let uncertain = balance.last().uncertainty;
    assert!(balance.largest_residual() < 1e-9 + 10.0 * uncertain && uncertain < 1e-6, "{:?}", balance.last());
}
