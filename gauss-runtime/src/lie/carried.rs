//! Elements of the groups known beyond the precision of their components: the sums of long runs.
//!
//! An element is meant that differs from the stored one by a carried increment, seen from the body:
//! `meant = stored ∘ exp(carried)`, where `carried` is of the size of a rounding. Then `meant ∘ exp(σ)` is stored to
//! the nearest, and what was rounded off is carried on. So a sum of n increments of size h has the rounding errors of
//! the increments, h ε each, and not those of the sum, ε each (Kahan; for Runge–Kutta methods Hairer, Lubich & Wanner,
//! *Geometric Numerical Integration*, VIII.5). Squares of the carried increment are below the rounding of a rounding.
//!
//! Norms. A unit quaternion gets `q·½(1 − |q|²)` added within the same sum, which holds its norm at 1 and, being along
//! q, turns nothing: the carried increment has no part along q.

use nalgebra::{Isometry2, Isometry3, SVector, UnitQuaternion};

use super::so3::{less_one, norm_correction};
use super::{coefficients, se2, se3};
use crate::real::Real;
use crate::triple::{add, compose, conjugate, cross, quaternion, rotate, rotate_back, scaled, triple, unit_quaternion};

/// a + b rounded to nearest, and the exact rounding error of that sum (Knuth).
#[inline(always)]
pub fn two_sum<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let second = sum - a;
    let first = sum - second;
    (sum, (a - first) + (b - second))
}

/// The same for every component.
#[inline(always)]
pub(crate) fn two_sums<T: Real, const N: usize>(a: [T; N], b: [T; N]) -> ([T; N], [T; N]) {
    let (mut sums, mut rest) = (a, b);
    for i in 0..N {
        (sums[i], rest[i]) = two_sum(a[i], b[i]);
    }
    (sums, rest)
}

/// A quaternion turned on by exp(σ), and the rounding error that is carried to the next turn.
#[inline(always)]
fn turn<T: Real>(q: [T; 4], sigma: [T; 3], carried: [T; 3]) -> ([T; 4], [T; 3]) {
    let half = T::ratio(1, 2);
    let step = less_one(sigma);
    let [a, b, c] = scaled(half, carried);
    let low = [a, b, c, T::zero()];
    let both = compose(low, step);
    let change = compose(q, core::array::from_fn(|i| step[i] + (low[i] + both[i])));
    let correction = norm_correction(q);
    let (sum, rest) = two_sums(q, core::array::from_fn(|i| correction[i] + change[i]));
    let [a, b, c, _] = compose(conjugate(sum), rest);
    (sum, [a + a, b + b, c + c])
}

/// On SO(3).
#[inline]
pub fn rotation<T: Real>(
    q: &UnitQuaternion<T>,
    sigma: &SVector<T, 3>,
    carried: &mut SVector<T, 3>,
) -> UnitQuaternion<T> {
    let (sum, rest) = turn(quaternion(q), triple(sigma), triple(carried));
    *carried = SVector::from(rest);
    unit_quaternion(sum)
}

/// On SE(3).
#[inline]
pub fn pose<T: Real>(q: &Isometry3<T>, sigma: &SVector<T, 6>, carried: &mut SVector<T, 6>) -> Isometry3<T> {
    let ((u, omega), (low_u, low_omega)) = (se3::split(sigma), se3::split(carried));
    let rotation = quaternion(&q.rotation);
    let shift = se3::displacement(u, omega);
    let shift = add(shift, add(low_u, cross(low_omega, shift)));
    let (sum, rest) = two_sums(triple(&q.translation.vector), rotate(rotation, shift));
    let (turned, low) = turn(rotation, omega, low_omega);
    *carried = se3::join(rotate_back(turned, rest), low);
    se3::isometry(unit_quaternion(turned), sum)
}

/// On SE(2).
#[inline]
pub fn plane<T: Real>(q: &Isometry2<T>, sigma: &SVector<T, 3>, carried: &mut SVector<T, 3>) -> Isometry2<T> {
    let ([_, _, omega], [low_u, low_v, low_omega]) = (sigma.data.0[0], carried.data.0[0]);
    let half = T::ratio(1, 2);
    let s = omega * omega;
    let step = [-(s * coefficients::versine(s)), omega * coefficients::sinc(s)];
    let times = |a: [T; 2], b: [T; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];

    let turn = q.rotation.as_ref();
    let turn = [turn.re, turn.im];
    let low = [T::zero(), low_omega];
    let both = times(low, step);
    let change = times(turn, core::array::from_fn(|i| step[i] + (low[i] + both[i])));
    let defect = half * (T::one() - turn[0].fma(turn[0], turn[1] * turn[1]));
    let (turned, rest) = two_sums(turn, core::array::from_fn(|i| defect.fma(turn[i], change[i])));
    let [_, rest_omega] = times([turned[0], -turned[1]], rest);

    let shift = se2::displacement(sigma);
    let across = times(low, shift);
    let shift = core::array::from_fn(|i| shift[i] + ([low_u, low_v][i] + across[i]));
    let [x, y] = q.translation.vector.data.0[0];
    let (sum, rest) = two_sums([x, y], times(turn, shift));
    let [rest_u, rest_v] = times([turned[0], -turned[1]], rest);
    *carried = SVector::from([rest_u, rest_v, rest_omega]);
    se2::isometry(se2::rotation(turned[0], turned[1]), sum)
}

#[cfg(test)]
#[path = "carried_tests.rs"]
mod tests;
