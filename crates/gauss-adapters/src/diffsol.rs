//! A problem of `diffsol`: [`FlatSystem::diffsol`] gives its `OdeBuilder` with right-hand side, Jacobian–vector product
//! and initial state set; tolerances, roots and the like are set there.
//!
//! A door with a strong damper, which is stiff, by the backward differentiation formulas:
//!
//! ```
//! use diffsol::{NalgebraLU, NalgebraMat, OdeSolverMethod, VectorCommon};
//! use gauss_adapters::FlatSystem;
//! use gauss_runtime::prelude::*;
//!
//! #[derive(GaussDynamics)]
//! #[gauss(
//!     coordinates(angle),
//!     body(door, rotation = rotation_z(angle)),
//!     spring(closer, along = angle, stiffness = spring, damping = damper),
//! )]
//! struct Door {
//!     #[gauss(body)] door: RigidBody<f64>,
//!     spring: f64,
//!     damper: f64,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let leaf = RigidBody { mass: 20.0, center_of_mass: Vector3::new(0.4, 0.0, 0.0), inertia: Matrix3::from_diagonal(&Vector3::new(1.6, 6.0, 7.0)) };
//! let kernel = Door { door: leaf, spring: 50.0, damper: 5e4 }.kernel()?;
//! let (open, at_rest) = (SVector::from([1.2]), SVector::from([0.0]));
//!
//! let system = FlatSystem::new(&kernel);
//! let problem = system.diffsol::<NalgebraMat<f64>>(0.0, &open, &at_rest).rtol(1e-8).atol([1e-10]).build()?;
//! let mut run = problem.bdf::<NalgebraLU<f64>>()?;
//! let (states, times, _) = run.solve(100.0)?;
//! # let _ = (states, times);
//! let end = system.sample(run.state().t, run.state().y.inner().as_slice());
//! // It creeps shut: θ̇ = −kθ/c.
//! assert!((end.q[0] - 1.2 * (-50.0_f64 * 100.0 / 5e4).exp()).abs() < 1e-4);
//! # Ok(())
//! # }
//! ```

use ::diffsol::{Closure, ConstantClosure, Matrix, OdeBuilder};

use crate::flat::FlatSystem;
use crate::jacobian::JacobianProduct;
use gauss_runtime::integrate::Problem;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

/// A builder with right-hand side F, Jacobian–vector product G and initial state H.
pub type Builder<M, F, G, H> = OdeBuilder<M, Closure<M, F, G>, ConstantClosure<M, H>>;

impl<S, P, J> FlatSystem<P, J>
where
    S: GaussSystem,
    P: Problem<System = S>,
    J: JacobianProduct<P>,
{
    /// A builder of `diffsol` with these equations, from the state (q, z) at time t, for matrices M. It has no
    /// parameters.
    ///
    /// ∂f/∂x is that of the system: [`Differences`](crate::ways::Differences) where nothing better was given.
    #[expect(clippy::type_complexity, reason = "closures have no names")]
    pub fn diffsol<M: Matrix<T = S::Scalar>>(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
    ) -> Builder<
        M,
        impl Fn(&[M::T], &[M::T], M::T, &mut [M::T]),
        impl Fn(&[M::T], &[M::T], M::T, &[M::T], &mut [M::T]),
        impl Fn(&[M::T], M::T, &mut [M::T]),
    > {
        let start = self.to_vec(t, q, z);
        OdeBuilder::<M>::new()
            .t0(t.lane(0))
            .rhs_implicit(
                |x, _, t, slope| self.rates(t, x, slope),
                |x, _, t, v, product| self.jacobian.product(self, t, x, v, product),
            )
            .init(move |_, _, x: &mut [M::T]| x.copy_from_slice(&start), Self::DIM)
    }
}
