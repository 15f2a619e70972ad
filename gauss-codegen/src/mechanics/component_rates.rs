//! Rates of all that a state is made of, as differential equations of numbers: components of the configuration, a rotation as its
//! unit quaternion, and z. Power series are made of them.

use crate::algebra::Expr;

use super::chart::ConfigurationKind;
use super::formula::{Formula, Method};
use super::methods::Scene;
use super::rotation::quaternion_rate;
use super::system::{Coordinate, System};
use super::vector::{Axes, is_zero};

impl<'g> Scene<'g> {
    /// Components as the methods take them, then ż.
    pub fn component_rates(&self, quaternion: Option<[Expr<'g>; 4]>, formulas: &[Formula<'g>]) -> Formula<'g> {
        let kinematics = &self.kinematics;
        let mut rates = Vec::new();
        let mut symbols = &kinematics.configuration[..];
        if let Some(quaternion) = quaternion {
            let omega = &kinematics.angular_velocity;
            rates.extend(if is_zero(&omega.body) {
                quaternion_rate(quaternion, &omega.space, Axes::Space)
            } else {
                quaternion_rate(quaternion, &kinematics.frame.resolve(omega, Axes::Body), Axes::Body)
            });
            symbols = if kinematics.kind == ConfigurationKind::Pose { &symbols[9..] } else { &[] };
        }
        rates.extend(symbols.iter().map(|symbol| kinematics.rates[&symbol.key()]));
        with_accelerations(&rates, formulas)
    }
}

impl<'g> System<'g> {
    /// Components of the groups among the coordinates in their order, then scalar coordinates, then ż.
    pub fn component_rates(&self, quaternions: &[Option<[Expr<'g>; 4]>], formulas: &[Formula<'g>]) -> Formula<'g> {
        let scene = &self.scene;
        let (mut groups, mut scalars): (Vec<Expr<'g>>, Vec<Expr<'g>>) = (Vec::new(), Vec::new());
        let mut rates = &scene.kinematics[..];
        for (coordinate, quaternion) in scene.coordinates.iter().zip(quaternions) {
            let (own, rest) = rates.split_at(coordinate.size());
            rates = rest;
            match (coordinate, quaternion) {
                (Coordinate::Pose(_, position), Some(quaternion)) => {
                    groups.extend(quaternion_rate(*quaternion, &[own[3], own[4], own[5]], Axes::Body));
                    groups.extend(position.iter().map(|symbol| scene.rates[&symbol.key()]));
                }
                (Coordinate::Plane { turn, position }, _) => {
                    groups.extend(turn.iter().chain(position).map(|symbol| scene.rates[&symbol.key()]));
                }
                (Coordinate::Rotation(_), Some(quaternion)) => {
                    groups.extend(quaternion_rate(*quaternion, &[own[0], own[1], own[2]], Axes::Body));
                }
                _ => scalars.extend(own),
            }
        }
        groups.extend(scalars);
        with_accelerations(&groups, formulas)
    }
}

/// The rates given, then each arrangement of the accelerations.
fn with_accelerations<'g>(rates: &[Expr<'g>], formulas: &[Formula<'g>]) -> Formula<'g> {
    let accelerations = formulas.iter().filter(|f| f.method == Method::Acceleration).flat_map(|f| &f.arrangements);
    let arrangements = accelerations.map(|acceleration| [rates, acceleration].concat()).collect();
    Formula { method: Method::ComponentRates, arrangements }
}
