//! Regrouping of matter that moves with the parent just as well: the base parameters of identification theory, found
//! from the velocities alone.

use crate::algebra::{Expr, Graph};

use crate::mechanics::kinematics::vector::{Triple, cross, dot};
use crate::mechanics::links::link::Link;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::tidy::tidy;

/// The monomials 1, x_i, x_i x_j whose moments the regrouping can move.
const MONOMIALS: [&[usize]; 10] = [&[], &[0], &[1], &[2], &[0, 0], &[1, 1], &[2, 2], &[0, 1], &[0, 2], &[1, 2]];

/// Moves moments from the leaves to the roots, and from roots that keep still to the ground.
///
/// Matter at x moves with the velocity `V + W × x` of its parent plus `δ(x) = δ_O + δ_ω × x`. A moment can move to the
/// parent when its coefficient vanishes in `(V + W × x)·δ` for every V and W and in δ·δ, so that no energy, momentum or
/// power changes, and when what it becomes in the parent's axes is constant.
pub fn regroup<'g>(graph: &'g Graph, links: &mut [Link<'g>]) {
    let formal = |name: &str| -> Triple<'g> { std::array::from_fn(|_| graph.symbol(name, name, false)) };
    let (v, w) = (formal("V"), formal("W"));
    for k in (0..links.len()).rev() {
        let link = &links[k];
        if link.moments.is_zero() || link.body().is_some_and(|body| body.added_mass.is_some()) {
            continue;
        }
        let mut moved = Moments::zero(graph);
        for monomial in MONOMIALS {
            let part = part(&link.moments, monomial);
            if part.is_zero() || !vanishes(monomial, [&v, &w, &link.velocity_beyond, &link.spin]) {
                continue;
            }
            let unit = received(link, &part_of_one(graph, monomial));
            let mut all = unit.first.iter().chain(unit.second.iter().flatten());
            if link.parent.is_none() || all.all(|e| e.is_constant()) {
                moved = moved.plus(&part);
            }
        }
        if moved.is_zero() {
            continue;
        }
        let given = received(link, &moved).map(tidy);
        let rest = link.moments.plus(&moved.map(|e| -e)).map(tidy);
        if let Some(parent) = link.parent {
            links[parent].moments = links[parent].moments.plus(&given);
        }
        links[k].moments = rest;
    }
}

/// The part of the moments that belongs to one monomial.
fn part<'g>(moments: &Moments<'g>, monomial: &[usize]) -> Moments<'g> {
    let mut part = Moments::zero(moments.mass.graph());
    match *monomial {
        [i] => part.first[i] = moments.first[i],
        [i, j] => {
            part.second[i][j] = moments.second[i][j];
            part.second[j][i] = moments.second[j][i];
        }
        _ => part.mass = moments.mass,
    }
    part
}

fn part_of_one<'g>(graph: &'g Graph, monomial: &[usize]) -> Moments<'g> {
    let one = graph.one();
    part(&Moments { mass: one, first: [one; 3], second: [[one; 3]; 3] }, monomial)
}

/// Moments of the link as the parent has them.
fn received<'g>(link: &Link<'g>, moments: &Moments<'g>) -> Moments<'g> {
    moments.turned(&link.own_joint.turns).shifted(&link.own_joint.offset)
}

/// Whether the coefficient of the monomial vanishes in `(V + W × x)·δ` and in δ·δ.
fn vanishes<'g>(monomial: &[usize], [v, w, beyond, spin]: [&Triple<'g>; 4]) -> bool {
    // δ(x) and V + W × x, as a constant and a part linear in each x_i.
    let graph = v[0].graph();
    let column = |a: &Triple<'g>, i: usize| -> Triple<'g> {
        let axis = std::array::from_fn(|k| if k == i { graph.one() } else { graph.zero() });
        cross(a, &axis)
    };
    let of = |constant: &Triple<'g>, turning: &Triple<'g>, monomial: &[usize]| match *monomial {
        [] => *constant,
        [i, ..] => column(turning, i),
    };
    let coefficient = |constant: &Triple<'g>, turning: &Triple<'g>| -> Expr<'g> {
        let pairing = |left: &[usize], right: &[usize]| dot(&of(constant, turning, left), &of(beyond, spin, right));
        match *monomial {
            [] => pairing(&[], &[]),
            [i] => pairing(&[], &[i]) + pairing(&[i], &[]),
            [i, j] if i == j => pairing(&[i], &[i]),
            [i, j] => pairing(&[i], &[j]) + pairing(&[j], &[i]),
            _ => graph.zero(),
        }
    };
    let zero = |e: Expr<'g>| tidy(e).is_zero();
    zero(coefficient(v, w)) && zero(coefficient(beyond, spin))
}
