//! Joints that mimic others: what the coordinate of each is.

use super::description::{Description, Fault, JointKind, Note};
use super::names::unknown;
use super::rotation::{Rotation, about_direction, multiply, turned};

/// `multiplier` times the coordinate of `joint`, and `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Its index.
    pub joint: usize,
    /// Factor of its coordinate.
    pub multiplier: f64,
    /// Constant that is added.
    pub offset: f64,
}

/// A joint that mimics a fixed one, or one that is fixed by that, is held at its offset.
pub fn hold_followers_of_fixed(description: &mut Description) {
    for joint in description.joints.iter_mut().filter(|joint| joint.kind == JointKind::Fixed) {
        // It is where its origin is, whatever it mimics.
        joint.mimic = None;
    }
    for _ in 0..description.joints.len() {
        let fixed =
            |name: &str| description.joints.iter().any(|joint| joint.name == name && joint.kind == JointKind::Fixed);
        let follower = description
            .joints
            .iter()
            .position(|joint| joint.kind.is_scalar() && joint.mimic.as_ref().is_some_and(|mimic| fixed(&mimic.joint)));
        let Some(joint) = follower.map(|index| &mut description.joints[index]) else { return };
        let Some(mimic) = joint.mimic.take() else { return };
        let value = mimic.offset - joint.reference;
        if joint.kind == JointKind::Turning {
            let turn = about_direction(&joint.axis, value);
            joint.rotation = Rotation::from_matrix(&multiply(&joint.rotation.matrix, &turn));
        } else {
            let way = turned(&joint.rotation.matrix, &joint.axis);
            joint.position = std::array::from_fn(|i| joint.position[i] + value * way[i]);
        }
        joint.kind = JointKind::Fixed;
        let text =
            format!("the joint `{}` mimics `{}`, which is fixed: it is held at its offset", joint.name, mimic.joint);
        description.notes.push(Note::told(mimic.at, text));
    }
}

/// Coordinate of each joint as a function of the one that it follows.
pub fn couplings(description: &Description, faults: &mut Vec<Fault>) -> Vec<Coupling> {
    let joints = &description.joints;
    (0..joints.len())
        .map(|index| {
            let mut coupling = Coupling { joint: index, multiplier: 1.0, offset: 0.0 };
            for _ in 0..=joints.len() {
                let joint = &joints[coupling.joint];
                let Some(mimic) = &joint.mimic else { return coupling };
                let leader = joints.iter().position(|other| other.name == mimic.joint);
                let message = match leader {
                    None => {
                        let others = joints.iter().filter(|other| other.name != joint.name);
                        unknown("joint", &mimic.joint, others.map(|other| other.name.as_str()))
                    }
                    Some(leader) if !joints[leader].kind.is_scalar() || !joint.kind.is_scalar() => {
                        format!("`{}`, and only joints with one coordinate mimic each other", mimic.joint)
                    }
                    Some(leader) => {
                        coupling.offset += coupling.multiplier * mimic.offset;
                        coupling.multiplier *= mimic.multiplier;
                        coupling.joint = leader;
                        continue;
                    }
                };
                // Of a joint that mimics one with a mistake nothing more is said.
                if coupling.joint == index {
                    faults
                        .push(Fault { at: mimic.at, message: format!("the joint `{}` mimics {message}", joint.name) });
                }
                return coupling;
            }
            let joint = &joints[index];
            faults
                .push(Fault { at: joint.at, message: format!("the joint `{}` mimics itself, by others", joint.name) });
            coupling
        })
        .collect()
}
