//! Links that float: the acceleration of O along the speeds that move it, and all that hangs on it, without turning
//! anything, is taken by the observer. With `ż = ζ + ż′`, where `Σ ζ_α a_α` takes away what O has of `a_O − g` at ż =
//! 0, the condition for ż′ is that of a base at rest without gravity: what is common to all bodies is never summed,
//! multiplied by masses and eliminated again.

use crate::algebra::Expr;

use crate::mechanics::kinematics::vector::{Axes, Vector, is_zero};
use crate::mechanics::links::link::{Link, Matter};

/// Speeds that move a link, and all that hangs on it, along axes and not otherwise.
pub struct Floating<'g> {
    axes: Axes,
    /// Speed, axis, and the component of a_α along it.
    along: Vec<(usize, usize, Expr<'g>)>,
}

impl<'g> Floating<'g> {
    /// Finds the speeds by which each link floats. Matter above it would be left behind, and fluid is not moved with
    /// the observer: then it does not float.
    pub fn of(links: &[Link<'g>], speeds: usize) -> Vec<Option<Self>> {
        (0..links.len()).map(|k| Self::new(links, k, speeds)).collect()
    }

    fn new(links: &[Link<'g>], k: usize, speeds: usize) -> Option<Self> {
        let above = |at: usize| std::iter::successors(links[at].parent, |&parent| links[parent].parent);
        let carries = |at: usize| at == k || above(at).any(|parent| parent == k);
        let wet = |link: &Link<'g>| link.body().is_some_and(|body| body.added_mass.is_some());
        let heavy = |at: usize| !matches!(links[at].matter, Matter::Nothing);
        if above(k).any(heavy) || (0..links.len()).any(|at| carries(at) && wet(&links[at])) {
            return None;
        }
        let own = |&speed: &usize| {
            let others = links.iter().enumerate().filter(|(at, _)| *at != k);
            is_zero(&links[k].angular_rows[speed]) && !others.into_iter().any(|(_, link)| link.is_moved_by(speed))
        };
        let mut floating: Option<Self> = None;
        for speed in (0..speeds).filter(own) {
            let Some((axes, axis, component)) = single(&links[k].linear_rows[speed]) else { continue };
            let found = floating.get_or_insert(Self { axes, along: Vec::new() });
            if found.axes == axes && found.along.iter().all(|(_, other, _)| *other != axis) {
                found.along.push((speed, axis, component));
            }
        }
        floating
    }

    /// Whether it is one of its speeds.
    pub fn takes(&self, speed: usize) -> bool {
        self.along.iter().any(|(own, ..)| *own == speed)
    }

    /// Rest of the acceleration of O; the part that speeds that are not held take of it goes to their rates.
    pub fn taken_from(
        &self,
        link: &Link<'g>,
        acceleration: &Vector<'g>,
        held: &[bool],
        rates: &mut [Expr<'g>],
    ) -> Vector<'g> {
        let frame = &link.frame;
        let mut rest = frame.resolve(acceleration, self.axes).map(Expr::group);
        for (speed, axis, component) in self.along.iter().filter(|(speed, ..)| !held[*speed]) {
            rates[*speed] = -rest[*axis] * component.recip();
            rest[*axis] = frame.graph.zero();
        }
        match self.axes {
            Axes::Body => frame.body_vector(rest),
            Axes::Space => frame.space_vector(rest),
        }
    }
}

/// The only component of a vector: its axes, its axis, its value.
fn single<'g>(a: &Vector<'g>) -> Option<(Axes, usize, Expr<'g>)> {
    let parts = [(Axes::Body, &a.body), (Axes::Space, &a.space)];
    let components =
        parts.into_iter().flat_map(|(axes, part)| part.iter().enumerate().map(move |(i, &e)| (axes, i, e)));
    let mut there = components.filter(|(_, _, e)| !e.is_zero());
    let first = there.next()?;
    there.next().is_none().then_some(first)
}
