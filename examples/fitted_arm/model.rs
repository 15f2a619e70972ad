//! An arm of two links with motors, and its runs as functions of numbers.

use gauss_runtime::prelude::*;
use gauss_sensitivity::{At, Cost, Residuals, Run, Start};

/// Two links in a vertical plane: angles from k₁, k₂ up.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(shoulder, elbow),
    body(upper, rotation = rotation_z(shoulder), mass = 4, center_of_mass = [c1, 0, 0], inertia = [0.01, i1, i1]),
    body(lower, parent = upper, position = [0.4, 0, 0], rotation = rotation_z(elbow),
         mass = 2, center_of_mass = [c2, 0, 0], inertia = [0.005, i2, i2]),
    gravity = [0, -9.81, 0],
    spring(along = shoulder, stiffness = 0, damping = f1),
    spring(along = elbow, stiffness = 0, damping = f2),
    input(at_shoulder = "N m", at_elbow = "N m"),
    drive(shoulder = at_shoulder),
    drive(elbow = at_elbow),
)]
pub struct Arm<T> {
    /// From each joint to the centre of mass of its link, m.
    pub c1: T,
    pub c2: T,
    /// Moments of inertia about the joints, kg m².
    pub i1: T,
    pub i2: T,
    /// Viscous friction, N m s.
    pub f1: T,
    pub f2: T,
}

pub type Kernel = ArmKernel<f64>;
/// c₁, c₂, i₁, i₂, f₁, f₂.
pub const NAMES: [&str; 6] = ["c1 / m", "c2 / m", "i1 / kg m²", "i2 / kg m²", "f1 / N m s", "f2 / N m s"];
pub const TRUTH: [f64; 6] = [0.21, 0.17, 0.27, 0.09, 0.5, 0.2];

/// The arm with these numbers.
///
/// # Errors
/// When no arm has them.
pub fn arm<T: Real>(&[c1, c2, i1, i2, f1, f2]: &[T; 6]) -> Result<ArmKernel<T>, ParameterError> {
    Arm { c1, c2, i1, i2, f1, f2 }.kernel()
}

/// Both links hang.
const HANGS: f64 = -std::f64::consts::FRAC_PI_2;

// ANCHOR: recorded
/// A recorded run: the torques are known, angles were measured.
pub struct Recorded {
    /// Amplitudes in N m and angular frequencies in rad/s of the torques.
    pub torques: [[f64; 2]; 2],
    pub times: Vec<f64>,
    pub angles: Vec<[f64; 2]>,
    /// The standard deviation of an angle, rad.
    pub deviation: f64,
}

impl Run<6> for Recorded {
    type System<T: Real> = ArmKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.times
    }

    fn system<T: Real>(&self, numbers: &[T; 6]) -> Result<ArmKernel<T>, ParameterError> {
        arm(numbers)
    }

    fn start<T: Real>(&self, _: &[T; 6], _: &ArmKernel<T>) -> Start<ArmKernel<T>> {
        (SVector::from([T::from_f64(HANGS), T::zero()]), SVector::from([T::zero(); 2]))
    }

    fn input<T: Real>(&self, _: &[T; 6], at: &At<'_, ArmKernel<T>>) -> SVector<T, 2> {
        SVector::from(self.torques.map(|[size, rate]| T::from_f64(size) * (T::from_f64(rate) * at.t).sin()))
    }
}

impl Residuals<6, 2> for Recorded {
    fn residuals<T: Real>(&self, _: &[T; 6], at: &At<'_, ArmKernel<T>>) -> [T; 2] {
        let seen = self.angles[at.number];
        [0, 1].map(|i| (at.q[i] - T::from_f64(seen[i])) / T::from_f64(self.deviation))
    }
}
// ANCHOR_END: recorded

/// Intervals of a plan, two torques in each.
pub const INTERVALS: usize = 60;
pub const TORQUES: usize = 2 * INTERVALS;
/// How long a plan takes, s.
pub const DURATION: f64 = 3.75;

// ANCHOR: planned
/// A swing from rest to rest, by torques that are held over intervals.
pub struct Planned {
    /// The arm, as far as it is known.
    pub numbers: [f64; 6],
    pub times: Vec<f64>,
    /// What a radian or a radian per second at the end costs, as its square.
    pub weight: f64,
}

impl Run<TORQUES> for Planned {
    type System<T: Real> = ArmKernel<T>;

    fn instants(&self) -> &[f64] {
        &self.times
    }

    fn system<T: Real>(&self, _: &[T; TORQUES]) -> Result<ArmKernel<T>, ParameterError> {
        arm(&self.numbers.map(T::from_f64))
    }

    fn start<T: Real>(&self, _: &[T; TORQUES], _: &ArmKernel<T>) -> Start<ArmKernel<T>> {
        (SVector::from([T::from_f64(HANGS), T::zero()]), SVector::from([T::zero(); 2]))
    }

    fn input<T: Real>(&self, torques: &[T; TORQUES], at: &At<'_, ArmKernel<T>>) -> SVector<T, 2> {
        SVector::from([torques[2 * at.number], torques[2 * at.number + 1]])
    }
}

impl Cost<TORQUES> for Planned {
    /// The squares of the torques over time, and those of what is missing at the end: both links upright, at rest.
    fn cost<T: Real>(&self, torques: &[T; TORQUES], at: &At<'_, ArmKernel<T>>) -> T {
        let square = |x: T| x * x;
        if at.number < INTERVALS {
            let both = square(torques[2 * at.number]) + square(torques[2 * at.number + 1]);
            return T::from_f64(DURATION / INTERVALS as f64) * both;
        }
        let missing = [at.q[0] + T::from_f64(HANGS), at.q[1], at.z[0], at.z[1]];
        missing.into_iter().fold(T::zero(), |sum, x| x.fma(x, sum)) * T::from_f64(self.weight)
    }
}
// ANCHOR_END: planned
