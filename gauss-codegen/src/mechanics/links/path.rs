//! Links of one tree beside each other: what is between two of them shows in the joints on the way from the one to the
//! other and nowhere else. Components are in body axes; how the last link that both hang on moves does not come in.

use crate::algebra::Expr;

use crate::mechanics::kinematics::turn::{inward, outward};
use crate::mechanics::kinematics::vector::{Triple, add, dot, subtract};
use crate::mechanics::links::link::Link;

/// A link and those that it hangs on, up to the root.
fn upward<'a>(links: &'a [Link<'_>], k: usize) -> impl Iterator<Item = usize> + 'a {
    std::iter::successors(Some(k), |&k| links[k].parent)
}

/// The last link that both hang on, or are; `None` in two trees.
pub fn common(links: &[Link<'_>], [a, b]: [usize; 2]) -> Option<usize> {
    upward(links, a).find(|&above| upward(links, b).any(|k| k == above))
}

/// The links on the way up from k to one that it hangs on, without that.
fn below(links: &[Link<'_>], k: usize, above: usize) -> Vec<usize> {
    upward(links, k).take_while(|&k| k != above).collect()
}

/// A vector in the axes of `from`, in those of `to`; `None` in two trees.
pub fn turned<'g>(links: &[Link<'g>], [from, to]: [usize; 2], a: &Triple<'g>) -> Option<Triple<'g>> {
    let top = common(links, [from, to])?;
    let up = below(links, from, top).into_iter().fold(*a, |a, k| outward(&links[k].own_joint.turns, &a));
    Some(below(links, to, top).into_iter().rev().fold(up, |a, k| inward(&links[k].own_joint.turns, &a)))
}

/// A point of k (from its O), from O and in the axes of a link that it hangs on, or is.
pub fn point_seen_from<'g>(links: &[Link<'g>], [k, above]: [usize; 2], at: &Triple<'g>) -> Triple<'g> {
    below(links, k, above).into_iter().fold(*at, |at, k| {
        let joint = &links[k].own_joint;
        add(&joint.offset, &outward(&joint.turns, &at)).map(Expr::group)
    })
}

/// The angular velocity of the first link relative to the second, in the axes of the first; `None` in two trees.
pub fn relative_angular_velocity<'g>(links: &[Link<'g>], [on, other]: [usize; 2]) -> Option<Triple<'g>> {
    let top = common(links, [on, other])?;
    let from_top = |k: usize| {
        let still = links[k].spin.map(|e| e.graph().zero());
        below(links, k, top)
            .into_iter()
            .rev()
            .fold(still, |omega, k| add(&inward(&links[k].own_joint.turns, &omega), &links[k].spin).map(Expr::group))
    };
    Some(subtract(&from_top(on), &turned(links, [other, on], &from_top(other))?))
}

/// The torques on the joints between two links, each on the link below the joint and in its axes, of a torque on the
/// first and its reaction on the second; components in the axes of the first.
fn torques_on_joints<'g>(links: &[Link<'g>], [on, other]: [usize; 2], torque: &Triple<'g>) -> Vec<(usize, Triple<'g>)> {
    let Some(top) = common(links, [on, other]) else { return Vec::new() };
    let (mut torques, mut own) = (Vec::new(), torque.map(Expr::group));
    for k in below(links, on, top) {
        torques.push((k, own));
        own = outward(&links[k].own_joint.turns, &own);
    }
    let mut reaction = own.map(|e| -e);
    for k in below(links, other, top).into_iter().rev() {
        reaction = inward(&links[k].own_joint.turns, &reaction);
        torques.push((k, reaction));
    }
    torques
}

/// The generalised forces of a torque on the first link with its reaction on the second, of one tree.
pub fn torque_between<'g>(links: &[Link<'g>], pair: [usize; 2], torque: &Triple<'g>, speeds: usize) -> Vec<Expr<'g>> {
    let zero = torque[0].graph().zero();
    let torques = torques_on_joints(links, pair, torque);
    let row = |speed: usize| {
        let joints = torques.iter().map(|(k, torque)| dot(torque, &links[*k].angular_rows[speed]));
        joints.fold(zero, |sum, e| sum + e)
    };
    (0..speeds).map(row).collect()
}

/// Its power: with the angular velocity of the first relative to the second.
pub fn power_between<'g>(links: &[Link<'g>], pair: [usize; 2], torque: &Triple<'g>) -> Expr<'g> {
    let joints = torques_on_joints(links, pair, torque).into_iter();
    let powers = joints.map(|(k, torque)| dot(&torque, &links[k].spin));
    powers.fold(torque[0].graph().zero(), |sum, e| sum + e)
}
