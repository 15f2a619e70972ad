//! Sums over runs, and numbers from measurements.

use gauss_runtime::integrate::{Fixed, Method, MethodError, StepSetting};
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, EnsembleError, Residuals, Run, SensitivityError, Start, Steps};

use super::number;

/// A pendulum with friction in its hinge.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    particle(mass = 1, position = [l * sin(angle), 0, -l * cos(angle)]),
    gravity = [0, 0, -9.81],
    spring(along = angle, stiffness = 0, damping = c),
)]
struct Pendulum<T> {
    l: T,
    c: T,
}

const INSTANTS: &[f64] = &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0];

/// By length and friction: let go at an angle, with what was measured since.
struct Recorded {
    angle: f64,
    measured: Vec<f64>,
    deviation: f64,
}

impl Run<2> for Recorded {
    type System<T: Real> = PendulumKernel<T>;

    fn instants(&self) -> &[f64] {
        INSTANTS
    }

    fn system<T: Real>(&self, &[l, c]: &[T; 2]) -> Result<PendulumKernel<T>, ParameterError> {
        Pendulum { l, c }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 2], _: &PendulumKernel<T>) -> Start<PendulumKernel<T>> {
        (SVector::from([T::from_f64(self.angle)]), SVector::from([T::zero()]))
    }
}

impl Residuals<2, 1> for Recorded {
    fn residuals<T: Real>(&self, _: &[T; 2], at: &At<'_, PendulumKernel<T>>) -> [T; 1] {
        if at.number == 0 {
            return [T::zero()];
        }
        [(at.q[0] - number(self.measured[at.number])) / number(self.deviation)]
    }
}

impl Cost<2> for Recorded {
    fn cost<T: Real>(&self, numbers: &[T; 2], at: &At<'_, PendulumKernel<T>>) -> T {
        let [residual] = self.residuals(numbers, at);
        residual * residual
    }
}

const TRUTH: [f64; 2] = [0.6, 0.15];

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

fn derivatives() -> Derivatives<gauss_sensitivity::FixedSteps> {
    Derivatives::fixed_step(0.1)
}

fn recorded(angle: f64, deviation: f64, noise: &mut Normal) -> Recorded {
    let empty = Recorded { angle, measured: Vec::new(), deviation };
    let points = derivatives().run(&empty, &TRUTH).expect("swings");
    let measured = points.iter().map(|point| point.q[0] + deviation * noise.next()).collect();
    Recorded { angle, measured, deviation }
}

fn several(deviation: f64, seed: u64) -> Vec<Recorded> {
    let mut noise = Normal(seed);
    [0.3, -1.0, 2.0, 2.6].map(|angle| recorded(angle, deviation, &mut noise)).into()
}

/// Steps by a method that is chosen by name are those of the method's own type, forward and backward; implicit methods
/// and those of several steps are refused.
#[test]
fn methods_by_name_have_the_same_bits() {
    let (runs, numbers) = (several(0.02, 1), [0.55, 0.1]);
    fn compare<C: Steps>(method: Method, setting: StepSetting<f64>, own: C, (runs, numbers): (&[Recorded], [f64; 2])) {
        let (named, own) = (Derivatives::by_method(method, setting).expect("is explicit"), Derivatives::by(own));
        for run in runs {
            assert_eq!(named.gradient(run, &numbers), own.gradient(run, &numbers), "{method}");
            let [named, own] = [named.run(run, &numbers), own.run(run, &numbers)].map(|points| {
                let points = points.expect("swings");
                points.iter().map(|point| (point.q, point.z)).collect::<Vec<_>>()
            });
            assert_eq!(named, own, "{method}");
        }
    }
    let (all, step, tolerant) = ((&runs[..], numbers), 0.07, StepSetting::tolerant(1e-7, 1e-7));
    let mut compared = Vec::new();
    macro_rules! each {
        ($($method:ident: $own:expr $(, $keeps:ident)?;)+) => {$(
            compare(Method::$method, StepSetting::Equal(step), Fixed::by($own, step), all);
            $(compare(Method::$method, tolerant, Adaptive::$keeps($own, 1e-7, 1e-7), all);)?
            compared.push(Method::$method);
        )+};
    }
    each! {
        DormandPrince8: RungeKutta(DormandPrince8), by;
        DormandPrince5: RungeKutta(DormandPrince5), by;
        Verner9: RungeKutta(Verner9), by;
        Classical4: RungeKutta(Classical4);
        CommutatorFree4: CommutatorFree4;
    }
    for &method in Method::ALL.iter().filter(|method| !compared.contains(method)) {
        let refused = Derivatives::by_method(method, StepSetting::Equal(step)).map(drop);
        assert_eq!(refused, Err(MethodError::Implicit(method)));
    }
    let refused = Derivatives::by_method(Method::Classical4, tolerant).map(drop);
    assert_eq!(refused, Err(MethodError::NoEstimate(Method::Classical4)));
}

