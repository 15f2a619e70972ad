//! The normal distribution of mean 0 and standard deviation 1.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use statrs::function::erf::{erfc, erfc_inv};

/// Φ: the probability of a number below `x`.
pub fn normal_probability(x: f64) -> f64 {
    0.5 * erfc(-x * FRAC_1_SQRT_2)
}

/// Φ⁻¹: the number below which another is with a probability between 0 and 1.
pub fn normal_quantile(probability: f64) -> f64 {
    -SQRT_2 * erfc_inv(2.0 * probability)
}

/// The number at `u` of the part between two bounds, in standard deviations from the mean: it is sought in the lower
/// tail, whose probabilities keep their digits.
pub fn truncated_quantile(u: f64, [from, to]: [f64; 2]) -> f64 {
    if from > 0.0 {
        return -truncated_quantile(1.0 - u, [-to, -from]);
    }
    let (low, high) = (normal_probability(from), normal_probability(to));
    normal_quantile(low + u * (high - low)).clamp(from, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles with 20 digits, by mpmath: `-sqrt(2) * erfinv(1 - 2 * p)`.
    #[test]
    fn quantiles_have_fifteen_digits() {
        let known = [
            (0.5, 0.0),
            (0.6, 0.253_347_103_135_799_8),
            (0.9, 1.281_551_565_544_600_4),
            (0.975, 1.959_963_984_540_054_2),
            (1e-3, -3.090_232_306_167_813_5),
            (1e-9, -5.997_807_015_007_686_9),
            (1e-15, -7.941_345_326_170_997),
        ];
        for (probability, quantile) in known {
            // Rational approximations of 1e-16 and some twenty roundings, each of half a unit in the last place.
            let error: f64 = normal_quantile(probability) - quantile;
            assert!(error.abs() <= 20.0 * f64::EPSILON * quantile.abs(), "{probability}: {error:e}");
        }
    }

    #[test]
    fn truncated_numbers_keep_to_their_bounds_in_both_tails() {
        for bounds in [[-1.0, 2.0], [4.0, 5.0], [-9.0, -8.0], [8.0, 9.0], [0.0, f64::INFINITY]] {
            let numbers = [1e-15, 0.01, 0.3, 0.5, 0.99, 1.0 - 1e-15].map(|u| truncated_quantile(u, bounds));
            assert!(numbers.is_sorted() && numbers[0] < numbers[5], "{bounds:?}: {numbers:?}");
            assert!(bounds[0] <= numbers[0] && numbers[5] <= bounds[1], "{bounds:?}: {numbers:?}");
            let mirrored = truncated_quantile(0.7, [-bounds[1], -bounds[0]]);
            // 1 − 0.7 is rounded.
            assert!((mirrored + truncated_quantile(0.3, bounds)).abs() < 1e-13, "{bounds:?}");
        }
    }
}
