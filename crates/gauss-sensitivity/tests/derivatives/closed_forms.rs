//! Motions that are known.

use gauss_runtime::dual::Dual;
use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, InputOf, Run, Start, Steps};

use super::number;

/// A mass on a spring with a damper, pushed.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(along = x, stiffness = k, damping = c),
    input(push),
    drive(x = push),
)]
struct Oscillator<T> {
    m: T,
    k: T,
    c: T,
}

/// By m, k, c, where and how fast it starts, and a push that is held from t = 1 on.
struct Swing;

const END: f64 = 2.5;

impl Run<6> for Swing {
    type System<T: Real> = OscillatorKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 1.0, END]
    }

    fn system<T: Real>(&self, &[m, k, c, ..]: &[T; 6]) -> Result<OscillatorKernel<T>, ParameterError> {
        Oscillator { m, k, c }.kernel()
    }

    fn start<T: Real>(&self, &[_, _, _, x, v, _]: &[T; 6], _: &OscillatorKernel<T>) -> Start<OscillatorKernel<T>> {
        (SVector::from([x]), SVector::from([v]))
    }

    fn input<T: Real>(&self, numbers: &[T; 6], at: &At<'_, OscillatorKernel<T>>) -> InputOf<OscillatorKernel<T>> {
        SVector::from([if at.number == 0 { T::zero() } else { numbers[5] }])
    }
}

/// (1 + x v) x at each instant behind the start, times k.
impl Cost<6> for Swing {
    fn cost<T: Real>(&self, numbers: &[T; 6], at: &At<'_, OscillatorKernel<T>>) -> T {
        if at.number == 0 { T::zero() } else { measure(numbers, at.q[0], at.z[0]) }
    }
}

fn measure<T: Real>(numbers: &[T; 6], x: T, v: T) -> T {
    numbers[1] * (T::one() + x * v) * x
}

/// (x, v) after t about the rest at `push`/k.
fn flow<T: Real>(&[m, k, c, ..]: &[T; 6], [x, v]: [T; 2], push: T, t: f64) -> [T; 2] {
    let (two, t) = (number::<T>(2.0), number::<T>(t));
    let (decay, rest) = (c / (two * m), push / k);
    let omega = (k / m - decay * decay).sqrt();
    let (a, (sine, cosine), fall) = (x - rest, (omega * t).sin_cos(), (-decay * t).exp());
    let b = (v + decay * a) / omega;
    let away = fall * (a * cosine + b * sine);
    [rest + away, fall * omega * (b * cosine - a * sine) - decay * away]
}

const NUMBERS: [f64; 6] = [1.3, 2.0, 0.4, 0.3, -0.2, 0.5];

/// In dual numbers of their own.
fn exact() -> [[Dual<6>; 2]; 2] {
    let numbers = std::array::from_fn(|k| Dual::variable(NUMBERS[k], k));
    let first = flow(&numbers, [numbers[3], numbers[4]], Dual::zero(), 1.0);
    [first, flow(&numbers, first, numbers[5], END - 1.0)]
}

fn check<C: Steps>(derivatives: Derivatives<C>, allowed: f64) {
    let points = derivatives.run(&Swing, &NUMBERS).expect("swings");
    assert_eq!(points.len(), 3);
    assert_eq!(
        (&points[0].q_slopes[0][..], &points[0].z_slopes[0][..]),
        (&[0., 0., 0., 1., 0., 0.][..], &[0., 0., 0., 0., 1., 0.][..])
    );
    for (point, [x, v]) in points[1..].iter().zip(exact()) {
        for k in 0..6 {
            let off = (point.q_slopes[0][k] - x.slopes[k]).abs().max((point.z_slopes[0][k] - v.slopes[k]).abs());
            assert!(off < allowed, "{k}: {off:e}");
        }
        assert!(!point.ended && point.t_slopes == [0.0; 6]);
    }
    let numbers = std::array::from_fn(|k| Dual::variable(NUMBERS[k], k));
    let cost = exact().into_iter().map(|[x, v]| measure(&numbers, x, v)).fold(Dual::zero(), |sum, cost| sum + cost);
    let gradient = derivatives.gradient(&Swing, &NUMBERS).expect("swings");
    assert!((gradient.value - cost.value).abs() < allowed);
    for k in 0..6 {
        // Costs are products of numbers below 2.
        let off = gradient.by_numbers[k] - cost.slopes[k];
        assert!(off.abs() < 10.0 * allowed, "{k}: {off:e}");
    }
    // The initial state is what the fourth and the fifth number are.
    assert_eq!((gradient.by_q[0], gradient.by_z[0]), (gradient.by_numbers[3], gradient.by_numbers[4]));
}

/// Errors of some ten steps, each within the tolerance of its value; those of derivatives are of that size, by numbers
/// of order 1.
#[test]
fn an_oscillator_has_the_derivatives_of_its_closed_form() {
    check(Derivatives::adaptive(1e-12, 1e-12), 1e-10);
    // Steps of order 8: 0.05⁸ is 4e-11, over 9!; and rounding.
    check(Derivatives::fixed_step(0.05), 1e-13);
    // Steps of order 4: h⁴ is 1e-8, times the error constant 1/120 and a second.
    check(Derivatives::by(Fixed::by(CommutatorFree4, 0.01)), 1e-9);
    check(Derivatives::by(Adaptive::by(RungeKutta(Verner9), 1e-12, 1e-12)), 1e-10);
}

/// The derivatives are those of what was computed: at a tolerance at which the motion is wrong by 1e-3, differences of
/// the same steps agree to ten digits.
#[test]
fn derivatives_are_those_of_the_steps_that_were_made() {
    let coarse = Derivatives::by(Fixed::by(RungeKutta(Classical4), 0.5));
    let points = coarse.run(&Swing, &NUMBERS).expect("swings");
    let [_, [x, _]] = exact();
    assert!((points[2].q[0] - x.value).abs() > 1e-5);
    let end = |numbers: &[f64; 6]| {
        let points = coarse.run(&Swing, numbers).expect("swings");
        [points[2].q[0], points[2].z[0]]
    };
    // Five steps of some fifty roundings, of numbers below 1.
    super::hold([points[2].q_slopes[0], points[2].z_slopes[0]], &NUMBERS, 2e-2, 250.0 * f64::EPSILON, end);
}
