//! A biped that moves in a plane, and its steps in time with their derivatives.

use gauss_contact::{ContactStepper, StepScheme};
use gauss_examples::ddp::{Expansion, Matrix, Plant, Vector};
use gauss_runtime::dual::Dual;
use gauss_runtime::prelude::*;

// ANCHOR: model
/// A trunk on two legs with hips and knees, on points. Angles are about the observer's second axis, from a leg that is
/// straight below the trunk; k₃ points up and the ground is z = 0.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    coordinates(x, z, pitch, left_hip, left_knee, right_hip, right_knee),
    body(trunk, position = [x, 0, z], rotation = rotation_y(pitch), mass = 10, center_of_mass = [0, 0, 0.2],
        inertia_about_center_of_mass = 0.2),
    body(left_thigh, parent = trunk, rotation = rotation_y(left_hip), mass = 1.5, center_of_mass = [0, 0, -0.12],
        inertia_about_center_of_mass = 0.012),
    body(left_shank, parent = left_thigh, position = [0, 0, -l], rotation = rotation_y(left_knee), mass = 0.8,
        center_of_mass = [0, 0, -0.12], inertia_about_center_of_mass = 0.006),
    body(right_thigh, parent = trunk, rotation = rotation_y(right_hip), mass = 1.5, center_of_mass = [0, 0, -0.12],
        inertia_about_center_of_mass = 0.012),
    body(right_shank, parent = right_thigh, position = [0, 0, -l], rotation = rotation_y(right_knee), mass = 0.8,
        center_of_mass = [0, 0, -0.12], inertia_about_center_of_mass = 0.006),
    point(left_toe, body = left_shank, at = [0, 0, -l]),
    point(right_toe, body = right_shank, at = [0, 0, -l]),
    contact(left_foot, point = left_toe, friction = mu),
    contact(right_foot, point = right_toe, friction = mu),
    input(left_hip_torque, left_knee_torque, right_hip_torque, right_knee_torque),
    drive(left_hip = left_hip_torque),
    drive(left_knee = left_knee_torque),
    drive(right_hip = right_hip_torque),
    drive(right_knee = right_knee_torque),
    frames(trunk, left_thigh, left_shank, right_thigh, right_shank),
)]
pub struct Biped<T> {
    /// Of a thigh, and of a shank.
    #[gauss(unit = "m")]
    pub l: T,
    pub mu: T,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: T,
}
// ANCHOR_END: model

/// Coordinates, then speeds.
pub type State = Vector<14>;
/// Hip and knee of the left leg, then of the right one, N m.
pub type Torques = Vector<4>;

/// Of a thigh, and of a shank, m.
pub const LENGTH: f64 = 0.3;
/// The length of a step in time, s.
pub const STEP: f64 = 0.005;
/// Of the ground.
pub const FRICTION: f64 = 0.7;

/// The biped as plans see it, in `f64` and in dual numbers.
pub struct Walker {
    pub plain: BipedKernel<f64>,
    dual: BipedKernel<Dual<6>>,
}

/// A stepper of the biped.
pub type Stepper<'k> = ContactStepper<'k, BipedKernel<f64>>;

impl Walker {
    /// # Errors
    /// None with the parameters of this file.
    pub fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let (l, mu, g) = (LENGTH, FRICTION, 9.81);
        let number = Dual::constant;
        let dual = Biped { l: number(l), mu: number(mu), g: number(g) }.kernel()?;
        Ok(Self { plain: Biped { l, mu, g }.kernel()?, dual })
    }

    /// A stepper at a state, which has no memory of steps before.
    pub fn stepper(&self, x: &State) -> Option<Stepper<'_>> {
        let (q, z) = (x.fixed_rows::<7>(0).into_owned(), x.fixed_rows::<7>(7).into_owned());
        Some(ContactStepper::new(&self.plain, 0.0, q, z).ok()?.scheme(StepScheme::MoreauJean))
    }

    // ANCHOR: expansion
    /// The end of a step and its derivatives, with the contacts that the laws find.
    pub fn linear(&self, stepper: &mut Stepper<'_>, u: &Torques) -> Option<StepDerivatives> {
        stepper.step_with_derivatives::<_, 6, 14, 4, 0>(STEP, u, &self.dual).ok()
    }
    // ANCHOR_END: expansion
}

pub type StepDerivatives = gauss_contact::StepDerivatives<14, 4, 0>;

/// The state of a stepper.
pub fn state(stepper: &Stepper<'_>) -> State {
    let (q, z) = (stepper.configuration(), stepper.speeds());
    State::from_fn(|i, _| if i < 7 { q[i] } else { z[i - 7] })
}

impl Plant<14, 4> for Walker {
    type Stages = ();

    fn step(&self, x: &State, u: &Torques) -> State {
        let made = self.stepper(x).and_then(|mut stepper| {
            stepper.step(STEP, u).ok()?;
            Some(state(&stepper))
        });
        made.unwrap_or(State::repeat(f64::NAN))
    }

    fn expansion(&self, x: &State, u: &Torques) -> Expansion<(), 14, 4> {
        let made = self.stepper(x).and_then(|mut stepper| self.linear(&mut stepper, u));
        match made {
            Some(step) => Expansion { by_state: step.by_state, by_input: step.by_input, stages: () },
            None => Expansion { by_state: Matrix::repeat(f64::NAN), by_input: Matrix::repeat(f64::NAN), stages: () },
        }
    }
}
