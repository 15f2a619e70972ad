//! Derivatives for identification of parameters: those of the motion by the parameters, and the forces of inertia as a
//! linear function of masses, first moments and inertias.
//!
//! `#[gauss(linearize(parameters))]` on a struct has the derive write [`ParametricSystem`], `#[gauss(regressor)]`
//! [`InertialRegressor`].

use core::fmt::Debug;
use core::ops::Index;

use crate::configuration::VectorSpace;
use crate::linearize::LinearizedSystem;
use crate::system::GaussSystem;

/// A system whose equations come with their derivatives by the parameters, the numbers of the fields of its struct.
///
/// Each number of a field is a parameter, in the order of the fields. Of a symmetric matrix (inertia, added mass) the
/// entries below the diagonal are parameters: each moves with its mirror image, and counts once. A parameter that the
/// equations do not depend on has a column of zeros.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A pendulum.
#[derive(GaussDynamics)]
#[gauss(linearize(parameters), coordinates(theta), particle(mass = m, position = [l * sin(theta), 0, -l * cos(theta)]))]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.kernel()?;
assert_eq!(PendulumKernel::PARAMETERS, ["m", "l", "g"]);
// θ̈ = −(g/l) sin θ: the mass does not matter.
let theta: f64 = 0.3;
let by_parameters = kernel.by_parameters(0.0, &SVector::from([theta]), &SVector::from([0.0]), &());
assert!((by_parameters[(1, 1)] - 9.81 / 0.25 * theta.sin()).abs() < 1e-12);
assert!((by_parameters[(1, 2)] + theta.sin() / 0.5).abs() < 1e-12);
assert!(!PendulumKernel::PARAMETER_PATTERN[1][0]);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives by its parameters, because its struct does not ask for them",
    label = "the clause `linearize(parameters)` brings them",
    note = "add `linearize(parameters)` to the `#[gauss(…)]` of the struct"
)]
pub trait ParametricSystem: LinearizedSystem {
    /// `SMatrix<Scalar, D, P>`: a row for each component of (V, ż), as in
    /// [`Linearization`](crate::linearize::Linearization), a column for each parameter.
    type ByParameters: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// The parameters in order, by the names of their fields: `m`, `center[2]`, `inertia[1][0]`,
    /// `arm.center_of_mass[2]`.
    const PARAMETERS: &'static [&'static str];

    /// Which entries of [`by_parameters`](Self::by_parameters) can be other than zero, row by row.
    const PARAMETER_PATTERN: &'static [&'static [bool]];

    /// ∂(V, ż)/∂parameters at a state, exact up to rounding; under constraints those of the accelerations that satisfy
    /// them.
    ///
    /// Units are those of V or ż over those of the parameter. Kinks and roots as in [`LinearizedSystem::linearize`].
    /// Non-finite input gives non-finite output.
    fn by_parameters(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::ByParameters;
}

/// A system whose forces of inertia come as a linear function `Y π` of its inertial parameters, so that masses can be
/// identified from a motion and its forces.
///
/// The equations of motion are `Y(t, q, z, ż) π = other_forces + Jᵀλ`, and without constraints
/// `gauss_residual = Y π − other_forces` at any ż. A row of Y pairs with a component of z, its unit is that of the
/// generalised force over that of the parameter.
///
/// π has for every body the mass m, the first moment m c about O (body axes), the inertia I_O about O (body axes: six
/// entries, three principal moments, or one, by the type of the field) and the added mass, as far as they are fields;
/// for every particle its mass, if that is a field. All of it is linear at once because moments are about O, not about
/// the centre of mass.
///
/// `Y π` has the forces of inertia less those of uniform gravity: the `gravity` of the struct belongs to the masses.
/// Buoyancy and all other elements (springs, drag, the motion of a medium, central gravity, forces) are in
/// [`other_forces`](Self::other_forces), also where they are made of a mass.
///
/// Y has dependent columns as soon as some parameters have no effect by themselves: only combinations of them can be
/// identified (base parameters; W. Khalil & E. Dombre, *Modeling, Identification and Control of Robots*, chapter 9).
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(regressor, motion = fixed_point)]
struct Top {
    #[gauss(mass)]
    m: f64,
    #[gauss(center_of_mass)]
    c: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let top = Top { m: 2.0, c: Vector3::new(0.0, 0.0, 0.1), inertia: Vector3::new(0.1, 0.1, 0.05), g: 9.81 }.kernel()?;
assert_eq!(TopKernel::INERTIAL_PARAMETERS, ["m", "m * c[0]", "m * c[1]", "m * c[2]", "inertia[0]", "inertia[1]", "inertia[2]"]);
let (q, z) = (UnitQuaternion::from_euler_angles(0.3, -0.2, 0.5), Vector3::new(0.4, -1.0, 2.0));
let rate = Vector3::new(1.0, 2.0, -0.5);
let forces = top.regressor(0.0, &q, &z, &rate) * top.inertial_parameters();
let residual = top.gauss_residual(0.0, &q, &z, &rate, &());
assert!((forces - top.other_forces(0.0, &q, &z, &rate, &()) - residual).amax() < 1e-13);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no regressor, because its struct does not ask for it",
    label = "the clause `regressor` brings it",
    note = "add `regressor` to the `#[gauss(…)]` of the struct"
)]
pub trait InertialRegressor: GaussSystem {
    /// `SMatrix<Scalar, DOF, P>`.
    type Regressor: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// `SVector<Scalar, P>`.
    type InertialParameters: VectorSpace<Self::Scalar>;

    /// The entries of π in order, by the names of the fields: `m`, `m * c[0]`, `inertia[1][0]`,
    /// `arm.mass * arm.center_of_mass[2]`.
    const INERTIAL_PARAMETERS: &'static [&'static str];

    /// Which entries of Y can be other than zero, row by row.
    const REGRESSOR_PATTERN: &'static [&'static [bool]];

    /// Y at a state and the rates ż, which need not be those that the forces give. Does not depend on π.
    fn regressor(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
    ) -> Self::Regressor;

    /// π of the kernel's own parameters.
    fn inertial_parameters(&self) -> Self::InertialParameters;

    /// The generalised forces that `Y π` does not contain: those of the elements, buoyancy, and the inertia of masses
    /// that are no fields (the only ones that depend on ż). Forces of constraints are not among them.
    fn other_forces(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds;
}
