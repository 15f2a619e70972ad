//! What acts on all that a body is made of: central gravity, and a medium that moves.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::vector::{Triple, add, cross, dot, is_zero, scale, subtract};
use crate::mechanics::links::link::reaction;
use crate::mechanics::matter::body::Body;
use crate::mechanics::matter::moments::Moments;

/// Terms that a component may have while what cancels is looked for.
const LIMIT: usize = 2000;

/// The potential energy of a body in the field of a centre, by its moments about O: `∫φ(ρ + x) dm` with the field φ = −μ/|ρ|
/// expanded to second order in x. For a body small beside its distance that is all of gravity: its first order moves the
/// body, its second turns it (the gravity-gradient torque) and corrects the first. `arm` is ρ, O from the centre, in body axes.
pub fn attraction<'g>(mu: Expr<'g>, moments: &Moments<'g>, arm: &Triple<'g>) -> Expr<'g> {
    let graph = mu.graph();
    let rho: Triple<'g> =
        std::array::from_fn(|i| graph.symbol(format!("ρ{}", i + 1), format!("\\rho_{{{}}}", i + 1), false));
    let field = -mu * dot(&rho, &rho).group().sqrt().recip();
    let gradient = rho.map(|r| field.partial(r));
    let second: Expr<'g> = (0..3)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .map(|(i, j)| gradient[i].partial(rho[j]) * moments.second[i][j])
        .sum();
    let energy = moments.mass * field + dot(&gradient, &moments.first) + second.half();
    energy.substitute(&rho.iter().zip(arm).map(|(r, value)| (r.key(), value.group())).collect())
}

/// What a uniform stream changes beside the relative velocity that drag feels: forces and a torque about O, body axes.
///
/// The fluid's impulse is that of the motion relative to the stream (Galilei), so the fluid reacts to u − c where it reacted to
/// u: the difference of the two reactions acts. In a stream that accelerates there is a gradient of pressure besides, which
/// acts on the displaced mass as gravity of −dc/dt would. `stream` is c in body axes, `acceleration` is dc/dt of the observer,
/// in body axes too, (`u`, `omega`) the twist of O.
pub fn entrained<'g>(
    graph: &'g Graph,
    body: &Body<'g>,
    [u, omega]: [&Triple<'g>; 2],
    stream: &Triple<'g>,
    acceleration: &Triple<'g>,
) -> (Triple<'g>, Triple<'g>) {
    let zero = [graph.zero(); 3];
    let (mut force, mut torque) = (zero, zero);
    if let Some(added) = &body.added_mass {
        let symbols = |letter: &str, there: &dyn Fn(usize) -> bool| -> Triple<'g> {
            let symbol =
                |i: usize| graph.symbol(format!("{letter}{}", i + 1), format!("{letter}_{{{}}}", i + 1), false);
            std::array::from_fn(|i| if there(i) { symbol(i) } else { graph.zero() })
        };
        let (v, c, w, a) = (
            symbols("u", &|_| true),
            symbols("c", &|i| !stream[i].is_zero()),
            symbols("w", &|i| !omega[i].is_zero()),
            symbols("a", &|i| !acceleration[i].is_zero()),
        );
        // u̇ is the same in both reactions and cancels; components of the stream change as the body turns under it.
        let rates: Map<u32, Expr<'g>> = c
            .iter()
            .zip(subtract(&a, &cross(&w, &c)))
            .filter(|(c, _)| !c.is_zero())
            .map(|(c, rate)| (c.key(), rate))
            .collect();
        let rate = |x: &Triple<'g>| add(&x.map(|e| e.derivative(&rates)), &cross(&w, x));
        let (still, still_torque) = reaction(added, &v, &w, rate);
        let (moving, moving_torque) = reaction(added, &subtract(&v, &c), &w, rate);
        let values: Map<u32, Expr<'g>> = [(v, u), (c, stream), (w, omega), (a, acceleration)]
            .into_iter()
            .flat_map(|(symbols, values)| symbols.into_iter().zip(*values))
            .filter(|(symbol, _)| !symbol.is_zero())
            .map(|(symbol, value)| (symbol.key(), value.group()))
            .collect();
        let difference =
            |a: &Triple<'g>, b: &Triple<'g>| subtract(a, b).map(|e| e.collected(LIMIT).substitute(&values));
        (force, torque) = (difference(&still, &moving), difference(&still_torque, &moving_torque));
    }
    if let Some((mass, center)) = &body.displaced
        && !is_zero(acceleration)
    {
        let push = scale(*mass, &acceleration.map(Expr::group));
        force = add(&force, &push);
        torque = add(&torque, &cross(center, &push.map(Expr::group)));
    }
    (force, torque)
}
