//! Constraints that coordinates and speeds do not solve by themselves: multipliers, and the way back to states that satisfy
//! them.
//!
//! C is least subject to φ(t, q) = 0 (position constraints) and φ(t, q, z) = 0 (velocity constraints), so that
//! [`acceleration`](GaussSystem::acceleration) satisfies them differentiated, `J ż = γ`. That keeps φ̇ and φ at zero only up
//! to the errors of integration, which add up. Integrators therefore [`project`] the state after every step. The projection
//! moves it by no more than about the step's own error and leaves exact solutions where they are: the order of the method stays
//! (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, IV.4; Ascher, Chin, Petzold & Reich 1995).

mod error;

pub use error::{ConstraintLevel, ProjectionError, ProjectionFailure};

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::GaussSystem;

/// A system with constraints that its coordinates and speeds do not solve by themselves.
///
/// Both kinds of constraint share one numbering, that of [`Multipliers`](Self::Multipliers). Units of a residual are those of
/// its φ (per unit of time for dφ/dt), units of λ are such that λ·φ is an energy for a position constraint, and a power for
/// a velocity constraint.
pub trait ConstrainedSystem: GaussSystem {
    /// `SVector<Scalar, K>`: one component for each scalar constraint, in the order written.
    type Multipliers: VectorSpace<Self::Scalar>;

    /// λ: `A ż = r + Jᵀλ`, where `A ż = r` without constraints, and J = ∂φ̇/∂ż; Jᵀλ is the generalised force of the
    /// constraints.
    fn multipliers(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        input: &Self::Input,
    ) -> Self::Multipliers;

    /// φ(t, q) of position constraints; 0 in the places of velocity constraints.
    fn position_residual(&self, t: Self::Scalar, q: &Self::Configuration) -> Self::Multipliers;

    /// dφ/dt of position constraints, φ(t, q, z) of velocity constraints.
    fn velocity_residual(&self, t: Self::Scalar, q: &Self::Configuration, z: &Self::Speeds) -> Self::Multipliers;

    /// The increment of q, least in the metric A, that cancels the residual of the position constraints to first order:
    /// `ψ_z A⁻¹Jᵀ (J A⁻¹Jᵀ)⁻¹ (−φ)`, J the rows of position constraints, seen from the body like all increments.
    fn position_correction(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        residual: &Self::Multipliers,
    ) -> <Self::Configuration as Configuration>::Tangent;

    /// The increment of z, least in the metric A, that cancels the residual to first order: `A⁻¹Jᵀ (J A⁻¹Jᵀ)⁻¹ (−φ)`.
    fn velocity_correction(
        &self,
        t: Self::Scalar,
        q: &Self::Configuration,
        z: &Self::Speeds,
        residual: &Self::Multipliers,
    ) -> Self::Speeds;
}

/// Corrections that are tried on each level. Overshooting by a factor 10⁷ on a quadratic constraint is undone by 24 halvings,
/// and five or six steps of quadratic convergence go from one digit to all of them.
const MOST_CORRECTIONS: u32 = 30;

/// The state nearest to (q, z), measured by the kinetic energy, that satisfies the constraints up to rounding: positions
/// first, then velocities at the corrected positions. This is [`GaussSystem::project`] of constrained systems.
///
/// Newton's method with a new J for every correction. It ends when corrections no longer halve the residual although they
/// should, which only rounding explains: the correction for one and the same residual, taken before and after the
/// step, tells how much the linearisation has changed along it, and where that is little, the residual would have fallen by
/// more than it did. No unit or size of coordinates enters this criterion. At least one correction is made, so that the
/// derivatives that dual numbers carry satisfy the differentiated constraints also where the values do by themselves.
///
/// # Errors
/// [`ProjectionError`] when corrections are undefined, or do not settle within 30 of each level.
pub fn project<S: ConstrainedSystem>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
    z: &S::Speeds,
) -> Result<(S::Configuration, S::Speeds), ProjectionError> {
    let q = settle(
        ConstraintLevel::Position,
        *q,
        |q| system.position_residual(t, q),
        |q, residual| system.position_correction(t, q, residual),
        |q, correction| q.retract(correction).renormalise(),
        Configuration::is_finite,
    )?;
    let z = settle(
        ConstraintLevel::Velocity,
        *z,
        |z| system.velocity_residual(t, &q, z),
        |z, residual| system.velocity_correction(t, &q, z, residual),
        |z, correction| z.add_scaled(S::Scalar::one(), correction),
        VectorSpace::is_finite,
    )?;
    Ok((q, z))
}

/// Newton's method from `point` to where the residual is rounding.
fn settle<T: Real, X, R: VectorSpace<T>, C: VectorSpace<T>>(
    level: ConstraintLevel,
    mut point: X,
    residual: impl Fn(&X) -> R,
    correction: impl Fn(&X, &R) -> C,
    moved: impl Fn(&X, &C) -> X,
    is_finite: impl Fn(&X) -> bool,
) -> Result<X, ProjectionError> {
    let stopped = |failure, residual: &R| Err(ProjectionError { level, failure, residual: residual.max_norm() });
    let mut left = residual(&point);
    for _ in 0..MOST_CORRECTIONS {
        let step = correction(&point, &left);
        let next = moved(&point, &step);
        let remaining = residual(&next);
        // What is not finite in the state or the correction is so in the next state.
        if !(is_finite(&next) && remaining.is_finite()) {
            return stopped(ProjectionFailure::NonFinite, &left);
        }
        if remaining.max_norm() >= 0.5 * left.max_norm() {
            // With θ the relative change of J along the step, ½θ of the residual is left but for rounding. 1/64 is far from
            // ½, so that constraints of different units and curvature may share the norm, and far above the rounding of the
            // corrections themselves.
            let change = correction(&next, &left).add_scaled(-T::one(), &step);
            if change.max_norm() <= step.max_norm() / 64.0 {
                return Ok(next);
            }
        }
        (point, left) = (next, remaining);
    }
    stopped(ProjectionFailure::NotConverged, &left)
}

#[cfg(test)]
mod tests;
