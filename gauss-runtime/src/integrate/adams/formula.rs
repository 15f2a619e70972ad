//! The coefficients of the Adams formulas of K steps of one length.

/// The most steps back.
pub(super) const MOST: usize = 12;

/// γ₀ … : `yₙ₊₁ = yₙ + h Σ γᵢ ∇ⁱfₙ` (Hairer, Nørsett & Wanner, III.1): `Σ γᵢ/(m + 1 − i)`, i up to m, is 1.
const GAMMA: [f64; MOST + 1] = {
    let mut gamma = [0.0; MOST + 1];
    let mut m = 0;
    while m <= MOST {
        let (mut rest, mut i) = (1.0, 0);
        while i < m {
            rest -= gamma[i] / (m + 1 - i) as f64;
            i += 1;
        }
        gamma[m] = rest;
        m += 1;
    }
    gamma
};

/// n over k.
const fn binomial(n: usize, k: usize) -> f64 {
    let (mut value, mut i) = (1.0, 0);
    while i < k {
        value = value * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    value
}

const fn signed(i: usize, value: f64) -> f64 {
    if i.is_multiple_of(2) { value } else { -value }
}

/// The explicit formula of K steps, and what the implicit one adds to it.
pub(super) struct Formula<const K: usize>;

impl<const K: usize> Formula<K> {
    const STEPS: () = assert!(2 <= K && K <= MOST, "an Adams method has 2 to 12 steps");

    /// Weights of fₙ, fₙ₋₁, … in the explicit formula. Multiples of 2⁻⁴⁷, so that they are 1 together to the last bit: what a
    /// constant derivative leads to is as exact as numbers are.
    pub(super) const EXPLICIT: [f64; K] = {
        const { Self::STEPS };
        let (mut weights, mut first, mut j) = ([0.0; K], 1.0, K - 1);
        while j > 0 {
            let (mut sum, mut i) = (0.0, j);
            while i < K {
                sum += binomial(i, j) * GAMMA[i];
                i += 1;
            }
            const SHIFTER: f64 = 1.5 * (1_u64 << 52) as f64 / (1_u64 << 47) as f64;
            weights[j] = signed(j, (sum + SHIFTER) - SHIFTER);
            first -= weights[j];
            j -= 1;
        }
        weights[0] = first;
        weights
    };

    /// Of fₙ₊₁ in ∇ᴷfₙ₊₁: 1. Of fₙ, fₙ₋₁, …:
    pub(super) const DIFFERENCE: [f64; K] = {
        let (mut weights, mut j) = ([0.0; K], 0);
        while j < K {
            weights[j] = signed(j + 1, binomial(K, j + 1));
            j += 1;
        }
        weights
    };

    /// What the implicit formula of order K + 1 adds, in h ∇ᴷfₙ₊₁.
    pub(super) const CORRECTION: f64 = GAMMA[K];
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫₀¹ of the polynomial that is xⁿ, by its values at 0, −1, …: 1/(n + 1).
    #[test]
    fn the_formulas_integrate_polynomials() {
        fn check<const K: usize>() {
            let power = |x: f64, n: usize| x.powi(n as i32);
            for n in 0..=K {
                let explicit: f64 = (0..K).map(|j| Formula::<K>::EXPLICIT[j] * power(-(j as f64), n)).sum();
                let difference: f64 =
                    power(1.0, n) + (0..K).map(|j| Formula::<K>::DIFFERENCE[j] * power(-(j as f64), n)).sum::<f64>();
                let largest = power(K as f64, n) * (0..K).map(|j| Formula::<K>::DIFFERENCE[j].abs()).sum::<f64>();
                let rounding = 64.0 * largest * f64::EPSILON;
                let exact = 1.0 / (n + 1) as f64;
                if n < K {
                    assert!((explicit - exact).abs() <= rounding, "{K} steps, x^{n}: {explicit}");
                    assert!(difference.abs() <= rounding, "{K} steps, x^{n}: {difference}");
                }
                let implicit = explicit + Formula::<K>::CORRECTION * difference;
                assert!((implicit - exact).abs() <= rounding, "{K} steps, x^{n}: {implicit}");
            }
            assert_eq!(Formula::<K>::EXPLICIT.iter().rev().sum::<f64>(), 1.0);
        }
        check::<2>();
        check::<4>();
        check::<8>();
        check::<10>();
        check::<12>();
        // Hairer, Nørsett & Wanner, table III.1.1 and 1.2.
        assert!((Formula::<8>::CORRECTION - 1_070_017.0 / 3_628_800.0).abs() < 8.0 * f64::EPSILON);
    }
}
