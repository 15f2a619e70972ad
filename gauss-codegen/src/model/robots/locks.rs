//! Joints of a file that are locked: held at a number they are as good as fixed, so that the mass data of links are
//! added; held at a parameter they are turned or moved by it. Joints that are driven by `motion(…)` are written as all
//! others are, but for inputs and limits of theirs.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use crate::model::language::context::Context;
use crate::model::language::declarations::Origin;
use crate::model::language::robots::{Limits, RobotClauses};
use crate::model::language::statements::Statements;
use crate::model::language::words::word;
use crate::model::scene::clauses::CoordinateClause;
use crate::model::scene::expression::Expression;
use gauss_robots::Structure;
use gauss_robots::description::{Description, Drive, Joint, JointKind, Note};

/// A joint with one coordinate that is locked.
pub struct LockedJoint {
    pub joint: usize,
    /// Name that its coordinate would have.
    pub ident: Ident,
    pub value: Expression,
    /// The value, where it is a number.
    pub number: Option<f64>,
}

/// Joints that are held or driven.
#[derive(Default)]
pub struct HeldJoints {
    pub locked: Vec<LockedJoint>,
    /// Their indices.
    pub driven: Vec<usize>,
}

impl HeldJoints {
    /// Whether a joint moves by nothing that is left to find.
    fn holds(&self, joint: usize) -> bool {
        self.driven.contains(&joint) || self.locked.iter().any(|lock| lock.joint == joint)
    }
}

/// A number, if the expression is one: literals, and multiples of π.
fn number(value: &Expression) -> Option<f64> {
    value.literal().or_else(|| Some(value.turns_of_pi()?.to_f64() * std::f64::consts::PI))
}

/// Finds the joints with one coordinate that are locked, and takes their coordinates away; of those that are driven
/// they stay. Clauses of other names stay with the statements, and so do those at parameters and motions, by the names
/// of coordinates.
pub fn found(
    (description, structure): (&Description, &mut Structure),
    clauses: &RobotClauses,
    coordinates: &mut [Vec<CoordinateClause>],
    statements: &mut Statements,
    context: &mut Context,
) -> HeldJoints {
    let HeldJoints { mut locked, mut driven } = HeldJoints::default();
    let mut left = Vec::new();
    for mut lock in std::mem::take(&mut statements.locks) {
        let is_called = |joint: usize| {
            let called = |q: &CoordinateClause| q.ident.unraw() == word(&lock.name);
            description.joints[joint].name == word(&lock.name) || coordinates[joint].iter().any(called)
        };
        let Some(index) = (0..description.joints.len()).find(|&joint| is_called(joint)) else {
            left.push(lock);
            continue;
        };
        let joint = &description.joints[index];
        // A coordinate of several has a name of its own.
        if joint.kind == JointKind::Planar && joint.name != word(&lock.name) {
            left.push(lock);
            continue;
        }
        let motion = lock.origin == Origin::Motion;
        if let Some(reason) = refusal(joint, &coordinates[index], motion) {
            context.error(lock.name.span(), format!("`{}` {reason}", lock.name));
            continue;
        }
        if motion && let Some(q) = coordinates[index].first() {
            lock.name = Ident::new(&q.ident.to_string(), lock.name.span());
            driven.push(index);
            left.push(lock);
            continue;
        }
        let ident = coordinates[index][0].ident.clone();
        let Some(value) = lock.expression.clone() else { continue };
        let number = number(&value);
        if locked.iter().any(|earlier| earlier.joint == index) {
            context.error(lock.name.span(), format!("`{}` is locked twice; keep one of the two", lock.name));
            continue;
        }
        if !matches!(clauses.limits, Some(Limits::None)) {
            let beyond = number.and_then(|number| beyond_limits((description, structure), index, number));
            if let Some(message) = beyond {
                context.error(value.span, message);
            }
        }
        lock.name = Ident::new(&ident.to_string(), lock.name.span());
        statements.locked_in_file.push(ident.clone());
        left.push(lock);
        locked.push(LockedJoint { joint: index, ident, value, number });
    }
    statements.locks = left;
    hold((description, structure), &locked);
    locked.iter().for_each(|lock| coordinates[lock.joint].clear());
    HeldJoints { locked, driven }
}

