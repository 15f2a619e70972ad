//! ANYmal on four feet, the controller that makes it trot, and the torques that it gave.

use std::f64::consts::{PI, TAU};

use gauss_contact::{ContactError, ContactStepper};
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
pub struct Anymal {
    pub mu: f64,
}

/// The length of a step, s.
pub const STEP: f64 = 1e-3;
/// s: of a stride, in which each diagonal pair of feet stands once.
pub const STRIDE: f64 = 0.5;
/// m: thigh, and shank as it stands aside of the knee's axis.
const THIGH: f64 = 0.25;
const SHANK: [f64; 2] = [0.033, 0.33797];
/// m: feet below the hips, and how high they are lifted.
const HEIGHT: f64 = 0.46;
const LIFT: f64 = 0.07;
/// N m/rad, N m s/rad: of the joints.
pub const GAINS: [f64; 2] = [250.0, 6.0];

pub type Place = (Isometry3<f64>, SVector<f64, 12>);
pub type Speeds = SVector<f64, 18>;
pub type Torques = SVector<f64, 12>;

/// Angles of hip and knee that bring a foot so far forward of and below its hip, m; knees of fore legs point back.
fn leg(forward: f64, below: f64) -> [f64; 2] {
    let shank = SHANK[0].hypot(SHANK[1]);
    let reach = forward.hypot(below).min(THIGH + shank - 1e-3);
    let toward = (-forward).atan2(below);
    let corner = |a: f64, b: f64, c: f64| ((a * a + b * b - c * c) / (2.0 * a * b)).clamp(-1.0, 1.0).acos();
    let hip = toward + corner(THIGH, reach, shank);
    [hip, toward - corner(shank, reach, THIGH) + SHANK[0].atan2(SHANK[1]) - hip]
}

/// Legs in the order of the file: left fore, left hind, right fore, right hind; whether it is a fore leg, and the
/// stride's part by which it is late.
const LEGS: [(bool, f64); 4] = [(true, 0.0), (false, 0.5), (true, 0.5), (false, 0.0)];

/// Angles with all feet below their hips.
#[must_use]
pub fn standing() -> SVector<f64, 12> {
    angles(|_| [0.0, 0.0, HEIGHT])
}

/// Joints of feet that are sideways (an angle), forward of and below their hips.
fn angles(foot: impl Fn(usize) -> [f64; 3]) -> SVector<f64, 12> {
    let mut all = SVector::<f64, 12>::zeros();
    for (k, (fore, _)) in LEGS.into_iter().enumerate() {
        let [aside, forward, below] = foot(k);
        // Hind legs are fore legs in a mirror.
        let side = if fore { 1.0 } else { -1.0 };
        let [hip, knee] = leg(side * forward, below);
        all.fixed_rows_mut::<3>(3 * k).copy_from_slice(&[aside, side * hip, side * knee]);
    }
    all
}

/// Torques that make it trot at about this speed, m/s.
#[must_use]
pub fn trot(t: f64, q: &Place, z: &Speeds, wanted: f64) -> Torques {
    GAINS[0] * (goal(t, q, z, wanted) - q.1) - GAINS[1] * z.fixed_rows::<12>(6)
}

/// Angles of the joints for it: feet on the ground go back under it, feet in the air are put down where they keep the
/// speed.
#[must_use]
pub fn goal(t: f64, (base, _): &Place, z: &Speeds, wanted: f64) -> SVector<f64, 12> {
    let begun = (t / STRIDE).min(1.0);
    let speed = z.fixed_rows::<3>(0);
    let (roll, _, yaw) = base.rotation.euler_angles();
    angles(|k| {
        let phase = (t / STRIDE + LEGS[k].1).fract();
        let fore = if LEGS[k].0 { 1.0 } else { -1.0 };
        // Joints lag behind what is wanted; feet are put down further ahead the faster it goes.
        let way = 0.31 * STRIDE * wanted + 0.04 * (speed[0] - wanted);
        let aside = 0.25 * (speed[1] + 0.3 * roll) - 0.05 * yaw * fore;
        // Back in the first half of its stride, forward in the second.
        let (along, up) = if phase < 0.5 {
            (1.0 - 4.0 * phase, 0.0)
        } else {
            (-(TAU * (phase - 0.5)).cos(), (PI * (2.0 * phase - 1.0)).sin())
        };
        let aside = if phase < 0.5 { 0.0 } else { aside };
        [begun * aside, begun * way * along, HEIGHT - begun * LIFT * up]
    })
}

/// On its feet.
#[must_use]
pub fn start(kernel: &AnymalKernel) -> (Place, Speeds) {
    let mut q = (Isometry3::translation(0.0, 0.0, 1.0), standing());
    q.0.translation.z -= kernel.gaps(0.0, &q).min();
    (q, Speeds::zeros())
}

/// A run of so many steps from a state; `torques` says what the joints do in each, `see` is shown its end.
///
/// # Errors
/// Where a step is one.
pub fn run(
    kernel: &AnymalKernel,
    (q, z): (Place, Speeds),
    steps: usize,
    mut torques: impl FnMut(usize, &Place, &Speeds) -> Torques,
    mut see: impl FnMut(&ContactStepper<'_, AnymalKernel>),
) -> Result<(), ContactError> {
    let mut stepper = ContactStepper::new(kernel, 0.0, q, z)?;
    for n in 0..steps {
        let input = torques(n, stepper.configuration(), stepper.speeds());
        stepper.step(STEP, &input)?;
        see(&stepper);
    }
    Ok(())
}
