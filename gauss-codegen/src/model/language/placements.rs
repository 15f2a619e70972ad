//! Clauses that place things: bodies, frames, particles, and points of bodies.

use super::arguments::{self, brackets, known, value};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::role_clauses;
use super::words::{Table, UNNAMED};
use crate::model::scene::clauses::{BodyClause, ParticleClause, PointClause};
use crate::model::scene::expression::{Expression, ExpressionKind, Property};
use crate::terms::Role;
use proc_macro2::{Ident, TokenTree};

const BODY: &Table<()> = &[
    ("position", ()),
    ("rotation", ()),
    ("pose", ()),
    ("parent", ()),
    ("mass", ()),
    ("center_of_mass", ()),
    ("inertia", ()),
    ("inertia_about_center_of_mass", ()),
    ("added_mass", ()),
    ("displaced_mass", ()),
    ("center_of_buoyancy", ()),
];
const PARTICLE: &Table<()> = &[("mass", ()), ("position", ()), ("parent", ())];
const POINT: &Table<()> = &[("body", ()), ("at", ())];

/// `body(name, …)`, or `frame(name, …)` if it is `massless`; `None` if not even its name is certain.
pub fn read_body(clause: &Clause, massless: bool, context: &mut Context) -> Option<BodyClause> {
    let (noun, place, example) = if massless {
        ("frame", Owner::Frame, "name, position = […], rotation = …")
    } else {
        ("body", Owner::Body, "position = […], rotation = …")
    };
    let group = brackets(clause, example, context)?;
    let mut body = BodyClause {
        name: None,
        massless,
        parent: None,
        position: None,
        rotation: None,
        role_clauses: Vec::new(),
        span: clause.name.span(),
    };
    let (arguments, complete) = arguments::arguments(group, place, context);
    let mut names: Vec<String> = Vec::new();
    let mut certain = true;
    for (index, argument) in arguments.iter().enumerate() {
        let mut word = argument.word();
        if index == 0 && may_be_name(argument, BODY) {
            body.name = match argument.value {
                Content::Absent => arguments::name(&argument.name, noun, context),
                _ => None,
            };
            certain &= body.name.is_some();
            continue;
        }
        let mut role = role_clauses::role(&word);
        if massless && role.is_some() {
            context.error(argument.name.span(), "a frame has no mass; matter is a `body` or a `particle`");
            continue;
        }
        if !known(argument, noun, BODY, &mut names, context) {
            // Mass data are read as what is meant, lest they be missing as well.
            role = arguments::meant(&word, BODY).and_then(role_clauses::role).filter(|_| !massless);
            match role.map(Role::word).filter(|word| !names.iter().any(|name| name == word)) {
                Some(meant) => word = meant.to_owned(),
                None => continue,
            }
            names.push(word.clone());
        }
        match word.as_str() {
            "position" => body.position = value(argument, "[x, y, 0]", context).or(body.position),
            _ if role.is_some() => {
                role.into_iter().for_each(|role| role_clauses::read(role, argument, &mut body.role_clauses, context))
            }
            "pose" => read_pose(argument, &mut body, &names, context),
            "rotation" => body.rotation = value(argument, "rotation_z(theta)", context).or(body.rotation),
            _ => body.parent = read_reference(argument, "another body or frame", context).or(body.parent),
        }
    }
    if massless && body.name.is_none() {
        if certain && complete {
            context.error(clause.name.span(), "a frame needs a name to be referred to by; write `frame(name, …)`");
        }
        return None;
    }
    certain.then_some(body)
}

/// `pose = craft`: position and rotation at once.
fn read_pose(argument: &Clause, body: &mut BodyClause, given: &[String], context: &mut Context) {
    if let Some(word) = ["position", "rotation"].into_iter().find(|word| given.iter().any(|name| name == word)) {
        context.error(
            argument.name.span(),
            format!("`pose` is position and rotation at once, and `{word}` is given too; keep one of the two"),
        );
        return;
    }
    let Some(name) = read_reference(argument, "a coordinate that is a `Pose`", context) else { return };
    let part = |property| {
        let pose = Expression { kind: ExpressionKind::Name(name.clone()), span: name.span() };
        Some(Expression { kind: ExpressionKind::Property(Box::new(pose), property), span: name.span() })
    };
    (body.position, body.rotation) = (part(Property::Position), part(Property::Rotation));
}

/// A word alone at the beginning is the name; so may be one after which something is wrong.
pub fn may_be_name(argument: &Clause, table: &Table<()>) -> bool {
    matches!(argument.value, Content::Absent | Content::Malformed)
        && !table.iter().any(|(name, ())| argument.word() == *name)
}

