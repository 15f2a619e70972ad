//! Inverse dynamics with its derivatives: what identification along a path, feedforward of elastic joints and
//! trajectory optimisation that has ż among its unknowns are made of.
//!
//! `#[gauss(linearize(inverse))]` on a struct has the derive write them: its kernel then implements
//! [`InverseLinearizedSystem`].

use core::fmt::Debug;

use nalgebra::{SMatrix, SVector};

use crate::configuration::VectorSpace;
use crate::system::GaussSystem;

/// A system whose inverse dynamics comes with its derivatives. There is no factorisation in them: they cost a fraction
/// of those of the accelerations.
///
/// The state moves by (σ, δz): `q ∘ exp(σ)` as everywhere in this crate (seen from the body: for a pose its first three
/// components move O along body axes, the last three turn about them), and `z + δz`. Under constraints the force is
/// that of [`GaussSystem::inverse_dynamics`], and its derivatives are taken along all directions, those that the
/// constraints exclude among them.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A pendulum.
#[derive(GaussDynamics)]
#[gauss(
    linearize(inverse),
    coordinates(theta),
    particle(mass = m, position = [l * sin(theta), 0, -l * cos(theta)]),
)]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.kernel()?;
// The torque that gives θ̈: m l² θ̈ + m g l sin θ.
let (hanging, still) = (SVector::from([0.0]), SVector::from([0.0]));
let inverse = kernel.linearize_inverse(0.0, &hanging, &still, &SVector::from([4.0]), &());
assert!((inverse.force[0] - 2.0 * 0.25 * 4.0).abs() < 1e-15);
assert!((inverse.by_configuration[(0, 0)] - 2.0 * 9.81 * 0.5).abs() < 1e-14);
assert!((inverse.by_acceleration[(0, 0)] - 2.0 * 0.25).abs() < 1e-15);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives of inverse dynamics, because its struct does not ask for them",
    label = "the clause `linearize(inverse)` brings them",
    note = "add `linearize(inverse)` to the `#[gauss(…)]` of the struct"
)]
pub trait InverseLinearizedSystem: GaussSystem<Input: VectorSpace<<Self as GaussSystem>::Scalar>> {
    /// [`InverseLinearization`] of this system's sizes.
    type InverseLinearization: Copy + Debug;

    /// [`GaussSystem::inverse_dynamics`] and all its derivatives, exact up to rounding. At kinks
    /// and roots as [`LinearizedSystem::linearize`](crate::linearize::LinearizedSystem::linearize) has them. Non-finite
    /// input gives non-finite output.
    fn linearize_inverse(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::InverseLinearization;
}

/// The generalised force τ that must act besides for ż to be what it is, in components dual to z, and its derivatives.
/// C counts the components of an increment σ of the configuration, N the speeds, U the components of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InverseLinearization<T, const C: usize, const N: usize, const U: usize> {
    /// τ.
    pub force: SVector<T, N>,
    /// ∂τ/∂σ.
    pub by_configuration: SMatrix<T, N, C>,
    /// ∂τ/∂z.
    pub by_speeds: SMatrix<T, N, N>,
    /// ∂τ/∂ż, which is the mass matrix.
    pub by_acceleration: SMatrix<T, N, N>,
    /// ∂τ/∂t, explicit in time: 0 where the equations do not name it.
    pub by_time: SVector<T, N>,
    /// ∂τ/∂input.
    pub by_input: SMatrix<T, N, U>,
}

impl<T, const C: usize, const N: usize, const U: usize> InverseLinearization<T, C, N, U> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(
        force: SVector<T, N>,
        by_configuration: SMatrix<T, N, C>,
        by_speeds: SMatrix<T, N, N>,
        by_acceleration: SMatrix<T, N, N>,
        by_time: SVector<T, N>,
        by_input: SMatrix<T, N, U>,
    ) -> Self {
        Self { force, by_configuration, by_speeds, by_acceleration, by_time, by_input }
    }
}