#[test]
fn the_gradient_of_an_ensemble_is_the_sum_of_gradients() {
    let (runs, numbers) = (several(0.02, 1), [0.55, 0.1]);
    let (value, by_numbers) = derivatives().gradient_of_all(&runs, &numbers).expect("swing");
    let (mut sum, mut by) = (0.0, [0.0; 2]);
    for run in &runs {
        let one = derivatives().gradient(run, &numbers).expect("swings");
        sum += one.value;
        by = [by[0] + one.by_numbers[0], by[1] + one.by_numbers[1]];
    }
    assert_eq!((value, by_numbers), (sum, by));
    // Twenty steps of some hundred roundings, whose sums are squared in units of 0.02.
    super::hold([by_numbers], &numbers, 1e-2, 2e3 * f64::EPSILON * value / 0.02, |numbers| {
        [derivatives().gradient_of_all(&runs, numbers).expect("swing").0]
    });
    let failed = derivatives().gradient_of_all(&runs, &[-1.0, f64::NAN]);
    assert!(matches!(failed, Err(EnsembleError { run: 0, error: SensitivityError::Parameters(_) })), "{failed:?}");
}

#[test]
fn a_fit_finds_the_numbers_that_the_measurements_were_made_with() {
    // Without noise to the last digits, from a guess that is a third off.
    let mut silent = several(1e-300, 1);
    silent.iter_mut().for_each(|run| run.deviation = 1.0);
    let fit = derivatives().fit(&silent, &[0.8, 0.05]).expect("converges");
    for (found, truth) in fit.numbers.into_iter().zip(TRUTH) {
        // The increment that is not made any more is below 1e-9 of the number.
        assert!((found - truth).abs() < 1e-9 * truth, "{found} {truth}");
    }
    // The gradient of what was made least is zero there: 2 Jᵀr.
    let runs = several(0.02, 2);
    let fit = derivatives().fit(&runs, &[0.8, 0.05]).expect("converges");
    let (misfit, slopes) = derivatives().gradient_of_all(&runs, &fit.numbers).expect("swing");
    assert!((misfit - fit.misfit).abs() < 1e-9 * misfit);
    for (slope, deviation) in slopes.into_iter().zip(fit.deviations()) {
        // The last increment promised less than 1e-6 of the misfit, which is (½ slope · deviation)² at least.
        assert!((0.5 * slope * deviation).powi(2) < 1e-6 * misfit, "{slope} {deviation}");
    }
}

/// Errors are those that the covariance claims, over 200 sets of measurements: sums of χ² within four deviations.
#[test]
fn covariances_are_true() {
    let (mut errors, mut misfits) = (0.0, 0.0);
    let sets = 200;
    for set in 0..sets {
        let fit = derivatives().fit(&several(5e-3, 100 + set), &[0.62, 0.12]).expect("converges");
        let error = SVector::from(fit.numbers) - SVector::from(TRUTH);
        let information = fit.covariance.try_inverse().expect("regular");
        errors += error.dot(&(information * error));
        misfits += fit.misfit;
    }
    // Two numbers, and 4 × 10 residuals less two.
    for (sum, freedom) in [(errors, 2.0), (misfits, 38.0)] {
        let (mean, deviation) = (sets as f64 * freedom, (2.0 * sets as f64 * freedom).sqrt());
        assert!((sum - mean).abs() < 4.0 * deviation, "{sum} instead of {mean} ± {deviation}");
    }
}
