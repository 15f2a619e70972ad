//! Momentum of the fluid that a body sets in motion, and how it reacts.

use crate::algebra::Expr;

use crate::mechanics::kinematics::vector::{Triple, add, apply_block, cross};

/// (Q_f, Γ_f) = M_A (u, ω).
pub fn impulse<'g>(added: &[Vec<Expr<'g>>], u: &Triple<'g>, omega: &Triple<'g>) -> (Triple<'g>, Triple<'g>) {
    let row = |first: usize| -> Triple<'g> {
        let (linear, angular) = (apply_block(added, first, 0, u), apply_block(added, first, 3, omega));
        add(&linear, &angular).map(Expr::group)
    };
    (row(0), row(3))
}

/// `dQ_f/dt` and `dΓ_f/dt + v_O × Q_f` of the fluid's impulse in body axes; `u` is the velocity of O relative to the
/// fluid far away, `rate` the observer's derivative of a vector in body axes.
pub fn reaction<'g>(
    added: &[Vec<Expr<'g>>],
    u: &Triple<'g>,
    omega: &Triple<'g>,
    rate: impl Fn(&Triple<'g>) -> Triple<'g>,
) -> (Triple<'g>, Triple<'g>) {
    let (q, gamma) = impulse(added, u, omega);
    (rate(&q), add(&rate(&gamma), &cross(u, &q)))
}
