//! The data of a body for splitting methods: the drift of attitudes and poses, and inertia read off the mass matrix.

use core::fmt;

use gauss_runtime::__crates_0_1_0::{
    axpy, cross, join, quaternion, rotate, rotate_back, split, triple, turned as turned_by, unit_quaternion,
};
use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::integrate::IntegrationErrorKind;
use gauss_runtime::real::Real;
use nalgebra::{Isometry3, Matrix3, SMatrix, SVector, Translation3, UnitQuaternion};

use crate::inertia::{FreeMotion, PrincipalAxes};

/// A system that cannot be split into free motion of one body and forces that depend on time and configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SplittingError {
    /// Quasi-velocities are not the body's twist in its own axes.
    NotBodyVelocities,
    /// The mass matrix depends on configuration or time.
    MassMatrixNotConstant,
    /// Translation and rotation are coupled: O is not the centre of mass, or the fluid couples them.
    Coupled {
        /// The largest entry of the coupling, mass times length.
        coupling: f64,
    },
    /// The mass is not the same in all directions.
    AnisotropicMass,
    /// A moment of inertia is not positive, or not finite.
    NotPositive,
    /// The forces depend on velocities: drag, or forces that velocities enter.
    ForcesDependOnVelocity {
        /// The largest component of the difference that was seen.
        difference: f64,
    },
    /// The equations are infinite or undefined at every configuration that was tried.
    NonFinite,
}

impl fmt::Display for SplittingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotBodyVelocities => f.write_str(
                "the quasi-velocities are not the body's velocities in its own axes; use the left-invariant chart",
            ),
            Self::MassMatrixNotConstant => f.write_str(
                "the mass matrix depends on the configuration, so that free motion is not that of one rigid body; \
                 use a Runge–Kutta or collocation method",
            ),
            Self::Coupled { coupling } => write!(
                f,
                "translation and rotation are coupled (by {coupling:e}); put O into the centre of mass, without added mass \
                 that couples them"
            ),
            Self::AnisotropicMass => f.write_str(
                "the mass depends on the direction (added mass): free motion is Kirchhoff's, not that of a body in vacuum; \
                 use a Runge–Kutta or collocation method",
            ),
            Self::NotPositive => f.write_str("the moments of inertia are not positive"),
            Self::ForcesDependOnVelocity { difference } => write!(
                f,
                "the forces depend on velocities (by {difference:e} where it was tried), which kicks between free \
                 motions cannot follow; use a Runge–Kutta method"
            ),
            Self::NonFinite => f.write_str("the equations are infinite or undefined wherever they were tried"),
        }
    }
}

impl core::error::Error for SplittingError {}

/// A body that moves freely between kicks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftingBody<T, M> {
    pub(crate) axes: PrincipalAxes<T>,
    pub(crate) motion: M,
    /// Not used where O is fixed.
    pub(crate) mass: T,
}

/// Configurations of one rigid body: an attitude, or a pose with O at the centre of mass.
///
/// Momenta are in body axes, those of left-invariant charts: Γ_O for attitudes, (Q, Γ_O) for poses.
pub trait BodyConfiguration: Configuration {
    /// Mass matrix of a kernel.
    type MassMatrix;

    /// Mass and inertia about O.
    ///
    /// # Errors
    /// When the matrix is not that of a body with O in its centre of mass.
    fn mass_and_inertia(matrix: &Self::MassMatrix) -> Result<(Self::Scalar, Matrix3<Self::Scalar>), SplittingError>;

    /// Free motion during h, with the momenta p.
    ///
    /// # Errors
    /// Those of the free rotation.
    fn drift<M: FreeMotion<Self::Scalar>>(
        &self,
        p: &Self::Tangent,
        body: &DriftingBody<Self::Scalar, M>,
        h: Self::Scalar,
    ) -> Result<(Self, Self::Tangent), IntegrationErrorKind>;

    /// ṗ without forces, of a body with the velocities z.
    fn inertial_rate(p: &Self::Tangent, z: &Self::Tangent) -> Self::Tangent;

    /// Configurations to try a system at.
    fn samples() -> [Self; 3];
}

/// A quaternion turned on, held at norm 1.
#[inline(always)]
fn turned<T: Real>(q: [T; 4], turn: &UnitQuaternion<T>) -> [T; 4] {
    let [x, y, z, w] = quaternion(turn);
    turned_by(q, [x, y, z, w - T::one()])
}

