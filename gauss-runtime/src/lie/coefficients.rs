//! The scalar functions of the angle that exp, log and their derivatives are made of, good at every angle.
//!
//! All of them are even, hence functions of `s = θ²`, and entire or a quotient of entire functions. With
//!
//! | name | closed form | series | at 0 |
//! |---|---|---|---|
//! | `sinc` | sin θ / θ | Σ (−s)ⁿ/(2n+1)! | 1 |
//! | `versine` | (1 − cos θ)/θ² | Σ (−s)ⁿ/(2n+2)! | 1/2 |
//! | `cubic` | (θ − sin θ)/θ³ | Σ (−s)ⁿ/(2n+3)! | 1/6 |
//! | D | (2·versine − sinc)/θ² | Σ (−s)ⁿ 2(n+1)/(2n+4)! | 1/12 |
//! | N | (θ²/4 + θ sin θ/4 − 1 + cos θ)/θ⁶ | Σ (−s)ⁿ (n+1)/(2(2n+6)!) | 1/1440 |
//!
//! the coefficient of dexp⁻¹ and of V⁻¹ and its derivative in s are
//!
//! `dexp_inv = (1 − (θ/2) cot(θ/2))/θ² = D/(2·versine)`,  `dexp_inv' = d/ds dexp_inv = N/versine`,
//!
//! quotients without cancellation, where the closed forms lose θ⁻² or θ⁻⁴ ulps. Those of dexp itself need
//!
//! `d/ds versine = −D/2`,  `d/ds cubic = −C`,  `C = (3·cubic − versine)/(2θ²) = Σ (−s)ⁿ (n+1)/(2n+5)!`,  1/120 at 0.
//!
//! **Truncation.** Every series alternates, and the ratio of neighbouring terms is at most s/2 at first (the cosine;
//! s/6 `sinc`, s/12 `versine`, s/20 `cubic`, s/15 D, s/28 N, s/21 C) and falls like s/4n², so from the term after the
//! largest on the error is below the first term left out. In `f64`, s < ¼ keeps terms 0…7: what is left out is below
//! s⁸/16! < 1e-18. s ≤ 16 keeps terms 0…16: N leaves out less than 1e-23 of N(0), the others are used for smaller s.
//! With 12 and 25 terms after the first, for double-double numbers, the bounds are 1e-34 and 1e-42.
//!
//! **Rounding**, measured against 50 digits on 8,700 angles up to 6.2: relative errors at most 1.5e-16 (`sinc`,
//! absolute), 3.9e-16 (`versine`), 3.5e-16 (`cubic`), 3.6e-16 (`dexp_inv`), 1e-15 (its derivative, forty times smaller
//! than it), 6e-16 up to θ = 5 (the derivative of `versine`, which vanishes at 2π), 1.1e-15 (that of `cubic`).
//!
//! **Which branch.** A plain scalar takes one branch. A pack takes the short series when all lanes are small (the usual
//! case in an integrator), else both other forms and selects; what is discarded may be infinite.

use crate::real::Real;

/// Below this value of θ² (θ = ½) the short series serves.
const SMALL: f64 = 0.25;

/// Terms after the first of the short (s < ¼) and the long (s ≤ 16) series, by the precision of a lane.
const fn terms<T: Real>() -> (usize, usize) {
    if T::EPSILON > 1e-9 {
        (4, 11)
    } else if T::EPSILON > 1e-17 {
        (7, 16)
    } else {
        (12, 25)
    }
}

/// `1 + x·r(0)·(1 + x·r(1)·(1 + …))`, `r(n)` the ratio of term n+1 to term n without its power of x. What is left out
/// is less than ε/64: 3.5e-18 in `f64`, 1.9e-9 in `f32`, where five terms of the cosine leave out 2.7e-10.
#[inline(always)]
fn nested<T: Real>(x: T, terms: usize, ratio: impl Fn(i64) -> (i64, i64)) -> T {
    let mut sum = T::one();
    for n in (0..terms).rev() {
        let (p, q) = ratio(n as i64);
        sum = (x * T::ratio(p, q)).fma(sum, T::one());
    }
    sum.omitting(T::from_f64(T::EPSILON / 64.0))
}

/// Takes `series(number of terms)` where s is below `limit`, else `closed(θ)`.
#[inline(always)]
fn branch<T: Real>(s: T, limit: f64, series: impl Fn(usize) -> T, closed: impl Fn(T) -> T) -> T {
    let (short, long) = terms::<T>();
    let below = |bound: f64| (0..T::LANES).filter(|&lane| s.lane(lane) < bound).count();
    if below(SMALL) == T::LANES {
        return series(short);
    }
    match below(limit) {
        0 => closed(s.sqrt()),
        all if all == T::LANES => series(long),
        _ => T::select_lt(s, T::from_f64(limit), series(long), closed(s.sqrt())),
    }
}

#[inline(always)]
fn sinc_series<T: Real>(s: T, terms: usize) -> T {
    nested(-s, terms, |n| (1, (2 * n + 2) * (2 * n + 3)))
}

#[inline(always)]
fn versine_series<T: Real>(s: T, terms: usize) -> T {
    T::ratio(1, 2) * nested(-s, terms, |n| (1, (2 * n + 3) * (2 * n + 4)))
}

/// `sin θ / θ` from `s = θ²`.
#[inline]
pub fn sinc<T: Real>(s: T) -> T {
    branch(s, SMALL, |terms| sinc_series(s, terms), |theta| theta.sin() / theta)
}

