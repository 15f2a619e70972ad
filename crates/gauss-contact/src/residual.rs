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
    /// The larger of each.
    pub(crate) fn worse(self, other: Self) -> Self {
        Self {
            signorini: self.signorini.max(other.signorini),
            coulomb: self.coulomb.max(other.coulomb),
            dissipation: self.dissipation.max(other.dissipation),
            rounding: self.rounding.max(other.rounding),
        }
    }

    /// The largest of the three.
    pub(crate) fn worst(&self) -> f64 {
        [self.signorini, self.coulomb, self.dissipation]
            .into_iter()
            .fold(0.0, |worst, r| if r <= worst { worst } else { r })
    }

    /// Whether all of it is rounding.
    pub(crate) fn holds(&self) -> bool {
        self.worst() <= self.rounding
    }
}
