//! Drives of balls and of joints that move freely.

use proc_macro2::Ident;

use super::clauses::Robot;
use super::drives::{DriveTarget, RobotInput};
use crate::model::scene::elements;
use crate::model::scene::elements::argument::{AXES, BODY, FORCE, REACTION, TORQUE, VALUE};
use crate::model::scene::expression::{Expression, FunctionName, Property};
use crate::model::scene::forces::{ForceAxes, ForceClause};
use gauss_robots::description::{Drive, JointKind, Turned};
use gauss_robots::rotation::{Rotation, Triple};

impl Robot<'_> {
    /// The clauses of drives in joints with several coordinates, called as their controls.
    pub fn turning(&self) -> Vec<ForceClause> {
        let of = |input: &RobotInput| {
            let DriveTarget::Drive(drive) = input.of else { return None };
            let drive = &self.description.drives[drive];
            let turned = drive.at_joint.as_ref()?;
            let (joint, q) = self.groups().find(|(joint, _)| joint.name == turned.name)?;
            let [body, other] = self.ends(joint);
            let (row, clause) = match joint.kind {
                JointKind::Floating => (&elements::WRENCH, self.pushed(input, (drive, turned), q)),
                _ => (&elements::TORQUE, self.twisted(input, (drive, turned), q)),
            };
            let clause = clause?.with(BODY, body);
            Some(if row.find(REACTION).is_some() { clause.with(REACTION, other) } else { clause })
        };
        self.inputs.iter().filter_map(of).collect()
    }

    /// Along observer's axes, and about them or those of the link.
    fn pushed(&self, input: &RobotInput, (drive, turned): (&Drive, &Turned), q: &Ident) -> Option<ForceClause> {
        let writer = self.writer;
        let [pull, turn] = turned.wrench;
        // What has no gear has a force of zero: its control is an input all the same.
        let pull =
            writer.triple(&pull).or_else(|| (turn == [0.0; 3]).then(|| writer.vector(pull.map(|c| writer.number(c)))));
        let turn = writer.triple(&turn);
        let rotation = writer.property(q, Property::Rotation);
        let turn = turn.map(|gear| if turned.in_parent { gear } else { writer.times(rotation.clone(), gear) });
        let omega = writer.times(rotation, writer.property(q, Property::BodyAngularVelocity));
        let rates = [(&pull, writer.property(q, Property::Velocity)), (&turn, omega)];
        let parts = rates.into_iter().filter_map(|(gear, rate)| Some(self.dot(gear.clone()?, rate)));
        let rate = parts.reduce(|a, b| writer.plus(a, b))?;
        let value = self.law(drive, writer.name(&input.name.ident), &[(2, rate)]);
        let [force, torque] = [pull, turn].map(|gear| Some(writer.times(value.clone(), gear?)));
        let clause = ForceClause::new(&elements::WRENCH, Some(input.name.ident.clone()), writer.span);
        Some(clause.with(FORCE, force).with(TORQUE, torque).with(AXES, Some(ForceAxes::Observer)))
    }

    /// In the axes of the link, or in those that it has where it is not turned.
    fn twisted(&self, input: &RobotInput, (drive, turned): (&Drive, &Turned), q: &Ident) -> Option<ForceClause> {
        let writer = self.writer;
        let rotation = writer.name(q);
        let fixed = writer.vector(turned.wrench[1].map(|gear| writer.number(gear)));
        let gear = if turned.in_parent { self.turned_back(&rotation, &fixed) } else { fixed.clone() };
        // What a turn leaves as it is has the same components in both.
        let length = self.dot(fixed, self.rotation_vector(&rotation, &Rotation::none()));
        let rate = self.dot(gear.clone(), writer.property(q, Property::BodyAngularVelocity));
        let value = self.law(drive, writer.name(&input.name.ident), &[(1, length), (2, rate)]);
        let clause = ForceClause::new(&elements::TORQUE, Some(input.name.ident.clone()), writer.span);
        Some(clause.with(VALUE, Some(writer.times(value, gear))))
    }

    /// A vector in the axes that a rotation turns.
    fn turned_back(&self, rotation: &Expression, v: &Expression) -> Expression {
        let writer = self.writer;
        let axes: [Triple; 3] = Rotation::none().matrix;
        let component = |axis: Triple| {
            let axis = writer.vector(axis.map(|c| writer.number(c)));
            self.dot(v.clone(), writer.times(rotation.clone(), axis))
        };
        writer.vector(axes.map(component))
    }

    fn dot(&self, a: Expression, b: Expression) -> Expression {
        self.writer.call(FunctionName::Dot, vec![a, b])
    }
}
