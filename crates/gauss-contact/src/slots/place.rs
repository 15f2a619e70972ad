//! Place and motion of the point of a slot beside its plane.
//!
//! In the axes of the plane's frame, whose origin moves with u and a and which turns with ω and α, the point is at r.
//! Its velocity relative to that frame is `v = u_p − u − ω × r`, and that is ṙ; so of a direction e that is fixed there
//! the rate is `e · v` and its derivative `e · (a_p − a − α × r − ω × (ω × r) − 2 ω × v)`. Of a sphere of radius ρ
//! about it the material point at −ρ n touches: `v + Ω × (−ρ n)` with the relative angular velocity `Ω = ω_p − ω`, n
//! fixed in the axes of the plane, and there `Ω̇ = α_p − α − ω × ω_p`.

use gauss_runtime::frames::FramePose;
use gauss_runtime::nalgebra::{Matrix3, SVector, Vector3};

use super::slot::Slot;

/// Linear and angular components in the axes of a frame: a twist, an acceleration, a row of a Jacobian.
pub(super) type Twist = SVector<f64, 6>;

/// A slot at a configuration.
pub(super) struct Touch {
    /// The point, in the axes of the plane from its frame's origin.
    at: Vector3<f64>,
    /// Takes components in the axes of the point's frame to those in the plane's.
    turn: Matrix3<f64>,
}

/// R and b; of what is at rest the identity.
pub(super) fn rest() -> FramePose<f64> {
    FramePose::identity()
}

impl Touch {
    /// From the poses of the frames.
    pub(super) fn new<F>(slot: &Slot<F>, [first, second]: [&FramePose<f64>; 2]) -> Self {
        let back = second.rotation.matrix().transpose();
        let apart = first.translation.vector - second.translation.vector;
        let turn = back * first.rotation.matrix();
        Self { at: back * apart + turn * slot.point, turn }
    }

    pub(super) fn gap<F>(&self, slot: &Slot<F>) -> f64 {
        slot.normal.dot(&(self.at - slot.origin)) - slot.radius
    }

    /// Factors of the twists of both frames in the rate along a direction, which is in the plane's axes.
    pub(super) fn arms<F>(&self, slot: &Slot<F>, direction: &Vector3<f64>) -> [Twist; 2] {
        let (own, to_plane) = (self.turn.transpose() * direction, self.turn.transpose() * slot.normal * slot.radius);
        [
            joined(&own, &(slot.point - to_plane).cross(&own)),
            -joined(direction, &(self.at - slot.normal * slot.radius).cross(direction)),
        ]
    }

    /// The derivative of the velocity with which it touches, relative to the plane's frame and in its axes, from twists
    /// and accelerations (classical ones of the origins) of both frames in their own axes.
    pub(super) fn acceleration<F>(
        &self,
        slot: &Slot<F>,
        twists: [&Twist; 2],
        accelerations: [&Twist; 2],
    ) -> Vector3<f64> {
        let [[u_own, w_own], [u, w]] = twists.map(split);
        let [[a_own, b_own], [a, b]] = accelerations.map(split);
        let p = &slot.point;
        let of_point = self.turn * (a_own + b_own.cross(p) + w_own.cross(&w_own.cross(p)));
        let velocity = self.turn * (u_own + w_own.cross(p)) - u - w.cross(&self.at);
        let turning = self.turn * b_own - b - w.cross(&(self.turn * w_own));
        let of_sphere = turning.cross(&slot.normal) * slot.radius;
        of_point - of_sphere - a - b.cross(&self.at) - w.cross(&w.cross(&self.at)) - 2.0 * w.cross(&velocity)
    }
}

fn joined(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Twist {
    Twist::from([linear.x, linear.y, linear.z, angular.x, angular.y, angular.z])
}

fn split(twist: &Twist) -> [Vector3<f64>; 2] {
    [Vector3::new(twist[0], twist[1], twist[2]), Vector3::new(twist[3], twist[4], twist[5])]
}
