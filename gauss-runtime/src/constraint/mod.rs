//! Constraints that coordinates and speeds do not solve by themselves: multipliers, and the way back to states that
//! satisfy them.
//!
//! C is least subject to φ(t, q) = 0 (position constraints) and φ(t, q, z) = 0 (velocity constraints), so that
//! [`acceleration`](GaussSystem::acceleration) satisfies them differentiated, `J ż = γ`. That keeps φ̇ and φ at zero
//! only up to the errors of integration, which add up. Integrators therefore [`project`] the state after every step.
//! The projection moves it by no more than about the step's own error and leaves exact solutions where they are: the
//! order of the method stays (Hairer, Lubich & Wanner, *Geometric Numerical Integration*, IV.4; Ascher, Chin, Petzold &
//! Reich 1995).

pub use crate::projection_error::{ConstraintLevel, ProjectionError, ProjectionFailure};

use core::marker::PhantomData;

use crate::configuration::{Configuration, VectorSpace};
use crate::real::Real;
use crate::system::GaussSystem;

/// A system with constraints that its coordinates and speeds do not solve by themselves.
///
/// Both kinds of constraint share one numbering, that of [`Multipliers`](Self::Multipliers). Units of a residual are
/// those of its φ (per unit of time for dφ/dt), units of λ are such that λ·φ is an energy for a position constraint,
/// and a power for a velocity constraint.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no multipliers: its coordinates and speeds satisfy all constraints by themselves",
    label = "the clause `constraint(…)` brings them, without `independent(…)`",
    note = "what a joint bears is told by the clause `reactions(…)`"
)]
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

/// Corrections that are tried on each level from one start. Damped corrections at least halve what a linear constraint
/// would leave three quarters of, and five or six steps of quadratic convergence go from one digit to all of them.
const MOST_CORRECTIONS: u32 = 60;
/// Halvings of a correction before it is given up: near a singular J the first correction can be 2³⁰ times too long.
const MOST_HALVINGS: i32 = 30;
/// Starts of further searches when the first fails: multiples of the first correction away from the given state, both
/// ways along the normal of the constraints.
const OTHER_STARTS: [f64; 10] = [-0.5, 2.0, -1.0, 3.0, -2.0, 5.0, -4.0, 9.0, -8.0, 16.0];

/// The state nearest to (q, z), measured by the kinetic energy, that satisfies the constraints up to rounding:
/// positions first, then velocities at the corrected positions. This is [`GaussSystem::project`] of constrained
/// systems.
///
/// Newton's method with a new J for every correction, damped where a whole one does not help. It ends when nothing but
/// rounding is left of the residual, for which two things must come together. A correction for one and the same
/// residual, taken before and after the step, tells how much the linearisation has changed along it; where that is
/// little, the residual should have fallen, and has not. And a small part of the correction does not make the residual
/// fall by that part either, as it would wherever the constraints can be resolved. What is left is then no more than a
/// move of the state by √ε of its size changes: more than that is left where constraints that may depend on one another
/// contradict each other. At least one correction is made, so that the derivatives that dual numbers carry satisfy the
/// differentiated constraints also where the values do by themselves.
///
/// Where the search ends without a state (constraints that curve back before they vanish), it begins anew some
/// corrections away on either side; the state that is found then need not be the nearest.
///
/// # Errors
/// [`ProjectionError`] when corrections are undefined, or none of the starts leads to the constraints: with the
/// residual of the given state, and the smallest one where a search was given up. Where the constraints hold and their
/// gradients vanish, as that of a square does, it says so.
pub fn project<S: ConstrainedSystem>(
    system: &S,
    t: S::Scalar,
    q: &S::Configuration,
    z: &S::Speeds,
) -> Result<(S::Configuration, S::Speeds), ProjectionError> {
    let positions = ProjectionSearch {
        level: ConstraintLevel::Position,
        residual: |q: &S::Configuration| system.position_residual(t, q),
        correction: |q: &S::Configuration, residual: &S::Multipliers| system.position_correction(t, q, residual),
        moved: |q: &S::Configuration, correction: &_| q.retract(correction).renormalise(),
        size: largest_magnitude::<S::Configuration>,
        is_finite: |q: &S::Configuration| q.is_finite(),
        scalar: PhantomData,
    };
    let q = positions.settle_from_any_start(*q)?;
    let velocities = ProjectionSearch {
        level: ConstraintLevel::Velocity,
        residual: |z: &S::Speeds| system.velocity_residual(t, &q, z),
        correction: |z: &S::Speeds, residual: &S::Multipliers| system.velocity_correction(t, &q, z, residual),
        moved: |z: &S::Speeds, correction: &S::Speeds| z.add_scaled(S::Scalar::one(), correction),
        size: |z: &S::Speeds| z.max_norm(),
        is_finite: |z: &S::Speeds| z.is_finite(),
        scalar: PhantomData,
    };
    let z = velocities.settle_from_any_start(*z)?;
    Ok((q, z))
}

