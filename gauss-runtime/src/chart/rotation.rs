//! Rotations in coordinates: Euler angles of all twelve sequences, Rodrigues and modified Rodrigues vectors.
//!
//! **Proper Euler angles** about axes i, j, i, with k the third axis and ε = e_i×e_j·e_k = ±1. Multiplying out,
//!
//! `w = cos β/2 cos (α+γ)/2, q_i = cos β/2 sin (α+γ)/2, q_j = sin β/2 cos (α−γ)/2, q_k = ε sin β/2 sin (α−γ)/2`
//!
//! so all three angles are atan2 of components or of their norms: no arc cosine, and no rotation matrix, whose entries
//! have already lost small angles.
//!
//! **Tait–Bryan angles** about i, j, k become proper ones by a quarter turn about the middle axis: since
//! `R_j(−π/2) e_k = −ε e_i`, `R_i(α) R_j(β) R_k(γ) R_j(π/2) = R_i(α) R_j(β + π/2) R_i(−εγ)`.

use nalgebra::UnitQuaternion;

use super::{ChartError, EulerSequence, RotationChart};
use crate::real::Real;
use crate::triple::{dot, quaternion, scaled, unit_quaternion};

/// The rotation with the given coordinates. [`RotationChart::Angle`] reads the first and ignores the others.
///
/// A sequence with axes that do not exist is read with 2 in their place: see [`EulerSequence::is_valid`].
#[inline]
#[doc(alias = "euler angles")]
#[doc(alias = "roll pitch yaw")]
pub fn rotation_from_coordinates<T: Real>(chart: RotationChart, coordinates: [T; 3]) -> UnitQuaternion<T> {
    let half = T::ratio(1, 2);
    match chart {
        RotationChart::Euler(sequence) => {
            let about = |n: usize| elementary(sequence.axes[n], coordinates[n]);
            let [a, b, c] = [about(0), about(1), about(2)];
            unit_quaternion(crate::triple::compose(crate::triple::compose(a, b), c))
        }
        RotationChart::Rodrigues => {
            // (g, 1)/√(1 + g²)
            let w = (T::one() + dot(coordinates, coordinates)).sqrt().recip();
            let [x, y, z] = scaled(w, coordinates);
            unit_quaternion([x, y, z, w])
        }
        RotationChart::ModifiedRodrigues => {
            // (2σ, 1 − σ²)/(1 + σ²)
            let square = dot(coordinates, coordinates);
            let over = (T::one() + square).recip();
            let [x, y, z] = scaled(over + over, coordinates);
            unit_quaternion([x, y, z, (T::one() - square) * over])
        }
        RotationChart::Angle => {
            let (sine, cosine) = (half * coordinates[0]).sin_cos();
            unit_quaternion([T::zero(), T::zero(), sine, cosine])
        }
    }
}

/// The coordinates of a rotation: the inverse of [`rotation_from_coordinates`], with
///
/// - Euler angles: the outer ones in [−π, π], the middle one in [−π/2, π/2] (Tait–Bryan) or [0, π] (proper);
/// - the modified Rodrigues vector of length at most 1 (the shadow set switched when needed);
/// - [`RotationChart::Angle`]: the angle about k₃ of the factor nearest to the rotation, and two zeros.
///
/// # Errors
/// [`ChartError::Singular`] where rounding alone decides the coordinates, [`ChartError::InvalidSequence`], and
/// [`ChartError::NonFinite`]. A pack of rotations fails when one lane does.
#[inline]
#[doc(alias = "euler angles")]
#[doc(alias = "roll pitch yaw")]
pub fn coordinates_of_rotation<T: Real>(
    chart: RotationChart,
    rotation: &UnitQuaternion<T>,
) -> Result<[T; 3], ChartError> {
    let q = quaternion(rotation);
    if !q.iter().all(|c| c.is_finite()) {
        return Err(ChartError::NonFinite);
    }
    match chart {
        RotationChart::Euler(sequence) => euler_angles(sequence, q),
        RotationChart::Rodrigues => {
            let [x, y, z, w] = q;
            let norm = dot([x, y, z], [x, y, z]).sqrt();
            // The distance from half a turn, as an angle: θ = π − 2 atan(|w|/|v|).
            let gap = w.abs().atan2(norm);
            refuse_singular(chart, gap + gap, |distance| core::f64::consts::PI - distance)?;
            Ok(scaled(w.recip(), [x, y, z]))
        }
        RotationChart::ModifiedRodrigues => {
            let [x, y, z, w] = q;
            // Of q and −q the one with w ≥ 0 has |σ| ≤ 1 and 1 + w ≥ 1: no singularity is left.
            let over = (T::one() + w.abs()).recip();
            Ok(scaled(T::select_lt(w, T::zero(), -over, over), [x, y, z]))
        }
        RotationChart::Angle => {
            let sign = T::select_lt(q[3], T::zero(), -T::one(), T::one());
            let half = (sign * q[2]).atan2(sign * q[3]);
            Ok([half + half, T::zero(), T::zero()])
        }
    }
}

