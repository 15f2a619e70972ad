//! Frames of a system and their motion: pose, twist, Jacobian and acceleration of bodies and frames by their names.
//!
//! `#[gauss(frames(tool, left_foot))]` has the derive write them: its kernel then implements [`FramedSystem`].
//!
//! A frame is a body or a `frame(…)` of the scene: its origin O and its axes e. Vectors have components in the axes of
//! the frame itself, and the pole is its origin: (linear, angular), as everywhere in this crate. [`in_observers_axes`]
//! turns them, and [`moved_to`] takes them to another point of the frame.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::Index;

use nalgebra::{IsometryMatrix3, Rotation3, SMatrix, SVector, Vector3};

use crate::real::Real;
use crate::system::GaussSystem;
use crate::triple::{Triple, add, cross};

/// R and b of a frame, nalgebra's type with a matrix for the rotation: `x̂ = R x + b`.
pub type FramePose<T> = IsometryMatrix3<T>;

/// A system that gives poses, twists and Jacobians of the frames that the scene names.
///
/// With the Jacobian J of a frame, its twist is `J z` and its acceleration `J ż + bias`. The twist of a frame whose
/// motion is partly a function of time is `J z` plus its twist at z = 0.
///
/// | of a frame | here | Pinocchio | Drake |
/// |---|---|---|---|
/// | R and b | [`pose_of`](Self::pose_of) | `updateFramePlacement`: `oMf` | `CalcPoseInWorld` |
/// | (u, ω) | [`twist_of`](Self::twist_of) | `getFrameVelocity`, `LOCAL` | `CalcSpatialVelocity` (angular part first) |
/// | J | [`jacobian_of`](Self::jacobian_of) | `getFrameJacobian`, `LOCAL` | `CalcJacobianSpatialVelocity` |
/// | bias | [`bias_of`](Self::bias_of) | `getFrameClassicalAcceleration` at q̈ = 0, `LOCAL` | `CalcBiasSpatialAcceleration` |
/// | the same, seen by the observer | [`in_observers_axes`] of it | `LOCAL_WORLD_ALIGNED` | in world |
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::frames::in_observers_axes;
use gauss_runtime::prelude::*;

/// Two links in the vertical plane with a tool at the end.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(shoulder, elbow),
    body(upper, rotation = rotation_y(shoulder), mass = 2.0, center_of_mass = [0, 0, -0.2], inertia = [0.1, 0.1, 0.01]),
    body(lower, parent = upper, position = [0, 0, -0.4], rotation = rotation_y(elbow), mass = 1.0,
         center_of_mass = [0, 0, -0.2], inertia = [0.06, 0.06, 0.01]),
    frame(tool, parent = lower, position = [0, 0, -0.5]),
    frames(tool, lower),
)]
struct Arm {
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let arm = Arm { g: 9.81 }.kernel()?;
let (q, z) = (SVector::from([0.0, 0.0]), SVector::from([1.0, 2.0]));
let pose = arm.pose_of(ArmFrame::tool, 0.0, &q);
assert_eq!(pose.translation.vector, Vector3::new(0.0, 0.0, -0.9));
let jacobian = arm.jacobian_of(ArmFrame::tool, 0.0, &q);
let twist = arm.twist_of(ArmFrame::tool, 0.0, &q, &z);
assert!((jacobian * z - twist).amax() < 1e-15);
// u = (−0.9 · 1 − 0.5 · 2, 0, 0) and ω = (0, 3, 0); here the observer's axes are those of the tool.
assert!((in_observers_axes(&pose, &twist) - Vector6::new(-1.9, 0.0, 0.0, 0.0, 3.0, 0.0)).amax() < 1e-15);
// All at once, what they have in common computed once.
let frames = arm.frames(0.0, &q, &z);
assert_eq!(frames[ArmFrame::tool].twist, twist);
assert_eq!(ArmFrame::named("lower"), Some(ArmFrame::lower));
# Ok(())
# }
```
"##
)]
#[doc(alias = "jacobian")]
#[doc(alias = "forward kinematics")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no frames, because its struct does not ask for them",
    label = "the clause `frames(…)` brings them",
    note = "add `frames(…)`, with names of bodies and frames, to the `#[gauss(…)]` of the struct"
)]
pub trait FramedSystem: GaussSystem {
    /// The names of the frames: a variant for each, called as in the scene.
    type Frame: FrameName;

