//! Rates of all that a state is made of, as differential equations of numbers: components of the configuration, a
//! rotation as its unit quaternion, and z. Power series are made of them.

use crate::algebra::Expr;

use crate::mechanics::formula::{Arrangements, Formula, Method};
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::rotation::quaternion_rate;
use crate::mechanics::kinematics::vector::{Axes, Triple, is_zero};
use crate::mechanics::system::System;

impl<'g> System<'g> {
    /// Components of the groups among the coordinates in their order, then scalar coordinates, then ż.
    pub fn component_rates(
        &self,
        quaternions: &[Option<[Expr<'g>; 4]>],
        accelerations: &Arrangements<'g>,
    ) -> Formula<'g> {
        let scene = &self.scene;
        let (mut groups, mut scalars): (Vec<Expr<'g>>, Vec<Expr<'g>>) = (Vec::new(), Vec::new());
        let mut rates = &scene.kinematics[..];
        for (coordinate, quaternion) in scene.coordinates.iter().zip(quaternions) {
            let (own, rest) = rates.split_at(coordinate.size());
            rates = rest;
            let rate = |symbol: &Expr<'g>| scene.rates[&symbol.key()];
            if let (Some(rotation), Some(quaternion), &[.., w1, w2, w3]) = (coordinate.rotation(), quaternion, own) {
                groups.extend(match self.spin_in_space(rotation) {
                    Some(omega) => quaternion_rate(*quaternion, &omega, Axes::Space),
                    None => quaternion_rate(*quaternion, &[w1, w2, w3], Axes::Body),
                });
            }
            match coordinate {
                Coordinate::Pose(_, position) => groups.extend(position.iter().map(rate)),
                Coordinate::Plane { turn, position } => groups.extend(turn.iter().chain(position).map(rate)),
                Coordinate::Rotation(_) => {}
                Coordinate::Scalar(_) => scalars.extend(own),
            }
        }
        groups.extend(scalars);
        // The rates, then each arrangement of the accelerations.
        let arrangements = accelerations.iter().map(|acceleration| [&groups[..], acceleration].concat()).collect();
        Formula { method: Method::ComponentRates, arrangements }
    }

    /// The angular velocity of the free link with that rotation, where the speeds give it in observer's axes.
    fn spin_in_space(&self, rotation: &[Triple<'g>; 3]) -> Option<Triple<'g>> {
        let link = self.free.iter().find(|free| free.kinematics.frame.rotation == *rotation)?;
        let omega = &link.kinematics.angular_velocity;
        is_zero(&omega.body).then_some(omega.space)
    }
}
