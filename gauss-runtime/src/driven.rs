//! Driving forces: the force that moves a coordinate as a function of time says, and its power.
//!
//! `#[gauss(motion(crank = w * t))]` has the derive write them: its kernel then implements [`DrivenSystem`]. The
//! coordinate is gone from state and equations; what is left moves as it must.
//!
//! The force is what the Gauss condition lacks when the coordinate is let go: the multiplier of the one speed that it
//! would have then. Nothing else is said about it.

use core::fmt::Debug;
use core::ops::Index;

use crate::frames::FrameName;
use crate::system::GaussSystem;

/// The generalised force that moves a driven coordinate, and the power that it delivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivingForce<T> {
    /// Along the coordinate, positive where it would make it grow: N of a length, N m of an angle in radians.
    pub force: T,
    /// Force times the rate of the coordinate, in W: what the drive gives to the system.
    pub power: T,
}

/// A system with coordinates that are given as functions of time, which gives the forces that move them.
///
/// The force is beyond all else that acts on the coordinate: weight and inertia, that of an armature among them,
/// springs, dampers, friction and motors `along` it are part of the balance, so that
/// `force = inertia − weight − springs − friction − motors`, the row of inverse dynamics of the scene in which the
/// coordinate is free. Of dry friction along it, a bound f, the drive overcomes `f signum(ẋ)`; at an instant at which
/// it rests the force is known only within ±f, and told without it.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A bob that hangs from a trolley, which moves to and fro.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(trolley, angle),
    body(carriage, position = [trolley, 0, 0], mass = 2, inertia = 1),
    body(bob, parent = carriage, rotation = rotation_y(angle), mass = m, center_of_mass = [0, 0, -l],
         inertia_about_center_of_mass = 0),
    motion(trolley = a * sin(w * t)),
)]
struct Crane {
    m: f64,
    l: f64,
    a: f64,
    w: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let crane = Crane { m: 1.0, l: 0.5, a: 0.1, w: 3.0, g: 9.81 }.kernel()?;
assert_eq!(CraneKernel::DOF, 1);
// Where the trolley turns back, with the bob straight below at rest: (M + m) ẍ, less what the bob lags behind, m ẍ.
let t = 0.5 * core::f64::consts::PI / 3.0;
let drive = crane.driving_forces(t, &[0.0].into(), &[0.0].into(), &())[CraneMotion::trolley];
assert!((drive.force + 2.0 * 0.1 * 9.0).abs() < 1e-14 && drive.power.abs() < 1e-14);
# Ok(())
# }
```
"##
)]
#[doc(alias = "actuation")]
#[doc(alias = "rheonomic")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no driving forces, because nothing in its struct is driven",
    label = "the clause `motion(…)` brings them",
    note = "add `motion(crank = …)`, with a function of `t`, to the `#[gauss(…)]` of the struct"
)]
pub trait DrivenSystem: GaussSystem {
    /// The names of the driven coordinates: a variant for each, in the order of the clauses.
    type Motion: FrameName;

    /// [`ByFrame`](crate::frames::ByFrame) of all driven coordinates.
    type DrivingForces: Copy + Debug + Index<Self::Motion, Output = DrivingForce<Self::Scalar>>;

    /// The forces at the given ż, without contact forces. Under constraints with the multipliers of the motion at
    /// (t, q, z), as [`gauss_residual`](GaussSystem::gauss_residual).
    fn driving_forces_at(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::DrivingForces;

    /// The forces in the motion at (t, q, z).
    #[inline]
    fn driving_forces(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::DrivingForces {
        self.driving_forces_at(t, q, z, &self.acceleration(t, q, z, input), input)
    }
}
