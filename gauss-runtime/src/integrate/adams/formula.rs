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

/// A multiple of 2⁻⁴⁷. Sums of weights such as these are exact: a formula whose weights are 1 together to the last bit
/// leads to what is as exact as numbers are where derivatives are constant.
const fn short(weight: f64) -> f64 {
    const SHIFTER: f64 = 1.5 * (1_u64 << 52) as f64 / (1_u64 << 47) as f64;
    (weight + SHIFTER) - SHIFTER
}

/// The explicit formula of K steps, and the implicit one of order K + 1. The weights of the latter as they are, not as
/// a correction by ∇ᴷf, whose binomials would bring the rounding of derivatives into the result a hundred times as
/// large.
pub(super) struct Formula<const K: usize>;

impl<const K: usize> Formula<K> {
    const STEPS: () = assert!(2 <= K && K <= MOST, "an Adams method has 2 to 12 steps");

    /// Weights of fₙ, fₙ₋₁, … in the explicit formula: Σ γᵢ ∇ⁱfₙ.
    pub(super) const EXPLICIT: [f64; K] = {
        const { Self::STEPS };
        let (mut weights, mut first, mut j) = ([0.0; K], 1.0, K - 1);
        while j > 0 {
            let (mut sum, mut i) = (0.0, j);
            while i < K {
                sum += binomial(i, j) * GAMMA[i];
                i += 1;
            }
            weights[j] = short(signed(j, sum));
            first -= weights[j];
            j -= 1;
        }
        weights[0] = first;
        weights
    };

    /// Weight of fₙ₊₁ at the state that the explicit formula predicts: γ_K.
    pub(super) const AHEAD: f64 = short(GAMMA[K]);

    /// Beside that of fₙ, fₙ₋₁, …: the explicit formula and γ_K ∇ᴷfₙ₊₁.
    pub(super) const IMPLICIT: [f64; K] = {
        let (mut weights, mut first, mut j) = ([0.0; K], 1.0 - Self::AHEAD, K - 1);
        while j > 0 {
            weights[j] = short(Self::EXPLICIT[j] + signed(j + 1, binomial(K, j + 1)) * GAMMA[K]);
            first -= weights[j];
            j -= 1;
        }
        weights[0] = first;
        weights
    };

    /// Weights of the explicit formula and of the implicit one, side by side.
    pub(super) const BOTH: [[f64; 2]; K] = {
        let (mut both, mut j) = ([[0.0; 2]; K], 0);
        while j < K {
            both[j] = [Self::EXPLICIT[j], Self::IMPLICIT[j]];
            j += 1;
        }
        both
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫₀¹ of the polynomial that is xⁿ, by its values at 0, −1, …: 1/(n + 1).
    #[test]
    fn the_formulas_integrate_polynomials() {
        fn check<const K: usize>() {
            let power = |x: f64, n: usize| x.powi(n as i32);
            let rounding = |weights: &[f64]| {
                64.0 * f64::EPSILON * power(K as f64, K) * weights.iter().map(|weight| weight.abs()).sum::<f64>()
            };
            for n in 0..=K {
                let sum = |weights: &[f64]| -> f64 { (0..K).map(|j| weights[j] * power(-(j as f64), n)).sum() };
                let exact = 1.0 / (n + 1) as f64;
                let explicit = sum(&Formula::<K>::EXPLICIT);
                if n < K {
                    let error = (explicit - exact).abs();
                    assert!(error <= rounding(&Formula::<K>::EXPLICIT), "{K} steps, x^{n}: {explicit}");
                }
                let implicit = Formula::<K>::AHEAD + sum(&Formula::<K>::IMPLICIT);
                let error = (implicit - exact).abs();
                assert!(error <= rounding(&Formula::<K>::IMPLICIT), "{K} steps, x^{n}: {implicit}");
            }
            assert_eq!(Formula::<K>::EXPLICIT.iter().rev().sum::<f64>(), 1.0);
            assert_eq!(Formula::<K>::IMPLICIT.iter().rev().sum::<f64>() + Formula::<K>::AHEAD, 1.0);
        }
        check::<2>();
        check::<4>();
        check::<8>();
        check::<10>();
        check::<12>();
        // Hairer, Nørsett & Wanner, table III.1.1 and 1.2.
        assert!((Formula::<8>::AHEAD - 1_070_017.0 / 3_628_800.0).abs() < 1.0 / (1_u64 << 47) as f64);
    }
}
