//! Joints of a file that are locked: held at a number they are as good as fixed, so that the mass data of links are
//! added; held at a parameter they are turned or moved by it.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use crate::model::language::context::Context;
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

/// A number, if the expression is one: literals, and multiples of π.
fn number(value: &Expression) -> Option<f64> {
    value.literal().or_else(|| Some(value.turns_of_pi()?.to_f64() * std::f64::consts::PI))
}

/// Finds the joints with one coordinate that are locked, and takes their coordinates away. Locks of other names stay
/// with the statements, and so do those at parameters, by the names of coordinates.
pub fn found(
    (description, structure): (&Description, &mut Structure),
    clauses: &RobotClauses,
    coordinates: &mut [Vec<CoordinateClause>],
    statements: &mut Statements,
    context: &mut Context,
) -> Vec<LockedJoint> {
    let mut locked: Vec<LockedJoint> = Vec::new();
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
        if let Some(reason) = refusal(joint, &coordinates[index]) {
            context.error(lock.name.span(), format!("`{}` {reason}", lock.name));
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
    locked
}

/// The reason why a joint cannot be locked.
fn refusal(joint: &Joint, own: &[CoordinateClause]) -> Option<String> {
    let names = || own.iter().map(|q| format!("`{}`", q.ident)).collect::<Vec<_>>().join(", ");
    Some(match (joint.kind, &joint.mimic) {
        (JointKind::Fixed, _) => "is a fixed joint: it is held without a lock".to_owned(),
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

/// Whether a drive acts on locked joints alone.
pub fn is_held((description, structure): (&Description, &Structure), locked: &[LockedJoint], drive: &Drive) -> bool {
    let held = |name: &String| {
        let joint = description.joints.iter().position(|joint| joint.name == *name);
        joint.is_some_and(|joint| locked.iter().any(|lock| lock.joint == structure.coupling_of[joint].joint))
    };
    !drive.along.is_empty() && drive.along.iter().all(|(name, _)| held(name))
}

/// Remarks on locked joints, and on drives that have nothing to move.
pub fn notes((description, structure): (&Description, &Structure), locked: &[LockedJoint]) -> Vec<Note> {
    let of_joint = |lock: &LockedJoint| {
        let joint = &description.joints[lock.joint];
        let text = format!(
            "the joint `{}` is locked: it has no coordinate, no speed and no input, and its limits, springs, damping, \
             friction and armature are left out",
            joint.name
        );
        Note::told(joint.at, text)
    };
    let of_drive = |drive: &Drive| {
        let text = format!("`{}` drives locked joints alone, and has no input", drive.name);
        let word = if description.only_driven { "actuator" } else { "transmission" };
        Note::ignored(drive.at, word, text)
    };
    let drives = description.drives.iter().filter(|drive| is_held((description, structure), locked, drive));
    locked.iter().map(of_joint).chain(drives.map(of_drive)).collect()
}
