//! A kernel that counts how often its equations are evaluated, whatever a method does with them.
//!
//! A method that asks a trait of its own of a kernel needs that trait passed on here.

use std::cell::Cell;

use gauss_runtime::constraint::ProjectionError;
use gauss_runtime::prelude::*;

/// A kernel and a count of its accelerations, rates of momentum and series. Runs that are timed count too, as those of
/// the baselines do: it is one addition an evaluation.
#[derive(Clone)]
pub struct Counted<S> {
    kernel: S,
    count: Cell<u64>,
}

impl<S> Counted<S> {
    /// Nothing evaluated yet.
    pub fn new(kernel: S) -> Self {
        Self { kernel, count: Cell::new(0) }
    }

    /// So many accelerations and rates of momentum were asked for.
    pub fn evaluations(&self) -> u64 {
        self.count.get()
    }

    #[inline(always)]
    fn counting(&self) -> &S {
        self.count.set(self.count.get() + 1);
        &self.kernel
    }
}

impl<S: GaussSystem> GaussSystem for Counted<S> {
    type Scalar = S::Scalar;
    type Configuration = S::Configuration;
    type Speeds = S::Speeds;
    type MassMatrix = S::MassMatrix;
    type Input = S::Input;

    const DOF: usize = S::DOF;
    const CHART: Chart = S::CHART;
    const CONSTRAINED: bool = S::CONSTRAINED;
    const HAS_CONTACTS: bool = S::HAS_CONTACTS;
    const STATES: usize = S::STATES;
    const SMOOTHNESS: Smoothness = S::SMOOTHNESS;

    #[inline(always)]
    fn acceleration(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting().acceleration(t, q, z, input)
    }

    #[inline(always)]
    fn momentum_rate(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds, input: &S::Input) -> S::Speeds {
        self.counting().momentum_rate(t, q, p, input)
    }

    #[inline(always)]
    fn kinematics(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
    ) -> <S::Configuration as Configuration>::Tangent {
        self.kernel.kinematics(t, q, z)
    }

    #[inline(always)]
    fn configuration_rates(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
        input: &S::Input,
    ) -> <S::Configuration as Configuration>::Tangent {
        self.kernel.configuration_rates(t, q, z, input)
    }

    #[inline(always)]
    fn momentum(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.kernel.momentum(t, q, z)
    }

    #[inline(always)]
    fn velocity(&self, t: S::Scalar, q: &S::Configuration, p: &S::Speeds) -> S::Speeds {
        self.kernel.velocity(t, q, p)
    }

    #[inline(always)]
    fn regularity(&self, t: S::Scalar, q: &S::Configuration) -> S::Scalar {
        self.kernel.regularity(t, q)
    }

    #[inline(always)]
    fn project(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
    ) -> Result<(S::Configuration, S::Speeds), ProjectionError> {
        self.kernel.project(t, q, z)
    }

    #[inline(always)]
    fn dependence(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        self.kernel.dependence(t, q, z)
    }

    fn mass_matrix(&self, t: S::Scalar, q: &S::Configuration) -> S::MassMatrix {
        self.kernel.mass_matrix(t, q)
    }

    fn kinetic_energy(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Scalar {
        self.kernel.kinetic_energy(t, q, z)
    }

    fn potential_energy(&self, t: S::Scalar, q: &S::Configuration) -> S::Scalar {
        self.kernel.potential_energy(t, q)
    }

    fn gauss_residual(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
        acceleration: &S::Speeds,
        input: &S::Input,
    ) -> S::Speeds {
        self.kernel.gauss_residual(t, q, z, acceleration, input)
    }

    fn constraint_function(
        &self,
        t: S::Scalar,
        q: &S::Configuration,
        z: &S::Speeds,
        acceleration: &S::Speeds,
        input: &S::Input,
    ) -> S::Scalar {
        self.kernel.constraint_function(t, q, z, acceleration, input)
    }
}

impl<S: TaylorSystem> TaylorSystem for Counted<S> {
    type Series = S::Series;

    const GROUPS: &'static [usize] = S::GROUPS;

    #[inline(always)]
    fn expand(&self, t: S::Scalar, q: &S::Configuration, z: &S::Speeds, order: usize, series: &mut S::Series) {
        self.counting().expand(t, q, z, order, series);
    }
}
