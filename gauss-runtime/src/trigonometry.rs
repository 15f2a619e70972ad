//! Sine and cosine of one angle together, inlined: kernels with angles spend most of their time in the library's otherwise.
//!
//! The angle is reduced by the nearest multiple of π/2, of which 119 binary digits are subtracted in parts that a product with the
//! multiple does not round (Cody & Waite), with what the second subtraction rounds off carried along. The polynomials on
//! [−π/4, π/4] are those of fdlibm (Sun Microsystems 1993; `k_sin.c`, `k_cos.c`, `e_rem_pio2.c`), whose errors are below 2⁻⁵⁸.
//! Results are within 1 ulp. What is left goes to the library: angles beyond [`LIMIT`], angles within [`CLOSE`] of a multiple of π/2,
//! whose leading digits cancel, and what is not finite.

/// Multiples below 2¹⁷·π/2 are exact beside parts of 33 binary digits, and what the reduction leaves out is far below an ulp.
const LIMIT: f64 = 1.0e5;

/// Half of the digits of an angle as large as [`LIMIT`] are left here.
const CLOSE: f64 = 1.0e-4;

/// 1.5·2⁵²: added and taken away again it rounds to whole numbers; in between they are the last digits.
const SHIFTER: f64 = 6_755_399_441_055_744.0;

const TWO_OVER_PI: f64 = core::f64::consts::FRAC_2_PI;

/// π/2 in two parts of 33 binary digits, and the rest.
const PARTS: [f64; 2] = [f64::from_bits(0x3FF9_21FB_5440_0000), f64::from_bits(0x3DD0_B461_1A60_0000)];
const REST: f64 = f64::from_bits(0x3BA3_198A_2E03_7073);

const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// `(sin x, cos x)`, with the given `a·b + c`.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64, fma: impl Fn(f64, f64, f64) -> f64) -> (f64, f64) {
    // Without its sign, so that −0 keeps it.
    let x = angle.abs();
    let shifted = x * TWO_OVER_PI + SHIFTER;
    let (n, quadrant) = (shifted - SHIFTER, shifted.to_bits());

    // x − n π/2 = y + tail. The first difference is exact, because both sides are within a factor of two of each other.
    let first = x - n * PARTS[0];
    let part = n * PARTS[1];
    let y = first - part;
    // False for a NaN. Where there is nothing to subtract nothing cancels.
    if !(x <= LIMIT && (y.abs() >= CLOSE || n == 0.0)) {
        return library(angle);
    }
    let tail = ((first - y) - part) - n * REST;

    let z = y * y;
    let (v, z2) = (z * y, z * z);
    // Pairs of terms side by side: what follows waits for them.
    let [s1, s2, s3, s4, s5, s6] = SINE;
    let higher = fma(fma(s6, z, s5), z2, fma(s4, z, s3));
    let sine = y - ((z * (0.5 * tail - v * fma(higher, z, s2)) - tail) - v * s1);
    let [c1, c2, c3, c4, c5, c6] = COSINE;
    let higher = fma(fma(c6, z, c5), z2, fma(c4, z, c3));
    let rest = fma(higher, z2, fma(c2, z, c1));
    let half = 0.5 * z;
    let most = 1.0 - half;
    let cosine = most + (((1.0 - most) - half) + (z2 * rest - y * tail));

    let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let flipped = |value: f64, signs: u64| f64::from_bits(value.to_bits() ^ (signs & (1 << 63)));
    (flipped(sine, (quadrant << 62) ^ angle.to_bits()), flipped(cosine, quadrant.wrapping_add(1) << 62))
}

#[cold]
#[inline(never)]
fn library(x: f64) -> (f64, f64) {
    #[cfg(feature = "std")]
    return x.sin_cos();
    #[cfg(not(feature = "std"))]
    return libm::sincos(x);
}

#[cfg(test)]
mod tests {
    use super::LIMIT;
    use crate::real::Real;
    use std::vec::Vec;

    fn sin_cos(x: f64) -> (f64, f64) {
        super::sin_cos(x, Real::fma)
    }

    /// Steps from one number to the other along the numbers that there are.
    fn apart(a: f64, b: f64) -> u64 {
        let place = |x: f64| {
            let bits = x.to_bits() as i64;
            if bits < 0 { i64::MIN - bits } else { bits }
        };
        place(a).abs_diff(place(b))
    }

    fn check(x: f64) {
        let (found, expected) = (sin_cos(x), x.sin_cos());
        // Both are within 1 ulp of the true value.
        assert!(apart(found.0, expected.0) <= 1 && apart(found.1, expected.1) <= 1, "{x:e}: {found:?} {expected:?}");
    }

    #[test]
    fn agree_with_the_library_within_an_ulp() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        };
        for scale in [1e-8, 1e-3, 0.5, 2.0, 10.0, 1e3, 1e5, LIMIT, 1e12, 1e300] {
            for _ in 0..20_000 {
                check(random() * scale);
            }
        }
    }

    /// Next to multiples of π/2 nearly all digits cancel.
    #[test]
    fn keep_all_digits_next_to_multiples_of_a_quarter_turn() {
        let near = |n: u32| {
            let x = f64::from(n) * core::f64::consts::FRAC_PI_2;
            (-2..=2).map(move |k: i64| f64::from_bits((x.to_bits() as i64 + k) as u64))
        };
        let multiples: Vec<u32> = (1..3000).chain((3000..500_000).step_by(97)).collect();
        for x in multiples.into_iter().flat_map(near) {
            check(x);
            check(-x);
        }
    }

    #[test]
    fn odd_and_even_and_exact_where_they_can_be() {
        assert_eq!((sin_cos(0.0).0.to_bits(), sin_cos(0.0).1), (0, 1.0));
        assert_eq!(sin_cos(-0.0).0.to_bits(), (-0.0_f64).to_bits());
        for x in [1e-300, 5e-324, 1e-9] {
            assert_eq!(sin_cos(x), (x, 1.0));
        }
        for x in [0.3, 1.7, 4.0, 1e4, 7e5] {
            let ((s, c), (t, d)) = (sin_cos(x), sin_cos(-x));
            assert_eq!((s, c), (-t, d));
        }
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
        }
    }
}
