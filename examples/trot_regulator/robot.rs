//! The robot, its gait by springs, and the derivatives of its steps.

use std::error::Error;
use std::f64::consts::PI;

use gauss_contact::{ContactError, ContactStepper, StepScheme};
use gauss_runtime::dual::Dual;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::prelude::*;

/// A quadruped from its file, on spheres of 31 mm.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/anymal.urdf", base = floating, gravity = 9.81,
    point(lf, body = LF_KFE_link, at = [0.033, 0.01305, -0.33797]),
    point(lh, body = LH_KFE_link, at = [-0.033, 0.01305, -0.33797]),
    point(rf, body = RF_KFE_link, at = [0.033, -0.01305, -0.33797]),
    point(rh, body = RH_KFE_link, at = [-0.033, -0.01305, -0.33797]),
    contact(lf_foot, point = lf, radius = 0.031, friction = mu),
    contact(lh_foot, point = lh, radius = 0.031, friction = mu),
    contact(rf_foot, point = rf, radius = 0.031, friction = mu),
    contact(rh_foot, point = rh, radius = 0.031, friction = mu),
    frames(
        base_link, LF_HAA_link, LF_HFE_link, LF_KFE_link, LH_HAA_link, LH_HFE_link, LH_KFE_link, RF_HAA_link,
        RF_HFE_link, RF_KFE_link, RH_HAA_link, RH_HFE_link, RH_KFE_link,
    ),
)]
pub struct Anymal<T> {
    pub mu: T,
}

pub type Kernel = AnymalKernel<f64>;
/// The pose of the trunk, and the angles of the joints.
pub type Place = (Isometry3<f64>, SVector<f64, 12>);
pub type Speeds = SVector<f64, 18>;
pub type Torques = SVector<f64, 12>;
/// Of increments of the place, seen from the trunk, and of speeds.
pub type Deviation = SVector<f64, 36>;
/// ∂(deviation after a step)/∂(deviation before it), and by torques.
pub type Slopes = (SMatrix<f64, 36, 36>, SMatrix<f64, 36, 12>);
/// A stepper of the robot.
pub type Stepper<'k> = ContactStepper<'k, Kernel>;

/// Directions of a pass in dual numbers: two, since a kernel of this size takes minutes to compile in wider ones.
const AT_ONCE: usize = 2;
/// The length of a step in time, and of a stride, s.
pub const STEP: f64 = 2e-3;
pub const STRIDE: f64 = 0.4;
/// N m/rad, N m s/rad: of the joints.
const SPRINGS: [f64; 2] = [250.0, 6.0];

/// Angles of all joints at a time: two diagonal pairs of legs are drawn up by turns, in the first stride by less.
fn wanted(t: f64) -> Torques {
    let wave = (2.0 * PI * t / STRIDE).sin() * (t / STRIDE).min(1.0);
    let lift = [wave, -wave, -wave, wave].map(|x| 0.35 * x.max(0.0));
    Torques::from_fn(|k, _| {
        // Left fore, left hind, right fore, right hind: hips aside and forward, knees. Hind legs are fore legs in a
        // mirror.
        let (leg, side) = (k / 3, if (k / 3) % 2 == 0 { 1.0 } else { -1.0 });
        match k % 3 {
            0 => 0.0,
            1 => side * (0.6 + lift[leg]),
            _ => -side * (1.1 + 2.0 * lift[leg]),
        }
    })
}

/// Torques of springs and dampers toward the angles of a time.
#[must_use]
pub fn springs(t: f64, q: &Place, z: &Speeds) -> Torques {
    (wanted(t) - q.1) * SPRINGS[0] - z.fixed_rows::<12>(6) * SPRINGS[1]
}

/// The robot in `f64` and in dual numbers.
pub struct Robot {
    pub plain: Kernel,
    dual: AnymalKernel<Dual<AT_ONCE>>,
}

impl Robot {
    /// # Errors
    /// None with the parameters of this file.
    pub fn new() -> Result<Self, Box<dyn Error>> {
        let mu = 0.7;
        Ok(Self { plain: Anymal { mu }.kernel()?, dual: Anymal { mu: Dual::constant(mu) }.kernel()? })
    }

    /// On its feet.
    #[must_use]
    pub fn start(&self) -> (Place, Speeds) {
        let mut q = (Isometry3::translation(0.0, 0.0, 1.0), wanted(0.0));
        q.0.translation.z -= self.plain.gaps(0.0, &q).min();
        (q, Speeds::zeros())
    }

    /// A stepper at a state, without a memory of steps before.
    ///
    /// # Errors
    /// Where a gap is below zero.
    pub fn stepper(&self, t: f64, (q, z): (Place, Speeds)) -> Result<Stepper<'_>, ContactError> {
        Ok(ContactStepper::new(&self.plain, t, q, z)?.scheme(StepScheme::MoreauJean))
    }

    // ANCHOR: derivatives
    /// A step with its derivatives by state and torques, and whether a contact is at a change of its mode.
    ///
    /// # Errors
    /// Where the step or a derivative is none.
    pub fn linear(&self, stepper: &mut Stepper<'_>, torques: &Torques) -> Result<(Slopes, bool), ContactError> {
        let step = stepper.step_with_derivatives::<_, AT_ONCE, 36, 12, 0>(STEP, torques, &self.dual)?;
        Ok(((step.by_state, step.by_input), step.at_change.is_some()))
    }
    // ANCHOR_END: derivatives
}