/// The least speeds that change rates of the constraints by unlike parts: [`GaussSystem::dependence`] of constrained
/// systems.
pub fn dependence<S: ConstrainedSystem>(system: &S, t: S::Scalar, q: &S::Configuration, z: &S::Speeds) -> S::Speeds {
    let mut rates = S::Multipliers::zero();
    (0..S::Multipliers::DIM).for_each(|i| rates.set_component(i, S::Scalar::from_f64(unlike(i))));
    system.velocity_correction(t, q, z, &rates)
}

/// A number from 1 to 2 for each component: multiples of the golden ratio are spread evenly and never equal.
fn unlike(i: usize) -> f64 {
    1.0 + f64::from((i as u32).wrapping_mul(0x9E37_79B9)) / 4_294_967_296.0
}

/// Damped Newton's method on one level: functions for the residual, for the correction, and for moving a point.
struct ProjectionSearch<T, R, C, M, N, F> {
    level: ConstraintLevel,
    residual: R,
    correction: C,
    moved: M,
    /// The largest component of a point.
    size: N,
    is_finite: F,
    scalar: PhantomData<T>,
}

impl<T: Real, R, C, M, N, F> ProjectionSearch<T, R, C, M, N, F> {
    /// From `start`, and where that fails from some corrections away.
    fn settle_from_any_start<X: Copy, L: VectorSpace<T>, K: VectorSpace<T>>(
        &self,
        start: X,
    ) -> Result<X, ProjectionError>
    where
        R: Fn(&X) -> L,
        C: Fn(&X, &L) -> K,
        M: Fn(&X, &K) -> X,
        N: Fn(&X) -> f64,
        F: Fn(&X) -> bool,
    {
        let failed = match self.settle(start) {
            Err(error) if error.failure != ProjectionFailure::NonFinite => error,
            settled => return settled,
        };
        let first = (self.correction)(&start, &(self.residual)(&start));
        let mut nearest = failed;
        for multiple in OTHER_STARTS {
            match self.settle((self.moved)(&start, &scaled(&first, multiple))) {
                Ok(point) => return Ok(point),
                Err(error) if error.residual < nearest.residual => {
                    let singular = error.failure == ProjectionFailure::Singular;
                    let failure = if singular { error.failure } else { nearest.failure };
                    nearest = ProjectionError { failure, residual: error.residual, ..nearest };
                }
                Err(_) => {}
            }
        }
        Err(nearest)
    }

    /// From `point` to where the residual is rounding.
    fn settle<X, L: VectorSpace<T>, K: VectorSpace<T>>(&self, mut point: X) -> Result<X, ProjectionError>
    where
        R: Fn(&X) -> L,
        C: Fn(&X, &L) -> K,
        M: Fn(&X, &K) -> X,
        N: Fn(&X) -> f64,
        F: Fn(&X) -> bool,
    {
        let mut left = (self.residual)(&point);
        let given = left.max_norm();
        let stopped = |failure, point: &X, residual: &L| {
            let holds = (self.is_finite)(point) && self.is_rounding::<_, _, K>(point, residual);
            let failure = if holds { ProjectionFailure::Singular } else { failure };
            Err(ProjectionError { level: self.level, failure, given, residual: residual.max_norm() })
        };
        for _ in 0..MOST_CORRECTIONS {
            let step = (self.correction)(&point, &left);
            let next = (self.moved)(&point, &step);
            let remaining = (self.residual)(&next);
            let defined = (self.is_finite)(&next) && remaining.is_finite();
            let from_defined = step.is_finite() && (self.is_finite)(&point) && left.is_finite();
            if !(defined || from_defined) {
                return stopped(ProjectionFailure::NonFinite, &point, &left);
            }
            if defined && remaining.max_norm() < 0.5 * left.max_norm() {
                (point, left) = (next, remaining);
                continue;
            }
            // With θ the relative change of J along the step, ½θ of the residual is left but for rounding. 1/64 is far
            // from ½, so that constraints of different units and curvature may share the norm, and far above the
            // rounding of the corrections themselves.
            let change = (self.correction)(&next, &left).add_scaled(-T::one(), &step);
            let straight = change.max_norm() <= step.max_norm() / 64.0;
            let resolved = self.falls_by_parts(&point, &step, &left);
            (point, left) = match (resolved, straight) {
                (false, true) if defined => match self.is_rounding::<_, _, K>(&next, &remaining) {
                    true => return Ok(next),
                    false => return stopped(ProjectionFailure::NotConverged, &next, &remaining),
                },
                (false, _) if defined => (next, remaining),
                _ => match self.damped(&point, &step, &left) {
                    Some(found) => found,
                    None => return stopped(ProjectionFailure::NotConverged, &point, &left),
                },
            };
        }
        stopped(ProjectionFailure::NotConverged, &point, &left)
    }

