//! The impulse of the fluid around a body: (Q, Γ) = M (u, ω) in body axes, and its balance.

use super::dense::dot;
use super::numbers::Jet;
use super::witness::{JetMatrix, JetTriple, inner};

/// (u, ω) and (Q, Γ) along a motion.
pub struct Fluid {
    pub twist: [Jet; 6],
    pub impulse: [Jet; 6],
}

pub fn part(six: &[Jet; 6], f: impl Fn(&Jet) -> f64) -> [f64; 6] {
    std::array::from_fn(|i| f(&six[i]))
}

impl Fluid {
    pub fn new(added: &[[f64; 6]; 6], origin: &JetTriple, rotation: &JetMatrix) -> Self {
        let velocity = origin.map(Jet::velocity);
        let axis = |j: usize| [0, 1, 2].map(|i| rotation[i][j].along());
        let turning = |j: usize| [0, 1, 2].map(|i| rotation[i][j].velocity());
        // u_i = e_i·v, ω₁ = e₃·ė₂ and so on.
        let twist = std::array::from_fn(|k| match k {
            0..3 => inner(&axis(k), &velocity),
            _ => inner(&axis((k + 2) % 3), &turning((k + 1) % 3)),
        });
        let impulse = added.map(|row| (0..6).fold(Jet::default(), |sum, j| sum + Jet::constant(row[j]) * twist[j]));
        Self { twist, impulse }
    }

    /// `ω × Q` and `ω × Γ + u × Q`: what turning axes and the moving pole add to the rate of (Q, Γ).
    pub fn turning(&self) -> [f64; 6] {
        let (t, p) = (part(&self.twist, |x| x.value), part(&self.impulse, |x| x.value));
        let cross = |a: &[f64], b: &[f64], i: usize| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        std::array::from_fn(|k| match k {
            0..3 => cross(&t[3..], &p[..3], k),
            _ => cross(&t[3..], &p[3..], k - 3) + cross(&t[..3], &p[..3], k - 3),
        })
    }

    /// The force that the fluid opposes to a partial velocity.
    pub fn inertia_force(&self) -> f64 {
        let (rate, side) = (part(&self.impulse, |x| x.rate), part(&self.twist, |x| x.side));
        dot(&rate, &side) + dot(&self.turning(), &side)
    }

    /// d/dt of the momentum `(Q, Γ)·∂(u, ω)/∂z`.
    pub fn momentum_rate(&self) -> f64 {
        let (value, rate) = (part(&self.impulse, |x| x.value), part(&self.impulse, |x| x.rate));
        dot(&rate, &part(&self.twist, |x| x.side)) + dot(&value, &part(&self.twist, |x| x.side_rate))
    }

    /// Its share of C: the gradient is the force.
    pub fn constraint_function(&self) -> f64 {
        let (rate, acceleration) = (part(&self.impulse, |x| x.rate), part(&self.twist, |x| x.rate));
        0.5 * dot(&rate, &acceleration) + dot(&self.turning(), &acceleration)
    }
}
