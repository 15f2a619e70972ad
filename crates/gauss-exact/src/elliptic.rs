//! Jacobi's elliptic functions and the integrals that belong to them, in `f64`.
//!
//! Parameters are given by the complementary modulus k' = √(1 − k²) ∈ [0, 1], because a body near the separatrix has k
//! so near to 1 that only k' tells how near. Relative errors are a few roundings times max(1, |u|): small cn and dn
//! keep their digits.
//!
//! Written for `f64` and not for every [`Real`]: the number of steps depends on the data.

use gauss_runtime::real::Real;

/// The arithmetic–geometric mean converges quadratically: from 1 and the smallest positive number in 15 steps.
const MOST_STEPS: usize = 20;

/// The arithmetic–geometric mean of 1 and k', with the sequence on the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Modulus {
    complement: f64,
    arithmetic: [f64; MOST_STEPS],
    geometric: [f64; MOST_STEPS],
    steps: usize,
    mean: f64,
}

/// sn, cn and dn of one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Jacobi {
    pub(crate) sn: f64,
    pub(crate) cn: f64,
    pub(crate) dn: f64,
}

impl Modulus {
    /// The modulus with the complement k' ∈ [0, 1].
    pub(crate) fn of_complement(complement: f64) -> Self {
        let mut modulus =
            Self { complement, arithmetic: [1.0; MOST_STEPS], geometric: [1.0; MOST_STEPS], steps: 0, mean: 1.0 };
        if complement == 0.0 {
            return modulus;
        }
        let (mut a, mut product) = (1.0, complement);
        while modulus.steps < MOST_STEPS {
            let g = if modulus.steps == 0 { complement } else { Real::sqrt(product) };
            modulus.arithmetic[modulus.steps] = a;
            modulus.geometric[modulus.steps] = g;
            modulus.steps += 1;
            modulus.mean = 0.5 * (a + g);
            // The next difference is (a − g)²/8a², below rounding.
            if Real::abs(a - g) <= 1e-8 * a {
                break;
            }
            product = a * g;
            a = modulus.mean;
        }
        modulus
    }

    /// K, a quarter of the period; infinite for k' = 0.
    pub(crate) fn quarter_period(&self) -> f64 {
        if self.complement == 0.0 { f64::INFINITY } else { core::f64::consts::FRAC_PI_2 / self.mean }
    }

    /// sn u, cn u, dn u for every real u, by descending Gauss transformations of cn/sn (Bulirsch 1965). Only sums of
    /// numbers of one sign occur, so that cn near u = K and dn for k' → 0 keep their relative accuracy.
    pub(crate) fn jacobi(&self, u: f64) -> Jacobi {
        if self.complement == 0.0 {
            let cn = 1.0 / Real::cosh(u);
            return Jacobi { sn: Real::tanh(u), cn, dn: cn };
        }
        let (sine, cosine) = Real::sin_cos(self.mean * u);
        if sine == 0.0 {
            return Jacobi { sn: sine, cn: cosine, dn: 1.0 };
        }
        let mut ratio = cosine / sine;
        let mut c = self.mean * ratio;
        let mut dn = 1.0;
        for step in (0..self.steps).rev() {
            let a = self.arithmetic[step];
            ratio *= c;
            c *= dn;
            dn = (self.geometric[step] + ratio) / (a + ratio);
            ratio = c / a;
        }
        let magnitude = 1.0 / Real::sqrt(c * c + 1.0);
        let sn = if sine < 0.0 { -magnitude } else { magnitude };
        Jacobi { sn, cn: c * sn, dn }
    }
}

impl Jacobi {
    /// The u ∈ [−K, K] with these values, cn ≥ 0: `F = sn R_F(cn², dn², 1)`, and
    /// `∫₀ᵘ sn²/(cn² + g sn²) du = ⅓ sn³ R_J(cn², dn², 1, cn² + g sn²)`, for g > 0 on one side of both 1 and k'²
    /// (Carlson 1995; the case that is called circular).
    pub(crate) fn integrals(&self, g: f64, complement: f64) -> (f64, f64) {
        let square = self.sn * self.sn;
        let cosine = self.cn * self.cn;
        // (p − x)(p − y)(p − z) without differences of sines and cosines.
        let spread = square * square * square * g * (g - complement * complement) * (g - 1.0);
        let (first, third) = carlson(cosine, self.dn * self.dn, cosine + g * square, spread);
        (self.sn * first, self.sn * square * third / 3.0)
    }
}

/// `∫₀ᴷ sn²/(cn² + g sn²) du`.
pub(crate) fn complete(g: f64, complement: f64) -> f64 {
    Jacobi { sn: 1.0, cn: 0.0, dn: complement }.integrals(g, complement).1
}

/// Carlson's R_F(x, y, 1) and R_J(x, y, 1, p), whose duplications are the same; `spread = (p − x)(p − y)(p − 1) ≥ 0`.
/// At most one of x and y is 0, p > 0.
fn carlson(x: f64, y: f64, p: f64, spread: f64) -> (f64, f64) {
    let (mut x, mut y, mut z, mut p) = (x, y, 1.0, p);
    let mean = (x + y + z + 2.0 * p) / 5.0;
    let deviation = [x, y, z, p].iter().fold(0.0_f64, |m, v| m.max(Real::abs(mean - v)));
    // Series are cut after terms of order 5 in the deviation: (ε/4)^(−1/6) = 570.
    let (mut radius, mut current, mut power, mut sum) = (570.0 * deviation, mean, 1.0, 0.0);
    let mut remaining = spread;
    // Every step divides the radius by 4 at least, and the first ones bring all within a factor of another.
    for _ in 0..60 {
        if radius < current {
            break;
        }
        let (rx, ry, rz, rp) = (Real::sqrt(x), Real::sqrt(y), Real::sqrt(z), Real::sqrt(p));
        let lambda = rx * (ry + rz) + ry * rz;
        let d = (rp + rx) * (rp + ry) * (rp + rz);
        sum += power / d * arctangent_ratio(remaining / (d * d));
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        p = 0.25 * (p + lambda);
        current = 0.25 * (current + lambda);
        radius *= 0.25;
        power *= 0.25;
        remaining /= 64.0;
    }
    (first_series(x, y, z), power * third_series(x, y, z, p, current) + 6.0 * sum)
}