    /// Whether a move by half of the digits changes a residual by as much as is left of it: of all coordinates, so that
    /// every constraint feels it, and by unlike parts, so that they do not cancel. Where the point itself is zero what
    /// it is computed of may be large: 2¹² ε is allowed for.
    fn is_rounding<X, L: VectorSpace<T>, K: VectorSpace<T>>(&self, point: &X, left: &L) -> bool
    where
        R: Fn(&X) -> L,
        M: Fn(&X, &K) -> X,
        N: Fn(&X) -> f64,
    {
        let digits = Real::sqrt(T::EPSILON) * (self.size)(point) + 4096.0 * T::EPSILON;
        let mut step = K::zero();
        for i in 0..K::DIM {
            step.set_component(i, T::from_f64(digits * unlike(i)));
        }
        let changed = (self.residual)(&(self.moved)(point, &step)).add_scaled(-T::one(), left);
        left.max_norm() <= changed.max_norm()
    }

    /// Whether some small part of a correction cancels that part of the residual: only rounding or a kink forbids it.
    /// Parts are taken ever smaller, until they no longer move the point.
    fn falls_by_parts<X, L: VectorSpace<T>, K: VectorSpace<T>>(&self, point: &X, step: &K, left: &L) -> bool
    where
        R: Fn(&X) -> L,
        M: Fn(&X, &K) -> X,
    {
        let all = left.max_norm();
        let parts = (1..10).map(|k| 0.5_f64.powi(6 * k));
        let moved = parts.map(|part| (part, (self.residual)(&(self.moved)(point, &scaled(step, part)))));
        let mut moved = moved.take_while(|(_, fallen)| fallen.add_scaled(-T::one(), left).max_norm() != 0.0);
        moved.any(|(part, fallen)| {
            // All but the part that is cancelled.
            let off = fallen.add_scaled(T::from_f64(part - 1.0), left);
            off.is_finite() && off.max_norm() <= 0.5 * part * all
        })
    }

    /// The largest of the halved corrections that helps, and the violation that it leaves.
    fn damped<X, L: VectorSpace<T>, K: VectorSpace<T>>(&self, point: &X, step: &K, left: &L) -> Option<(X, L)>
    where
        R: Fn(&X) -> L,
        M: Fn(&X, &K) -> X,
        F: Fn(&X) -> bool,
    {
        let all = left.max_norm();
        (0..=MOST_HALVINGS).map(|halvings| 0.5_f64.powi(halvings)).find_map(|part| {
            let next = (self.moved)(point, &scaled(step, part));
            let remaining = (self.residual)(&next);
            let helps =
                (self.is_finite)(&next) && remaining.is_finite() && remaining.max_norm() <= (1.0 - 0.25 * part) * all;
            helps.then_some((next, remaining))
        })
    }
}

/// The largest component of a configuration, with 1 for rotations.
fn largest_magnitude<Q: Configuration>(q: &Q) -> f64 {
    (0..<Q::Tangent as VectorSpace<Q::Scalar>>::DIM).map(|i| q.magnitude(i)).fold(0.0, f64::max)
}

/// `factor · v`.
fn scaled<T: Real, V: VectorSpace<T>>(v: &V, factor: f64) -> V {
    v.add_scaled(T::from_f64(factor - 1.0), v)
}

#[cfg(test)]
mod tests;
