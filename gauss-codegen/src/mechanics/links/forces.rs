//! Forces on links: their power, and their generalised forces.

use crate::algebra::{Expr, Map};

use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, dot};
use crate::mechanics::links::link::Link;
use crate::mechanics::links::path::{power_between, torque_between};
use crate::mechanics::loads::forces::Force;

impl<'g> Force<'g> {
    /// Resultant and torque about O of the link that it acts on, if that is how it acts.
    pub fn load(&self, links: &[Link<'g>]) -> Option<(usize, Vector<'g>, Triple<'g>)> {
        let Force::OnLink { link, at, force, torque, axes } = self else { return None };
        let target = &links[*link];
        let in_working = |a: &Triple<'g>, axes: Axes| target.in_working_axes(a, axes).map(Expr::group);
        let force = in_working(force, *axes);
        let arm = in_working(at, Axes::Body);
        let torque = add(&in_working(torque, *axes), &cross(&arm, &force)).map(Expr::group);
        Some((*link, target.frame.body_vector(force), torque))
    }

    /// The power that it delivers: with the velocity of its point of action, whatever that is due to.
    pub fn power(&self, links: &[Link<'g>], speeds: &[Expr<'g>], rates: &Map<u32, Expr<'g>>) -> Expr<'g> {
        match self {
            Force::AtPoint { at, force } => dot(&force.map(Expr::group), &at.map(|e| e.derivative(rates).group())),
            Force::OnLink { link, .. } => {
                let Some((_, force, torque)) = self.load(links) else { return links[*link].frame.graph.zero() };
                let link = &links[*link];
                link.frame.dot(&force, &link.velocity) + dot(&torque, &link.angular_velocity)
            }
            Force::Between { links: pair, torque } => power_between(links, *pair, torque),
            Force::OnRate { rate, force } => rate.group() * force.group(),
            Force::Dissipation(function) => {
                let terms = speeds.iter().map(|&z| -z * function.partial(z));
                terms.fold(function.graph().zero(), |sum, e| sum + e)
            }
        }
    }

    /// The velocities by which its power is a sum; none of a dissipation function, whose power is that of speeds.
    pub fn velocities(&self, links: &[Link<'g>], rates: &Map<u32, Expr<'g>>) -> Vec<Expr<'g>> {
        match self {
            Force::AtPoint { at, .. } => at.iter().map(|e| e.derivative(rates)).collect(),
            Force::OnLink { link, .. } => {
                let link = &links[*link];
                let unit = |k: usize| std::array::from_fn(|i| link.frame.graph.integer(i64::from(i == k)));
                let along = |k: usize| link.frame.dot(&link.frame.body_vector(unit(k)), &link.velocity);
                (0..3).map(along).chain(link.angular_velocity).collect()
            }
            Force::Between { links: pair, torque } => {
                let unit = |k: usize| std::array::from_fn(|i| torque[0].graph().integer(i64::from(i == k)));
                (0..3).map(|k| power_between(links, *pair, &unit(k))).collect()
            }
            Force::OnRate { rate, .. } => vec![*rate],
            Force::Dissipation(_) => Vec::new(),
        }
    }

    /// Its generalised forces where it does not act on one link.
    pub fn generalised(
        &self,
        links: &[Link<'g>],
        speeds: &[Expr<'g>],
        rates: &Map<u32, Expr<'g>>,
    ) -> Option<Vec<Expr<'g>>> {
        Some(match self {
            Force::AtPoint { at, force } => {
                let velocity = at.map(|e| e.derivative(rates).group());
                let force = force.map(Expr::group);
                speeds.iter().map(|&z| dot(&force, &velocity.map(|e| e.partial(z)))).collect()
            }
            Force::OnLink { .. } => return None,
            Force::Between { links: pair, torque } => torque_between(links, *pair, torque, speeds.len()),
            Force::OnRate { rate, force } => speeds.iter().map(|&z| rate.partial(z) * force.group()).collect(),
            Force::Dissipation(function) => speeds.iter().map(|&z| -function.partial(z)).collect(),
        })
    }
}
