//! Distances of contacts from their laws.

use gauss_runtime::real::Real;

/// Distance of a contact from its laws, in units of u: a velocity after an impact, else an acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Residual<T = f64> {
    /// `min(u_N, D_NN λ_N)`, without its sign: 0 where the gap does not close and nothing pulls.
    pub signorini: T,
    /// Excess of friction over μ λ_N, times D_TT.
    pub coulomb: T,
    /// Distance of friction from the force within μ λ_N that opposes slip most, times D_TT.
    pub dissipation: T,
    /// Rounding of these.
    pub rounding: T,
}

impl<T: Real> Residual<T> {
    /// None at all.
    pub(crate) fn zero() -> Self {
        let [signorini, coulomb, dissipation, rounding] = [T::zero(); 4];
        Self { signorini, coulomb, dissipation, rounding }
    }

    /// The larger of each; NaN where one is.
    pub(crate) fn worse(self, other: Self) -> Self {
        Self {
            signorini: self.signorini.max(other.signorini),
            coulomb: self.coulomb.max(other.coulomb),
            dissipation: self.dissipation.max(other.dissipation),
            rounding: self.rounding.max(other.rounding),
        }
    }

    /// The largest of the three; NaN where one is.
    pub fn worst(&self) -> T {
        self.signorini.max(self.coulomb).max(self.dissipation)
    }

    /// The residual of one lane.
    pub(crate) fn lane(&self, lane: usize) -> Residual {
        Residual {
            signorini: self.signorini.lane(lane),
            coulomb: self.coulomb.lane(lane),
            dissipation: self.dissipation.lane(lane),
            rounding: self.rounding.lane(lane),
        }
    }
}

impl Residual {
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
