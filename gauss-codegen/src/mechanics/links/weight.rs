//! The potential of weight and buoyancy, first moments gathered at the roots.

use crate::algebra::Expr;

use crate::mechanics::kinematics::turn::outward;
use crate::mechanics::kinematics::vector::{Triple, add, dot, scale, subtract};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::matter::weight::Weight;

impl<'g> Tree<'g> {
    /// `−ĝ·Σ∫x̂ dm`. All matter counts, also what keeps still.
    pub fn potential_energy(&self) -> Expr<'g> {
        let Some(gravity) = self.gravity else { return self.graph.zero() };
        let planar = self.planar_axis().is_some();
        let mut gathered: Vec<(Expr<'g>, Triple<'g>)> =
            self.links.iter().map(|link| if planar { heavy(link) } else { heavy_at_pole(link) }).collect();
        let mut energy = self.graph.zero();
        for k in (0..self.links.len()).rev() {
            let link = &self.links[k];
            let (mass, first) = gathered[k];
            let joint = if planar { &link.own_joint } else { &link.joint };
            let turned = outward(&joint.turns, &first);
            match link.parent {
                Some(parent) => {
                    let first = add(&turned, &scale(mass, &joint.offset));
                    gathered[parent].0 = gathered[parent].0 + mass;
                    gathered[parent].1 = add(&gathered[parent].1, &first).map(Expr::group);
                }
                None => energy = energy - dot(&gravity, &add(&turned, &scale(mass, &link.position))),
            }
        }
        self.deformations.iter().fold(energy, |sum, modes| sum + modes.potential_energy())
    }
}

/// Mass of a link that weight acts on, and its first moment about O in body axes.
fn heavy<'g>(link: &Link<'g>) -> (Expr<'g>, Triple<'g>) {
    let graph = link.frame.graph;
    match &link.matter {
        Matter::Nothing => (graph.zero(), [graph.zero(); 3]),
        Matter::Particle(mass) => (*mass, [graph.zero(); 3]),
        Matter::Body(body) => match Weight::new(body) {
            Some(weight) => (weight.effective_mass, weight.effective_moment),
            None => (body.mass, body.first_moment()),
        },
    }
}

/// The same about its pole in working axes.
fn heavy_at_pole<'g>(link: &Link<'g>) -> (Expr<'g>, Triple<'g>) {
    let (mass, first) = heavy(link);
    let about_pole = subtract(&first, &scale(mass, &link.shift));
    (mass, link.turned.map_or(about_pole, |turn| turn.vector(&about_pole.map(Expr::group)).map(Expr::group)))
}
