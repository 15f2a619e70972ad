//! A Kalman filter whose errors are increments of the configuration: multiplicative, with three parameters for the
//! attitude.

use gauss_runtime::linearize::error_matrix;
use gauss_runtime::prelude::*;

use crate::model::{DISTURBANCE, FIRST, STEP, STEPS, SpacecraftKernel, State, TRACKER, Truth, nominal, wheels};

/// Of the error (σ, δω): the true attitude is `R ∘ exp(σ)`, the true angular velocity ω + δω, all in axes of the
/// estimated body.
pub type Covariance = Matrix6<f64>;

/// Where the transition matrix of a step comes from. The estimate itself is stepped in the same way by all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transition {
    /// The derivatives of the step.
    Exact,
    /// 1 + hF once a step.
    FirstOrder,
    /// 1 + TF once, from one look at the stars to the next.
    FirstOrderPerLook,
}

/// An estimate and its covariance.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    pub state: State,
    pub covariance: Covariance,
}

impl Estimate {
    /// What is known at first.
    pub fn first() -> Self {
        let deviations = Vector6::from_fn(|i, _| if i < 3 { FIRST.0 } else { FIRST.1 });
        Self { state: nominal(), covariance: Matrix6::from_diagonal(&deviations.component_mul(&deviations)) }
    }

    /// From the look after the step `from` to the next one. `each` sees the estimate after every step.
    ///
    /// # Errors
    /// When a step cannot be made.
    pub fn predict(
        &mut self,
        kernel: &SpacecraftKernel,
        from: usize,
        transition: Transition,
        mut each: impl FnMut(&Self),
    ) -> Result<(), IntegrationErrorKind> {
        let (looked, strength) = (*self, DISTURBANCE * DISTURBANCE);
        for n in 0..STEPS {
            let torque = wheels(from + n);
            // ANCHOR: predict
            let step = CommutatorFree4.step_linearized(kernel, 0.0, &self.state.0, &self.state.1, &torque, STEP)?;
            // ANCHOR_END: predict
            // How the covariance grows, from which one, and over which time.
            let ((by_state, by_torque), earlier, time) = match transition {
                Transition::Exact => ((step.by_state, step.by_input), self.covariance, STEP),
                Transition::FirstOrder => (first_order(kernel, &self.state, &torque, STEP), self.covariance, STEP),
                Transition::FirstOrderPerLook => {
                    let time = STEP * (n + 1) as f64;
                    (first_order(kernel, &looked.state, &wheels(from), time), looked.covariance, time)
                }
            };
            self.state = (step.q, step.z);
            // A torque that is held for a time and white from one time to the next has the variance S/time.
            self.covariance =
                by_state * earlier * by_state.transpose() + by_torque * by_torque.transpose() * (strength / time);
            each(self);
        }
        Ok(())
    }

    /// Takes in an attitude that the tracker saw.
    ///
    /// # Errors
    /// When the covariance has lost its digits.
    pub fn look(&mut self, kernel: &SpacecraftKernel, seen: &UnitQuaternion<f64>) -> Result<(), &'static str> {
        let noise = Matrix3::from_diagonal(&Vector3::from(TRACKER.map(|deviation| deviation * deviation)));
        let p = self.covariance;
        let innovation = p.fixed_view::<3, 3>(0, 0) + noise;
        let inverse = innovation.try_inverse().ok_or("the covariance of the innovation is singular")?;
        let gain: SMatrix<f64, 6, 3> = p.fixed_columns::<3>(0) * inverse;
        // ANCHOR: look
        let change = gain * self.state.0.difference(seen);
        self.state = kernel.retract(&self.state.0, &self.state.1, &change);
        // ANCHOR_END: look
        // Joseph's form, symmetric whatever the rounding.
        let mut rest = Matrix6::identity();
        let mut left = rest.fixed_columns_mut::<3>(0);
        left -= gain;
        let posterior = rest * p * rest.transpose() + gain * noise * gain.transpose();
        // What is left of the error is seen from the new estimate: exp(σ + ε) = exp(σ) ∘ exp(dexp ε).
        let carried: Matrix6<f64> = kernel.dexp(&change);
        self.covariance = carried * posterior * carried.transpose();
        Ok(())
    }

    /// (σ, δω) from the estimate to the truth.
    pub fn error(&self, kernel: &SpacecraftKernel, (q, z): &State) -> Vector6<f64> {
        kernel.difference((&self.state.0, &self.state.1), (q, z))
    }

    /// The normalised error eᵀP⁻¹e; six on average where the filter knows how wrong it is.
    pub fn normalised_error(&self, kernel: &SpacecraftKernel, truth: &State) -> f64 {
        let error = self.error(kernel, truth);
        self.covariance.cholesky().map_or(f64::INFINITY, |factors| error.dot(&factors.solve(&error)))
    }
}

/// 1 + hF, and h times the derivatives by the torque.
fn first_order(
    kernel: &SpacecraftKernel,
    (q, z): &State,
    torque: &Vector3<f64>,
    h: f64,
) -> (Matrix6<f64>, SMatrix<f64, 6, 3>) {
    let linear = kernel.linearize(0.0, q, z, torque);
    (Matrix6::identity() + error_matrix::<SpacecraftKernel>(&linear) * h, linear.by_input * h)
}

/// A moment of a run: the error, its standard deviations as the filter has them, and the normalised error.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    pub t: f64,
    pub error: Vector6<f64>,
    pub deviations: Vector6<f64>,
    pub normalised: f64,
    /// Whether the tracker has just been heard.
    pub updated: bool,
}

/// The filter along a motion: a moment after each step and one after each look.
///
/// # Errors
/// When a step cannot be made, or the covariance loses its digits.
pub fn follow(
    kernel: &SpacecraftKernel,
    truth: &Truth,
    transition: Transition,
) -> Result<Vec<Moment>, Box<dyn std::error::Error>> {
    let mut estimate = Estimate::first();
    let moment = |estimate: &Estimate, step: usize, updated: bool| Moment {
        t: step as f64 * STEP,
        error: estimate.error(kernel, &truth.state(step)),
        deviations: estimate.covariance.diagonal().map(f64::sqrt),
        normalised: estimate.normalised_error(kernel, &truth.state(step)),
        updated,
    };
    let mut moments = vec![moment(&estimate, 0, false)];
    for (n, seen) in truth.looks.iter().enumerate() {
        let mut step = n * STEPS;
        estimate.predict(kernel, n * STEPS, transition, |estimate| {
            step += 1;
            moments.push(moment(estimate, step, false));
        })?;
        estimate.look(kernel, seen)?;
        moments.push(moment(&estimate, step, true));
    }
    Ok(moments)
}
