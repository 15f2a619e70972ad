//! A Panda pushes a box over a table with both of its fingers, and holds it there.

use gauss_runtime::prelude::*;

/// The arm from its file, with a sphere at the tip of each finger; a box on the four corners of its lower face.
///
/// The fingers touch the face of the box that looks along −e₂ of it: a gap and two slips of each, in axes of the box.
/// Nothing knows where that face ends.
#[derive(Clone, Copy, GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/panda.urdf", gravity = 9.81, coordinates(pose: Pose),
    body(cargo, position = pose.position, rotation = pose.rotation, mass = m, inertia = m * a * a / 6),
    point(sole, body = cargo, at = [0, 0, -a / 2]),
    contact(table, point = sole, edges = [a, a, 0], height = h, friction = mu),
    point(tip1, body = panda_finger_joint1_link, at = [0, 0, tip]),
    point(tip2, body = panda_finger_joint2_link, at = [0, 0, tip]),
    define(
        place1 = inverse(cargo.rotation) * (tip1 - cargo.position),
        place2 = inverse(cargo.rotation) * (tip2 - cargo.position),
        turn1 = inverse(cargo.rotation) * (panda_finger_joint1_link.angular_velocity - cargo.angular_velocity),
        turn2 = inverse(cargo.rotation) * (panda_finger_joint2_link.angular_velocity - cargo.angular_velocity),
    ),
    contact(finger1, gap = -place1.y - a / 2 - r, friction = mu,
        slip = [rate(place1.x) - r * turn1.z, rate(place1.z) + r * turn1.x]),
    contact(finger2, gap = -place2.y - a / 2 - r, friction = mu,
        slip = [rate(place2.x) - r * turn2.z, rate(place2.z) + r * turn2.x]),
    frames(panda_finger_joint1_link, panda_finger_joint2_link),
)]
pub struct Pusher {
    /// kg, m: the box and its edges.
    pub m: f64,
    pub a: f64,
    /// m: radius of the tips, and how far below the origins of the fingers they are.
    pub r: f64,
    pub tip: f64,
    /// m: of the table.
    pub h: f64,
    pub mu: f64,
}

pub type Place = (Isometry3<f64>, SVector<f64, 9>);
/// Where the rates of the joints begin among the speeds; those of the box follow them.
pub const RATES: usize = 0;

/// rad, and m of the fingers: the gripper points down, its fingers are apart along the way outward.
const POSTURE: [f64; 9] = [0.0, 0.2, 0.0, -2.0, 0.0, 2.2, -0.785, 0.04, 0.04];
/// N m/rad, N m s/rad; N/m, N s/m of the fingers. The first and the third joint turn about nearly the same axis: what
/// is between them is light, so that both may have little damping in steps of a millisecond.
pub const STIFFNESS: [f64; 9] = [1000.0, 2000.0, 1000.0, 1000.0, 300.0, 300.0, 100.0, 1000.0, 1000.0];
pub const DAMPING: [f64; 9] = [30.0, 60.0, 15.0, 40.0, 3.0, 3.0, 1.0, 3.0, 3.0];
/// rad: by which the first joint turns; s: from when to when.
const SWEEP: f64 = 0.4;
const BETWEEN: [f64; 2] = [0.3, 1.5];
/// m: from the tips to the face of the box at the start, and down to the table.
const APART: f64 = 2e-3;
const ABOVE: f64 = 0.04;

/// Where the joints are to be.
#[must_use]
pub fn target(t: f64) -> SVector<f64, 9> {
    let part = ((t - BETWEEN[0]) / (BETWEEN[1] - BETWEEN[0])).clamp(0.0, 1.0);
    let mut target = SVector::from(POSTURE);
    target[0] += SWEEP * 0.5 * (1.0 - (std::f64::consts::PI * part).cos());
    target
}

/// The arm beside the box, which lies on the table, and where all is.
///
/// # Errors
/// Where a parameter is one.
pub fn start(mu: f64) -> Result<(Pusher, Place), ParameterError> {
    let mut pusher = Pusher { m: 1.0, a: 0.12, r: 0.01, tip: 0.045, h: 0.0, mu };
    let joints = SVector::from(POSTURE);
    let kernel = pusher.kernel()?;
    let tip = |frame| {
        let pose = kernel.pose_of(frame, 0.0, &(Isometry3::identity(), joints));
        pose.translation.vector + pose.rotation * Vector3::new(0.0, 0.0, pusher.tip)
    };
    let tips = [PusherFrame::panda_finger_joint1_link, PusherFrame::panda_finger_joint2_link].map(tip);
    let middle = (tips[0] + tips[1]) * 0.5;
    pusher.h = middle.z - ABOVE;
    let half = 0.5 * pusher.a;
    let cargo = Isometry3::translation(middle.x, middle.y + pusher.r + APART + half, pusher.h + half);
    Ok((pusher, (cargo, joints)))
}
