//! An oscillator with elements, typed by hand: a spring that may stiffen with time, friction or a stop, a drive.

use core::marker::PhantomData;

use nalgebra::{SMatrix, SVector};

use crate::chart::Chart;
use crate::forces::{Element, ForcedSystem};
use crate::system::{GaussSystem, Smoothness};

type One = SVector<f64, 1>;

/// A force that depends on position and velocity.
pub(crate) trait ForceLaw {
    const SMOOTHNESS: Smoothness;
    fn force(x: f64, v: f64) -> f64;
}

/// −0.3 v.
pub(crate) struct Viscous;

impl ForceLaw for Viscous {
    const SMOOTHNESS: Smoothness = Smoothness::Smooth;
    fn force(_: f64, v: f64) -> f64 {
        -0.3 * v
    }
}

/// A second spring of stiffness 8 for x > 0 only.
pub(crate) struct OneSided;

impl ForceLaw for OneSided {
    const SMOOTHNESS: Smoothness = Smoothness::Kinks;
    fn force(x: f64, _: f64) -> f64 {
        -8.0 * x.max(0.0)
    }
}

/// Dry friction of size ½.
pub(crate) struct Dry;

impl ForceLaw for Dry {
    const SMOOTHNESS: Smoothness = Smoothness::Jumps;
    fn force(_: f64, v: f64) -> f64 {
        -0.5 * crate::real::Real::signum(v)
    }
}

/// `ẍ = −k(t) x + law(x, ẋ) + input`, `k(t) = 1 + a t`, mass 1.
pub(crate) struct Oscillator<L> {
    /// a.
    pub(crate) stiffening: f64,
    law: PhantomData<L>,
}

impl<L> Oscillator<L> {
    pub(crate) const fn new(stiffening: f64) -> Self {
        Self { stiffening, law: PhantomData }
    }

    fn stiffness(&self, t: f64) -> f64 {
        1.0 + self.stiffening * t
    }
}

impl<L: ForceLaw> ForcedSystem for Oscillator<L> {
    type Powers = SVector<f64, 3>;
    type ElementForces = SMatrix<f64, 1, 3>;
    const ELEMENTS: &'static [Element] =
        &[Element::new("spring", true), Element::new("law", false), Element::new("drive", false)];

    fn powers(&self, t: f64, q: &One, z: &One, input: &f64) -> SVector<f64, 3> {
        (self.element_forces(t, q, z, input) * z[0]).transpose()
    }
    fn element_forces(&self, t: f64, q: &One, z: &One, input: &f64) -> SMatrix<f64, 1, 3> {
        SMatrix::from([[-self.stiffness(t) * q[0]], [L::force(q[0], z[0])], [*input]])
    }
    fn supplied_power(&self, _: f64, q: &One, z: &One, input: &f64) -> f64 {
        (L::force(q[0], z[0]) + input) * z[0] + 0.5 * self.stiffening * q[0] * q[0]
    }
}

impl<L: ForceLaw> GaussSystem for Oscillator<L> {
    type Scalar = f64;
    type Configuration = One;
    type Speeds = One;
    type MassMatrix = SMatrix<f64, 1, 1>;
    /// A force.
    type Input = f64;
    const DOF: usize = 1;
    const CHART: Chart = Chart::Own;
    const SMOOTHNESS: Smoothness = L::SMOOTHNESS;

    fn kinematics(&self, _: f64, _: &One, z: &One) -> One {
        *z
    }
    fn acceleration(&self, t: f64, q: &One, z: &One, input: &f64) -> One {
        One::from([L::force(q[0], z[0]) + input - self.stiffness(t) * q[0]])
    }
    fn momentum(&self, _: f64, _: &One, z: &One) -> One {
        *z
    }
    fn velocity(&self, _: f64, _: &One, p: &One) -> One {
        *p
    }
    fn momentum_rate(&self, t: f64, q: &One, p: &One, input: &f64) -> One {
        self.acceleration(t, q, p, input)
    }
    fn mass_matrix(&self, _: f64, _: &One) -> SMatrix<f64, 1, 1> {
        SMatrix::identity()
    }
    fn kinetic_energy(&self, _: f64, _: &One, z: &One) -> f64 {
        0.5 * z[0] * z[0]
    }
    fn potential_energy(&self, t: f64, q: &One) -> f64 {
        0.5 * self.stiffness(t) * q[0] * q[0]
    }
    fn gauss_residual(&self, t: f64, q: &One, z: &One, acceleration: &One, input: &f64) -> One {
        acceleration - self.acceleration(t, q, z, input)
    }
    fn constraint_function(&self, t: f64, q: &One, z: &One, acceleration: &One, input: &f64) -> f64 {
        let excess = self.gauss_residual(t, q, z, acceleration, input)[0];
        0.5 * excess * excess
    }
}
