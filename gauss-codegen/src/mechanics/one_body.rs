//! A system whose only matter is one body, whatever its coordinates are: its pose, its twist and its momentum.

use crate::algebra::{Expr, Map};

use crate::mechanics::derivatives::linearize::Increments;
use crate::mechanics::formula::{Formula, Method};
use crate::mechanics::kinematics::vector::{Frame, Triple, add, scale};
use crate::mechanics::links::link::{Link, Matter, impulse};
use crate::mechanics::matter::body::Body;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::system::System;
use crate::mechanics::tidy::compact;

impl<'g> System<'g> {
    /// What says where the only body is, and how it moves there: of a system of no more and no less, whose
    /// configuration is not that pose.
    pub fn formulas_of_one_body(&self) -> Option<Vec<Formula<'g>>> {
        let (link, body) = self.one_body().filter(|_| self.rigid_body().is_none())?;
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let (u, omega) = link.twist();
        let (q, gamma) = momentum(body, &u, &omega);
        Some(vec![
            single(Method::BodyTwist, [u, omega].concat()),
            single(Method::BodyMomentum, [q, gamma].concat()),
            single(Method::Pose, link.rotation.iter().flatten().chain(&link.position).copied().collect()),
            single(Method::PoseByConfiguration, self.twists_of_increments(link)),
        ])
    }

    /// The only link with matter, if that is a body.
    fn one_body(&self) -> Option<(&Link<'g>, &Body<'g>)> {
        let mut massive = self.scene.tree.links.iter().filter(|link| !matches!(link.matter, Matter::Nothing));
        let (first, further) = (massive.next()?, massive.next());
        first.body().filter(|_| further.is_none()).map(|body| (first, body))
    }

    /// For each component of an increment of the configuration the twist in body axes that it makes: u = Rᵀ ḃ, [ω]× =
    /// Rᵀ Ṙ.
    fn twists_of_increments(&self, link: &Link<'g>) -> Vec<Expr<'g>> {
        let frame = Frame { graph: self.scene.graph, rotation: link.rotation };
        let twist = |along: &Map<u32, Expr<'g>>| -> [Triple<'g>; 2] {
            let rate = |e: Expr<'g>| e.derivative(along);
            let columns: [Triple<'g>; 3] =
                std::array::from_fn(|j| frame.to_body(&std::array::from_fn(|i| rate(link.rotation[i][j]))));
            let u = frame.to_body(&link.position.map(rate));
            [u, [columns[1][2], columns[2][0], columns[0][1]]]
        };
        let directions = Increments::of(&self.scene).directions.into_iter();
        let along =
            directions.map(|direction| direction.into_iter().map(|(symbol, rate)| (symbol.key(), rate)).collect());
        along.flat_map(|along| twist(&along).concat()).map(compact).collect()
    }
}

/// (Q, Γ_O) of body and fluid, body axes.
fn momentum<'g>(body: &Body<'g>, u: &Triple<'g>, omega: &Triple<'g>) -> (Triple<'g>, Triple<'g>) {
    let moments = Moments::of_body(body);
    let (beside, gamma) = moments.momentum(u, omega);
    let q = add(&scale(moments.mass, u), &beside);
    match &body.added_mass {
        Some(added) => {
            let (impulse, moment) = impulse(added, u, omega);
            (add(&q, &impulse), add(&gamma, &moment))
        }
        None => (q, gamma),
    }
}