/// `None` if something is missing or wrong, which is noted.
pub fn read_particle(clause: &Clause, context: &mut Context) -> Option<ParticleClause> {
    let group = brackets(clause, "mass = m, position = [x, y, z]", context)?;
    let (mut mass, mut position, mut parent) = (None, None, None);
    let mut given: Vec<String> = Vec::new();
    let (arguments, _) = arguments::arguments(group, Owner::Particle, context);
    let mut misspelt = Vec::new();
    for argument in &arguments {
        let word = argument.word();
        if matches!(argument.value, Content::Absent) && arguments::meant(&word, PARTICLE).is_none() {
            context.error(
                argument.name.span(),
                "a particle has no name: remove it, and write its place where something acts on it",
            );
            continue;
        }
        if !known(argument, "particle", PARTICLE, &mut given, context) {
            misspelt.extend(arguments::meant(&word, PARTICLE));
            continue;
        }
        match word.as_str() {
            "mass" => mass = value(argument, "m", context).or(mass),
            "position" => position = value(argument, "[x, y, 0]", context).or(position),
            _ => parent = read_reference(argument, "a body or a frame", context).or(parent),
        }
    }
    for (word, example) in [("mass", "mass = m"), ("position", "position = [x, y, z]")] {
        if !given.iter().any(|name| name == word) && !misspelt.contains(&word) {
            context.error(clause.name.span(), format!("a particle needs its {word}; add `{example}`"));
        }
    }
    Some(ParticleClause { mass: mass?, position: position?, parent, span: clause.name.span() })
}

/// `None` if something is missing or wrong, which is noted. In a chart it is a point of the only body.
pub fn read_point(clause: &Clause, in_chart: bool, context: &mut Context) -> Option<PointClause> {
    let group = brackets(clause, "name, body = …, at = [x, y, z]", context)?;
    let (arguments, complete) = arguments::arguments(group, Owner::Point, context);
    let (mut name, mut body, mut at) = (None, None, None);
    let mut given: Vec<String> = Vec::new();
    let mut misspelt = Vec::new();
    let mut named = !complete;
    for (index, argument) in arguments.iter().enumerate() {
        let word = argument.word();
        if index == 0 && may_be_name(argument, POINT) {
            named = true;
            if matches!(argument.value, Content::Absent) {
                name = arguments::name(&argument.name, "point", context);
            }
            continue;
        }
        if !known(argument, "point", POINT, &mut given, context) {
            misspelt.extend(arguments::meant(&word, POINT));
            continue;
        }
        match word.as_str() {
            "body" => body = read_reference(argument, "a body or a frame", context).or(body),
            _ => at = value(argument, "[l, 0, 0]", context).or(at),
        }
    }
    if !named {
        context.error(clause.name.span(), "a point needs a name to be referred to by; write `point(name, …)`");
    }
    for (word, what, example) in
        [("body", "the body that it is fixed in", "body = name"), ("at", "its place in the body", "at = [x, y, z]")]
    {
        let spared = word == "body" && in_chart;
        if !given.iter().any(|name| name == word) && !misspelt.contains(&word) && !spared {
            context.error(clause.name.span(), format!("a point needs {what}; add `{example}`"));
        }
    }
    if in_chart && !given.iter().any(|name| name == "body") {
        body = Some(Ident::new(UNNAMED, clause.name.span()));
    }
    Some(PointClause { name: name?, body: body?, at: at?, span: clause.name.span() })
}

/// The name of `what` that an argument is said to be.
pub fn read_reference(argument: &Clause, what: &str, context: &mut Context) -> Option<Ident> {
    let name = &argument.name;
    let tokens = match &argument.value {
        Content::Malformed => return None,
        Content::Equals(tokens) => attributes::flat(tokens.iter().cloned().collect()),
        Content::Absent | Content::Brackets(_) => {
            let remedy = if name == "parent" { ", or leave it out" } else { "" };
            context.error(name.span(), format!("`{name}` needs the name of {what}; write `{name} = other`{remedy}"));
            return None;
        }
    };
    match tokens.as_slice() {
        [TokenTree::Ident(parent)] => Some(parent.clone()),
        [TokenTree::Ident(_), extra, ..] | [extra, ..] => {
            context.error(
                attributes::start(extra),
                format!("`{name}` is the name of {what}, found {}", attributes::found(extra)),
            );
            None
        }
        [] => None,
    }
}
