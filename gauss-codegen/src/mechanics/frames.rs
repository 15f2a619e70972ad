//! Quantities of frames: each of each frame, and all of all frames at once.

use crate::algebra::Expr;

use crate::mechanics::formula::{Formula, FrameQuantity, Method};
use crate::mechanics::system::System;

impl<'g> System<'g> {
    /// Formulas of the links with these numbers.
    pub fn frame_formulas(&self, links: &[usize]) -> Vec<Formula<'g>> {
        if links.is_empty() {
            return Vec::new();
        }
        let tree = &self.scene.tree;
        let accelerations = tree.bias_accelerations();
        let ways = |quantity: FrameQuantity, link: usize| match quantity {
            FrameQuantity::Pose => vec![tree.pose_of(link)],
            FrameQuantity::Twist => vec![tree.twist_of(link)],
            FrameQuantity::Jacobian => tree.jacobians_of(link).into(),
            FrameQuantity::JacobianRate => tree.jacobian_rates_of(link).into(),
            FrameQuantity::Bias => vec![tree.bias_of(link, &accelerations)],
        };
        let mut formulas = Vec::new();
        // Together with the others what is carried outward has more in common with them than what is gathered, or less.
        let mut together: [Vec<Expr<'g>>; 2] = Default::default();
        for (number, &link) in links.iter().enumerate() {
            for quantity in FrameQuantity::ALL {
                let arrangements = ways(quantity, link);
                let (first, last) = (&arrangements[0], &arrangements[arrangements.len() - 1]);
                together[0].extend(first);
                together[1].extend(last);
                formulas.push(Formula { method: Method::OfFrame(quantity, number), arrangements });
            }
        }
        formulas.push(Formula { method: Method::Frames, arrangements: together.into() });
        formulas
    }
    /// Rates of the Jacobians of the links with these numbers.
    pub fn jacobian_rates(&self, links: &[usize]) -> Vec<Formula<'g>> {
        let of = |(number, &link): (usize, &usize)| Formula {
            method: Method::OfFrame(FrameQuantity::JacobianRate, number),
            arrangements: self.scene.tree.jacobian_rates_of(link).into(),
        };
        links.iter().enumerate().map(of).collect()
    }
}
