//! Traits of a generated kernel: the equations of motion in two forms, energies, and the pieces of the Gauss condition.
//!
//! Time first, then what a method depends on: `t, &q, &z, &input`. q is the configuration, z the quasi-velocities,
//! `p = ∂T/∂z` the momenta.

use core::fmt::{self, Debug};
use core::ops::Index;

use nalgebra::{Isometry3, Matrix3, SVector, Vector3};

use crate::chart::{Chart, ChartError};
use crate::configuration::{Configuration, VectorSpace};
use crate::constraint::ProjectionError;
use crate::lie::se3::{join, split};
use crate::real::Real;
use crate::triple::{add, cross, quaternion, rotate, triple};

/// A mechanical system whose equations of motion come from the Gauss condition (3.4).
///
/// Implemented by the kernels that `#[derive(GaussDynamics)]` generates, and by systems whose equations are written by
/// hand. The equations and costs of a kernel are in [`DescribedSystem`](crate::description::DescribedSystem). Units are
/// the user's, consistent ones; angles are in radians. No method panics, and non-finite input gives non-finite output,
/// which the integrators look for.
pub trait GaussSystem {
    /// The number type.
    type Scalar: Real;

    /// The configuration q: positions and rotations.
    type Configuration: Configuration<Scalar = Self::Scalar>;

    /// `SVector<Scalar, DOF>`: quasi-velocities, momenta and generalised forces alike.
    type Speeds: VectorSpace<Self::Scalar>;

    /// `SMatrix<Scalar, DOF, DOF>`, with entries by `(row, column)`.
    type MassMatrix: Copy + Debug + Index<(usize, usize), Output = Self::Scalar>;

    /// Values that arrive at run time; `()` when the scene has none.
    type Input: Copy + Debug;

    /// The number of quasi-velocities.
    const DOF: usize = <Self::Speeds as VectorSpace<Self::Scalar>>::DIM;

    /// The chart that z belongs to.
    const CHART: Chart;

    /// Whether there are constraints that coordinates and speeds do not solve by themselves: integrators then
    /// [`project`](Self::project) the state after every step.
    const CONSTRAINED: bool = false;

    /// Whether the scene has gaps that may close, whose contact forces these equations do not have: runs refuse them,
    /// but for [`Simulation::without_contacts`](crate::integrate::Simulation::without_contacts).
    const HAS_CONTACTS: bool = false;

    /// Number of the states of elements (`states(…)`): scalars of the configuration behind all others, which move no
    /// body. They stand still in [`kinematics`](Self::kinematics) and change in
    /// [`configuration_rates`](Self::configuration_rates).
    const STATES: usize = 0;

    /// Whether nothing but contacts can raise the [energy](Self::energy) of a scene that has them: no input, no force
    /// outside of the potential energy but those of dampers, nothing that depends on the time. Steps with contacts then
    /// refuse a run that gains more than all there was; `false` claims nothing.
    const KEEPS_ENERGY: bool = false;

    /// [`KEEPS_ENERGY`](Self::KEEPS_ENERGY), which a system whose equations come at run time knows by itself alone.
    #[inline(always)]
    fn keeps_energy(&self) -> bool {
        Self::KEEPS_ENERGY
    }

    /// Smoothness of the accelerations as functions of the state: adaptive integrators step with more care where they
    /// are not smooth.
    const SMOOTHNESS: Smoothness = Smoothness::Smooth;

    /// [`SMOOTHNESS`](Self::SMOOTHNESS), which a system whose equations come at run time knows by itself alone.
    #[inline(always)]
    fn smoothness(&self) -> Smoothness {
        Self::SMOOTHNESS
    }

