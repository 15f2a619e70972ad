//! One body: the definition, whatever the coordinates are; its pose, its twist and its momentum.

use crate::algebra::{Expr, Map};

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::derivatives::linearize::Increments;
use crate::mechanics::formula::{Formula, Method};
use crate::mechanics::kinematics::vector::{Frame, Triple, add, scale};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::matter::added_mass::impulse;
use crate::mechanics::matter::body::Body;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::system::System;
use crate::mechanics::tidy::compact;

/// A body that is all the matter of a system. Frames without matter may be there, and any coordinates and constraints.
pub struct OneBody<'a, 'g> {
    link: &'a Link<'g>,
    body: &'a Body<'g>,
    /// Its link as a free one, where the configuration is its pose, so that twist and speeds determine each other: in a
    /// chart, or with the pose or the rotation for its only coordinate, and without constraints.
    pub posed: Option<&'a FreeLink<'g>>,
}

fn single<'g>(method: Method, outputs: Vec<Expr<'g>>) -> Formula<'g> {
    Formula { method, arrangements: vec![outputs] }
}

impl<'g> System<'g> {
    /// The only link with matter, if that is a body: what the kernel's `RigidBodySystem` is about.
    pub fn one_body(&self) -> Option<OneBody<'_, 'g>> {
        let mut massive = self.scene.tree.links.iter().filter(|link| !matches!(link.matter, Matter::Nothing));
        let (link, further) = (massive.next()?, massive.next());
        let body = link.body().filter(|_| further.is_none())?;
        let is_pose = |free: &&FreeLink<'g>| match self.scene.coordinates.as_slice() {
            _ if !self.constraints.is_empty() => false,
            [coordinate] if free.is_placed_by(coordinate) => true,
            _ => self.scene.chart().is_some(),
        };
        Some(OneBody { link, body, posed: self.balance_of_all().filter(is_pose) })
    }

    /// Symbols of a twist in body axes: the argument of `speeds`, where the configuration is the pose of one body.
    pub fn twist(&self) -> &[Expr<'g>] {
        self.one_body().and_then(|one| one.posed).map_or(&[], |free| &free.twist)
    }

    /// Twist, momentum and speeds of one body whose pose is the configuration.
    pub fn formulas_by_pose(&self) -> Vec<Formula<'g>> {
        let Some(free) = self.one_body().and_then(|one| one.posed) else { return Vec::new() };
        let mut formulas = vec![
            single(Method::BodyTwist, free.kinematics.body_twist().to_vec()),
            single(Method::Speeds, free.speeds_of_twist()),
            single(Method::BodyMomentum, free.body_momentum()),
        ];
        formulas.extend(free.regularity().map(|outputs| single(Method::Regularity, outputs)));
        formulas
    }

    /// Pose, twist and momentum of one body whose pose is a function of the configuration.
    pub fn formulas_by_coordinates(&self) -> Option<Vec<Formula<'g>>> {
        let OneBody { link, body, .. } = self.one_body().filter(|one| one.posed.is_none())?;
        let (u, omega) = link.twist();
        let (q, gamma) = momentum(body, &u, &omega);
        Some(vec![
            single(Method::BodyTwist, [u, omega].concat()),
            single(Method::BodyMomentum, [q, gamma].concat()),
            single(Method::Pose, link.rotation.iter().flatten().chain(&link.position).copied().collect()),
            single(Method::PoseByConfiguration, self.twists_of_increments(link)),
        ])
    }

    /// Twist in body axes that each component of an increment of the configuration makes: u = Rᵀ ḃ, [ω]× = Rᵀ Ṙ.
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
