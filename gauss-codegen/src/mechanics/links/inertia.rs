//! Forces of inertia of one link, with those of the fluid that it moves.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, cross_matrix, dot, is_zero, scale};
use crate::mechanics::links::link::Link;
use crate::mechanics::matter::added_mass::reaction;
use crate::mechanics::matter::body::Body;

/// The rate of the angular momentum of a link: two ways to form it, one cheaper here, the other there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inertia {
    /// `I ω̇ + ω × I ω`.
    Tensor,
    /// `∫x × Ξ x dm` with the acceleration field `a_O + Ξ x`, `Ξ = [ω̇]× + [ω]×²`.
    Field,
}

/// `∫(a_P − g) dm` and `∫x × (a_P − g) dm`, and what the fluid needs to follow.
pub fn force_of_inertia<'g>(
    (graph, gravity): (&'g Graph, Option<Triple<'g>>),
    link: &Link<'g>,
    (a, alpha): (&Vector<'g>, &Triple<'g>),
    along: &Map<u32, Expr<'g>>,
    inertia: Inertia,
) -> (Vector<'g>, Triple<'g>) {
    let (frame, moments, w) = (&link.frame, &link.moments, &link.angular_velocity);
    let first = &moments.first;
    let (turning, mut torque) = match inertia {
        Inertia::Field => {
            let field = acceleration_gradient(w, alpha);
            // ∫x × Ξx dm is the axial vector of Ξ J.
            let product = |i: usize, j: usize| dot(&field[i], &moments.second[j]);
            let torque = std::array::from_fn(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                product(k, j) - product(j, k)
            });
            (apply(&field, first), torque)
        }
        Inertia::Tensor => {
            let tensor = moments.inertia();
            let spin = apply(&tensor, w).map(Expr::group);
            let turning = add(&cross(alpha, first), &cross(w, &cross(w, first).map(Expr::group)));
            (turning, add(&apply(&tensor, alpha), &cross(w, &spin)))
        }
    };
    let mut force = a.times(moments.mass).plus(&frame.body_vector(turning));
    if !is_zero(first) {
        torque = add(&torque, &cross(first, &frame.resolve(a, Axes::Body)));
    }
    if let Some(body) = link.body() {
        let (more, moment) = fluid_force((graph, gravity), link, body, along);
        force = force.plus(&more);
        torque = add(&torque, &moment);
    }
    (force.map(Expr::group), torque.map(Expr::group))
}

/// `dQ_f/dt` and `dΓ_f/dt + v_O × Q_f` of the fluid's impulse, minus buoyancy.
fn fluid_force<'g>(
    (graph, gravity): (&'g Graph, Option<Triple<'g>>),
    link: &Link<'g>,
    body: &Body<'g>,
    along: &Map<u32, Expr<'g>>,
) -> (Vector<'g>, Triple<'g>) {
    let frame = &link.frame;
    let zero = [graph.zero(); 3];
    let (mut force, mut torque) = (frame.zero(), zero);
    if let Some(added) = &body.added_mass {
        let (u, w) = (frame.resolve(&link.velocity, Axes::Body), &link.angular_velocity);
        let rate = |a: &Triple<'g>| add(&a.map(|e| e.derivative(along)), &cross(w, a));
        let (resultant, moment) = reaction(added, &u, w, rate);
        force = frame.body_vector(resultant);
        torque = moment;
    }
    if let (Some((mass, center)), Some(gravity)) = (link.displaced(), gravity) {
        let lift = frame.space_vector(scale(mass, &gravity));
        let turned = frame.resolve(&lift, Axes::Body);
        torque = add(&torque, &cross(&center, &turned));
        // What is handed on to a parent is in body axes.
        force = force.plus(&if link.is_alone() { lift } else { frame.body_vector(turned) });
    }
    (force, torque)
}

/// Ξ of the acceleration field `a_O + Ξ x`: `[ω̇]× + [ω]×²`.
pub fn acceleration_gradient<'g>(omega: &Triple<'g>, alpha: &Triple<'g>) -> [Triple<'g>; 3] {
    let turn = cross_matrix(alpha);
    let square: Expr<'g> = dot(omega, omega);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let own = omega[i] * omega[j];
            let centripetal = if i == j { own - square } else { own };
            (turn[i][j] + centripetal).group()
        })
    })
}

/// A matrix times components.
pub fn apply<'g>(matrix: &[Triple<'g>; 3], a: &Triple<'g>) -> Triple<'g> {
    std::array::from_fn(|i| dot(&matrix[i], a))
}
