//! Gauss' principle (3.1) and the condition (3.4), word for word: v_P, its derivatives, integrals over the body by
//! moments.
//!
//! Tests check everything else against this definition: the equations that kernels are made from (`links`,
//! `arrangements`) are arranged for speed, and must give the same residual. The macro itself checks with the
//! stationarity of C (`faults`), which is cheaper to form than (3.4); tests prove that the two are equal.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::vector::{Axes, BodyMotion, Triple, Vector, apply_block, dot};
use crate::mechanics::matter::body::{AffineField, Body, integrate_product};

/// Body coordinates x of the point P, as formal symbols.
fn body_point(graph: &Graph) -> Triple<'_> {
    std::array::from_fn(|j| graph.symbol(format!("x{}", j + 1), format!("x_{{{}}}", j + 1), false))
}

/// v_P = d/dt (R x + b), observer's components (1.1), (2.2)–(2.6).
pub fn velocity_field<'g>(kinematics: &Kinematics<'g>, x: &Triple<'g>) -> Triple<'g> {
    let turned = kinematics.frame.to_space(x);
    std::array::from_fn(|i| (turned[i] + kinematics.position[i]).derivative(&kinematics.rates))
}

/// v_P with its partial derivatives w_α = ∂v_P/∂z^α: affine fields over the body.
fn fields<'g>(kinematics: &Kinematics<'g>) -> (AffineField<'g>, Vec<AffineField<'g>>) {
    let x = body_point(kinematics.frame.graph);
    let field = AffineField::of(&velocity_field(kinematics, &x), &x);
    (field, kinematics.speeds.iter().map(|&z| field.map(|e| e.partial(z))).collect())
}

/// Gauss' principle itself: ∂C/∂ż^α of `C = ½∫|a_P − dF/dm|² dm` (3.1), which is `∫a_P·w_α dm − ∫w_α·dF` because
/// ∂a_P/∂ż^α = w_α. A function of (q, z, ż).
pub fn stationarity<'g>(kinematics: &Kinematics<'g>, body: &Body<'g>) -> Vec<Expr<'g>> {
    let along = kinematics.rates_with_accelerations();
    let (field, partials) = fields(kinematics);
    let acceleration = field.map(|e| e.derivative(&along));
    let row = |(partial, &z): (&AffineField<'g>, &Expr<'g>)| {
        integrate_product(body, &acceleration, partial) + fluid(&kinematics.motion(), body, z, &along)
            - active_forces(body, partial)
    };
    partials.iter().zip(&kinematics.speeds).map(row).collect()
}

/// `d/dt ∫v_P·w_α dm − ∫v_P·dw_α/dt dm − ∫w_α·dF` for every α: the condition (3.4), a function of (q, z, ż).
#[cfg(test)]
pub fn gauss_condition<'g>(kinematics: &Kinematics<'g>, body: &Body<'g>) -> Vec<Expr<'g>> {
    let along = kinematics.rates_with_accelerations();
    let (field, partials) = fields(kinematics);
    let row = |(partial, &z): (&AffineField<'g>, &Expr<'g>)| {
        let momentum = integrate_product(body, &field, partial);
        let partial_rate = partial.map(|e| e.derivative(&along));
        let inertia = momentum.derivative(&along) - integrate_product(body, &field, &partial_rate);
        inertia + fluid(&kinematics.motion(), body, z, &along) - active_forces(body, partial)
    };
    partials.iter().zip(&kinematics.speeds).map(row).collect()
}

/// `∫∂v_P/∂z^α·dF` of weight and buoyancy.
fn active_forces<'g>(body: &Body<'g>, partial: &AffineField<'g>) -> Expr<'g> {
    let Some(gravity) = body.gravity else { return body.mass.graph().zero() };
    let weight = AffineField { constant: gravity, linear: [[body.mass.graph().zero(); 3]; 3] };
    let work = integrate_product(body, &weight, partial);
    match body.displaced {
        Some((mass, center)) => work - mass * dot(&gravity, &partial.at(&center)),
        None => work,
    }
}

/// Contribution of the impulse (Q_f, Γ_f) = M_A (u, ω) of the fluid: it pairs with w_α as the body's own momentum does.
fn fluid<'g>(motion: &BodyMotion<'_, 'g>, body: &Body<'g>, z: Expr<'g>, along: &Map<u32, Expr<'g>>) -> Expr<'g> {
    let frame = motion.frame;
    let Some(added) = &body.added_mass else { return frame.graph.zero() };
    let u = frame.resolve(motion.velocity, Axes::Body);
    let omega = frame.resolve(motion.angular_velocity, Axes::Body);
    let impulse = |row: usize| -> Vector<'g> {
        let (linear, angular) = (apply_block(added, row, 0, &u), apply_block(added, row, 3, &omega));
        frame.body_vector(std::array::from_fn(|i| linear[i] + angular[i]))
    };
    pairing(motion, &impulse(0), &impulse(3), z, along)
}

/// `d/dt p_α − [Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α]` with `p_α = Q·a_α + Γ_O·o_α`: the left-hand side of (3.4) for any
/// momentum (Q, Γ_O) that pairs with rigid partial velocities.
pub fn pairing<'g>(
    motion: &BodyMotion<'_, 'g>,
    linear_momentum: &Vector<'g>,
    angular_momentum: &Vector<'g>,
    z: Expr<'g>,
    along: &Map<u32, Expr<'g>>,
) -> Expr<'g> {
    let BodyMotion { frame, velocity, angular_velocity: omega } = motion;
    let (a, o) = (velocity.partial(z), omega.partial(z));
    let a_rate = frame.derivative(&a, along, omega);
    let o_rate = frame.derivative(&o, along, omega);
    let momentum = frame.dot(linear_momentum, &a) + frame.dot(angular_momentum, &o);
    let turning = a_rate.plus(&frame.cross(velocity, &o));
    momentum.derivative(along) - frame.dot(linear_momentum, &turning) - frame.dot(angular_momentum, &o_rate)
}
