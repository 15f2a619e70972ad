//! Loads by all that a body is in: a medium that moves.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::vector::{Triple, add, cross, is_zero, scale, subtract};
use crate::mechanics::matter::added_mass::reaction;
use crate::mechanics::matter::body::Body;

/// Terms that a component may have while what cancels is looked for.
const LIMIT: usize = 2000;

/// Forces of a uniform stream beside those of the relative velocity that drag feels: a force and a torque about O, body
/// axes.
///
/// The fluid's impulse is that of the motion relative to the stream (Galilei), so the fluid reacts to u − c where it
/// reacted to u: the difference of the two reactions acts. In a stream that accelerates there is a gradient of pressure
/// besides, which acts on the displaced mass as gravity of −dc/dt would. `stream` is c in body axes, `acceleration` is
/// dc/dt of the observer, in body axes too, (`u`, `omega`) the twist of O.
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
