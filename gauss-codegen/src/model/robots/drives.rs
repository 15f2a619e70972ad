//! The inputs of a robot: efforts by the names of joints, or controls by those of actuators.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use super::names::RobotNames;
use crate::model::language::robots::Inputs;
use crate::model::scene::clauses::CoordinateClause;
use crate::terms::{InputKind, InputName};
use gauss_robots::description::{Description, Drive, JointKind, Note};

/// An input, and what it drives.
pub struct RobotInput {
    pub name: InputName,
    /// The index of a joint, or of a drive.
    pub of: DriveTarget,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum DriveTarget {
    Joint(usize),
    Drive(usize),
}

/// The inputs in the order of the file; of efforts that of the joints. Drives that are held have none.
pub fn inputs(
    (description, is_held): (&Description, &dyn Fn(&Drive) -> bool),
    coordinates: &[Vec<CoordinateClause>],
    asked: Option<Inputs>,
    names: &mut RobotNames,
) -> Vec<RobotInput> {
    let usual = if description.only_driven { Inputs::Transmissions } else { Inputs::All };
    let is_driven =
        |joint: &str| description.drives.iter().any(|drive| drive.along.iter().any(|(name, _)| name == joint));
    match asked.unwrap_or(usual) {
        Inputs::None => Vec::new(),
        Inputs::Actuators => controls(description, |drive| !is_held(drive), names),
        asked => {
            let joints = description.joints.iter().enumerate().zip(coordinates);
            let own = joints.filter(|((_, joint), own)| joint.kind.is_scalar() && own.len() == 1);
            let driven = own.filter(|((_, joint), _)| asked == Inputs::All || is_driven(&joint.name));
            let efforts: Vec<RobotInput> = driven
                .map(|((index, joint), own)| {
                    // As the coordinate, whatever the file calls it.
                    let word = own[0].ident.unraw().to_string();
                    let ident = names.chosen(&format!("{word}_effort"));
                    input(ident, &word, Some(unit(joint.kind)), DriveTarget::Joint(index))
                })
                .collect();
            // A wrench is no effort of a joint.
            let others = controls(description, Drive::is_wrench, names);
            efforts.into_iter().chain(others).collect()
        }
    }
}

/// The controls of some drives, by their names.
fn controls(description: &Description, which: impl Fn(&Drive) -> bool, names: &mut RobotNames) -> Vec<RobotInput> {
    let kind = |name: &String| description.joints.iter().find(|joint| joint.name == *name).map(|j| j.kind);
    let drives = description.drives.iter().enumerate().filter(|(_, drive)| which(drive));
    drives
        .map(|(index, drive)| {
            // Links keep their names, as joints do.
            let of_link = description.links.iter().any(|link| link.name == drive.name);
            let ident = match of_link {
                true => names.chosen(&format!("{}_control", drive.name)),
                false => names.identifier(&drive.name, "control", drive.at),
            };
            // The control of a gain has whatever unit that gives it.
            let unit = drive.along.first().filter(|_| drive.is_plain()).and_then(|(name, _)| kind(name)).map(unit);
            input(ident, &drive.name, unit, DriveTarget::Drive(index))
        })
        .collect()
}

fn unit(kind: JointKind) -> &'static str {
    if kind == JointKind::Turning { "N m" } else { "N" }
}

fn input(ident: Ident, field: &str, unit: Option<&str>, of: DriveTarget) -> RobotInput {
    let word = syn::parse_str::<Ident>(field);
    let called = word.map_or_else(|_| ident.clone(), |word| Ident::new(&word.to_string(), ident.span()));
    let name = InputName { ident, kind: InputKind::Scalar, unit: unit.map(str::to_owned), called };
    RobotInput { name, of }
}

/// Notes on drives with gears or gains whose input is an effort.
pub fn notes(description: &Description, inputs: &[RobotInput]) -> Vec<Note> {
    let is_drive =
        |input: &RobotInput| matches!(input.of, DriveTarget::Drive(drive) if !description.drives[drive].is_wrench());
    let plain = |drive: &&Drive| {
        let geared = drive.along.iter().any(|(_, factor)| *factor != 1.0);
        !drive.is_wrench() && (geared || !drive.is_plain())
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

/// Drives of joints that have no effort of their own for an input, because they mimic others.
pub fn lost(
    (description, is_held): (&Description, &dyn Fn(&Drive) -> bool),
    inputs: &[RobotInput],
    asked: Option<Inputs>,
) -> Vec<Note> {
    if matches!(asked, Some(Inputs::None | Inputs::Actuators)) {
        return Vec::new();
    }
    let has_input = |joint: &str| {
        inputs.iter().any(|input| match input.of {
            DriveTarget::Joint(index) => description.joints[index].name == joint,
            DriveTarget::Drive(_) => false,
        })
    };
    let is_lost = |drive: &&Drive| {
        let joints = description.joints.iter().filter(|joint| drive.along.iter().any(|(name, _)| *name == joint.name));
        let mimics = joints.clone().any(|joint| joint.mimic.is_some());
        mimics && !is_held(drive) && !joints.into_iter().any(|joint| has_input(&joint.name))
    };
    let told = |drive: &Drive| {
        let text = format!(
            "`{}` drives a joint that mimics another, and has no input: `inputs = actuators` has it, scaled as the joint is",
            drive.name
        );
        let word = if description.only_driven { "actuator" } else { "transmission" };
        Note::ignored(drive.at, word, text).about("mimics")
    };
    description.drives.iter().filter(is_lost).map(told).collect()
}
