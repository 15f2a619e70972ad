//! Attitudes and poses.

use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, InputOf, Run, Start};

use super::{hold, number};

/// A satellite with a controller that turns it back.
#[derive(GaussDynamics)]
#[gauss(linearize, motion = fixed_point, mass = 1, input(wheels: Vector3), torque(wheels, value = wheels))]
struct Satellite<T> {
    #[gauss(inertia)]
    inertia: Vector3<T>,
}

/// By three moments of inertia, an increment of the attitude, the angular velocity, two gains.
struct Turn;

type Numbers<T> = [T; 11];

impl Run<11> for Turn {
    type System<T: Real> = SatelliteKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.5, 1.5, 3.0]
    }

    fn system<T: Real>(&self, &[a, b, c, ..]: &Numbers<T>) -> Result<SatelliteKernel<T>, ParameterError> {
        Satellite { inertia: SVector::from([a, b, c]) }.kernel()
    }

    fn start<T: Real>(&self, numbers: &Numbers<T>, _: &SatelliteKernel<T>) -> Start<SatelliteKernel<T>> {
        let three = |first: usize| SVector::from(std::array::from_fn(|i| numbers[first + i]));
        let half = number::<T>(0.5);
        let tilted = UnitQuaternion::new_unchecked(Quaternion::from(SVector::from([half, -half, half, half])));
        (tilted.retract(&three(3)), three(6))
    }

    fn input<T: Real>(&self, numbers: &Numbers<T>, at: &At<'_, SatelliteKernel<T>>) -> InputOf<SatelliteKernel<T>> {
        let [x, y, z, w] = at.q.as_ref().coords.data.0[0];
        // Against the vector part of the quaternion, in body axes, and against the rate.
        let of_attitude = [x, y, z].map(|part| -numbers[9] * part * w);
        SVector::from(std::array::from_fn(|i| of_attitude[i] - numbers[10] * at.z[i]))
    }
}

/// The kinetic energy and a component of the attitude, at every instant.
impl Cost<11> for Turn {
    fn cost<T: Real>(&self, numbers: &Numbers<T>, at: &At<'_, SatelliteKernel<T>>) -> T {
        at.system.kinetic_energy(at.t, at.q, at.z) + numbers[9] * at.q.as_ref().coords[0]
    }
}

const NUMBERS: Numbers<f64> = [0.9, 1.1, 0.6, 0.2, -0.1, 0.3, 0.7, -0.5, 0.4, 0.3, 0.1];

/// Of runs by other numbers as increments from the attitude of this one, seen from the body.
#[test]
fn derivatives_of_attitudes_are_increments_seen_from_the_body() {
    let derivatives = Derivatives::fixed_step(0.05);
    let points = derivatives.run(&Turn, &NUMBERS).expect("turns");
    for (n, point) in points.iter().enumerate() {
        let found = std::array::from_fn(|i| if i < 3 { point.q_slopes[i] } else { point.z_slopes[i - 3] });
        // Fifty steps of some hundred roundings, of numbers below 1, that the motion does not make larger.
        hold::<11, 6>(found, &NUMBERS, 1e-2, 5e3 * f64::EPSILON, |numbers| {
            let moved = &derivatives.run(&Turn, numbers).expect("turns")[n];
            let (sigma, z) = (point.q.difference(&moved.q), moved.z);
            [sigma[0], sigma[1], sigma[2], z[0], z[1], z[2]]
        });
    }
}

#[test]
fn backward_is_forward() {
    let derivatives = Derivatives::adaptive(1e-9, 1e-9);
    let points = derivatives.run(&Turn, &NUMBERS).expect("turns");
    let gradient = derivatives.gradient(&Turn, &NUMBERS).expect("turns");
    // The cost by hand: T = ½ Σ I ω², and the rate of x is that of the quaternion.
    let mut expected = [0.0; 11];
    for point in &points {
        for k in 0..11 {
            for i in 0..3 {
                expected[k] += NUMBERS[i] * point.z[i] * point.z_slopes[i][k];
            }
            let sigma = SVector::from(std::array::from_fn(|i| point.q_slopes[i][k]));
            expected[k] += NUMBERS[9] * point.q.component_rates(&sigma)[0];
        }
        for i in 0..3 {
            expected[i] += 0.5 * point.z[i] * point.z[i];
        }
        expected[9] += point.q.as_ref().coords[0];
    }
    for k in 0..11 {
        // Rounding: some thirty steps of twelve stages with ten operations each, of numbers of order 1; as many again
        // for the conditions of the motion.
        let off = gradient.by_numbers[k] - expected[k];
        assert!(off.abs() < 1000.0 * f64::EPSILON, "{k}: {off:e}");
    }
    // σ₀ and ω₀ as such: retract(s) at s ≠ 0 moves by dexp(s), so that the numbers move σ₀ by that.
    let increment = SVector::from([NUMBERS[3], NUMBERS[4], NUMBERS[5]]);
    let dexp = UnitQuaternion::<f64>::dexp(&increment);
    for k in 0..3 {
        let moved = dexp(&SVector::from_fn(|i, _| f64::from(u8::from(i == k))));
        let by: f64 = (0..3).map(|i| gradient.by_q[i] * moved[i]).sum();
        assert!((by - gradient.by_numbers[3 + k]).abs() < 100.0 * f64::EPSILON, "{k}");
        assert!((gradient.by_z[k] - gradient.by_numbers[6 + k]).abs() < 100.0 * f64::EPSILON, "{k}");
    }
}

/// Torques in one step that are held, by the increment of the attitude, the angular velocity and the torques.
struct Step(f64);

