//! The trait `ODE` of `differential-equations`: a [`FlatSystem`] is an equation for any of its types of states, arrays,
//! `Vec` and whatever its features add.
//!
//! ```
//! use differential_equations::prelude::{ExplicitRungeKutta, IVP};
//! use gauss_adapters::FlatSystem;
//! use gauss_runtime::prelude::*;
//!
//! /// A body that moves through a fluid.
//! #[derive(GaussDynamics)]
//! #[gauss(motion = free)]
//! struct Ellipsoid {
//!     #[gauss(mass)]       mass: f64,
//!     #[gauss(inertia)]    inertia: Vector3<f64>,
//!     #[gauss(added_mass)] added: Matrix6<f64>,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let added = Matrix6::from_diagonal(&Vector6::new(0.3, 0.9, 1.4, 0.02, 0.1, 0.06));
//! let kernel = Ellipsoid { mass: 1.0, inertia: Vector3::new(0.1, 0.2, 0.25), added }.kernel()?;
//! let (pose, twist) = (Isometry3::identity(), Vector6::new(1.0, 0.2, 0.0, 0.3, 0.1, -0.4));
//!
//! // The quaternion and the place of O, then the momenta.
//! let system = FlatSystem::new(&kernel).momentum_form();
//! let start: [f64; 13] = system.vector(0.0, &pose, &twist);
//! let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-12);
//! let solution = IVP::ode(&system, 0.0, 5.0, start).method(method).solve().map_err(|e| format!("{e:?}"))?;
//! let (t, x) = solution.last().map_err(|e| format!("{e:?}"))?;
//! let end = system.sample(*t, x);
//!
//! let ours = Simulation::new(&kernel).adaptive(1e-12, 1e-12).run_to_end(pose, twist, 0.0..5.0)?;
//! assert!((end.q.to_homogeneous() - ours.q.to_homogeneous()).amax() < 1e-8 && (end.z - ours.z).amax() < 1e-8);
//! # Ok(())
//! # }
//! ```

use alloc::vec;
use alloc::vec::Vec;

use ::differential_equations::linalg::Matrix;
use ::differential_equations::ode::ODE;
use ::differential_equations::traits::{Real as Scalar, State};

use crate::flat::FlatSystem;
use crate::jacobian::JacobianProduct;
use gauss_runtime::integrate::Problem;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

impl<T, Y, S, P, J> ODE<T, Y> for FlatSystem<P, J>
where
    T: Real + Scalar,
    Y: State<T>,
    S: GaussSystem<Scalar = T>,
    P: Problem<System = S>,
    J: JacobianProduct<P>,
{
    #[inline]
    fn diff(&self, t: T, x: &Y, slope: &mut Y) {
        self.rates_by(t, |i| x.get_component(i), |i, value| slope.set_component(i, value));
    }

    /// Column by column.
    fn jacobian(&self, t: T, x: &Y, matrix: &mut Matrix<T>) {
        let x: Vec<T> = (0..Self::DIM).map(|i| x.get_component(i)).collect();
        let (mut direction, mut column) = (vec![<T as Real>::zero(); Self::DIM], vec![<T as Real>::zero(); Self::DIM]);
        for j in 0..Self::DIM {
            direction[j] = <T as Real>::one();
            self.jacobian.product(self, t, &x, &direction, &mut column);
            direction[j] = <T as Real>::zero();
            for (i, &entry) in column.iter().enumerate() {
                matrix[(i, j)] = entry;
            }
        }
    }
}
