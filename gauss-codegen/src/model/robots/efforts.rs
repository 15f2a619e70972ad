//! What inputs do: generalised forces on coordinates.

use proc_macro2::Ident;

use super::clauses::Robot;
use super::description::Drive;
use super::drives::Driven;
use crate::model::scene::expression::{Expression, FunctionName};

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
                    let Some(force) = self.force(drive, control) else { continue };
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

    /// gain · u + b₀ + b₁ l + b₂ l̇.
    fn force(&self, drive: &Drive, control: Expression) -> Option<Expression> {
        let writer = self.writer;
        let length = self.length(&drive.along)?;
        let rate = writer.call(FunctionName::Rate, vec![length.clone()]);
        let scaled = if drive.gain == 1.0 { control } else { writer.times(writer.number(drive.gain), control) };
        let [constant, by_length, by_rate] = drive.bias;
        let mut sum = scaled;
        if constant != 0.0 {
            sum = writer.plus(sum, writer.number(constant));
        }
        for (factor, value) in [(by_length, length), (by_rate, rate)] {
            if factor != 0.0 {
                sum = writer.plus(sum, writer.times(writer.number(factor), value));
            }
        }
        Some(sum)
    }
}