/// The reason why a joint cannot be locked, or driven.
fn refusal(joint: &Joint, own: &[CoordinateClause], motion: bool) -> Option<String> {
    let names = || own.iter().map(|q| format!("`{}`", q.ident)).collect::<Vec<_>>().join(", ");
    Some(match (joint.kind, &joint.mimic) {
        (JointKind::Fixed, _) if motion => "is a fixed joint, and moves by nothing".to_owned(),
        (JointKind::Fixed, _) => "is a fixed joint: it is held without a lock".to_owned(),
        (JointKind::Turning | JointKind::Sliding, Some(mimic)) if motion => {
            format!("follows the joint `{0}`, and stands where that one is; drive `{0}`", mimic.joint)
        }
        (JointKind::Planar, _) if motion => format!("moves by three coordinates; drive those of {}", names()),
        (JointKind::Ball, _) if motion => {
            "is a rotation, and a motion is one number; make the joint of the file three hinges".to_owned()
        }
        (JointKind::Floating, _) if motion => {
            "is a pose, and a motion is one number; make the joint of the file slides and hinges".to_owned()
        }
        (JointKind::Turning | JointKind::Sliding, Some(mimic)) => {
            format!("follows the joint `{0}`, and stands where that one is; lock `{0}`", mimic.joint)
        }
        (JointKind::Turning | JointKind::Sliding, None) => return None,
        (JointKind::Planar, _) => format!("moves by three coordinates; lock those of {}", names()),
        (JointKind::Ball, _) => {
            "is a rotation, and a lock is one number; make the joint of the file a fixed one".to_owned()
        }
        (JointKind::Floating, _) => {
            "is a pose, and a lock is one number; make the joint of the file a fixed one".to_owned()
        }
    })
}

/// The message that the joint, or one that follows it, does not reach so far.
fn beyond_limits((description, structure): (&Description, &Structure), leader: usize, number: f64) -> Option<String> {
    for (index, joint) in description.joints.iter().enumerate() {
        let coupling = structure.coupling_of[index];
        let value = coupling.multiplier * number + coupling.offset;
        let [least, most] = joint.limits;
        let is_beyond = least.is_some_and(|least| value < least) || most.is_some_and(|most| value > most);
        if coupling.joint == leader && joint.kind.is_scalar() && is_beyond {
            let range = match (least, most) {
                (Some(least), Some(most)) => format!("is from {least} to {most}"),
                (Some(least), None) => format!("is from {least} on"),
                (None, most) => format!("is up to {}", most.unwrap_or_default()),
            };
            return Some(format!(
                "the joint `{}` would stand at {value}, and its range in the file {range}; lock it within, or write \
                 `limits = none`",
                joint.name
            ));
        }
    }
    None
}

/// Lets the links of locked joints move as one with what they hang on.
fn hold((description, structure): (&Description, &mut Structure), locked: &[LockedJoint]) {
    if locked.is_empty() {
        return;
    }
    let by = |(joint, written): (usize, &Joint)| {
        let coupling = structure.coupling_of[joint];
        let lock = locked.iter().find(|lock| lock.joint == coupling.joint)?;
        // Over a joint at a parameter no mass data are added: any place will do.
        let value = |number: f64| coupling.multiplier * number + coupling.offset - written.reference;
        Some(lock.number.map_or(0.0, value))
    };
    let held: Vec<Option<f64>> = description.joints.iter().enumerate().map(by).collect();
    structure.hold(description, &held);
}

/// Whether a drive acts on joints alone that are locked or driven by a motion.
pub fn is_held((description, structure): (&Description, &Structure), joints: &HeldJoints, drive: &Drive) -> bool {
    let held = |name: &String| {
        let joint = description.joints.iter().position(|joint| joint.name == *name);
        joint.is_some_and(|joint| joints.holds(structure.coupling_of[joint].joint))
    };
    !drive.along.is_empty() && drive.along.iter().all(|(name, _)| held(name))
}

/// Remarks on joints that are locked or driven, and on drives that have nothing to move.
pub fn notes((description, structure): (&Description, &Structure), joints: &HeldJoints) -> Vec<Note> {
    let of_joint = |lock: &LockedJoint| {
        let joint = &description.joints[lock.joint];
        let text = format!(
            "the joint `{}` is locked: it has no coordinate, no speed and no input, and its limits, springs, damping, \
             friction and armature are left out",
            joint.name
        );
        Note::told(joint.at, text)
    };
    let of_motion = |&joint: &usize| {
        let joint = &description.joints[joint];
        let text = format!(
            "the joint `{}` is driven by `motion`: it has no coordinate, no speed and no input, and its limits are left \
             out; its springs, damping, friction and armature are part of its driving force",
            joint.name
        );
        Note::told(joint.at, text)
    };
    let of_drive = |drive: &Drive| {
        let held =
            if joints.driven.is_empty() { "locked joints" } else { "joints that are locked or driven by `motion`" };
        let text = format!("`{}` drives {held} alone, and has no input", drive.name);
        let word = if description.only_driven { "actuator" } else { "transmission" };
        Note::ignored(drive.at, word, text)
    };
    let drives = description.drives.iter().filter(|drive| is_held((description, structure), joints, drive));
    let of_joints = joints.locked.iter().map(of_joint).chain(joints.driven.iter().map(of_motion));
    of_joints.chain(drives.map(of_drive)).collect()
}
