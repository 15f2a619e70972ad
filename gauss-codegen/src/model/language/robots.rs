//! Clauses about a robot that a file describes: `urdf = "…"` or `mjcf = "…"` with `base = fixed | floating` or
//! `base(position = […], rotation = …)`, `inputs = all | none | transmissions | actuators`,
//! `joint_friction = dry | smooth(width) | none`, `limits = range | stop(…) | none`, `ground(…)`, `self_contact(…)`,
//! `saturation = clamp | none`, `parameters = inertial`, `ignore(…)`.

use super::arguments;
use super::arithmetic;
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::ground::{self, Ground};
use super::self_contact::{self, SelfContact};
use super::words::{self, Table};
use crate::model::scene::expression::Expression;
use proc_macro2::{Delimiter, Group, Ident, Span, TokenTree};
use syn::LitStr;

/// Contents of the clauses, as far as they are read.
#[derive(Default)]
pub struct RobotClauses {
    pub file: Option<File>,
    pub base: Option<Base>,
    /// Pose at which the root is held, if not at Ω and along k.
    pub mount: Option<Mount>,
    pub inputs: Option<Inputs>,
    pub friction: Option<Friction>,
    pub limits: Option<Limits>,
    /// Planes that the shapes of links touch.
    pub grounds: Vec<Ground>,
    /// Links that touch each other.
    pub self_contacts: Vec<SelfContact>,
    pub saturation: Option<Saturation>,
    /// The word `parameters` of `parameters = inertial`.
    pub inertial: Option<Ident>,
    /// Elements of the file that the user ignores on purpose.
    pub ignored: Vec<Ident>,
}

/// `urdf = "robots/arm.urdf"`.
pub struct File {
    pub format: Format,
    /// As it is written.
    pub path: String,
    /// The string.
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Urdf,
    Mjcf,
}

/// Whether the root is held or moves freely.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Base {
    Fixed,
    Floating,
}

/// `base(position = [0, 0, h], rotation = rotation_x(pi))`: how the axes of the file lie in those of the observer.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub struct Mount {
    /// The word `base`.
    pub span: Span,
    pub position: Option<Expression>,
    pub rotation: Option<Expression>,
}

/// Which joints have an input.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Inputs {
    All,
    None,
    Transmissions,
    /// Their controls, with gears and gains.
    Actuators,
}

/// Treatment of dry friction.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub enum Friction {
    /// Force times v/√(v² + w²), with this w.
    Smooth(Expression),
    /// Exact dry friction: a contact without a normal.
    Dry,
    None,
}

/// Treatment of the limits of joints and tendons.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub enum Limits {
    /// They are contacts.
    Range,
    Stop {
        stiffness: Expression,
        width: Expression,
        damping: Option<Expression>,
    },
    None,
}

/// Treatment of the ranges of controls, forces and efforts.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Saturation {
    /// Values beyond the range are cut off.
    Clamp,
    None,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum RobotTopic {
    File(Format),
    Base,
    Inputs,
    Friction,
    Limits,
    Ground,
    SelfContact,
    Saturation,
    Parameters,
    Ignore,
}

/// The clauses that name a file.
pub const FILES: &Table<RobotTopic> =
    &[("urdf", RobotTopic::File(Format::Urdf)), ("mjcf", RobotTopic::File(Format::Mjcf))];

/// Clauses that say what is made of the file.
pub const OPTIONS: &Table<RobotTopic> = &[
    ("base", RobotTopic::Base),
    ("inputs", RobotTopic::Inputs),
    ("joint_friction", RobotTopic::Friction),
    ("limits", RobotTopic::Limits),
    ("ground", RobotTopic::Ground),
    ("self_contact", RobotTopic::SelfContact),
    ("saturation", RobotTopic::Saturation),
    ("parameters", RobotTopic::Parameters),
    ("ignore", RobotTopic::Ignore),
];

const BASES: &Table<Base> = &[("fixed", Base::Fixed), ("floating", Base::Floating)];
const INPUTS: &Table<Inputs> = &[
    ("all", Inputs::All),
    ("none", Inputs::None),
    ("transmissions", Inputs::Transmissions),
    ("actuators", Inputs::Actuators),
];
const FRICTION: &Table<bool> = &[("dry", false), ("smooth", true), ("none", false)];
const LIMITS: &Table<bool> = &[("range", false), ("stop", true), ("none", false)];
const SATURATION: &Table<Saturation> = &[("clamp", Saturation::Clamp), ("none", Saturation::None)];
const STOP: &Table<()> = &[("stiffness", ()), ("width", ()), ("damping", ())];
const MOUNT: &Table<()> = &[("position", ()), ("rotation", ())];
const PARAMETERS: &Table<()> = &[("inertial", ())];

