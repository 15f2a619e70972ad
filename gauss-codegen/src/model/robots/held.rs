//! Effects of locked joints on what a file says: values in the place of coordinates, lengths that stay, relations that
//! hold or do not.

use super::clauses::Robot;
use super::locks::LockedJoint;
use gauss_robots::description::{Closure, Note, Polynomial};

impl Robot<'_> {
    /// The lock of a joint, or of the one that it follows.
    pub fn lock_of(&self, joint: usize) -> Option<&LockedJoint> {
        let leader = self.structure.coupling_of[joint].joint;
        self.locked.iter().find(|lock| lock.joint == leader)
    }

    /// Whether a joint is driven, or the one that it follows.
    pub fn is_driven(&self, joint: usize) -> bool {
        self.driven.contains(&self.structure.coupling_of[joint].joint)
    }

    /// Whether joints are locked or driven, all of them.
    pub fn is_given(&self, along: &[(String, f64)]) -> bool {
        let joint = |name: &String| self.description.joints.iter().position(|joint| joint.name == *name);
        let given = |joint: usize| self.lock_of(joint).is_some() || self.is_driven(joint);
        !along.is_empty() && along.iter().all(|(name, _)| joint(name).is_some_and(given))
    }

    /// Whether joints are locked, all of them.
    pub fn is_still(&self, along: &[(String, f64)]) -> bool {
        let joint = |name: &String| self.description.joints.iter().position(|joint| joint.name == *name);
        let held = |(name, _): &(String, f64)| joint(name).is_some_and(|joint| self.lock_of(joint).is_some());
        !along.is_empty() && along.iter().all(held)
    }

    /// Whether locked joints hold two links to each other that are joined by more.
    pub fn is_held_together(&self, closure: &Closure) -> bool {
        let owner = |name: &String| {
            let link = self.description.links.iter().position(|link| link.name == *name)?;
            Some(self.structure.owner_of[link])
        };
        !self.locked.is_empty() && owner(&closure.links[0]) == owner(&closure.links[1])
    }

    /// Relations of locked joints alone: those that their values do not meet, and loops, whose points may be apart.
    pub fn broken_relations(&self) -> Vec<Note> {
        let sum = |along: &Vec<(String, f64)>| {
            let part = |(name, factor): &(String, f64)| {
                let index = self.description.joints.iter().position(|joint| joint.name == *name)?;
                let coupling = self.structure.coupling_of[index];
                let value = coupling.multiplier * self.lock_of(index)?.number? + coupling.offset;
                Some(factor * (value - self.description.joints[index].reference))
            };
            along.iter().map(part).sum::<Option<f64>>()
        };
        let broken = |relation: &Polynomial| {
            let (value, of) = (sum(&relation.along)?, relation.of.as_ref().map_or(Some(0.0), sum)?);
            let wanted = relation.coefficients.iter().rev().fold(0.0, |power, c| power * of + c);
            let size = value.abs().max(wanted.abs()).max(of.abs());
            let text =
                format!("an equality of locked joints does not hold: it asks for {wanted}, and there is {value}");
            // Roundings of a few products and sums.
            ((value - wanted).abs() > 16.0 * f64::EPSILON * size).then(|| Note::ignored(relation.at, "equality", text))
        };
        let held = |closure: &Closure| {
            let text = format!(
                "`{}` and `{}` are held to each other by locked joints: that they are joined is left out, whether their \
                 points meet there or not",
                closure.links[0], closure.links[1]
            );
            self.is_held_together(closure).then(|| Note::ignored(closure.at, "equality", text))
        };
        let relations = self.description.polynomials.iter().filter_map(broken);
        relations.chain(self.description.closures.iter().filter_map(held)).collect()
    }

    /// Whether between a link and the one that it moves as one with some joint is held at a parameter.
    pub fn is_placed_by_parameter(&self, link: usize) -> bool {
        if self.locked.iter().all(|lock| lock.number.is_some()) {
            return false;
        }
        let owner = self.structure.owner_of[link];
        let chain = std::iter::successors(Some(link), |&link| self.structure.parent_of[link]);
        let mut joints = chain.take_while(|&link| link != owner).filter_map(|link| self.structure.joint_of[link]);
        joints.any(|joint| self.lock_of(joint).is_some_and(|lock| lock.number.is_none()))
    }
}
