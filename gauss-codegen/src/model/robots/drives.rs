//! What drives the joints: efforts by the names of joints, or controls by those of actuators.

use proc_macro2::Ident;

use super::clauses::Robot;
use super::description::{Description, Drive, JointKind, Note};
use super::names::Names;
use crate::model::language::robots::Inputs;
use crate::model::scene::clauses::{Coordinate, InputKind, InputName};
use crate::model::scene::expression::Expression;
use crate::model::scene::expression::FunctionName;

/// An input, and what it drives.
pub struct Input {
    pub name: InputName,
    /// The index of a joint, or of a drive.
    pub of: Driven,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Driven {
    Joint(usize),
    Drive(usize),
}

/// The inputs in the order of the file; of efforts that of the joints.
pub fn inputs(
    description: &Description,
    coordinates: &[Vec<Coordinate>],
    asked: Option<Inputs>,
    names: &mut Names,
) -> Vec<Input> {
    let usual = if description.only_driven { Inputs::Transmissions } else { Inputs::All };
    let is_driven =
        |joint: &str| description.drives.iter().any(|drive| drive.along.iter().any(|(name, _)| name == joint));
    let unit = |kind: JointKind| if kind == JointKind::Turning { "N m" } else { "N" };
    let input = |ident: Ident, field: &str, unit: Option<&str>, of| {
        let name =
            InputName { ident, kind: InputKind::Scalar, unit: unit.map(str::to_owned), field: Some(field.to_owned()) };
        Input { name, of }
    };
    match asked.unwrap_or(usual) {
        Inputs::None => Vec::new(),
        Inputs::Actuators => {
            let drives = description.drives.iter().enumerate();
            drives
                .map(|(index, drive)| {
                    let ident = names.identifier(&drive.name, "control", drive.at);
                    let kind =
                        |name: &String| description.joints.iter().find(|joint| joint.name == *name).map(|j| j.kind);
                    // The control of a gain has whatever unit that gives it.
                    let plain = drive.gain == 1.0 && drive.bias == [0.0; 3];
                    let unit = drive.along.first().filter(|_| plain).and_then(|(name, _)| kind(name)).map(unit);
                    input(ident, &drive.name, unit, Driven::Drive(index))
                })
                .collect()
        }
        asked => {
            let joints = description.joints.iter().enumerate().zip(coordinates);
            let own = joints.filter(|((_, joint), own)| joint.kind.is_scalar() && own.len() == 1);
            let driven = own.filter(|((_, joint), _)| asked == Inputs::All || is_driven(&joint.name));
            driven
                .map(|((index, joint), own)| {
                    let word = own[0].ident.to_string();
                    let ident = names.chosen(&format!("{}_effort", word.trim_start_matches("r#")));
                    input(ident, &joint.name, Some(unit(joint.kind)), Driven::Joint(index))
                })
                .collect()
        }
    }
}

/// What drives with gears or gains and has an effort for an input.
pub fn notes(description: &Description, inputs: &[Input]) -> Vec<Note> {
    let is_drive = |input: &Input| matches!(input.of, Driven::Drive(_));
    let plain = |drive: &&Drive| {
        drive.gain != 1.0 || drive.bias != [0.0; 3] || drive.along.iter().any(|(_, factor)| *factor != 1.0)
    };
    let told = |drive: &Drive| {
        let text = format!(
            "the input of `{}` is the effort of its joint: gears and gains are left to it; `inputs = actuators` has them",
            drive.name
        );
        Note::told(drive.at, text).about("gears")
    };
    if inputs.iter().any(is_drive) { Vec::new() } else { description.drives.iter().filter(plain).map(told).collect() }
}

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
