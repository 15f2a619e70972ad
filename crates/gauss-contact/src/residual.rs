//! How far contacts are from their laws.

/// How far a contact is from its laws, in units of u: a velocity after an impact, else an acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Residual {
    /// `min(u_N, D_NN λ_N)`, without its sign: 0 where the gap does not close and nothing pulls.
    pub signorini: f64,
    /// By how much friction is larger than μ λ_N, times D_TT.
    pub coulomb: f64,
    /// How far friction is from the force within μ λ_N that opposes slip most, times D_TT.
    pub dissipation: f64,
    /// What rounding makes of these.
    pub rounding: f64,
}

impl Residual {
    /// The larger of each; NaN where one is.
    pub(crate) fn worse(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
        Self {
            signorini: larger(self.signorini, other.signorini),
            coulomb: larger(self.coulomb, other.coulomb),
            dissipation: larger(self.dissipation, other.dissipation),
            rounding: larger(self.rounding, other.rounding),
        }
    }

    /// The largest of the three; NaN where one is.
    pub fn worst(&self) -> f64 {
        let larger = |worst: f64, r: f64| if r > worst || r.is_nan() { r } else { worst };
        [self.signorini, self.coulomb, self.dissipation].into_iter().fold(0.0, larger)
    }

    /// Whether all of it is rounding.
    pub(crate) fn holds(&self) -> bool {
        self.worst() <= self.rounding
    }
}

#[cfg(test)]
mod tests {
    use super::Residual;

    #[test]
    fn what_is_no_number_does_not_hold() {
        let good = Residual { rounding: 1.0, ..Residual::default() };
        assert!(good.holds());
        for k in 0..3 {
            let mut each = [0.0; 3];
            each[k] = f64::NAN;
            let [signorini, coulomb, dissipation] = each;
            let bad = Residual { signorini, coulomb, dissipation, ..good };
            assert!(bad.worst().is_nan() && !bad.holds(), "{k}");
            assert!(good.worse(bad).worst().is_nan() && bad.worse(good).worst().is_nan(), "{k}");
        }
    }
}