/// The clause with this word, if it is one of these; options are clauses only where the struct names a file.
pub fn topic(word: &str, beside_file: bool) -> Option<RobotTopic> {
    let options = if beside_file { OPTIONS } else { &[] };
    FILES.iter().chain(options).find(|(name, _)| *name == word).map(|&(_, topic)| topic)
}

/// The nearest of them to a misspelt word.
pub fn near(word: &str, beside_file: bool) -> Option<&'static str> {
    let options = if beside_file { OPTIONS } else { &[] };
    let all: Vec<(&'static str, RobotTopic)> = FILES.iter().chain(options).copied().collect();
    words::nearest(word, &all).map(|(name, _)| name)
}

impl RobotClauses {
    pub fn read(&mut self, topic: RobotTopic, clause: &Clause, context: &mut Context) {
        let twice = match topic {
            RobotTopic::File(_) => self.file.is_some(),
            RobotTopic::Base => self.base.is_some() || self.mount.is_some(),
            RobotTopic::Inputs => self.inputs.is_some(),
            RobotTopic::Friction => self.friction.is_some(),
            RobotTopic::Limits => self.limits.is_some(),
            RobotTopic::Saturation => self.saturation.is_some(),
            RobotTopic::Parameters => self.inertial.is_some(),
            // Each is a plane of its own, or of some links.
            RobotTopic::Ground | RobotTopic::SelfContact | RobotTopic::Ignore => false,
        };
        if twice {
            let name = &clause.name;
            context.error(name.span(), format!("`{name}` is given twice; keep one of the two"));
        }
        match topic {
            RobotTopic::File(format) => self.file = self.file.take().or(read_file(format, clause, context)),
            RobotTopic::Base => match &clause.value {
                Content::Brackets(group) => self.mount = self.mount.take().or(read_mount(clause, group, context)),
                _ => self.base = self.base.or(read_word("base", clause, BASES, context)),
            },
            RobotTopic::Inputs => self.inputs = self.inputs.or(read_word("inputs", clause, INPUTS, context)),
            RobotTopic::Friction => self.friction = self.friction.take().or(read_friction(clause, context)),
            RobotTopic::Limits => self.limits = self.limits.take().or(read_limits(clause, context)),
            RobotTopic::Ground => self.grounds.extend(ground::read(clause, context)),
            RobotTopic::SelfContact => self.self_contacts.extend(self_contact::read(clause, context)),
            RobotTopic::Saturation => {
                self.saturation = self.saturation.or(read_word("saturation", clause, SATURATION, context));
            }
            RobotTopic::Parameters => {
                let read = read_word("parameters", clause, PARAMETERS, context);
                self.inertial = self.inertial.take().or(read.map(|()| clause.name.clone()));
            }
            RobotTopic::Ignore => self.ignored.extend(read_ignored(clause, context)),
        }
    }
}

/// `ignore(gazebo, contact)`: names of elements and attributes.
fn read_ignored(clause: &Clause, context: &mut Context) -> Vec<Ident> {
    let Content::Brackets(group) = &clause.value else {
        let name = &clause.name;
        context.error(name.span(), format!("`{name}` takes names of elements of the file; write `{name}(gazebo)`"));
        return Vec::new();
    };
    let mut names = Vec::new();
    for piece in attributes::pieces(group.stream(), "the name of an element", context) {
        match piece.as_slice() {
            [TokenTree::Ident(name)] => names.push(name.clone()),
            [other, ..] => {
                let found = attributes::found(other);
                context.error(attributes::start(other), format!("expected the name of an element, found {found}"));
            }
            [] => {}
        }
    }
    names
}

/// `None` if something is wrong, which is noted.
fn read_mount(clause: &Clause, group: &Group, context: &mut Context) -> Option<Mount> {
    let (earlier, span) = (context.count(), clause.name.span());
    let owner = Owner::Action { word: "base", example: "an argument such as `position = [0, 0, h]`" };
    let (arguments, _) = arguments::arguments(group, owner, context);
    let mut mount = Mount { span, position: None, rotation: None };
    let mut given = Vec::new();
    for argument in &arguments {
        if !arguments::known(argument, "base", MOUNT, &mut given, context) {
            continue;
        }
        match argument.word().as_str() {
            "position" => mount.position = arguments::value(argument, "[0, 0, h]", context),
            _ => mount.rotation = arguments::value(argument, "rotation_x(pi)", context),
        }
    }
    if given.is_empty() && context.count() == earlier {
        context.error(span, "`base(…)` says where the root is held; write `base(position = [0, 0, h])`");
    }
    (context.count() == earlier).then_some(mount)
}

