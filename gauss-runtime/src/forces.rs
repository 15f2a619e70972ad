//! Forces on a system, element by element: generalised forces and powers by name, and the balance of energy.
//!
//! With E the kinetic and potential energy, and P_e the power of element e, `dE/dt = Σ P_e + ∂U/∂t`, summed over the
//! elements whose work the potential energy U does not count already: [`ForcedSystem::supplied_power`].

use core::fmt;

use nalgebra::{SMatrix, SVector};

use crate::configuration::VectorSpace;
use crate::real::Real;
use crate::sealed::Sealed;
use crate::system::GaussSystem;

/// A system whose forces are known element by element: the right-hand side of (3.4).
///
/// An element is one clause of the scene that makes a force: gravity, a spring, drag on a body, a motor. Units are
/// those of the user's parameters: powers in energy per time; component α of a generalised force in power per unit of
/// z_α.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no forces, because nothing acts in its scene",
    label = "clauses such as `force(…)`, `spring(…)` and `gravity = …` bring them"
)]
pub trait ForcedSystem: GaussSystem {
    /// `SVector<Scalar, E>` with `E = ELEMENTS.len()`: one component for each element.
    type Powers: VectorSpace<Self::Scalar>;

    /// `SMatrix<Scalar, DOF, E>`: one column for each element.
    type ElementForces: Columns<Self::Speeds>;

    /// The elements in the order of [`Powers`](Self::Powers): those in the potential energy first. Names are unique.
    const ELEMENTS: &'static [Element];

    /// The power that each element delivers to the system (negative: takes from it): its forces and torques times the
    /// velocities, relative to the observer, of the points and bodies on which they act.
    fn powers(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds, input: &Self::Input) -> Self::Powers;

    /// Column e: `∫ ∂v_P/∂z · dF` of element e. The sum of the columns is the right-hand side of (3.4).
    fn element_forces(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::ElementForces;

    /// dE/dt by the elements, E = T + U: the powers of those that are not in the potential energy, and of the dampers
    /// of springs and stops that are, plus ∂U/∂t.
    ///
    /// It is all of dE/dt. Where something is moved as a function of time (a prescribed coordinate, a constraint that
    /// depends on t), whatever moves it does work as well: that is the last element, `guides`, which has no generalised
    /// force.
    fn supplied_power(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Scalar;

    /// The power that the element with this name delivers; `None` when there is no such element.
    #[inline]
    fn power(
        &self,
        name: &str,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Option<Self::Scalar> {
        let element = position::<Self>(name)?;
        Some(self.powers(t, q, z, input).component(element))
    }

    /// The generalised force `∫ ∂v_P/∂z · dF` of the element with this name; `None` when there is no such element.
    #[inline]
    fn generalised_force(
        &self,
        name: &str,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Option<Self::Speeds> {
        let element = position::<Self>(name)?;
        self.element_forces(t, q, z, input).nth(element)
    }
}

/// The place of an element in the lists of a system.
fn position<S: ForcedSystem + ?Sized>(name: &str) -> Option<usize> {
    S::ELEMENTS.iter().position(|element| element.name == name)
}

/// One element of the forces on a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Element {
    /// Its name in the scene, or the name of its kind where it has none.
    pub name: &'static str,
    /// Whether [`potential_energy`](GaussSystem::potential_energy) counts its work; of a spring with a damper, that of
    /// the spring.
    pub conservative: bool,
    /// Whether it is a spring or a stop with a damper, whose power changes the energy.
    pub damped: bool,
}

impl Element {
    /// An element from its parts, in the order of the fields.
    #[must_use]
    pub const fn new(name: &'static str, conservative: bool) -> Self {
        Self { name, conservative, damped: false }
    }

    /// The same with a damper.
    #[must_use]
    pub const fn with_damper(self) -> Self {
        Self { damped: true, ..self }
    }
}

impl fmt::Display for Element {
    /// `spring (in the potential energy)`, `stop (in the potential energy, with a damper)`, `drag`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        match (self.conservative, self.damped) {
            (true, true) => f.write_str(" (in the potential energy, with a damper)"),
            (true, false) => f.write_str(" (in the potential energy)"),
            (false, _) => Ok(()),
        }
    }
}

/// A matrix that is a list of columns `V`.
pub trait Columns<V>: Sealed {
    /// Column `n`, counted from 0; `None` beyond the last.
    fn nth(&self, n: usize) -> Option<V>;
}

impl<T, const N: usize, const E: usize> Sealed for SMatrix<T, N, E> {}

impl<T: Real, const N: usize, const E: usize> Columns<SVector<T, N>> for SMatrix<T, N, E> {
    #[inline]
    fn nth(&self, n: usize) -> Option<SVector<T, N>> {
        self.data.0.get(n).map(|column| SVector::from(*column))
    }
}

#[cfg(test)]
#[path = "forces_tests.rs"]
mod tests;
