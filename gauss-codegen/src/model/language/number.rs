//! Literals as exact fractions: `0.1` is one tenth, not the nearest binary number.

/// Numerator and denominator, in lowest terms, of decimal digits such as `12`, `0.5` or `1e-3`, if both fit 64 bits.
pub fn exact(digits: &str) -> Option<(i64, i64)> {
    let (negative, digits) = match digits.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, digits),
    };
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let all = format!("{whole}{fraction}");
    let significant = all.trim_start_matches('0').trim_end_matches('0');
    if significant.is_empty() {
        // Zero, whatever its exponent.
        return Some((0, 1));
    }
    let trailing = all.len() - all.trim_end_matches('0').len();
    let exponent = exponent
        .parse::<i64>()
        .ok()?
        .checked_sub(i64::try_from(fraction.len()).ok()?)?
        .checked_add(i64::try_from(trailing).ok()?)?;
    let power = 10_i128.checked_pow(u32::try_from(exponent.unsigned_abs()).ok()?)?;
    let mantissa: i128 = significant.parse().ok()?;
    let (numerator, denominator) = if exponent < 0 { (mantissa, power) } else { (mantissa.checked_mul(power)?, 1) };
    let common = greatest_common_divisor(numerator, denominator);
    let numerator = i64::try_from(numerator / common).ok()?;
    let denominator = i64::try_from(denominator / common).ok()?;
    Some((if negative { -numerator } else { numerator }, denominator))
}

/// Euclid's algorithm, for positive numbers.
fn greatest_common_divisor(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::exact;

    #[test]
    fn fractions() {
        assert_eq!(exact("0"), Some((0, 1)));
        assert_eq!(exact("0.000e-999"), Some((0, 1)));
        assert_eq!(exact("12"), Some((12, 1)));
        assert_eq!(exact("-12"), Some((-12, 1)));
        assert_eq!(exact("1200"), Some((1200, 1)));
        assert_eq!(exact("0.5"), Some((1, 2)));
        assert_eq!(exact("1."), Some((1, 1)));
        assert_eq!(exact("9.80665"), Some((196_133, 20_000)));
        assert_eq!(exact("1e-3"), Some((1, 1000)));
        assert_eq!(exact("1.5E+3"), Some((1500, 1)));
        assert_eq!(exact("9223372036854775807"), Some((i64::MAX, 1)));
    }

    #[test]
    fn what_64_bits_cannot_hold() {
        assert_eq!(exact("9223372036854775808"), None);
        assert_eq!(exact("1e-19"), None);
        assert_eq!(exact("1e19"), None);
        assert_eq!(exact("1e99999999999999999999"), None);
        assert_eq!(exact("1e-4294967296"), None);
        assert_eq!(exact("0.12345678901234567891"), None);
    }
}
