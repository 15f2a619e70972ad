//! The trait `System` of `ode_solvers`: a [`FlatSystem`] is what its methods take, with vectors of a size known when
//! the program is compiled (`SVector`), or not (`DVector`).
//!
//! The vectors are those that `ode_solvers` exports, of its own version of nalgebra. In its version 0.6.2 `Dop853`
//! evaluates stage 12 at the beginning of the step instead of its end: where equations depend on time it is slow and
//! stops by `StiffnessDetected`, and `Dopri5` is the one to take.
//!
//! ```
//! use gauss_adapters::FlatSystem;
//! use gauss_runtime::prelude::*;
//!
//! /// A heavy top that turns about O.
//! #[derive(GaussDynamics)]
//! #[gauss(motion = fixed_point)]
//! struct Top {
//!     #[gauss(mass)]           mass: f64,
//!     #[gauss(center_of_mass)] center: Vector3<f64>,
//!     #[gauss(inertia)]        inertia: Vector3<f64>,
//!     #[gauss(gravity)]        g: f64,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let top = Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.4), inertia: Vector3::new(0.2, 0.2, 0.05), g: 9.81 };
//! let kernel = top.kernel()?;
//! let (tilted, spinning) = (UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0), Vector3::new(0.0, 0.0, 20.0));
//!
//! let system = FlatSystem::new(&kernel);
//! let start = ode_solvers::SVector::<f64, 7>::from(system.vector(0.0, &tilted, &spinning));
//! let mut run = ode_solvers::Dop853::new(system, 0.0, 2.0, 0.1, start, 1e-12, 1e-12);
//! run.set_output(ode_solvers::OutputType::Sparse);
//! run.integrate()?;
//! let (times, states) = run.results().get();
//! let end = system.sample(times[times.len() - 1], states[states.len() - 1].as_slice());
//!
//! let ours = Simulation::new(&kernel).adaptive(1e-12, 1e-12).run_to_end(tilted, spinning, 0.0..2.0)?;
//! assert!(end.q.angle_to(&ours.q) < 1e-8 && (end.z - ours.z).norm() < 1e-8);
//! # Ok(())
//! # }
//! ```

use ::ode_solvers::dop_shared::FloatNumber;
use ::ode_solvers::{DVector, SVector, System};

use crate::flat::FlatSystem;
use gauss_runtime::integrate::Problem;
use gauss_runtime::real::Real;
use gauss_runtime::system::GaussSystem;

impl<T, S, P, J, const N: usize> System<T, SVector<T, N>> for FlatSystem<P, J>
where
    T: Real + FloatNumber,
    S: GaussSystem<Scalar = T>,
    P: Problem<System = S>,
{
    #[inline]
    fn system(&self, t: T, x: &SVector<T, N>, slope: &mut SVector<T, N>) {
        const { assert!(N == Self::DIM, "the vector has as many components as configuration and speeds together") };
        self.rates(t, x.as_slice(), slope.as_mut_slice());
    }
}

impl<T, S, P, J> System<T, DVector<T>> for FlatSystem<P, J>
where
    T: Real + FloatNumber,
    S: GaussSystem<Scalar = T>,
    P: Problem<System = S>,
{
    #[inline]
    fn system(&self, t: T, x: &DVector<T>, slope: &mut DVector<T>) {
        self.rates(t, x.as_slice(), slope.as_mut_slice());
    }
}