fn attitudes<T: Real>() -> [UnitQuaternion<T>; 3] {
    let of = |components: [(i64, i64); 4]| unit_quaternion(components.map(|(p, q)| T::ratio(p, q)));
    [of([(0, 1), (0, 1), (0, 1), (1, 1)]), of([(1, 5), (2, 5), (4, 5), (2, 5)]), of([(-2, 7), (3, 7), (-6, 7), (0, 1)])]
}

impl<T: Real> BodyConfiguration for UnitQuaternion<T> {
    type MassMatrix = SMatrix<T, 3, 3>;

    fn mass_and_inertia(matrix: &Self::MassMatrix) -> Result<(T, Matrix3<T>), SplittingError> {
        Ok((T::one(), *matrix))
    }

    #[inline]
    fn drift<M: FreeMotion<T>>(
        &self,
        p: &SVector<T, 3>,
        body: &DriftingBody<T, M>,
        h: T,
    ) -> Result<(Self, SVector<T, 3>), IntegrationErrorKind> {
        let turn = body.axes.turn(&body.motion, p, h)?;
        Ok((unit_quaternion(turned(quaternion(self), &turn.rotation)), p.add_scaled(T::one(), &turn.change)))
    }

    fn inertial_rate(p: &SVector<T, 3>, z: &SVector<T, 3>) -> SVector<T, 3> {
        SVector::from(cross(triple(p), triple(z)))
    }

    fn samples() -> [Self; 3] {
        attitudes()
    }
}

impl<T: Real> BodyConfiguration for Isometry3<T> {
    type MassMatrix = SMatrix<T, 6, 6>;

    fn mass_and_inertia(matrix: &Self::MassMatrix) -> Result<(T, Matrix3<T>), SplittingError> {
        let entry = |i: usize, j: usize| matrix.data.0[j][i];
        let inertia = Matrix3::from_fn(|i, j| entry(i + 3, j + 3));
        for lane in 0..T::LANES {
            let mass = entry(0, 0).lane(lane);
            let rounding = 16.0 * T::EPSILON;
            let largest = (3..6).fold(0.0_f64, |m, i| m.max(entry(i, i).lane(lane)));
            let mut coupling = 0.0_f64;
            for i in 0..3 {
                for j in 0..3 {
                    let expected = if i == j { mass } else { 0.0 };
                    if (entry(i, j).lane(lane) - expected).abs() > rounding * mass.abs() {
                        return Err(SplittingError::AnisotropicMass);
                    }
                    coupling = coupling.max(entry(i, j + 3).lane(lane).abs());
                }
            }
            // A first moment m|c| against √(m I).
            if coupling > rounding * Real::sqrt(mass.abs()) * Real::sqrt(largest.abs()) {
                return Err(SplittingError::Coupled { coupling });
            }
        }
        Ok((entry(0, 0), inertia))
    }

    #[inline]
    fn drift<M: FreeMotion<T>>(
        &self,
        p: &SVector<T, 6>,
        body: &DriftingBody<T, M>,
        h: T,
    ) -> Result<(Self, SVector<T, 6>), IntegrationErrorKind> {
        let (linear, angular) = split(p);
        let turn = body.axes.turn(&body.motion, &SVector::from(angular), h)?;
        let (rotation, delta) = (quaternion(&self.rotation), quaternion(&turn.rotation));
        // A straight line in space, seen from a body that turns.
        let position = axpy(h / body.mass, rotate(rotation, linear), triple(&self.translation.vector));
        let pose = Self {
            rotation: unit_quaternion(turned(rotation, &turn.rotation)),
            translation: Translation3 { vector: SVector::from(position) },
        };
        let angular = axpy(T::one(), triple(&turn.change), angular);
        Ok((pose, join(rotate_back(delta, linear), angular)))
    }

    fn inertial_rate(p: &SVector<T, 6>, z: &SVector<T, 6>) -> SVector<T, 6> {
        let ((linear, angular), (_, omega)) = (split(p), split(z));
        // u × Q vanishes: Q = m u.
        join(cross(linear, omega), cross(angular, omega))
    }

    fn samples() -> [Self; 3] {
        let [a, b, c] = attitudes();
        let at = |rotation, position: [i64; 3]| Self {
            rotation,
            translation: Translation3 { vector: SVector::from(position.map(|p| T::ratio(p, 1))) },
        };
        [at(a, [0, 0, 0]), at(b, [1, -2, 3]), at(c, [-40, 20, 10])]
    }
}