/// The quaternion of a rotation by `angle` about one axis.
#[inline(always)]
fn elementary<T: Real>(axis: u8, angle: T) -> [T; 4] {
    let (sine, cosine) = (T::ratio(1, 2) * angle).sin_cos();
    let mut q = [T::zero(), T::zero(), T::zero(), cosine];
    q[usize::from(axis.min(2))] = sine;
    q
}

#[inline]
fn euler_angles<T: Real>(sequence: EulerSequence, q: [T; 4]) -> Result<[T; 3], ChartError> {
    if !sequence.is_valid() {
        return Err(ChartError::InvalidSequence { axes: sequence.axes });
    }
    let [i, j, last] = sequence.axes.map(usize::from);
    let k = 3 - i - j;
    // The handedness of (i, j, k): +1 for cyclic orders.
    let epsilon = if (i + 1) % 3 == j { T::one() } else { -T::one() };
    let (w, qi, qj, qk) = (q[3], q[i], q[j], epsilon * q[k]);
    if i == last {
        let (sum, difference) = (qi.atan2(w), qk.atan2(qj));
        let (p, r) = ((w * w + qi * qi).sqrt(), (qj * qj + qk * qk).sqrt());
        let half = r.atan2(p);
        let beta = half + half;
        // sin(β/2) cos(β/2) > 0: the smaller of β and π − β.
        let gap = T::select_lt(p, r, p, r).atan2(T::select_lt(p, r, r, p));
        refuse_singular(RotationChart::Euler(sequence), gap + gap, |distance| {
            if beta.lane(0) > 1.5 { core::f64::consts::PI - distance } else { distance }
        })?;
        Ok([wrapped(sum + difference), beta, wrapped(sum - difference)])
    } else {
        // q ∘ (1 + e_j), up to the factor √½ that atan2 does not see.
        let (w1, i1, j1, k1) = (w - qj, qi - qk, qj + w, qk + qi);
        let (sum, difference) = (i1.atan2(w1), k1.atan2(j1));
        let (p, r) = ((w1 * w1 + i1 * i1).sqrt(), (j1 * j1 + k1 * k1).sqrt());
        // cos β = 2pr/(p² + r²), and sin β = (r² − p²)/(p² + r²) with r² − p² = 4(w q_j + q_i q_k) taken without
        // cancelling.
        let sine = w * qj + qi * qk;
        let beta = (sine + sine).atan2(p * r);
        let gap = T::select_lt(p, r, p, r).atan2(T::select_lt(p, r, r, p));
        refuse_singular(RotationChart::Euler(sequence), gap + gap, |distance| {
            let magnitude = core::f64::consts::FRAC_PI_2 - distance;
            if beta.lane(0) < 0.0 { -magnitude } else { magnitude }
        })?;
        Ok([wrapped(sum + difference), beta, -epsilon * wrapped(sum - difference)])
    }
}

/// Brings a sum of two angles of [−π, π] back to [−π, π].
#[inline(always)]
fn wrapped<T: Real>(angle: T) -> T {
    let (pi, turn) = (T::from_f64(core::f64::consts::PI), T::from_f64(core::f64::consts::TAU));
    let below = T::select_lt(pi, angle, angle - turn, angle);
    T::select_lt(below, -pi, below + turn, below)
}

/// Refuses a distance from the singularity (an angle) that is rounding: the quaternion is known to a few ulp only.
#[inline(always)]
fn refuse_singular<T: Real>(chart: RotationChart, distance: T, angle: impl Fn(f64) -> f64) -> Result<(), ChartError> {
    for lane in 0..T::LANES {
        let distance = distance.lane(lane);
        if distance <= 8.0 * T::EPSILON {
            return Err(ChartError::Singular { chart, angle: angle(distance), distance });
        }
    }
    Ok(())
}