    /// `SMatrix<Scalar, 6, DOF>`.
    type Jacobian: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// [`ByFrame`] of all frames.
    type Frames: Index<Self::Frame, Output = FrameMotion<Self::Scalar, Self::Jacobian>>;

    /// The pose (R, b): `x̂ = R x + b` takes coordinates in the frame to the observer's. R is a matrix, as it is
    /// computed.
    fn pose_of(&self, frame: Self::Frame, t: Self::Scalar, q: &Self::Configuration) -> FramePose<Self::Scalar>;

    /// The twist (u, ω): velocity of the origin and angular velocity, both relative to the observer, components in the
    /// frame's axes.
    fn twist_of(
        &self,
        frame: Self::Frame,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> SVector<Self::Scalar, 6>;

    /// ∂(u, ω)/∂z, a column for each speed: rows as [`twist_of`](Self::twist_of).
    fn jacobian_of(&self, frame: Self::Frame, t: Self::Scalar, q: &Self::Configuration) -> Self::Jacobian;

    /// (a, ω̇) at ż = 0: acceleration of the origin and angular acceleration as the observer sees them, components in
    /// the frame's axes. So (a, ω̇) is `J ż + bias`.
    ///
    /// a is the *classical* acceleration d²b/dt² of a point, `u̇ + ω × u`, not the rate u̇ of components in turning
    /// axes. Seen in observer's axes it is d/dt(R J) z, and what moves as a function of time besides. Gravity is no
    /// part of it.
    fn bias_of(
        &self,
        frame: Self::Frame,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> SVector<Self::Scalar, 6>;

    /// All of this of all frames at once: what they have in common, such as sines and cosines, is computed once.
    fn frames(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Frames;
}

/// A system that gives the time derivatives of the Jacobians of its frames: `frames(tool), methods(jacobian_rates)`.
///
/// The rate is the one that the observer sees, with components in the axes of the frame: `J̇ = Rᵀ d(R J)/dt`. So the
/// acceleration of a frame is `J ż + J̇ z`, and `J̇ z` is [`bias_of`](FramedSystem::bias_of) where nothing is moved as
/// a function of time. [`in_observers_axes`] of it is the rate of [`in_observers_axes`] of J (Pinocchio's
/// `getFrameJacobianTimeVariation`, `LOCAL_WORLD_ALIGNED`). The rate of the components in the turning axes of the frame
/// (`LOCAL` there) is J̇ less ω × both parts of each column of J. Where `J̇ z` is all that is wanted, `bias_of` costs a
/// fraction.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no rates of Jacobians, because its struct does not ask for them",
    label = "the clause `methods(jacobian_rates)` brings them",
    note = "add `methods(jacobian_rates)` beside `frames(…)` to the `#[gauss(…)]` of the struct"
)]
pub trait JacobianRates: FramedSystem {
    /// J̇, a column for each speed: rows as [`twist_of`](FramedSystem::twist_of).
    fn jacobian_rate_of(
        &self,
        frame: Self::Frame,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> Self::Jacobian;
}

/// Names of frames: an enum with a variant for each, generated.
pub trait FrameName: Copy + Debug + PartialEq + 'static {
    /// All of them, in the order in which `frames(…)` names them.
    const ALL: &'static [Self];

    /// As in the scene.
    fn name(self) -> &'static str;

    /// Its place in [`ALL`](Self::ALL).
    fn index(self) -> usize;

    /// The frame of that name; `None` if `frames(…)` of the scene does not name it.
    #[must_use]
    fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|frame| frame.name() == name)
    }
}

/// Pose, twist, Jacobian and acceleration bias of a frame: see [`FramedSystem`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct FrameMotion<T, J> {
    /// R and b.
    pub pose: FramePose<T>,
    /// (u, ω).
    pub twist: SVector<T, 6>,
    /// ∂(u, ω)/∂z.
    pub jacobian: J,
    /// (a, ω̇) at ż = 0.
    pub bias: SVector<T, 6>,
}

impl<T, J> FrameMotion<T, J> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(pose: FramePose<T>, twist: SVector<T, 6>, jacobian: J, bias: SVector<T, 6>) -> Self {
        Self { pose, twist, jacobian, bias }
    }
}