/// `(sin θ / θ, cos θ)` from `s = θ²`, sharing the sine–cosine pair.
#[inline]
pub fn sinc_cos<T: Real>(s: T) -> (T, T) {
    let (short, _) = terms::<T>();
    let small = (0..T::LANES).filter(|&lane| s.lane(lane) < SMALL).count();
    let series = || (sinc_series(s, short), nested(-s, short, |n| (1, (2 * n + 1) * (2 * n + 2))));
    let closed = || {
        let theta = s.sqrt();
        let (sine, cosine) = theta.sin_cos();
        (sine / theta, cosine)
    };
    if small == T::LANES {
        series()
    } else if small == 0 {
        closed()
    } else {
        let ((a, b), (c, d)) = (series(), closed());
        let limit = T::from_f64(SMALL);
        (T::select_lt(s, limit, a, c), T::select_lt(s, limit, b, d))
    }
}

/// `(1 − cos θ)/θ²` from `s = θ²`; by the half angle, `½ (sin(θ/2)/(θ/2))²`, where the series ends.
#[inline]
pub fn versine<T: Real>(s: T) -> T {
    branch(
        s,
        4.0,
        |terms| versine_series(s, terms),
        |theta| {
            let half = theta * T::ratio(1, 2);
            let sinc = half.sin() / half;
            T::ratio(1, 2) * sinc * sinc
        },
    )
}

/// `(θ − sin θ)/θ³` from `s = θ²`. Series up to θ = 2, beyond which `1 − sin θ/θ` no longer cancels.
#[inline]
pub fn cubic<T: Real>(s: T) -> T {
    branch(
        s,
        4.0,
        |terms| T::ratio(1, 6) * nested(-s, terms, |n| (1, (2 * n + 4) * (2 * n + 5))),
        |theta| (theta - theta.sin()) / (s * theta),
    )
}

/// D, see above: minus twice the derivative of [`versine`].
#[inline(always)]
fn versine_slope_series<T: Real>(s: T, terms: usize) -> T {
    T::ratio(1, 12) * nested(-s, terms, |n| (n + 2, (n + 1) * (2 * n + 5) * (2 * n + 6)))
}

/// The derivative of [`versine`] with respect to `s = θ²`. Series up to θ = 2.5, beyond which the closed form hardly
/// cancels.
#[inline]
pub fn versine_derivative<T: Real>(s: T) -> T {
    branch(
        s,
        6.25,
        |terms| T::ratio(-1, 2) * versine_slope_series(s, terms),
        |theta| (theta.sin() / theta - (versine(s) + versine(s))) / (s + s),
    )
}

/// The derivative of [`cubic`] with respect to `s = θ²`. Series up to θ ≈ 3.4, beyond which the closed form hardly
/// cancels.
#[inline]
pub fn cubic_derivative<T: Real>(s: T) -> T {
    branch(
        s,
        11.5,
        |terms| T::ratio(-1, 120) * nested(-s, terms, |n| (n + 2, (n + 1) * (2 * n + 6) * (2 * n + 7))),
        |_| (versine(s) - T::from_f64(3.0) * cubic(s)) / (s + s),
    )
}

/// `(1 − (θ/2) cot(θ/2))/θ²` from `s = θ²`: the coefficient of `ad²` in dexp⁻¹ on SO(3), and of `[ω]×²` in V⁻¹ on
/// SE(3).
///
/// Series up to θ = 2.5, beyond which `1 − (θ/2) cot(θ/2)` no longer cancels. A pole at 2π.
#[inline]
pub fn dexp_inv<T: Real>(s: T) -> T {
    branch(
        s,
        6.25,
        |terms| versine_slope_series(s, terms) / nested(-s, terms, |n| (1, (2 * n + 3) * (2 * n + 4))),
        |theta| {
            let half = theta * T::ratio(1, 2);
            let (sine, cosine) = half.sin_cos();
            (T::one() - half * cosine / sine) / s
        },
    )
}

/// The derivative of [`dexp_inv`] with respect to `s = θ²`: the coefficient that SE(3) adds.
///
/// Series up to θ ≈ 3.4, beyond which the closed numerator hardly cancels. A double pole at 2π.
#[inline]
pub fn dexp_inv_derivative<T: Real>(s: T) -> T {
    branch(
        s,
        11.5,
        |terms| {
            let numerator = T::ratio(1, 720) * nested(-s, terms, |n| (n + 2, (n + 1) * (2 * n + 7) * (2 * n + 8)));
            numerator / nested(-s, terms, |n| (1, (2 * n + 3) * (2 * n + 4)))
        },
        |theta| {
            let half = theta * T::ratio(1, 2);
            let (sine, cosine) = half.sin_cos();
            let square = half * half;
            let numerator = square + half * sine * cosine - (sine + sine) * sine;
            let denominator = (square + square) * sine;
            // 32 x⁴ sin² x = 8 (2x² sin x)²
            T::ratio(1, 8) * numerator / (denominator * denominator)
        },
    )
}

/// `atan(r)/r` from `r²` small: `Σ (−r²)ᵏ/(2k+1)`, for `r² < 1/64`, where 9 terms omit less than 1e-18 (18: 1e-35).
#[inline]
pub(crate) fn arctangent_ratio<T: Real>(square: T) -> T {
    let terms = if T::EPSILON > 1e-17 { 9 } else { 18 };
    nested(-square, terms, |k| (2 * k + 1, 2 * k + 3))
}
