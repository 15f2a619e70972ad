//! Matter that flows inside a body on its way to a place where it leaves, or from one where it enters.

use crate::algebra::{Expr, Map};

use crate::mechanics::kinematics::vector::{Triple, add, cross, dot, scale};
use crate::mechanics::matter::moments::Moments;

/// A flow with the velocity w in the axes of its body, by the moments that it carries: with matter that is conserved
/// `∂/∂t ∫f dm = ∫(∂f/∂x) w dm + ṁ f(x_E)` for f = 1, x, x xᵀ, where ṁ < 0 leaves at E.
///
/// In (3.4) the matter has v_P = v_O + ω × x + w, and ∂v_P/∂z is that of the body. So a_P has the terms 2 ω × w + Dw/Dt
/// beside those of a body whose masses stay. Their integrals, and those with x ×, are moments of this flow, but for
/// ∫(x − x_E) × w dm, which is taken to be zero: the flow has no swirl about E.
pub struct MatterFlow<'g> {
    /// ṁ.
    pub rate: Expr<'g>,
    /// E from O, body axes.
    pub exit: Triple<'g>,
    /// `x → ∫w dm`, `x xᵀ → ∫(w xᵀ + x wᵀ) dm`, about O in body axes.
    carried: Moments<'g>,
    /// ∂/∂t ∫w dm.
    surge: Triple<'g>,
}

impl<'g> MatterFlow<'g> {
    /// The flow of a body with these moments, functions of `instant`, through the place E, now.
    pub fn through(exit: Triple<'g>, moments: &Moments<'g>, [instant, now]: [Expr<'g>; 2]) -> Self {
        let rates = moments.map(|e| e.partial(instant));
        let carried = rates.plus(&Moments::particle(-rates.mass).shifted(&exit));
        let at = Map::from_iter([(instant.key(), now)]);
        let surge = carried.first.map(|e| e.partial(instant).substitute(&at));
        Self { rate: rates.mass.substitute(&at), exit, carried: carried.map(|e| e.substitute(&at)), surge }
    }

    /// Whether nothing flows.
    pub fn is_still(&self) -> bool {
        self.rate.is_zero() && self.carried.is_zero()
    }

    /// Force and torque about O, body axes: `−∫(2 ω × w + Dw/Dt) dm` and `−∫x × (2 ω × w + Dw/Dt) dm`, without the
    /// momentum ṁ u that passes through E. Dw/Dt integrates to ∂/∂t ∫w dm − ṁ u, x × Dw/Dt to ∂/∂t ∫x × w dm − ṁ x_E ×
    /// u, and 2 x × (ω × w) to the inertia that is carried, times ω, and ω × ∫x × w dm.
    pub fn reaction(&self, omega: &Triple<'g>) -> [Triple<'g>; 2] {
        let two = self.rate.graph().integer(2);
        let force = add(&scale(two, &cross(omega, &self.carried.first)), &self.surge);
        let turned = self.carried.inertia().map(|row| dot(&row, omega));
        let swept = cross(omega, &cross(&self.exit, &self.carried.first).map(Expr::group));
        let torque = add(&add(&turned, &swept), &cross(&self.exit, &self.surge));
        [force, torque].map(|a| a.map(|e| -e))
    }
}