impl Run<9> for Step {
    type System<T: Real> = SatelliteKernel<T>;

    fn instants(&self) -> &[f64] {
        if self.0 > 0.0 { &[0.0, 0.3] } else { &[0.0, -0.3] }
    }

    fn system<T: Real>(&self, _: &[T; 9]) -> Result<SatelliteKernel<T>, ParameterError> {
        Satellite { inertia: SVector::from([0.9, 1.1, 0.6].map(number)) }.kernel()
    }

    fn start<T: Real>(&self, numbers: &[T; 9], _: &SatelliteKernel<T>) -> Start<SatelliteKernel<T>> {
        let three = |first: usize| SVector::from(std::array::from_fn(|i| numbers[first + i]));
        let half = number::<T>(0.5);
        let tilted = UnitQuaternion::new_unchecked(Quaternion::from(SVector::from([half, -half, half, half])));
        (tilted.retract(&three(0)), three(3))
    }

    fn input<T: Real>(&self, numbers: &[T; 9], _: &At<'_, SatelliteKernel<T>>) -> InputOf<SatelliteKernel<T>> {
        SVector::from([numbers[6], numbers[7], numbers[8]])
    }
}

/// The transition of a step, which `step_linearized` has from `linearize` and the differential of exp: another way.
#[test]
fn a_step_has_the_transition_of_the_step_linearized() {
    for direction in [1.0, -1.0] {
        let numbers = [0.0, 0.0, 0.0, 0.7, -0.5, 0.4, 0.2, -0.1, 0.3];
        let derivatives = Derivatives::by(Fixed::by(CommutatorFree4, 0.3));
        let end = &derivatives.run(&Step(direction), &numbers).expect("steps")[1];
        let kernel = Step(direction).system(&numbers).expect("a satellite");
        let (q, z) = Step(direction).start(&numbers, &kernel);
        let torque = SVector::from([0.2, -0.1, 0.3]);
        let step = CommutatorFree4.step_linearized(&kernel, 0.0, &q, &z, &torque, 0.3 * direction).expect("steps");
        // Some hundred operations, on numbers of order 1.
        let same = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        for i in 0..3 {
            for k in 0..6 {
                same(end.q_slopes[i][k], step.by_state[(i, k)]);
                same(end.z_slopes[i][k], step.by_state[(3 + i, k)]);
            }
            for k in 0..3 {
                same(end.q_slopes[i][6 + k], step.by_input[(i, k)]);
                same(end.z_slopes[i][6 + k], step.by_input[(3 + i, k)]);
            }
        }
    }
}

/// A ball with a heavy spot, on a spring, in air.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(ball, position = pose.position, rotation = pose.rotation, mass = m, inertia_about_center_of_mass = [0.2, 0.3, 0.25],
         center_of_mass = [0.1, 0, c]),
    drag(body = ball, linear = [d, d, d, d, d, d]),
    spring(from = [0, 0, 1], to = ball.position, stiffness = k),
)]
struct Ball<T> {
    m: T,
    c: T,
    d: T,
    k: T,
    #[gauss(gravity)]
    g: T,
}

/// By all five, in two runs of steps of one length.
struct Throw;

impl Run<5> for Throw {
    type System<T: Real> = BallKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 1.0]
    }

    fn system<T: Real>(&self, &[m, c, d, k, g]: &[T; 5]) -> Result<BallKernel<T>, ParameterError> {
        Ball { m, c, d, k, g }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 5], _: &BallKernel<T>) -> Start<BallKernel<T>> {
        let [zero, one] = [T::zero(), T::one()];
        let upright = UnitQuaternion::new_unchecked(Quaternion::from(SVector::from([zero, zero, zero, one])));
        let q = Isometry3 { translation: SVector::from([one, zero, zero]).into(), rotation: upright };
        (q, SVector::from([0.3, 2.0, 1.0, 1.5, -0.5, 2.0].map(number)))
    }
}

/// How far from the origin it comes, and which way a quaternion points.
impl Cost<5> for Throw {
    fn cost<T: Real>(&self, _: &[T; 5], at: &At<'_, BallKernel<T>>) -> T {
        let place = at.q.translation.vector;
        if at.number == 0 { T::zero() } else { place[0] * place[1] + place[2] * at.q.rotation.as_ref().coords[1] }
    }
}

#[test]
fn poses_have_increments_of_six_components() {
    let numbers = [1.2, 0.05, 0.1, 3.0, 9.81];
    for derivatives in [Derivatives::fixed_step(0.04), Derivatives::fixed_step(0.3)] {
        let point = &derivatives.run(&Throw, &numbers).expect("flies")[1];
        let found = std::array::from_fn(|i| if i < 6 { point.q_slopes[i] } else { point.z_slopes[i - 6] });
        // 25 steps of some hundred roundings, of numbers up to 5.
        let rounding = 2.5e3 * 5.0 * f64::EPSILON;
        hold::<5, 12>(found, &numbers, 2e-3, rounding, |numbers| {
            let moved = &derivatives.run(&Throw, numbers).expect("flies")[1];
            let (sigma, z) = (point.q.difference(&moved.q), moved.z);
            std::array::from_fn(|i| if i < 6 { sigma[i] } else { z[i - 6] })
        });
        let gradient = derivatives.gradient(&Throw, &numbers).expect("flies");
        // A cost is a sum of products of such numbers.
        hold([gradient.by_numbers], &numbers, 2e-3, 10.0 * rounding, |numbers| {
            [derivatives.gradient(&Throw, numbers).expect("flies").value]
        });
        assert_eq!((point.q_slopes.len(), point.z_slopes.len(), gradient.by_q.len()), (6, 6, 6));
    }
}
