//! A die, and one throw of it.

use std::error::Error;
use std::f64::consts::PI;

use gauss_contact::{ContactStepper, StepSample, WithContacts};
use gauss_runtime::prelude::*;
use gauss_study::Draw;

/// A cube over a table, on its corners. Its center of mass lies off the middle along k₃ of the die, away from the six.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(die, position = pose.position, rotation = pose.rotation, mass = m, center_of_mass = [0, 0, off],
        inertia_about_center_of_mass = j),
    contact(table, point = die.position, edges = [a, a, a], friction = mu, restitution = e),
)]
pub struct Die {
    #[gauss(unit = "kg")]
    pub m: f64,
    #[gauss(unit = "m")]
    pub off: f64,
    #[gauss(unit = "kg m^2")]
    pub j: f64,
    #[gauss(unit = "m")]
    pub a: f64,
    pub mu: f64,
    pub e: f64,
    #[gauss(gravity, unit = "m/s^2")]
    pub g: f64,
}

/// The length of a step, s, and how long a throw may take.
const STEP: f64 = 5e-4;
const LONGEST: f64 = 4.0;

/// How many of so many dice show each face, from the one.
pub type Faces = [usize; 6];

/// The end of a throw.
pub struct Throw {
    /// The face that is up, where the die lies on one.
    pub face: Option<usize>,
    /// Whether it lies still: below 10⁻¹² m/s and rad/s, roundings of the speeds that it had.
    pub rests: bool,
    pub steps: usize,
    /// The largest residual of all steps, m/s, and the lowest gap at their ends, m.
    pub residual: f64,
    pub lowest: f64,
}

impl Die {
    /// Of 16 mm and 4.5 g.
    pub fn even() -> Self {
        let (m, a) = (4.5e-3, 16e-3);
        Self { m, off: 0.0, j: m * a * a / 6.0, a, mu: 0.3, e: 0.4, g: 9.81 }
    }

    /// The same with its center of mass moved towards the one, which lies opposite to the six.
    pub fn loaded(off: f64) -> Self {
        Self { off: -off, ..Self::even() }
    }
}

/// Where a throw starts: any attitude, 25 to 35 cm up, with a push and a spin.
fn start(draw: &Draw) -> (Isometry3<f64>, SVector<f64, 6>) {
    let mut random = draw.stream("throw");
    let turn = Quaternion::new(random.normal(), random.normal(), random.normal(), random.normal());
    let height = 0.3 + 0.05 * (random.normal() / PI).tanh();
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, height), UnitQuaternion::new_normalize(turn));
    let push = Vector3::new(0.3 * random.normal(), 0.3 * random.normal(), 0.0);
    let spin = 10.0 * Vector3::new(random.normal(), random.normal(), random.normal());
    (pose, DieState { pose, pose_u: pose.rotation.inverse() * push, pose_omega: spin }.z())
}

/// A throw, until it rests.
///
/// # Errors
/// Where a step is one.
pub fn throw(kernel: &DieKernel, draw: &Draw) -> Result<Throw, gauss_contact::ContactError> {
    let (q, z) = start(draw);
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z)?;
    let mut throw = Throw { face: None, rests: false, steps: 0, residual: 0.0, lowest: 0.0 };
    while stepper.time() < LONGEST && !throw.rests {
        let residual = stepper.step(STEP, &())?.residual;
        throw.residual = throw.residual.max(residual.signorini).max(residual.dissipation);
        throw.steps += 1;
        throw.rests = stepper.speeds().amax() < 1e-12;
        throw.lowest = throw.lowest.min(kernel.gaps(0.0, stepper.configuration()).min());
    }
    // Opposite faces together are seven.
    let up = stepper.configuration().rotation.inverse() * Vector3::z();
    let faces = [(-up.z, 1), (-up.y, 2), (-up.x, 3), (up.x, 4), (up.y, 5), (up.z, 6)];
    throw.face = faces.into_iter().find(|(cosine, _)| *cosine > 1.0 - 1e-6).map(|(_, face)| face);
    Ok(throw)
}

/// All steps of a throw.
///
/// # Errors
/// Where a step is one.
pub fn path(kernel: &DieKernel, draw: &Draw) -> Result<Vec<StepSample<DieKernel>>, Box<dyn Error>> {
    let (q, z) = start(draw);
    Ok(Simulation::new(kernel).contact_steps(STEP).run(q, z, 0.0..1.2)?.samples)
}