impl<T: Real, const N: usize> FrameMotion<T, SMatrix<T, 6, N>> {
    /// (a, ω̇) at the given ż, components in the frame's axes: `J ż + bias`.
    #[inline]
    pub fn acceleration(&self, rates: &SVector<T, N>) -> SVector<T, 6> {
        SVector::from(core::array::from_fn(|i| {
            (0..N).fold(self.bias[i], |sum, k| self.jacobian[(i, k)].fma(rates[k], sum))
        }))
    }

    /// The same with all components in observer's axes; the pole stays the origin of the frame.
    #[inline]
    #[must_use]
    pub fn in_observers_axes(&self) -> Self {
        Self {
            pose: self.pose,
            twist: in_observers_axes(&self.pose, &self.twist),
            jacobian: in_observers_axes(&self.pose, &self.jacobian),
            bias: in_observers_axes(&self.pose, &self.bias),
        }
    }
}

/// A value for each frame, by its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByFrame<F, X, const N: usize> {
    values: [X; N],
    names: PhantomData<F>,
}

impl<F: FrameName, X, const N: usize> ByFrame<F, X, N> {
    /// In the order of [`FrameName::ALL`].
    #[inline(always)]
    pub fn new(values: [X; N]) -> Self {
        Self { values, names: PhantomData }
    }

    /// Every frame with its value.
    pub fn iter(&self) -> impl Iterator<Item = (F, &X)> {
        F::ALL.iter().copied().zip(&self.values)
    }
}

impl<F: FrameName, X, const N: usize> Index<F> for ByFrame<F, X, N> {
    type Output = X;

    #[inline]
    fn index(&self, frame: F) -> &X {
        &self.values[frame.index()]
    }
}

/// Columns (linear, angular) with components in the axes of a frame (twists, accelerations, wrenches, Jacobians), with
/// components in observer's axes: R of both parts. The pole stays where it is.
#[inline]
pub fn in_observers_axes<T: Real, const N: usize>(pose: &FramePose<T>, columns: &SMatrix<T, 6, N>) -> SMatrix<T, 6, N> {
    of_columns(columns, |[linear, angular]| [linear, angular].map(|part| turned(&pose.rotation, part)))
}

/// The inverse of [`in_observers_axes`]: Rᵀ of both parts.
#[inline]
pub fn in_frames_axes<T: Real, const N: usize>(pose: &FramePose<T>, columns: &SMatrix<T, 6, N>) -> SMatrix<T, 6, N> {
    of_columns(columns, |[linear, angular]| [linear, angular].map(|part| turned_back(&pose.rotation, part)))
}

/// Twists, or Jacobians of twists, with the pole at another point of the frame: `u + ω × at`, and ω as it is.
///
/// `at` is from the old pole, in the axes of the columns. For a point that is fixed in a frame `at` are its coordinates
/// there.
#[inline]
pub fn moved_to<T: Real, const N: usize>(at: &Vector3<T>, columns: &SMatrix<T, 6, N>) -> SMatrix<T, 6, N> {
    let at = at.data.0[0];
    of_columns(columns, |[linear, angular]| [add(linear, cross(angular, at)), angular])
}

fn of_columns<T: Real, const N: usize>(
    columns: &SMatrix<T, 6, N>,
    f: impl Fn([Triple<T>; 2]) -> [Triple<T>; 2],
) -> SMatrix<T, 6, N> {
    SMatrix::from(columns.data.0.map(|[a, b, c, d, e, g]| {
        let [[a, b, c], [d, e, g]] = f([[a, b, c], [d, e, g]]);
        [a, b, c, d, e, g]
    }))
}

#[inline(always)]
fn turned<T: Real>(rotation: &Rotation3<T>, a: Triple<T>) -> Triple<T> {
    let r = rotation.matrix();
    core::array::from_fn(|i| r[(i, 0)].fma(a[0], r[(i, 1)].fma(a[1], r[(i, 2)] * a[2])))
}

#[inline(always)]
fn turned_back<T: Real>(rotation: &Rotation3<T>, a: Triple<T>) -> Triple<T> {
    let r = rotation.matrix();
    core::array::from_fn(|i| r[(0, i)].fma(a[0], r[(1, i)].fma(a[1], r[(2, i)] * a[2])))
}
