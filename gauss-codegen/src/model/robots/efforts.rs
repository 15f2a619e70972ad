//! Effects of inputs: generalised forces on coordinates.

use std::collections::HashMap;

use proc_macro2::Ident;

use super::clauses::Robot;
use super::drives::{DriveTarget, RobotInput};
use crate::model::scene::elements::WRENCH;
use crate::model::scene::elements::argument::{BODY, FORCE, TORQUE};
use crate::model::scene::expression::{Expression, FunctionName, Property};
use crate::model::scene::forces::ForceClause;
use gauss_robots::description::Drive;
use gauss_robots::rotation::Triple;

impl Robot<'_> {
    /// Generalised forces on coordinates.
    pub fn efforts(&self) -> Vec<(Ident, Expression)> {
        let writer = self.writer;
        let scaled = |factor: f64, force: Expression| match factor == 1.0 {
            true => force,
            false => writer.times(writer.number(factor), force),
        };
        let mut all: Vec<(Ident, Expression)> = Vec::new();
        let mut places: HashMap<Ident, usize> = HashMap::new();
        let mut add = |q: &Ident, force: Expression| match places.get(q) {
            Some(&place) => all[place].1 = writer.plus(all[place].1.clone(), force),
            None => {
                places.insert(q.clone(), all.len());
                all.push((q.clone(), force));
            }
        };
        // Of joints whose efforts are kept in a range, all together.
        let mut kept: Vec<(usize, Expression)> = Vec::new();
        for input in &self.inputs {
            for (index, q, multiplier, factor, force) in self.parts(input) {
                let is_kept = self.is_clamped() && self.description.joints[index].efforts.is_some();
                match kept.iter_mut().find(|(joint, _)| *joint == index) {
                    Some((_, sum)) => *sum = writer.plus(sum.clone(), scaled(factor, force)),
                    None if is_kept => kept.push((index, scaled(factor, force))),
                    None => add(q, scaled(factor * multiplier, force)),
                }
            }
        }
        for (index, joint, q, multiplier) in self.scalar_joints() {
            let own = kept.iter().find(|(kept, _)| *kept == index);
            own.into_iter().for_each(|(_, sum)| add(q, scaled(multiplier, self.within(sum.clone(), joint.efforts))));
        }
        all
    }

    /// Effects of an input in joints: the index of each, its coordinate with how many times its rate that of the joint
    /// is, and a factor of a force.
    fn parts(&self, input: &RobotInput) -> Vec<(usize, &Ident, f64, f64, Expression)> {
        let control = self.writer.name(&input.name.ident);
        match input.of {
            DriveTarget::Joint(joint) => match self.coordinates[joint].as_slice() {
                [q] => vec![(joint, &q.ident, 1.0, 1.0, control)],
                _ => Vec::new(),
            },
            DriveTarget::Drive(drive) => {
                let drive = &self.description.drives[drive];
                let Some(length) = self.length(&drive.along) else { return Vec::new() };
                let force = self.force(drive, control, length);
                let ends = self.ends_of(&drive.along);
                ends.map(|(index, q, multiplier, factor)| (index, q, multiplier, factor, force.clone())).collect()
            }
        }
    }

    /// The joints of a length: the index of each, its coordinate with how many times its rate that of the joint is, and
    /// what the length changes by the joint.
    pub fn ends_of<'b>(
        &'b self,
        along: &'b [(String, f64)],
    ) -> impl Iterator<Item = (usize, &'b Ident, f64, f64)> + 'b {
        along.iter().filter_map(|(name, factor)| {
            let (index, _, q, multiplier) = self.scalar_joints().find(|(_, joint, ..)| joint.name == *name)?;
            Some((index, q, multiplier, *factor))
        })
    }

    /// (g₀ + g₁ l + g₂ l̇) u + b₀ + b₁ l + b₂ l̇ along a length.
    fn force(&self, drive: &Drive, control: Expression, length: Expression) -> Expression {
        let writer = self.writer;
        let rate = writer.call(FunctionName::Rate, vec![length.clone()]);
        self.law(drive, control, &[(1, length), (2, rate)])
    }

    /// The same of these values, each with the place of its factors. What is beyond ranges is cut off where that is
    /// said.
    pub fn law(&self, drive: &Drive, control: Expression, values: &[(usize, Expression)]) -> Expression {
        let writer = self.writer;
        let scaled = |factor: f64, value: Expression| match factor == 1.0 {
            true => value,
            false => writer.times(writer.number(factor), value),
        };
        let with = |start: Expression, factors: &Triple| {
            let acting = values.iter().filter(|(place, _)| factors[*place] != 0.0);
            acting.fold(start, |sum, (place, value)| {
                writer.plus(sum, writer.times(writer.number(factors[*place]), value.clone()))
            })
        };
        let control = self.within(control, drive.controls);
        let mut sum = match drive.gain {
            [constant, 0.0, 0.0] => scaled(constant, control),
            [constant, ..] => writer.times(with(writer.number(constant), &drive.gain), control),
        };
        if drive.bias[0] != 0.0 {
            sum = writer.plus(sum, writer.number(drive.bias[0]));
        }
        self.within(with(sum, &drive.bias), drive.forces)
    }

    /// Wrenches of drives that act at frames, called as their controls; a length there stays zero, its rate is that of
    /// the frame along the wrench.
    pub fn thrusts(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let thrust = |input: &RobotInput| {
            let DriveTarget::Drive(drive) = input.of else { return None };
            let drive = &self.description.drives[drive];
            let (link, wrench) = drive.at_link.as_ref()?;
            let index = self.description.links.iter().position(|own| own.name == *link)?;
            let link = &self.links[index];
            let rate = wrench.iter().zip([Property::BodyVelocity, Property::BodyAngularVelocity]);
            let rate = rate.filter_map(|(gear, velocity)| {
                let parts = vec![writer.triple(gear)?, writer.property(link, velocity)];
                Some((2, writer.call(FunctionName::Dot, parts)))
            });
            let control = writer.name(&input.name.ident);
            let value = self.law(drive, control, &rate.collect::<Vec<_>>());
            let [force, torque] = wrench.map(|gear| Some(writer.times(value.clone(), writer.triple(&gear)?)));
            let clause = ForceClause::new(&WRENCH, Some(input.name.ident.clone()), writer.span);
            Some(clause.with(BODY, Some(link.clone())).with(FORCE, force).with(TORQUE, torque))
        };
        self.inputs.iter().filter_map(thrust).collect()
    }
}
