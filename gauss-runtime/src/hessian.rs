//! Second derivatives of the equations of motion along given weights: what differential dynamic programming, Newton's
//! method along a trajectory and the sensitivities of costates ask for.
//!
//! `#[gauss(linearize(hessian))]` on a struct has the derive write them: its kernel then implements [`HessianSystem`].

use core::fmt::Debug;

use nalgebra::SMatrix;

use crate::linearize::{LinearModel, LinearizedSystem};

/// A system whose equations come with the second derivatives of `λ · (V, ż)`, a number, by the state and the input.
///
/// λ weighs the rates as [`Linearization::rate`](crate::linearize::Linearization::rate) has them, V and then ż: the
/// gradient of the cost to go in dynamic programming, the costate in the maximum principle. All second derivatives of
/// all rates would be as many matrices; of one sum of them there is one, and it costs a few times
/// [`linearize`](LinearizedSystem::linearize).
///
/// The state moves by (σ, δz) as for `linearize`: second derivatives are those of `λ · (V, ż)` at `q ∘ exp(σ)`,
/// `z + δz` and `input + δu`, by σ, δz and δu at 0. They are symmetric. (Differentiating `linearize` along one
/// component of a rotation after the other is not: it differs by half of the bracket of the two,
/// [`Configuration::Tangent`](crate::configuration::Configuration), and the mean of both orders is what stands here.)
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// A pendulum with a motor at its hinge.
#[derive(GaussDynamics)]
#[gauss(
    linearize(hessian),
    coordinates(theta),
    particle(mass = m, position = [l * sin(theta), 0, -l * cos(theta)]),
    input(torque),
    drive(theta = torque),
)]
struct Pendulum {
    m: f64,
    l: f64,
    #[gauss(gravity)]
    g: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.kernel()?;
// θ̈ = −(g/l) sin θ + torque/(m l²), weighed by 3.
let (q, z, input) = (SVector::from([0.4]), SVector::from([1.0]), SVector::from([0.2]));
let second = kernel.hessian(0.0, &q, &z, &input, &SVector::from([7.0, 3.0]));
assert!((second.by_state[(0, 0)] - 3.0 * 9.81 / 0.5 * 0.4_f64.sin()).abs() < 1e-13);
assert_eq!(second.by_state[(1, 1)], 0.0);
assert_eq!(second.by_input_and_state[(0, 0)], 0.0);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no second derivatives, because its struct does not ask for them",
    label = "the clause `linearize(hessian)` brings them",
    note = "add `linearize(hessian)` to the `#[gauss(…)]` of the struct"
)]
pub trait HessianSystem: LinearizedSystem {
    /// [`Hessian`] of this system's sizes.
    type Hessian: Copy + Debug;

    /// The second derivatives of `weights · (V, ż)`, exact up to rounding; under constraints those of the accelerations
    /// that satisfy them.
    ///
    /// At a kink (`abs`, `min`, `max`, `clamp`) second derivatives are those of its two sides; the kink itself adds
    /// nothing. Where a root is 0 they are of no use. Non-finite input gives non-finite output.
    fn hessian(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
        weights: &<Self::Linearization as LinearModel<Self::Scalar>>::Vector,
    ) -> Self::Hessian;
}

/// The second derivatives of a weighted sum of the rates. D counts the components of (σ, δz), U those of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hessian<T, const D: usize, const U: usize> {
    /// Second derivatives by (σ, δz) twice; symmetric.
    pub by_state: SMatrix<T, D, D>,
    /// Mixed second derivatives by a component of the input, row by row, and one of (σ, δz).
    pub by_input_and_state: SMatrix<T, U, D>,
    /// Second derivatives by the input twice; symmetric. Zero where inputs enter linearly.
    pub by_input: SMatrix<T, U, U>,
}

impl<T, const D: usize, const U: usize> Hessian<T, D, U> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(by_state: SMatrix<T, D, D>, by_input_and_state: SMatrix<T, U, D>, by_input: SMatrix<T, U, U>) -> Self {
        Self { by_state, by_input_and_state, by_input }
    }
}
