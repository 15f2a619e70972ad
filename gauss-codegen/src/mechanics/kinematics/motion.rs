//! Kinematics of one body: its pose, its velocities in terms of the speeds, and the rates of all that these depend on.

use crate::algebra::{Expr, Map};

#[cfg(test)]
use crate::mechanics::kinematics::vector::BodyMotion;
use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, Vector};

/// Kinematics of one body.
#[derive(Clone)]
pub struct Kinematics<'g> {
    pub frame: Frame<'g>,
    /// b = O − Ω, observer's components.
    pub position: Triple<'g>,
    /// The quasi-velocities z that move it and, formally, their rates ż.
    pub speeds: Vec<Expr<'g>>,
    pub speed_rates: Vec<Expr<'g>>,
    /// ψ: the rates of t and of every symbol of the configuration.
    pub rates: Map<u32, Expr<'g>>,
    /// v_O, each part in the axes where it is simplest.
    pub velocity: Vector<'g>,
    /// ω, likewise.
    pub angular_velocity: Vector<'g>,
    /// The components of the twist of O in body axes, (u, ω), that the motion can have.
    pub active: Vec<usize>,
}

impl<'g> Kinematics<'g> {
    /// ψ together with ż, for derivatives of what depends on z.
    pub fn rates_with_accelerations(&self) -> Map<u32, Expr<'g>> {
        let mut rates = self.rates.clone();
        rates.extend(self.speeds.iter().zip(&self.speed_rates).map(|(z, dz)| (z.key(), *dz)));
        rates
    }

    /// The motion of the body.
    #[cfg(test)]
    pub fn motion(&self) -> BodyMotion<'_, 'g> {
        BodyMotion { frame: &self.frame, velocity: &self.velocity, angular_velocity: &self.angular_velocity }
    }

    /// Body axes about which the motion can turn.
    pub fn angular_axes(&self) -> Vec<usize> {
        self.active.iter().filter(|&&k| k >= 3).map(|k| k - 3).collect()
    }

    /// Body axes along which O can move.
    pub fn linear_axes(&self) -> Vec<usize> {
        self.active.iter().copied().filter(|&k| k < 3).collect()
    }

    /// (u, ω), body axes, pole O.
    pub fn body_twist(&self) -> [Expr<'g>; 6] {
        let in_body = |a: &Vector<'g>| self.frame.resolve(a, Axes::Body).map(Expr::group);
        let ([u1, u2, u3], [w1, w2, w3]) = (in_body(&self.velocity), in_body(&self.angular_velocity));
        [u1, u2, u3, w1, w2, w3]
    }
}
