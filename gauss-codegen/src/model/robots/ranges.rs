//! Controls, forces and efforts within their ranges: with `saturation = clamp` values beyond are cut off.

use std::collections::HashSet;

use super::clauses::Robot;
use super::drives::DriveTarget;
use crate::model::language::robots::Saturation;
use crate::model::scene::expression::{Expression, FunctionName};
use gauss_robots::description::Note;

impl Robot<'_> {
    pub fn is_clamped(&self) -> bool {
        self.clauses.saturation == Some(Saturation::Clamp)
    }

    /// A value, or the end of the range that it is beyond.
    pub fn within(&self, value: Expression, range: Option<[f64; 2]>) -> Expression {
        match range.filter(|_| self.is_clamped()) {
            Some(range) => {
                let [least, most] = range.map(|end| self.writer.number(end));
                self.writer.call(FunctionName::Clamp, vec![value, least, most])
            }
            None => value,
        }
    }

    /// Ranges that do not act, and are not known not to.
    pub fn notes_of_ranges(&self) -> Vec<Note> {
        let saturation = self.clauses.saturation;
        if saturation == Some(Saturation::None) || self.inputs.is_empty() {
            return Vec::new();
        }
        let (driving, driven) = self.driving_and_driven();
        let drives = self.description.drives.iter().enumerate();
        let of_drives = drives.flat_map(|(index, drive)| {
            let ranges = [("ctrlrange", drive.controls), ("forcerange", drive.forces)];
            ranges.map(|(word, range)| (word, drive.at, &drive.name, range, driving.contains(&index)))
        });
        let of_joints = self.scalar_joints().filter(|(_, joint, ..)| driven.contains(joint.name.as_str()));
        let of_joints = of_joints.map(|(_, joint, ..)| {
            let word = if self.description.only_driven { "actuatorfrcrange" } else { "effort" };
            (word, joint.at, &joint.name, joint.efforts, true)
        });
        let note = |(word, at, name, range, has_input): (&'static str, _, &String, Option<[f64; 2]>, bool)| {
            let [least, most] = range?;
            let remedy = match (has_input, saturation) {
                (true, Some(_)) => return None,
                (true, None) => "write `saturation = clamp` to cut off what is beyond",
                (false, _) => {
                    "the input is the effort of its joint; `inputs = actuators` with `saturation = clamp` has it"
                }
            };
            let text = format!(
                "the range {least} to {most} of `{name}` (`{word}`) does not act; {remedy}, or `saturation = none`"
            );
            Some(Note::ignored(at, word, text).about(word))
        };
        of_drives.chain(of_joints).filter_map(note).collect()
    }

    /// The drives, by their indices, and the joints, by their names, that inputs act on.
    fn driving_and_driven(&self) -> (HashSet<usize>, HashSet<&str>) {
        let (mut driving, mut driven) = (HashSet::new(), HashSet::new());
        for input in &self.inputs {
            match input.of {
                DriveTarget::Joint(joint) => {
                    driven.insert(self.description.joints[joint].name.as_str());
                }
                DriveTarget::Drive(drive) => {
                    driving.insert(drive);
                    driven.extend(self.description.drives[drive].along.iter().map(|(joint, _)| joint.as_str()));
                }
            }
        }
        (driving, driven)
    }
}