fn read_file(format: Format, clause: &Clause, context: &mut Context) -> Option<File> {
    let name = &clause.name;
    let tokens = match &clause.value {
        Content::Malformed => return None,
        Content::Equals(tokens) => attributes::flat(tokens.iter().cloned().collect()),
        Content::Absent | Content::Brackets(_) => Vec::new(),
    };
    let text = match tokens.as_slice() {
        [TokenTree::Literal(literal)] => syn::parse_str::<LitStr>(&literal.to_string()).ok(),
        _ => None,
    };
    let span = tokens.first().map_or(name.span(), attributes::start);
    let Some(path) = text.map(|text| text.value()).filter(|path| !path.is_empty()) else {
        context.error(
            span,
            format!(
                "`{name}` is the path of a file from the folder of the package, in quotes; write `{name} = \
             \"robots/arm.urdf\"`"
            ),
        );
        return None;
    };
    Some(File { format, path, span })
}

fn read_word<T: Copy>(noun: &str, clause: &Clause, table: &Table<T>, context: &mut Context) -> Option<T> {
    let word = clause.bare_word(table, context)?;
    let meaning = words::resolve(&format!("`{noun}`"), &word.ident, table, context).ok()?;
    if let Some(arguments) = word.arguments {
        refuse_brackets(&arguments, &word.ident, noun, context);
        return None;
    }
    Some(meaning)
}

fn refuse_brackets(group: &Group, word: &Ident, noun: &str, context: &mut Context) {
    context.error(group.span_open(), format!("`{word}` takes nothing in brackets; write `{noun} = {word}`"));
}

/// A word, and what is in its brackets if it takes some.
fn read_law(
    clause: &Clause,
    table: &Table<bool>,
    example: &str,
    context: &mut Context,
) -> Option<(Ident, Option<Group>)> {
    let word = clause.bare_word(table, context)?;
    if let Some(remedy) = arguments::law(&words::word(&word.ident), table) {
        context.error(word.ident.span(), format!("unknown `{}` `{}`; {remedy}", clause.name, word.ident));
        return None;
    }
    let takes = words::resolve(&format!("`{}`", clause.name), &word.ident, table, context).ok()?;
    match (takes, word.arguments) {
        (false, None) => Some((word.ident, None)),
        (false, Some(group)) => {
            refuse_brackets(&group, &word.ident, &clause.word(), context);
            None
        }
        (true, Some(group)) if group.delimiter() == Delimiter::Parenthesis && !group.stream().is_empty() => {
            Some((word.ident, Some(group)))
        }
        (true, _) => {
            context.error(word.ident.span(), format!("`{}` is empty; write `{} = {example}`", word.ident, clause.name));
            None
        }
    }
}

fn read_friction(clause: &Clause, context: &mut Context) -> Option<Friction> {
    let group = match read_law(clause, FRICTION, "smooth(0.01)", context)? {
        (_, Some(group)) => group,
        (word, None) => return Some(if word == "dry" { Friction::Dry } else { Friction::None }),
    };
    let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
    arithmetic::read("friction", &tokens, context).map(Friction::Smooth)
}

fn read_limits(clause: &Clause, context: &mut Context) -> Option<Limits> {
    const EXAMPLE: &str = "stop(stiffness = 1e4, width = 0.01)";
    let group = match read_law(clause, LIMITS, EXAMPLE, context)? {
        (_, Some(group)) => group,
        (word, None) => return Some(if word == "range" { Limits::Range } else { Limits::None }),
    };
    let owner = Owner::Action { word: "stop", example: "an argument such as `stiffness = 1e4`" };
    let (arguments, _) = arguments::arguments(&group, owner, context);
    let (mut stiffness, mut width, mut damping) = (None, None, None);
    let mut given = Vec::new();
    for argument in &arguments {
        if !arguments::known(argument, "stop", STOP, &mut given, context) {
            continue;
        }
        let place = match argument.word().as_str() {
            "stiffness" => &mut stiffness,
            "width" => &mut width,
            _ => &mut damping,
        };
        *place = arguments::value(argument, "0.01", context).or(place.take());
    }
    for word in ["stiffness", "width"] {
        if !given.iter().any(|name| name == word) {
            context.error(clause.name.span(), format!("stops at limits need `{word}`; write `limits = {EXAMPLE}`"));
        }
    }
    Some(Limits::Stop { stiffness: stiffness?, width: width?, damping })
}
