//! What inputs do: generalised forces on coordinates.

use proc_macro2::Ident;

use super::clauses::Robot;
use super::description::Drive;
use super::drives::{Driven, Input};
use crate::model::scene::clauses::{ForceAxes, ForceClause, ForceKind};
use crate::model::scene::expression::{Expression, FunctionName, Property};

impl Robot<'_> {
    /// Generalised forces on coordinates.
    pub fn efforts(&self) -> Vec<(Ident, Expression)> {
        let writer = self.writer;
        let mut all: Vec<(Ident, Expression)> = Vec::new();
        let mut add = |q: &Ident, force: Expression| match all.iter_mut().find(|(name, _)| name == q) {
            Some((_, sum)) => *sum = writer.plus(sum.clone(), force),
            None => all.push((q.clone(), force)),
        };
        for input in &self.inputs {
            let control = writer.name(&input.name.ident);
            match input.of {
                Driven::Joint(joint) => {
                    if let [q] = self.coordinates[joint].as_slice() {
                        add(&q.ident, control);
                    }
                }
                Driven::Drive(drive) => {
                    let drive = &self.description.drives[drive];
                    let Some(force) = self.length(&drive.along).map(|length| self.force(drive, control, length)) else {
                        continue;
                    };
                    for (name, factor) in &drive.along {
                        let own = self.scalar_joints().find(|(_, joint, ..)| joint.name == *name);
                        let Some((.., q, multiplier)) = own else { continue };
                        let factor = factor * multiplier;
                        let part = if factor == 1.0 {
                            force.clone()
                        } else {
                            writer.times(writer.number(factor), force.clone())
                        };
                        add(q, part);
                    }
                }
            }
        }
        all
    }

    /// gain · u + b₀ + b₁ l + b₂ l̇ along a length.
    fn force(&self, drive: &Drive, control: Expression, length: Expression) -> Expression {
        let writer = self.writer;
        let rate = writer.call(FunctionName::Rate, vec![length.clone()]);
        let [constant, by_length, by_rate] = drive.bias;
        self.affine(drive.gain, control, [(by_length, length), (by_rate, rate)], constant)
    }

    fn affine(
        &self,
        gain: f64,
        control: Expression,
        parts: impl IntoIterator<Item = (f64, Expression)>,
        constant: f64,
    ) -> Expression {
        let writer = self.writer;
        let scaled = |factor: f64, value: Expression| match factor == 1.0 {
            true => value,
            false => writer.times(writer.number(factor), value),
        };
        let mut sum = scaled(gain, control);
        if constant != 0.0 {
            sum = writer.plus(sum, writer.number(constant));
        }
        for (factor, value) in parts.into_iter().filter(|(factor, _)| *factor != 0.0) {
            sum = writer.plus(sum, writer.times(writer.number(factor), value));
        }
        sum
    }

    /// Wrenches of drives that act at frames, called as their controls; a length there stays zero, its rate is that of
    /// the frame along the wrench.
    pub fn thrusts(&self) -> Vec<ForceClause> {
        let writer = self.writer;
        let thrust = |input: &Input| {
            let Driven::Drive(drive) = input.of else { return None };
            let drive = &self.description.drives[drive];
            let (link, wrench) = drive.at_link.as_ref()?;
            let index = self.description.links.iter().position(|own| own.name == *link)?;
            let link = &self.links[index];
            let rate = wrench.iter().zip([Property::BodyVelocity, Property::BodyAngularVelocity]);
            let rate = rate.filter_map(|(gear, velocity)| {
                let parts = vec![writer.triple(gear)?, writer.property(link, velocity)];
                Some((drive.bias[2], writer.call(FunctionName::Dot, parts)))
            });
            let control = writer.name(&input.name.ident);
            let value = self.affine(drive.gain, control, rate, drive.bias[0]);
            let [force, torque] = wrench.map(|gear| Some(writer.times(value.clone(), writer.triple(&gear)?)));
            let kind = ForceKind::Wrench { body: link.clone(), at: None, force, torque, axes: ForceAxes::Body };
            Some(ForceClause { name: Some(input.name.ident.clone()), kind, span: writer.span })
        };
        self.inputs.iter().filter_map(thrust).collect()
    }
}
