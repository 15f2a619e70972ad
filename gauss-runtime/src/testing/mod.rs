//! Systems that tests of several modules share: dual numbers, a free rigid body and constrained systems typed by hand.
//! Runs of 10⁵ steps and more are in `tests/long_runs/tests/rounding`, which includes this folder and is optimised.
//!
//! The hand-typed Euler equations are an independent check of the integrators; kernels proper are derived.

use nalgebra::{SMatrix, SVector, UnitQuaternion};

use crate::chart::Chart;
use crate::description::DescribedSystem;
use crate::real::Real;
use crate::system::GaussSystem;

pub(crate) mod coasting;
pub(crate) mod constrained;
pub(crate) mod dual;
pub(crate) mod order;
pub(crate) mod oscillator;

/// A body that turns freely about its centre of mass, principal axes: `I ω̇ = Iω × ω + M`, z = ω in the body frame.
#[derive(Clone, Copy)]
pub(crate) struct FreeTop<T> {
    pub(crate) inertia: [T; 3],
}

impl<T: Real> DescribedSystem for FreeTop<T> {}

impl<T: Real> GaussSystem for FreeTop<T> {
    type Scalar = T;
    type Configuration = UnitQuaternion<T>;
    type Speeds = SVector<T, 3>;
    type MassMatrix = SMatrix<T, 3, 3>;
    /// A torque, body frame.
    type Input = [T; 3];

    const DOF: usize = 3;
    const CHART: Chart = Chart::LeftInvariant;

    fn kinematics(&self, _: T, _: &UnitQuaternion<T>, z: &SVector<T, 3>) -> SVector<T, 3> {
        *z
    }
    fn acceleration(&self, t: T, q: &UnitQuaternion<T>, z: &SVector<T, 3>, input: &[T; 3]) -> SVector<T, 3> {
        let rate = self.momentum_rate(t, q, &self.momentum(t, q, z), input);
        self.velocity(t, q, &rate)
    }
    fn momentum(&self, _: T, _: &UnitQuaternion<T>, z: &SVector<T, 3>) -> SVector<T, 3> {
        SVector::from(core::array::from_fn(|i| self.inertia[i] * z.data.0[0][i]))
    }
    fn velocity(&self, _: T, _: &UnitQuaternion<T>, p: &SVector<T, 3>) -> SVector<T, 3> {
        SVector::from(core::array::from_fn(|i| p.data.0[0][i] / self.inertia[i]))
    }
    fn momentum_rate(&self, t: T, q: &UnitQuaternion<T>, p: &SVector<T, 3>, input: &[T; 3]) -> SVector<T, 3> {
        let omega = self.velocity(t, q, p).data.0[0];
        SVector::from(crate::triple::add(crate::triple::cross(p.data.0[0], omega), *input))
    }
    fn mass_matrix(&self, _: T, _: &UnitQuaternion<T>) -> SMatrix<T, 3, 3> {
        SMatrix::from_fn(|i, j| if i == j { self.inertia[i] } else { T::zero() })
    }
    fn kinetic_energy(&self, t: T, q: &UnitQuaternion<T>, z: &SVector<T, 3>) -> T {
        T::ratio(1, 2) * crate::triple::dot(z.data.0[0], self.momentum(t, q, z).data.0[0])
    }
    fn potential_energy(&self, _: T, _: &UnitQuaternion<T>) -> T {
        T::zero()
    }
    fn gauss_residual(
        &self,
        t: T,
        q: &UnitQuaternion<T>,
        z: &SVector<T, 3>,
        acceleration: &SVector<T, 3>,
        input: &[T; 3],
    ) -> SVector<T, 3> {
        let rate = self.momentum_rate(t, q, &self.momentum(t, q, z), input);
        SVector::from(crate::triple::sub(self.momentum(t, q, acceleration).data.0[0], rate.data.0[0]))
    }
    fn constraint_function(
        &self,
        t: T,
        q: &UnitQuaternion<T>,
        z: &SVector<T, 3>,
        acceleration: &SVector<T, 3>,
        input: &[T; 3],
    ) -> T {
        let rate = self.momentum_rate(t, q, &self.momentum(t, q, z), input);
        self.kinetic_energy(t, q, acceleration) - crate::triple::dot(rate.data.0[0], acceleration.data.0[0])
    }
}
