//! A system on any configuration: what groups do with velocities that change, and nothing else.

use core::ops::Index;

use crate::chart::Chart;
use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::GaussSystem;

/// The matrix of an inertia that is 1 for every speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Identity<T> {
    zero: T,
    one: T,
}

impl<T> Index<(usize, usize)> for Identity<T> {
    type Output = T;

    fn index(&self, (row, column): (usize, usize)) -> &T {
        if row == column { &self.one } else { &self.zero }
    }
}

/// Speeds that push and drag alone change, each by itself, on any configuration: `V = z`, `ż = push − drag z`.
#[derive(Clone, Copy)]
pub(crate) struct Coasting<C: Configuration> {
    pub(crate) push: C::Tangent,
    pub(crate) drag: C::Scalar,
}

impl<C: Configuration> GaussSystem for Coasting<C> {
    type Scalar = C::Scalar;
    type Configuration = C;
    type Speeds = C::Tangent;
    type MassMatrix = Identity<C::Scalar>;
    type Input = ();
    const DOF: usize = <C::Tangent as VectorSpace<C::Scalar>>::DIM;
    const CHART: Chart = Chart::Own;

    fn kinematics(&self, _: C::Scalar, _: &C, z: &C::Tangent) -> C::Tangent {
        *z
    }
    fn acceleration(&self, _: C::Scalar, _: &C, z: &C::Tangent, (): &()) -> C::Tangent {
        self.push.add_scaled(-self.drag, z)
    }
    fn momentum(&self, _: C::Scalar, _: &C, z: &C::Tangent) -> C::Tangent {
        *z
    }
    fn velocity(&self, _: C::Scalar, _: &C, p: &C::Tangent) -> C::Tangent {
        *p
    }
    fn momentum_rate(&self, t: C::Scalar, q: &C, p: &C::Tangent, (): &()) -> C::Tangent {
        self.acceleration(t, q, p, &())
    }
    fn mass_matrix(&self, _: C::Scalar, _: &C) -> Identity<C::Scalar> {
        Identity { zero: Real::zero(), one: Real::one() }
    }
    fn kinetic_energy(&self, _: C::Scalar, _: &C, z: &C::Tangent) -> C::Scalar {
        let squares = (0..Self::DOF).map(|i| z.component(i) * z.component(i));
        C::Scalar::ratio(1, 2) * squares.fold(C::Scalar::zero(), |sum, square| sum + square)
    }
    fn potential_energy(&self, _: C::Scalar, _: &C) -> C::Scalar {
        C::Scalar::zero()
    }
    fn gauss_residual(&self, t: C::Scalar, q: &C, z: &C::Tangent, acceleration: &C::Tangent, (): &()) -> C::Tangent {
        acceleration.add_scaled(-C::Scalar::one(), &self.acceleration(t, q, z, &()))
    }
    fn constraint_function(
        &self,
        t: C::Scalar,
        q: &C,
        z: &C::Tangent,
        acceleration: &C::Tangent,
        (): &(),
    ) -> C::Scalar {
        self.kinetic_energy(t, q, &self.gauss_residual(t, q, z, acceleration, &()))
    }
}

/// An increment with components of both signs, angles about 1.
pub(crate) fn increment<V: VectorSpace<T>, T: Real>(seed: f64) -> V {
    let mut v = V::zero();
    for i in 0..V::DIM {
        v.set_component(i, T::from_f64((seed + 2.3 * i as f64).sin()));
    }
    v
}