/// R_F of nearly equal arguments.
fn first_series(x: f64, y: f64, z: f64) -> f64 {
    let mean = (x + y + z) / 3.0;
    let (a, b) = (1.0 - x / mean, 1.0 - y / mean);
    let c = -(a + b);
    let (e2, e3) = (a * b - c * c, a * b * c);
    // To order 7, because the radius is that of R_J.
    let series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0 - 5.0 * e2 * e2 * e2 / 208.0
        + 3.0 * e3 * e3 / 104.0
        + e2 * e2 * e3 / 16.0;
    series / Real::sqrt(mean)
}

/// R_J of nearly equal arguments with the weighted mean given.
fn third_series(x: f64, y: f64, z: f64, p: f64, mean: f64) -> f64 {
    let (a, b, c) = (1.0 - x / mean, 1.0 - y / mean, 1.0 - z / mean);
    let q = 1.0 - p / mean;
    let abc = a * b * c;
    let e2 = a * b + a * c + b * c - 3.0 * q * q;
    let e3 = abc + 2.0 * e2 * q + 4.0 * q * q * q;
    let e4 = (2.0 * abc + e2 * q + 3.0 * q * q * q) * q;
    let e5 = abc * q * q;
    let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
        + 3.0 * e5 / 26.0;
    series / (mean * Real::sqrt(mean))
}

/// `arctan(√e)/√e`, which is R_C(1, 1 + e).
fn arctangent_ratio(e: f64) -> f64 {
    // The first term left out is e⁸/17.
    if e < 0.01 {
        let mut sum = 1.0 / 15.0;
        for odd in [13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
            sum = 1.0 / odd - e * sum;
        }
        sum
    } else {
        let root = Real::sqrt(e);
        Real::atan(root) / root
    }
}

/// To the nearest integer; beyond 2⁵¹ what is given is one, or has no digits left that would tell.
pub(crate) fn round(x: f64) -> f64 {
    if x.abs() < 2.0e15 { (x + if x < 0.0 { -0.5 } else { 0.5 }) as i64 as f64 } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Values by mpmath with 40 digits, rounded once: `tests/references/elliptic_values.py`. The first line has names.
    fn values<const N: usize>(table: &str) -> Vec<[f64; N]> {
        let row = |line: &str| {
            let mut numbers = line.split(',').map(|number| number.parse().expect("a number"));
            let row = core::array::from_fn(|_| numbers.next().expect("a column"));
            assert_eq!(numbers.next(), None);
            row
        };
        table.lines().skip(1).map(row).collect()
    }

    fn close(found: f64, expected: f64, roundings: f64) -> bool {
        Real::abs(found - expected) <= roundings * f64::EPSILON * Real::abs(expected)
    }

    #[test]
    fn functions_keep_their_relative_accuracy() {
        let functions = values(include_str!("../tests/data/elliptic_functions.csv"));
        assert!(functions.len() > 70);
        for [complement, u, sn, cn, dn] in functions {
            let found = Modulus::of_complement(complement).jacobi(u);
            // Some ten operations a transformation, and what the rounding of u and k' does.
            let allowed = 16.0 * (1.0 + Real::abs(u));
            assert!(close(found.sn, sn, allowed), "sn({u}, {complement}): {} {sn}", found.sn);
            // Near K cn is a difference of u from K, and relative errors grow like K/(K − u).
            let near = allowed * (1.0 + Real::abs(u) * Real::abs(sn / cn) * dn.max(complement));
            assert!(close(found.cn, cn, near), "cn({u}, {complement}): {} {cn}", found.cn);
            assert!(close(found.dn, dn, allowed), "dn({u}, {complement}): {} {dn}", found.dn);
        }
    }

    #[test]
    fn integrals_have_the_digits_of_their_arguments() {
        let integrals = values(include_str!("../tests/data/elliptic_integrals.csv"));
        assert!(integrals.len() > 70);
        for [complement, g, sn, cn, dn, first, third] in integrals {
            let (found_first, found_third) = Jacobi { sn, cn, dn }.integrals(g, complement);
            // Seven to thirteen duplications of positive terms.
            assert!(close(found_first, first, 32.0), "F: {found_first} {first}, k' = {complement}");
            assert!(close(found_third, third, 64.0), "third kind: {found_third} {third}, k' = {complement}, g = {g}");
        }
    }

    #[test]
    fn the_quarter_period_is_where_cn_vanishes() {
        // Squares of complements are within the range of numbers: see `FreeFlow`.
        for complement in [1.0, 0.7, 0.01, 1e-9, 1e-150] {
            let modulus = Modulus::of_complement(complement);
            let k = modulus.quarter_period();
            let (first, _) = Jacobi { sn: 1.0, cn: 0.0, dn: complement }.integrals(1.5, complement);
            assert!(close(first, k, 32.0), "K({complement}): {first} {k}");
            let there = modulus.jacobi(k);
            assert!(Real::abs(there.cn) <= 4.0 * f64::EPSILON * (1.0 + k), "{there:?}");
        }
        assert_eq!(Modulus::of_complement(0.0).quarter_period(), f64::INFINITY);
    }
}