    /// The velocity of the configuration, q̇ = ψ(t, q, z) (3.2), as seen from the body (left-trivialised). It is affine
    /// in z: states of elements stand still in it, as when speeds jump or constraints are restored.
    fn kinematics(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> <Self::Configuration as Configuration>::Tangent;

    /// Number of the states of elements of this system: [`STATES`](Self::STATES), but of models that come at run time,
    /// whose types do not know them.
    #[inline(always)]
    fn states(&self) -> usize {
        Self::STATES
    }

    /// q̇ with the rates ẋ = f(t, q, z, x, input) of the [states](Self::STATES) of elements: what a configuration is
    /// integrated by. Without states it is [`kinematics`](Self::kinematics). Who wraps a system hands this on, too.
    #[inline(always)]
    fn configuration_rates(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> <Self::Configuration as Configuration>::Tangent {
        let _ = input;
        self.kinematics(t, q, z)
    }

    /// ż: the velocity form of the equations of motion. It satisfies the constraints, differentiated to `J ż = γ`,
    /// where there are any.
    ///
    /// Contact forces are not in it: of a scene with [contacts](Self::HAS_CONTACTS) it is the acceleration where all
    /// gaps are open, that of free fall for what rests on the ground. `InMode::at` of the crate `gauss-contact` is the
    /// system in the modes that its contacts have at a state, whose acceleration has them.
    fn acceleration(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds;

    /// q̇, ż and both energies at once: what they have in common, such as sines, cosines and velocities of bodies, is
    /// computed once. For callers that want all of it, such as output with accounts; integrators call what they need.
    #[inline]
    fn evaluate(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Evaluated<Self> {
        Evaluated::new(
            self.configuration_rates(t, q, z, input),
            self.acceleration(t, q, z, input),
            self.kinetic_energy(t, q, z),
            self.potential_energy(t, q),
        )
    }

    /// The momenta p = ∂T/∂z.
    fn momentum(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Speeds;

    /// The quasi-velocities z with the momenta p: the inverse of [`momentum`](Self::momentum).
    fn velocity(&self, t: Self::Scalar, q: &Self::Configuration, p: &Self::Speeds) -> Self::Speeds;

    /// ṗ: the momentum form of the equations of motion, forces of constraints included.
    fn momentum_rate(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        p: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds;

    /// A = ∂²T/∂z∂z, symmetric and positive definite where the chart is regular.
    fn mass_matrix(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::MassMatrix;

    /// The kinetic energy T, that of the fluid included.
    fn kinetic_energy(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Scalar;

    /// The potential energy, 0 where the scene has no potential.
    fn potential_energy(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Scalar;

    /// ∂C/∂ż at the given ż, with constraints ∂C/∂ż − Jᵀλ: zero at the true acceleration.
    fn gauss_residual(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds;

    /// Inverse dynamics: the generalised force, in components dual to z, that must be added to all forces of the scene
    /// for the motion to have the given ż.
    ///
    /// It is A (ż − ż₀), with ż₀ the [`acceleration`](Self::acceleration) without it, and equals
    /// [`gauss_residual`](Self::gauss_residual), so it costs no factorisation. Its power is its product with z: for a
    /// coordinate whose rate is a speed it is the force or the torque along that coordinate, for a twist (u, ω) a
    /// wrench about O in body axes. For the joints of an arm it is the result of recursive Newton–Euler, with inputs of
    /// the joints at zero.
    ///
    /// Under constraints ż must satisfy them, or no force makes it. Forces of constraints are then those of the motion
    /// without the force: of all generalised forces with the same motion, which differ by Jᵀμ, this is the one that
    /// leaves the multipliers as they are.
    #[inline]
    fn inverse_dynamics(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds {
        self.gauss_residual(t, q, z, acceleration, input)
    }

    /// Inverse dynamics at ż = 0: the generalised force that must be added to all forces of the scene for no speed to
    /// change. It balances weight, centrifugal and Coriolis forces among others, and `A ż + nonlinear_effects` is
    /// [`inverse_dynamics`](Self::inverse_dynamics) at any ż.
    ///
    /// With `methods(nonlinear_effects)` it is a program of its own, cheaper than inverse dynamics at any ż.
    #[inline]
    fn nonlinear_effects(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Speeds {
        self.inverse_dynamics(t, q, z, &Self::Speeds::zero(), input)
    }

    /// Gauss' constraint function C (3.1) at the given ż, up to a term that does not depend on ż: least at the true
    /// acceleration, among those that the constraints admit.
    fn constraint_function(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        acceleration: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Scalar;

    /// Distance of the coordinates from a singularity: 0 at one, where it vanishes with the distance, and ±1 at best.
    /// For Euler angles the sine or cosine of the middle angle (det ∂ω/∂q̇ over the lengths of its columns), of
    /// opposite signs on the two sides; for Rodrigues' parameters, which become infinite, 1/√(1 + |g|²), the cosine of
    /// half the angle of the rotation, and for modified ones 1/√(1 + |σ|²), that of a quarter; 1 in charts without
    /// singularities. Errors of velocities grow like its reciprocal, but for modified parameters, which stretch equally
    /// in all directions.
    #[inline]
    fn regularity(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Scalar {
        let _ = (t, q);
        Self::Scalar::one()
    }

    /// The state nearest to (q, z), measured by the kinetic energy, that satisfies the constraints up to rounding; the
    /// state as it is where there are none ([`CONSTRAINED`](Self::CONSTRAINED)). Use it to make initial states
    /// consistent. It goes any distance; how far it went is [`q.difference(&nearest)`](Configuration::difference) and
    /// the difference of the speeds.
    ///
    /// # Errors
    /// [`ProjectionError`] when none is found from there: see [`project`](crate::constraint::project).
    #[inline]
    fn project(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
    ) -> Result<(Self::Configuration, Self::Speeds), ProjectionError> {
        let _ = t;
        Ok((*q, *z))
    }

    /// The least speeds, in the metric A, that change rates of the constraints by −ρ, `−A⁻¹Jᵀ (J A⁻¹Jᵀ)⁻¹ ρ`, for a ρ
    /// of unlike components between 1 and 2. They grow as 1/δ towards a place, at a distance δ, where constraints
    /// depend on one another, and point the other way behind it; zero where there are no constraints.
    #[inline]
    fn dependence(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Speeds {
        let _ = (t, q, z);
        Self::Speeds::zero()
    }

    /// Kinetic plus potential energy.
    #[inline]
    fn energy(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Scalar {
        self.kinetic_energy(t, q, z) + self.potential_energy(t, q)
    }
}

/// The result of [`GaussSystem::evaluate`].
#[non_exhaustive]
pub struct Evaluated<S: GaussSystem + ?Sized> {
    /// q̇ as seen from the body: what [`GaussSystem::configuration_rates`] gives.
    pub velocity: <S::Configuration as Configuration>::Tangent,
    /// ż.
    pub acceleration: S::Speeds,
    /// T.
    pub kinetic_energy: S::Scalar,
    /// 0 where the scene has no potential.
    pub potential_energy: S::Scalar,
}

impl<S: GaussSystem + ?Sized> Clone for Evaluated<S> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: GaussSystem + ?Sized> Copy for Evaluated<S> {}

impl<S: GaussSystem + ?Sized> fmt::Debug for Evaluated<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Evaluated")
            .field("velocity", &self.velocity)
            .field("acceleration", &self.acceleration)
            .field("kinetic_energy", &self.kinetic_energy)
            .field("potential_energy", &self.potential_energy)
            .finish()
    }
}

impl<S: GaussSystem + ?Sized> Evaluated<S> {
    /// From its parts, in the order of the fields.
    #[inline(always)]
    pub fn new(
        velocity: <S::Configuration as Configuration>::Tangent,
        acceleration: S::Speeds,
        kinetic_energy: S::Scalar,
        potential_energy: S::Scalar,
    ) -> Self {
        Self { velocity, acceleration, kinetic_energy, potential_energy }
    }

    /// T + U.
    #[inline]
    pub fn energy(&self) -> S::Scalar {
        self.kinetic_energy + self.potential_energy
    }
}

/// Smoothness of the accelerations of a system as functions of time and state. The least smooth element decides: the
/// order is that of growing roughness.
///
/// A method of order p has local errors of order h^(p+1) only where p derivatives of the acceleration exist. On a step
/// across a kink they are of order h², across a jump of order h, whatever the method, and so are the errors of states
/// that are interpolated within that step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Smoothness {
    /// As many derivatives as a method needs, away from singularities of the coordinates.
    #[default]
    Smooth,
    /// Accelerations are continuous, derivatives jump: `abs`, `min`, `max`, `clamp`; of `smooth_step` the second ones.
    Kinks,
    /// Accelerations jump: `signum`. Where a system comes to rest on a jump (dry friction) there is no solution in the
    /// classical sense: adaptive steps shrink to the tolerance over the jump, steps of one length chatter. A steep
    /// smooth law sticks without either.
    Jumps,
}

/// Mass data of one body of a system: the type of the fields that `#[gauss(body)]` marks.
///
/// A `RigidBody<T>` has its inertia about O. Data sheets and programs for drawing give that about the centre of mass: a
/// `RigidBody<T, AboutCenterOfMass<T>>` keeps it, made by [`about_center_of_mass`](RigidBody::about_center_of_mass).
/// Where the centre of mass is far from O that is the only way to have all digits: m c² of I_O hides them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize, I: serde::Serialize",
        deserialize = "T: nalgebra::Scalar + serde::Deserialize<'de>, I: serde::Deserialize<'de>"
    ))
)]
pub struct RigidBody<T, I = Matrix3<T>> {
    /// m.
    pub mass: T,
    /// c = G − O, body axes.
    pub center_of_mass: Vector3<T>,
    /// I_O: the inertia tensor about O (not about the centre of mass), body axes; or I_G, in [`AboutCenterOfMass`].
    pub inertia: I,
}

/// I_G: an inertia tensor about the centre of mass, body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: nalgebra::Scalar + serde::Deserialize<'de>"
    ))
)]
pub struct AboutCenterOfMass<T>(pub Matrix3<T>);

impl<T> RigidBody<T, AboutCenterOfMass<T>> {
    /// A body of mass m with G at c from O and the inertia tensor I_G about G, all in body axes.
    ///
    /// ```
    /// use gauss_runtime::prelude::*;
    ///
    /// #[derive(GaussDynamics)]
    /// #[gauss(coordinates(angle), body(arm, rotation = rotation_y(angle)))]
    /// struct Pendulum {
    ///     #[gauss(body)]
    ///     arm: RigidBody<f64, AboutCenterOfMass<f64>>,
    /// }
    ///
    /// let center = Vector3::new(0.0, 0.0, -3.0);
    /// let arm = RigidBody::about_center_of_mass(2.0, center, Matrix3::identity());
    /// let kernel = Pendulum { arm }.kernel()?;
    /// // I_G + m c².
    /// assert_eq!(kernel.mass_matrix(0.0, &SVector::from([0.3]))[0], 19.0);
    /// # Ok::<(), ParameterError>(())
    /// ```
    pub fn about_center_of_mass(mass: T, center_of_mass: Vector3<T>, inertia: Matrix3<T>) -> Self {
        Self { mass, center_of_mass, inertia: AboutCenterOfMass(inertia) }
    }
}

/// A system whose only matter is one rigid body: its variables as a pose and a twist, whatever they are.
///
/// Bodies in charts, and bodies with coordinates and speeds of their own, also with fewer degrees of freedom or
/// constraints.
///
/// Frames: F = {Ω, k₁ k₂ k₃} of the observer, F′ = {O, e₁ e₂ e₃} of the body.
#[diagnostic::on_unimplemented(
    message = "the kernel `{Self}` is not of one rigid body alone",
    label = "kernels of one body have this",
    note = "of systems: `monitor` in place of `monitor_body`, `frames(…)` for poses and twists, `methods(centroidal)` for momenta"
)]
pub trait RigidBodySystem: GaussSystem {
    /// The pose (R, b): `x̂ = R x + b` takes body coordinates to the observer's.
    fn pose(&self, t: Self::Scalar, q: &Self::Configuration) -> Isometry3<Self::Scalar>;

    /// The twist (u, ω): velocity of the pole O and angular velocity, components in the body frame e.
    fn body_twist(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> SVector<Self::Scalar, 6>;

    /// The quasi-velocities of a body twist (u, ω); inverse of [`body_twist`](Self::body_twist) on the twists that the
    /// motion has. What the motion cannot have is dropped: [`convert`](crate::chart::convert) checks.
    fn speeds(&self, t: Self::Scalar, q: &Self::Configuration, twist: &SVector<Self::Scalar, 6>) -> Self::Speeds;

    /// The momentum (Q, Γ_O) of body and fluid: components in the body frame e, pole O.
    fn body_momentum(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> SVector<Self::Scalar, 6>;

    /// A configuration with the given pose at t = 0: see [`configuration_at`](Self::configuration_at).
    ///
    /// # Errors
    /// When the pose is singular for the coordinates, or the motion does not have it.
    #[inline]
    fn configuration(&self, pose: &Isometry3<Self::Scalar>) -> Result<Self::Configuration, ChartError> {
        self.configuration_at(Self::Scalar::zero(), pose)
    }

    /// A configuration with the given pose at time t. In a chart there is one, up to full turns of angles. Coordinates
    /// of the scene's own are found by Newton's method, from zero first; where several have that pose, it is one of
    /// them.
    ///
    /// # Errors
    /// When the pose is singular for the coordinates, the motion does not have it, or nothing is found.
    fn configuration_at(
        &self,
        t: Self::Scalar,
        pose: &Isometry3<Self::Scalar>,
    ) -> Result<Self::Configuration, ChartError>;

    /// Degree to which a twist determines the speeds here: 1 where the twists of all speeds are orthogonal, 0 where
    /// some of them depend on the others, as in polar coordinates at the pole. 1 in charts, which have their
    /// [`regularity`](GaussSystem::regularity).
    #[inline]
    fn determinacy(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Scalar {
        let _ = (t, q);
        Self::Scalar::one()
    }

    /// The momentum (Q̂, Γ̂_Ω) of body and fluid: components in the observer frame k, pole Ω.
    ///
    /// `Q̂ = R Q`, `Γ̂_Ω = R Γ_O + b × Q̂`. Constant without forces, in every chart.
    #[inline]
    fn space_momentum(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> SVector<Self::Scalar, 6> {
        let pose = self.pose(t, q);
        let rotation = quaternion(&pose.rotation);
        let (linear, angular) = split(&self.body_momentum(t, q, z));
        let linear = rotate(rotation, linear);
        let lever = cross(triple(&pose.translation.vector), linear);
        join(linear, add(rotate(rotation, angular), lever))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::FreeTop;

    /// A z by the entries of A.
    fn momentum<S: GaussSystem>(system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
        let (matrix, mut product) = (system.mass_matrix(t, q), S::Speeds::zero());
        for i in 0..S::DOF {
            let row = (0..S::DOF).map(|j| matrix[(i, j)] * z.component(j));
            product.set_component(i, row.fold(S::Scalar::zero(), |sum, term| sum + term));
        }
        product
    }

    /// ż under an input that is kept.
    fn twice<S: GaussSystem>(system: &S, q: &S::Configuration, z: &S::Speeds, input: &S::Input) -> [S::Speeds; 2] {
        let (t, kept) = (S::Scalar::zero(), *input);
        [*input, kept].map(|input| system.acceleration(t, q, z, &input))
    }

    #[test]
    fn code_over_all_systems_uses_mass_matrices_and_inputs() {
        let top = FreeTop { inertia: [2.0, 3.0, 5.0] };
        let (q, z) = (nalgebra::UnitQuaternion::identity(), SVector::from([1.0, -2.0, 0.5]));
        assert_eq!(momentum(&top, 0.0, &q, &z), SVector::from([2.0, -6.0, 2.5]));
        // I ω̇ = Iω × ω + M: Iω × ω = (−6·0.5 + 2.5·2, 2.5 − 2·0.5, −4 + 6).
        let expected = SVector::from([(2.0 + 8.0) / 2.0, (1.5 + 3.0) / 3.0, (2.0 - 2.0) / 5.0]);
        assert_eq!(twice(&top, &q, &z, &[8.0, 3.0, -2.0]), [expected; 2]);
    }
}
