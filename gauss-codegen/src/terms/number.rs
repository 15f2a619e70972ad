//! Literals as exact fractions: `0.1` is one tenth, not the nearest binary number.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::algebra::Rational;

/// Powers of ten beyond which no number of less than a million digits is in the range of double precision.
const EXPONENTS: i64 = 1_000_000;

/// Decimal digits such as `12`, `0.5` or `1e-3`, if double precision has a number near them.
pub fn exact(digits: &str) -> Option<Rational> {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let mantissa: BigInt = format!("{whole}{fraction}").parse().ok()?;
    if mantissa == BigInt::ZERO {
        // Whatever its exponent.
        return Some(Rational::zero());
    }
    let exponent = exponent.parse::<i64>().ok()?.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    let power = Some(exponent.unsigned_abs() as u32).filter(|_| exponent.abs() < EXPONENTS)?;
    let power = BigInt::from(10).pow(power);
    let value = if exponent < 0 { BigRational::new(mantissa, power) } else { BigRational::from(mantissa * power) };
    let value = Rational::from(value);
    Some(value).filter(|value| value.to_f64().is_normal())
}

/// The shortest decimal fraction that is read as a number. What is too small for a normal one is none that a file
/// means.
pub fn shortest(value: f64) -> Rational {
    let size = exact(&format!("{:e}", value.abs())).unwrap_or_else(Rational::zero);
    if value < 0.0 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::exact;
    use crate::algebra::Rational;

    #[test]
    fn fractions() {
        let fraction = |numerator, denominator| Some(Rational::new(numerator, denominator));
        assert_eq!(exact("0"), fraction(0, 1));
        assert_eq!(exact("0.000e-999"), fraction(0, 1));
        assert_eq!(exact("12"), fraction(12, 1));
        assert_eq!(exact("-12"), fraction(-12, 1));
        assert_eq!(exact("1200"), fraction(1200, 1));
        assert_eq!(exact("0.5"), fraction(1, 2));
        assert_eq!(exact("1."), fraction(1, 1));
        assert_eq!(exact("9.80665"), fraction(196_133, 20_000));
        assert_eq!(exact("1e-3"), fraction(1, 1000));
        assert_eq!(exact("1.5E+3"), fraction(1500, 1));
        assert_eq!(exact("9223372036854775807"), fraction(i64::MAX, 1));
    }

    /// As the compiler reads them.
    #[test]
    fn many_digits() {
        for digits in [
            "9223372036854775808",
            "3.14159265358979323846264338327950288419716939937510",
            "1e-19",
            "6.62607015e-34",
            "1e300",
            "2.2250738585072014e-308",
            "0.12345678901234567891",
            "5.972168e24",
        ] {
            assert_eq!(exact(digits).map(Rational::to_f64), digits.parse().ok(), "{digits}");
        }
    }

    #[test]
    fn what_double_precision_cannot_hold() {
        for digits in ["1e309", "1e-309", "1e99999999999999999999", "1e-4294967296", "1e2000000"] {
            assert_eq!(exact(digits), None, "{digits}");
        }
    }
}
