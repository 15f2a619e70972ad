//! Reactions of joints: the force and the torque with which a bearing, a hinge, a rail or a weld holds what it carries.
//!
//! `#[gauss(reactions(upper, lower))]` has the derive write them: its kernel then implements [`Reactions`]. A joint is
//! named by the body or frame that it carries, in robots of files also by its own name; fixed ones are joints, too.
//!
//! The reaction of a joint is what the Gauss condition lacks when the joint is let go: the multiplier of the six
//! velocities that what the joint carries would have then. Nothing else is said about it.

use core::fmt::Debug;
use core::ops::Index;

use nalgebra::{SMatrix, SVector};

use crate::contact::ContactSystem;
use crate::frames::FrameName;
use crate::system::GaussSystem;

/// A system that gives the forces and torques of its joints.
///
/// The reaction (f, m) of a joint acts **on what it carries**: the body or frame with its name, and all that hangs on
/// that. Components are in the axes of that body or frame, the pole is its origin O: in robots of files the axes and
/// the origin of the joint. Units are N and N m. The parent bears (−f, −m) at the same point; a root is held by the
/// ground. [`in_observers_axes`](crate::frames::in_observers_axes) turns it.
///
/// It is all that goes through the joint: what the bearing takes up, and what acts on the rate of the joint itself
/// (motors, springs and friction `along` its coordinate, armatures, limits). So its component along a free hinge is
/// zero, and along a driven one the torque of the drive. Loads between two bodies (`torque(…, reaction = hull)`,
/// springs and dampers between points) do not go through the joint.
///
/// | reaction | here | Pinocchio | Drake |
/// |---|---|---|---|
/// | (f, m) on the child | [`reactions`](Self::reactions) | `data.f` after `rnea` | `reaction_forces` output port |
///
/// Loops: forces of `constraint(…)` act on the points that it names, with the multipliers of the motion; a constraint
/// on a coordinate (`piston` in the place of `block.position`) acts on its rate, as a motor does. Where constraints
/// hold more than they need, as a planar loop whose closing pin is held across the plane by nothing that is written,
/// the distribution is the one in which what is not written holds nothing.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A pendulum: a rod on a hinge.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(angle),
    body(rod, rotation = rotation_y(angle), mass = m, center_of_mass = [0, 0, -l],
         inertia_about_center_of_mass = [0.02, 0.02, 0.001]),
    reactions(rod),
)]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let pendulum = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.kernel()?;
// As it swings through: weight, and the centripetal force m l ω². Along the free hinge there is no torque.
let reaction = pendulum.reaction(PendulumJoint::rod, 0.0, &[0.0].into(), &[3.0].into(), &());
assert!((reaction - Vector6::new(0.0, 0.0, 2.0 * (9.81 + 0.5 * 9.0), 0.0, 0.0, 0.0)).amax() < 1e-14);
# Ok(())
# }
```
"##
)]
#[doc(alias = "bearing")]
#[doc(alias = "joint force")]
#[doc(alias = "constraint force")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no reactions of joints, because its struct does not ask for them",
    label = "the clause `reactions(…)` brings them",
    note = "add `reactions(…)`, with names of bodies that joints carry, to the `#[gauss(…)]` of the struct"
)]
pub trait Reactions: GaussSystem {
    /// The names of the joints: a variant for each, called as in `reactions(…)`.
    type Joint: FrameName;

    /// [`ByFrame`](crate::frames::ByFrame) of all joints.
    type Reactions: Copy + Debug + Index<Self::Joint, Output = SVector<Self::Scalar, 6>>;

    /// (f, m) of every joint at the given ż, without contact forces. Under constraints with the multipliers of the
    /// motion at (t, q, z), as [`gauss_residual`](GaussSystem::gauss_residual).
    fn reactions_at(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Reactions;

    /// (f, m) of every joint in the motion at (t, q, z).
    #[inline]
    fn reactions(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Reactions {
        self.reactions_at(t, q, z, &self.acceleration(t, q, z, input), input)
    }

    /// (f, m) of one joint in the motion at (t, q, z). Of several [`reactions`](Self::reactions) is cheaper.
    #[doc(alias = "bearing")]
    #[doc(alias = "joint force")]
    #[inline]
    fn reaction(
        &self,
        joint: Self::Joint,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> SVector<Self::Scalar, 6> {
        self.reactions(t, q, z, input)[joint]
    }
}

/// Reactions under contact forces: of systems with contacts and without constraints.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no reactions under contact forces",
    label = "the clause `reactions(…)` brings them, where there are contacts and no constraints",
    note = "without contacts the method is `reaction`; under constraints `reactions_at` takes the accelerations"
)]
pub trait ContactReactions: Reactions + ContactSystem {
    /// [`ByFrame`](crate::frames::ByFrame) of all joints: `SMatrix<Scalar, 6, ROWS>` each.
    type ContactReactions: Copy + Debug;

    /// Change of (f, m) of every joint by a unit contact force of each row at given ż, column by column: it is less by
    /// the force that the contact already holds.
    fn contact_reactions(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::ContactReactions;

    /// (f, m) of a joint at ż, where contacts act with `forces` (normal and tangents, row by row).
    ///
    /// ż is that under these forces, as a run of `gauss-contact` has it.
    fn reaction_under<const ROWS: usize>(
        &self,
        joint: Self::Joint,
        t: Self::Scalar,
        q: &Self::Configuration,
        motion: (&Self::Speeds, &Self::Speeds),
        input: &Self::Input,
        forces: &Self::ContactRows,
    ) -> SVector<Self::Scalar, 6>
    where
        Self: ContactSystem<ContactRows = SVector<<Self as GaussSystem>::Scalar, ROWS>>,
        Self::ContactReactions: Index<Self::Joint, Output = SMatrix<Self::Scalar, 6, ROWS>>,
    {
        let (z, acceleration) = motion;
        let without = self.reactions_at(t, q, z, acceleration, input)[joint];
        let columns = self.contact_reactions(t, q)[joint];
        SVector::from(core::array::from_fn(|i| (0..ROWS).fold(without[i], |sum, k| sum + columns[(i, k)] * forces[k])))
    }
}
