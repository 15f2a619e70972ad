//! What has no derivatives.

use gauss_runtime::integrate::IntegrationErrorKind;
use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Derivatives, FitError, Residuals, Run, SensitivityError, Start};

/// A ball over a floor.
#[derive(GaussDynamics)]
#[gauss(coordinates(x, height), particle(mass = m, position = [x, 0, height]), contact(floor, gap = height))]
struct Ball<T> {
    m: T,
    #[gauss(gravity)]
    g: T,
}

/// A ball that nothing touches.
#[derive(GaussDynamics)]
#[gauss(coordinates(x, height), particle(mass = m, position = [x, 0, height]))]
struct Thrown<T> {
    m: T,
    #[gauss(gravity)]
    g: T,
}

struct Touching;

impl Run<1> for Touching {
    type System<T: Real> = BallKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 1.0]
    }

    fn system<T: Real>(&self, &[g]: &[T; 1]) -> Result<BallKernel<T>, ParameterError> {
        Ball { m: T::one(), g }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 1], _: &BallKernel<T>) -> Start<BallKernel<T>> {
        (SVector::from([T::zero(), T::one()]), SVector::from([T::zero(); 2]))
    }
}

impl Cost<1> for Touching {
    fn cost<T: Real>(&self, _: &[T; 1], at: &At<'_, BallKernel<T>>) -> T {
        at.q[0]
    }
}

/// By mass and gravity, at given instants; a cost that is a root of x, or asks for a gradient itself.
struct Free {
    instants: Vec<f64>,
    nested: bool,
}

impl Run<2> for Free {
    type System<T: Real> = ThrownKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.instants
    }

    fn system<T: Real>(&self, &[m, g]: &[T; 2]) -> Result<ThrownKernel<T>, ParameterError> {
        Thrown { m, g }.kernel()
    }

    fn start<T: Real>(&self, &[m, _]: &[T; 2], _: &ThrownKernel<T>) -> Start<ThrownKernel<T>> {
        (SVector::from([m - m * m, T::one()]), SVector::from([T::zero(); 2]))
    }
}

impl Cost<2> for Free {
    fn cost<T: Real>(&self, _: &[T; 2], at: &At<'_, ThrownKernel<T>>) -> T {
        if self.nested && T::DERIVATIVES {
            let inner =
                Derivatives::fixed_step(0.1).gradient(&Self { instants: vec![0.0, 1.0], nested: false }, &[2.0, 9.81]);
            assert_eq!(inner.map(|gradient| gradient.value), Err(SensitivityError::Nested));
        }
        if at.number == 1 && !self.nested { at.q[0].abs().sqrt() } else { T::zero() }
    }
}

impl Residuals<2, 1> for Free {
    fn residuals<T: Real>(&self, _: &[T; 2], at: &At<'_, ThrownKernel<T>>) -> [T; 1] {
        [at.q[1] - T::from_f64(0.2)]
    }
}

fn free(instants: &[f64]) -> Free {
    Free { instants: instants.to_vec(), nested: false }
}

#[test]
fn contacts_are_refused() {
    let derivatives = Derivatives::adaptive(1e-9, 1e-9);
    for error in [derivatives.run(&Touching, &[9.81]).err(), derivatives.gradient(&Touching, &[9.81]).err()] {
        let Some(SensitivityError::Run(error)) = error else { panic!("{error:?}") };
        assert_eq!(error.kind, IntegrationErrorKind::Contacts);
    }
}

#[test]
fn instants_are_in_order() {
    for (instants, number) in [
        (&[][..], 0),
        (&[0.0][..], 1),
        (&[0.0, f64::NAN], 1),
        (&[0.0, 0.0], 1),
        (&[0.0, 1.0, 0.5], 2),
        (&[0.0, -1.0, -0.5], 2),
        (&[0.0, 1.0, 2.0, f64::INFINITY], 3),
    ] {
        let found = Derivatives::fixed_step(0.1).gradient(&free(instants), &[2.0, 9.81]);
        assert_eq!(found, Err(SensitivityError::Instants { number }), "{instants:?}");
        let message = found.expect_err("a mistake").to_string();
        assert!(message.contains(&format!("number {number}")), "{message}");
    }
    // Backward in time there is a run as well.
    assert!(Derivatives::fixed_step(0.1).gradient(&free(&[0.0, -0.5, -1.0]), &[2.0, 9.81]).is_ok());
}

#[test]
fn parameters_that_no_body_has_are_named() {
    let error = Derivatives::fixed_step(0.1).gradient(&free(&[0.0, 1.0]), &[-1.0, 9.81]).expect_err("a mass");
    let SensitivityError::Parameters(error) = error else { panic!("{error}") };
    assert_eq!(error.violations()[0].field, "m");
}

/// At m = 1 the cost is the root of zero, whose slope is infinite; at any other mass it is not.
#[test]
fn infinite_slopes_are_errors() {
    let at = |m: f64| Derivatives::fixed_step(0.1).gradient(&free(&[0.0, 1.0]), &[m, 9.81]);
    assert!(matches!(at(1.0), Err(SensitivityError::NonFinite { .. })), "{:?}", at(1.0));
    // √|m − m²|: (2m − 1)/(2√(m² − m)).
    let slope = at(2.0).expect("a cost").by_numbers[0];
    assert!((slope - 1.5 / 2.0_f64.sqrt()).abs() < 1e-14, "{slope}");
}

#[test]
fn gradients_within_gradients_are_refused() {
    let run = Free { instants: vec![0.0, 1.0], nested: true };
    assert_eq!(Derivatives::fixed_step(0.1).gradient(&run, &[2.0, 9.81]).expect("the outer one").value, 0.0);
}

/// A fall tells gravity, and no mass.
#[test]
fn what_measurements_do_not_tell_is_refused() {
    let found = Derivatives::fixed_step(0.1).fit(&[free(&[0.0, 1.0])], &[2.0, 9.81]);
    assert_eq!(found, Err(FitError::Undetermined));
}

/// An event that is given up on the way.
struct Forgets;

impl Run<1> for Forgets {
    type System<T: Real> = ThrownKernel<T>;

    fn instants(&self) -> &[f64] {
        &[0.0, 1.0]
    }

    fn system<T: Real>(&self, &[g]: &[T; 1]) -> Result<ThrownKernel<T>, ParameterError> {
        Thrown { m: T::one(), g }.kernel()
    }

    fn start<T: Real>(&self, _: &[T; 1], _: &ThrownKernel<T>) -> Start<ThrownKernel<T>> {
        (SVector::from([T::zero(), T::one()]), SVector::from([T::zero(); 2]))
    }

    fn until<T: Real>(&self, _: &[T; 1], at: &At<'_, ThrownKernel<T>>) -> Option<(Crossing, T)> {
        (at.t.lane(0) < 0.2).then_some((Crossing::Falling, at.q[1]))
    }
}

#[test]
fn events_that_are_forgotten_are_errors() {
    let error = Derivatives::fixed_step(0.1).run(&Forgets, &[9.81]).err().expect("an event without a value");
    let SensitivityError::Run(error) = error else { panic!("{error}") };
    assert!(matches!(error.kind, IntegrationErrorKind::NonFinite { .. }), "{error}");
}
