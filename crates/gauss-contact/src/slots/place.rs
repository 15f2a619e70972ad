//! Place and motion of the point of a slot beside its plane.
//!
//! In the axes of the plane's frame, whose origin moves with u and a and which turns with ω and α, the point is at r.
//! Its velocity relative to that frame is `v = u_p − u − ω × r`, and that is ṙ; so of a direction e that is fixed there
//! the rate is `e · v` and its derivative `e · (a_p − a − α × r − ω × (ω × r) − 2 ω × v)`. Of a sphere of radius ρ
//! about it the material point at −ρ n touches: `v + Ω × (−ρ n)` with the relative angular velocity `Ω = ω_p − ω`, n
//! fixed in the axes of the plane, and there `Ω̇ = α_p − α − ω × ω_p`.

use gauss_runtime::__crates_0_1_0::{Triple, add, cross, join, scaled, split, sub, triple};
use gauss_runtime::frames::FramePose;
use gauss_runtime::nalgebra::{Rotation3, SMatrix, SVector, Vector3};
use gauss_runtime::real::Real;

use super::slot::{Slot, dot};

/// Linear and angular components in the axes of a frame: a twist, an acceleration, a row of a Jacobian.
pub(super) type Twist<T> = SVector<T, 6>;

/// A slot at a configuration.
pub(super) struct Touch<T> {
    /// The point, in the axes of the plane from its frame's origin.
    at: Triple<T>,
    /// Columns of the matrix that takes components in the axes of the point's frame to those in the plane's.
    turn: [Triple<T>; 3],
}

/// R and b; of what is at rest the identity.
pub(super) fn rest<T: Real>() -> FramePose<T> {
    let identity = SMatrix::from_fn(|i, j| if i == j { T::one() } else { T::zero() });
    let translation = Vector3::from([T::zero(); 3]).into();
    FramePose { translation, rotation: Rotation3::from_matrix_unchecked(identity) }
}

/// R x.
pub(super) fn turned<T: Real>(pose: &FramePose<T>, x: Triple<T>) -> Triple<T> {
    combined(&pose.rotation.matrix().data.0, x)
}

/// The sum of three columns with factors.
fn combined<T: Real>(columns: &[Triple<T>; 3], factors: Triple<T>) -> Triple<T> {
    core::array::from_fn(|i| columns[0][i] * factors[0] + columns[1][i] * factors[1] + columns[2][i] * factors[2])
}

impl<T: Real> Touch<T> {
    /// From the poses of the frames.
    pub(super) fn new<F>(slot: &Slot<F, T>, [first, second]: [&FramePose<T>; 2]) -> Self {
        let columns = &second.rotation.matrix().data.0;
        let back = |x: Triple<T>| columns.map(|column| dot(column, x));
        let apart = sub(triple(&first.translation.vector), triple(&second.translation.vector));
        let turn = first.rotation.matrix().data.0.map(back);
        Self { at: add(back(apart), combined(&turn, triple(&slot.point))), turn }
    }

    /// Components in the axes of the point's frame.
    fn back(&self, x: Triple<T>) -> Triple<T> {
        self.turn.map(|column| dot(column, x))
    }

    pub(super) fn gap<F>(&self, slot: &Slot<F, T>) -> T {
        dot(triple(&slot.normal), sub(self.at, triple(&slot.origin))) - slot.radius
    }

    /// Factors of the twists of both frames in the rate along a direction, which is in the plane's axes.
    pub(super) fn arms<F>(&self, slot: &Slot<F, T>, direction: Triple<T>) -> [Twist<T>; 2] {
        let (own, normal) = (self.back(direction), triple(&slot.normal));
        let touches = sub(triple(&slot.point), scaled(slot.radius, self.back(normal)));
        let beside = sub(self.at, scaled(slot.radius, normal));
        let opposite = |x: Triple<T>| x.map(|component| -component);
        [join(own, cross(touches, own)), join(opposite(direction), opposite(cross(beside, direction)))]
    }

    /// The derivative of the velocity with which it touches, relative to the plane's frame and in its axes, from twists
    /// and accelerations (classical ones of the origins) of both frames in their own axes.
    pub(super) fn acceleration<F>(
        &self,
        slot: &Slot<F, T>,
        twists: [&Twist<T>; 2],
        accelerations: [&Twist<T>; 2],
    ) -> Triple<T> {
        let [(u_own, w_own), (u, w)] = twists.map(split);
        let [(a_own, b_own), (a, b)] = accelerations.map(split);
        let (p, turn) = (triple(&slot.point), |x: Triple<T>| combined(&self.turn, x));
        let of_point = turn(add(add(a_own, cross(b_own, p)), cross(w_own, cross(w_own, p))));
        let velocity = sub(sub(turn(add(u_own, cross(w_own, p))), u), cross(w, self.at));
        let turning = sub(sub(turn(b_own), b), cross(w, turn(w_own)));
        let of_sphere = scaled(slot.radius, cross(turning, triple(&slot.normal)));
        let of_plane =
            [a, cross(b, self.at), cross(w, cross(w, self.at)), scaled(T::from_f64(2.0), cross(w, velocity))];
        of_plane.into_iter().fold(sub(of_point, of_sphere), sub)
    }
}
