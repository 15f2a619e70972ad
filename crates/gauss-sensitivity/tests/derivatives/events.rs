//! Runs that an event ends.

use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, Run, SensitivityError, Start};

use super::number;

/// A pendulum.
#[derive(GaussDynamics)]
#[gauss(coordinates(angle), particle(mass = 0.3, position = [l * sin(angle), 0, -l * cos(angle)]))]
struct Pendulum<T> {
    l: T,
    #[gauss(gravity)]
    g: T,
}

/// By l, g and the amplitude: until it hangs straight down for the first time.
struct QuarterPeriod;

impl Run<3> for QuarterPeriod {
    type System<T: Real> = PendulumKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 0.2, 9.0]
    }

    fn system<T: Real>(&self, &[l, g, _]: &[T; 3]) -> Result<PendulumKernel<T>, ParameterError> {
        Pendulum { l, g }.kernel()
    }

    fn start<T: Real>(&self, &[_, _, amplitude]: &[T; 3], _: &PendulumKernel<T>) -> Start<PendulumKernel<T>> {
        (SVector::from([amplitude]), SVector::from([T::zero()]))
    }

    fn until<T: Real>(&self, _: &[T; 3], at: &At<'_, PendulumKernel<T>>) -> Option<(Crossing, T)> {
        Some((Crossing::Falling, at.q[0]))
    }
}

/// t² z at the end.
impl Cost<3> for QuarterPeriod {
    fn cost<T: Real>(&self, _: &[T; 3], at: &At<'_, PendulumKernel<T>>) -> T {
        if at.ended { at.t * at.t * at.z[0] } else { T::zero() }
    }
}

/// The time, π/(2 agm(1, cos ½α)) √(l/g) (Gauss), and the rate, −√(2 g (1 − cos α)/l).
fn closed_form<T: Real>([l, g, amplitude]: [T; 3]) -> [T; 2] {
    let (half, two) = (T::ratio(1, 2), number::<T>(2.0));
    let (mut a, mut b) = (T::one(), (half * amplitude).cos());
    for _ in 0..6 {
        (a, b) = (half * (a + b), (a * b).sqrt());
    }
    let time = number::<T>(std::f64::consts::FRAC_PI_2) / a * (l / g).sqrt();
    [time, -(two * g * (T::one() - amplitude.cos()) / l).sqrt()]
}

#[test]
fn the_period_of_a_pendulum_has_derivatives_by_length_gravity_and_amplitude() {
    let numbers = [0.5, 9.81, 2.0];
    let [time, rate] = closed_form(std::array::from_fn(|k| Dual::<3>::variable(numbers[k], k)));
    let derivatives = Derivatives::adaptive(1e-12, 1e-12);
    let points = derivatives.run(&QuarterPeriod, &numbers).expect("swings");
    let end = points.last().expect("an end");
    assert!(points.len() == 3 && end.ended && !points[1].ended);
    let gradient = derivatives.gradient(&QuarterPeriod, &numbers).expect("swings");
    let cost = time * time * rate;
    assert!((gradient.value - cost.value).abs() < 1e-10);
    for k in 0..3 {
        // Some ten tolerances, of rates up to 8.
        assert!((end.t_slopes[k] - time.slopes[k]).abs() < 1e-10, "{k}: {} {}", end.t_slopes[k], time.slopes[k]);
        assert!((end.z_slopes[0][k] - rate.slopes[k]).abs() < 1e-9, "{k}");
        assert!((gradient.by_numbers[k] - cost.slopes[k]).abs() < 1e-9, "{k}");
        // It hangs straight down whatever the numbers are: slopes of order 1 to 10 that cancel.
        assert!(end.q_slopes[0][k].abs() < 100.0 * f64::EPSILON, "{k}: {}", end.q_slopes[0][k]);
    }
}

/// Until a function of the height passes through zero at no rate: as a cube does, or a jump.
#[derive(Clone, Copy)]
enum Falls {
    Cube,
    Jump,
}

/// A stone.
#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]))]
struct Stone<T> {
    #[gauss(gravity)]
    g: T,
}

impl Run<1> for Falls {
    type System<T: Real> = StoneKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 2.0]
    }

    fn system<T: Real>(&self, &[g]: &[T; 1]) -> Result<StoneKernel<T>, ParameterError> {
        Stone { g }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 1], _: &StoneKernel<T>) -> Start<StoneKernel<T>> {
        (SVector::from([T::one()]), SVector::from([T::zero()]))
    }

    fn until<T: Real>(&self, _: &[T; 1], at: &At<'_, StoneKernel<T>>) -> Option<(Crossing, T)> {
        let x = at.q[0];
        let function = match self {
            Self::Cube => x * x * x,
            Self::Jump => x.signum(),
        };
        Some((Crossing::Falling, function))
    }
}

impl Cost<1> for Falls {
    fn cost<T: Real>(&self, _: &[T; 1], at: &At<'_, StoneKernel<T>>) -> T {
        at.t
    }
}

#[test]
fn a_time_without_derivative_is_refused() {
    for kind in [Falls::Cube, Falls::Jump] {
        let derivatives = Derivatives::adaptive(1e-10, 1e-10);
        let forward = derivatives.run(&kind, &[9.81]).err().expect("no derivative");
        let backward = derivatives.gradient(&kind, &[9.81]).expect_err("no derivative");
        for error in [forward, backward] {
            let SensitivityError::NoDerivative { time, .. } = error else { panic!("{error}") };
            // √(2h/g), to where a cube is distinguished from zero.
            assert!((time - (2.0_f64 / 9.81).sqrt()).abs() < 1e-3, "{time}");
        }
    }
}
