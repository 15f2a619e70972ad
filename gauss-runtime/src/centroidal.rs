//! A system as a whole: its centre of mass and its momenta about that, and what holds its weight.
//!
//! `#[gauss(methods(centroidal, gravity_torques))]` has the derive write them.

use core::fmt::Debug;
use core::ops::Index;

use nalgebra::{SVector, Vector3};

use crate::system::GaussSystem;
use crate::triple::{add, cross, sub, triple};

/// A system that gives its centre of mass G and its momenta about G: `methods(centroidal)`.
///
/// Components are the observer's, of momenta linear then angular. All bodies and particles count, the fluid around
/// bodies does not. Without mass there is no centre, and the numbers are not finite.
///
/// With the *centroidal momentum matrix* `A_G` the momentum is `h = A_G z`, and `dh/dt = A_G ż + bias` is the resultant
/// of all forces from outside and their torque about G (D. E. Orin, A. Goswami & S.-H. Lee, *Centroidal dynamics of a
/// humanoid robot*, Autonomous Robots 35, 2013). Where something is moved as a function of time the momentum at z = 0
/// comes besides.
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::prelude::*;

/// Two balls joined by a spring.
#[derive(GaussDynamics)]
#[gauss(
    methods(centroidal),
    coordinates(a, b),
    particle(mass = 1, position = [a, 0, 0]),
    particle(mass = m, position = [b, 1, 0]),
    spring(from = [a, 0, 0], to = [b, 1, 0], stiffness = 4),
)]
struct Balls {
    m: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let balls = Balls { m: 3.0 }.kernel()?;
let (q, z) = (SVector::from([0.0, 4.0]), SVector::from([1.0, -1.0]));
assert_eq!(balls.total_mass(), 4.0);
assert_eq!(balls.center_of_mass(0.0, &q), Vector3::new(3.0, 0.75, 0.0));
assert_eq!(balls.center_velocity(0.0, &q, &z), Vector3::new(-0.5, 0.0, 0.0));
// About G the one is ¾ below and the other ¼ above.
let h = balls.centroidal_momentum(0.0, &q, &z);
assert_eq!(h, Vector6::new(-2.0, 0.0, 0.0, 0.0, 0.0, 0.75 + 0.75));
assert_eq!(balls.centroidal_matrix(0.0, &q) * z, h);
assert_eq!(balls.momentum_about(&Vector3::zeros(), 0.0, &q, &z)[5], 3.0);
# Ok(())
# }
```
"##
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no sums over all bodies, because its struct does not ask for them",
    label = "the clause `methods(centroidal)` brings them",
    note = "add `methods(centroidal)` to the `#[gauss(…)]` of the struct"
)]
pub trait CentroidalSystem: GaussSystem {
    /// `SMatrix<Scalar, 6, DOF>`.
    type CentroidalMatrix: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// `SMatrix<Scalar, 3, DOF>`.
    type CenterJacobian: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// The mass of all bodies and particles.
    fn total_mass(&self) -> Self::Scalar;

    /// G − Ω.
    fn center_of_mass(&self, t: Self::Scalar, q: &Self::Configuration) -> Vector3<Self::Scalar>;

    /// (Q̂, Γ̂_G): linear momentum, and angular momentum about G.
    fn centroidal_momentum(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> SVector<Self::Scalar, 6>;

    /// A_G = ∂(Q̂, Γ̂_G)/∂z.
    fn centroidal_matrix(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::CentroidalMatrix;

    /// d(Q̂, Γ̂_G)/dt at ż = 0: `Ȧ_G z`, and what moves as a function of time besides.
    fn centroidal_bias(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> SVector<Self::Scalar, 6>;

    /// ∂v_G/∂z: the upper rows of A_G over the mass.
    fn center_jacobian(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::CenterJacobian;

    /// v_G.
    #[inline]
    fn center_velocity(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Vector3<Self::Scalar> {
        let (h, mass) = (self.centroidal_momentum(t, q, z), self.total_mass());
        Vector3::new(h[0] / mass, h[1] / mass, h[2] / mass)
    }

    /// (Q̂, Γ̂) about a point that is given from Ω in observer's axes: `Γ̂_G + (G − point) × Q̂`.
    #[inline]
    fn momentum_about(
        &self,
        point: &Vector3<Self::Scalar>,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> SVector<Self::Scalar, 6> {
        let [a, b, c, d, e, f] = self.centroidal_momentum(t, q, z).data.0[0];
        let lever = sub(triple(&self.center_of_mass(t, q)), triple(point));
        let [d, e, f] = add([d, e, f], cross(lever, [a, b, c]));
        SVector::from([a, b, c, d, e, f])
    }
}

/// A system that gives the generalised forces that balance its weight: `methods(gravity_torques)`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no torques of gravity, because its struct does not ask for them",
    label = "the clause `methods(gravity_torques)` brings them",
    note = "add `methods(gravity_torques)` to the `#[gauss(…)]` of the struct"
)]
pub trait GravityTorques: GaussSystem {
    /// The generalised forces g(q) that balance weight and buoyancy: minus those of weight and buoyancy, zero without
    /// the role `gravity`. Springs, other potentials and `central_gravity` are not in them:
    /// [`nonlinear_effects`](GaussSystem::nonlinear_effects) at z = 0 has everything.
    fn gravity_torques(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Speeds;
}
