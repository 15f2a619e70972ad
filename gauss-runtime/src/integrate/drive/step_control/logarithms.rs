//! Logarithms and exponentials of the controller of steps, inlined and without branches, so that those of several lanes
//! are formed side by side. The same bits alone and among others, on every target with the same products and sums.
//!
//! A controller needs two digits of them; they are good to some units in the last place, since shorter series would
//! hardly be cheaper.

use crate::real::Real;

/// The bits of √½: mantissas are taken between this and √2.
const LEAST: u64 = 0x3FE6_A09E_667F_3BCD;

/// ln 2 in two parts, the first of 32 binary digits, so that its products with exponents are exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];

/// 1.5·2⁵²: added and taken away again it rounds to whole numbers.
const SHIFTER: f64 = 6_755_399_441_055_744.0;

/// ln x of a positive normal number.
#[inline(always)]
pub fn logarithm(x: f64) -> f64 {
    let bits = x.to_bits();
    let exponent = (bits.wrapping_sub(LEAST) as i64) >> 52;
    let mantissa = f64::from_bits(bits.wrapping_sub((exponent << 52) as u64));
    // ln m = 2 artanh s = 2 Σ s²ʲ⁺¹/(2j + 1) with s below 0.1716: ten terms leave 1e-17 of the sum out.
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let square = s * s;
    let mut sum = 0.0;
    for j in (0..10).rev() {
        sum = Real::fma(sum, square, 2.0 / f64::from(2 * j + 1));
    }
    let whole = exponent as f64;
    Real::fma(whole, LN_2[0], Real::fma(s, sum, whole * LN_2[1]))
}

/// eˣ, |x| below 700.
#[inline(always)]
pub fn exponential(x: f64) -> f64 {
    let shifted = x * core::f64::consts::LOG2_E + SHIFTER;
    let whole = shifted - SHIFTER;
    let rest = Real::fma(-whole, LN_2[1], Real::fma(-whole, LN_2[0], x));
    // Σ rʲ/j! with r below 0.3466: what follows r¹³ is below 1e-17.
    const FACTORS: [f64; 14] = {
        let mut factors = [1.0; 14];
        let mut j = 1;
        while j < 14 {
            factors[j] = factors[j - 1] / j as f64;
            j += 1;
        }
        factors
    };
    let mut sum = 0.0;
    for j in (0..14).rev() {
        sum = Real::fma(sum, rest, FACTORS[j]);
    }
    // The last digits of what was shifted are the exponent.
    sum * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0_f64.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units in the last place: a few roundings in the sum and in what is added to it.
    const ULP: f64 = 3.0 * f64::EPSILON;

    #[test]
    fn they_agree_with_the_library() {
        for n in 0..20_000 {
            let x = f64::from(n).mul_add(7e-4, -7.0);
            let (error, power) = (10.0_f64.powf(x * 1.4), exponential(x));
            assert!((logarithm(error) - error.ln()).abs() <= ULP * error.ln().abs(), "ln {error}");
            assert!((power / x.exp() - 1.0).abs() <= ULP, "exp {x}");
        }
        assert_eq!((logarithm(1.0), exponential(0.0)), (0.0, 1.0));
        for extreme in [f64::MIN_POSITIVE, f64::MAX] {
            assert!((logarithm(extreme) / extreme.ln() - 1.0).abs() <= ULP);
        }
    }
}
