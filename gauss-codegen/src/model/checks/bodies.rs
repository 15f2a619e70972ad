//! Rules between the bodies and frames of a scene: their names, their fields and their parents.

use super::masses;
use crate::model::language::context::Context;
use crate::model::language::fields::{ReadField, Reader};
use crate::model::language::statements::{Statement, Statements};
use crate::model::language::words::{self, UNNAMED, same, word};
use crate::model::scene::clauses::BodyClause;
use crate::model::scene::elements::ElementArgument;
use crate::terms::{KernelOptions, Role};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use syn::ext::IdentExt;

/// Checks the clauses and the fields of bodies against one another; `scalar` is what proposed types are made of.
pub fn check(
    statements: &Statements,
    reader: &Reader<'_>,
    wanted: &KernelOptions,
    scalar: &str,
    context: &mut Context,
) {
    check_names(statements, scalar, context);
    check_fields(statements, reader, scalar, context);
    check_references(statements, wanted, context);
    check_cycles(&statements.bodies, context);
}

impl BodyClause {
    /// Name in expressions and clauses.
    pub fn word(&self) -> String {
        self.name.as_ref().map_or_else(|| UNNAMED.to_owned(), word)
    }
}

/// The names that bodies have.
fn named<'a>(bodies: &[&'a BodyClause]) -> Vec<&'a Ident> {
    bodies.iter().filter_map(|body| body.name.as_ref()).collect()
}

/// Only one body can do without a name, and no two have one.
fn check_names(statements: &Statements, scalar: &str, context: &mut Context) {
    let bodies: Vec<&BodyClause> = statements.massive().collect();
    let mut taken = HashSet::new();
    for body in &bodies {
        match &body.name {
            None if bodies.len() > 1 && !statements.in_chart => context.error(
                body.span,
                format!(
                    "a body without a name must be the only one, and there are {}; write `body(name, …)` with a field \
                     `#[gauss(body)] name: RigidBody<{scalar}>`",
                    bodies.len()
                ),
            ),
            Some(name) if !taken.insert(word(name)) => context.error(
                name.span(),
                format!("two bodies are called `{name}`; each has a field of its own: rename one of the two"),
            ),
            _ => {}
        }
    }
}

/// Each named body has a field, and each field that is a body has a clause.
fn check_fields(statements: &Statements, reader: &Reader<'_>, scalar: &str, context: &mut Context) {
    let is_body = |field: &ReadField<'_>| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body);
    statements.massive().filter(|body| body.has_matter()).for_each(|body| {
        masses::check_named(body, &reader.fields, context);
    });
    let bodies = named(&statements.massive().filter(|body| !body.has_matter()).collect::<Vec<_>>());
    // That a frame cannot have the name of a field is noted with the names.
    let frames: Vec<&Ident> = statements.frames().collect();
    let all = named(&statements.massive().collect::<Vec<_>>());
    let placed = |field: &ReadField<'_>| all.iter().chain(&frames).any(|name| same(name, field.ident));
    let unclaimed: Vec<(String, ())> = reader
        .fields
        .iter()
        .filter(|field| is_body(field) && !placed(field))
        .map(|field| (field.ident.unraw().to_string(), ()))
        .collect();
    let table: Vec<(&str, ())> = unclaimed.iter().map(|(name, ())| (name.as_str(), ())).collect();
    // A field whose name is misspelt in its clause is not also a field without a clause.
    let mut meant: Vec<String> = Vec::new();
    let mut seen = HashSet::new();
    for name in bodies {
        if !seen.insert(word(name)) {
            continue;
        }
        let field = reader.fields.iter().find(|field| same(field.ident, name));
        match field {
            Some(field) if is_body(field) => {}
            // Its role is wrong, which is noted.
            Some(_) if reader.meant.contains(&Role::Body) => {}
            Some(field) => refuse_no_body(name, field, scalar, context),
            // A file that could not be read may have them.
            None if statements.missed => {}
            None => meant.extend(refuse_no_field(name, &table, scalar, context)),
        }
    }
    if statements.missed_any(&[Statement::Body]) {
        return;
    }
    for field in reader.fields.iter().filter(|field| is_body(field)) {
        let name = field.ident.unraw().to_string();
        if let Some(claim) = &field.role
            && table.iter().any(|(unclaimed, ())| *unclaimed == name)
            && !meant.contains(&name)
        {
            context.error(
                claim.span,
                format!(
                    "the field `{name}` is a body, but no clause gives its place; \
                     add `body({name}, position = […], rotation = …)` above `struct`"
                ),
            );
        }
    }
}

/// The field of the body is something else.
fn refuse_no_body(name: &Ident, field: &ReadField<'_>, scalar: &str, context: &mut Context) {
    let problem = match &field.role {
        Some(claim) => format!("is the {} of a body, not a body", claim.role.word().replace('_', " ")),
        None => "has no role".into(),
    };
    context.error(
        name.span(),
        format!(
            "the body `{name}` takes its mass data from the field `{name}`, which {problem}; \
             write `#[gauss(body)] {name}: RigidBody<{scalar}>`"
        ),
    );
}

/// The body has no field. Gives back the one that is meant, among those that no body has.
fn refuse_no_field(name: &Ident, table: &[(&str, ())], scalar: &str, context: &mut Context) -> Option<String> {
    let near = words::nearest(&name.unraw().to_string(), table).map(|(near, ())| near.to_owned());
    let remedy = match &near {
        Some(near) => format!("did you mean `{near}`?"),
        None => {
            format!("add `#[gauss(body)] {name}: RigidBody<{scalar}>`, or `mass = …` and `inertia = …` to the clause")
        }
    };
    context.error(name.span(), format!("the body `{name}` has no field with its mass data; {remedy}"));
    near
}

/// Places of bodies and frames in a list, by their names; of two with one name the first.
fn places(bodies: &[BodyClause]) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    bodies.iter().enumerate().for_each(|(k, body)| _ = places.entry(body.word()).or_insert(k));
    places
}

/// Refuses names of parents, of bodies with points, of bodies with forces, in `frames(…)` and `reactions(…)` that are
/// no bodies or frames of the system.
fn check_references(statements: &Statements, wanted: &KernelOptions, context: &mut Context) {
    if statements.missed_any(&[Statement::Body, Statement::Frame]) {
        return;
    }
    let known = places(&statements.bodies);
    for reference in references(statements, wanted) {
        if !known.contains_key(&word(reference.written)) {
            refuse_reference(&reference, statements, context);
        }
    }
}

/// A name that a body or frame should have.
struct BodyReference<'a> {
    written: &'a Ident,
    /// The body that it cannot be.
    other: Option<&'a Ident>,
    /// The argument that can be left out.
    optional: Option<&'static str>,
    /// A joint of a robot's file is meant as well.
    joint: bool,
}

impl<'a> BodyReference<'a> {
    fn to(written: &'a Ident) -> Self {
        Self { written, other: None, optional: None, joint: false }
    }
}

fn references<'a>(statements: &'a Statements, wanted: &'a KernelOptions) -> Vec<BodyReference<'a>> {
    let mut references = Vec::new();
    for body in &statements.bodies {
        let parent = body.parent.as_ref().map(BodyReference::to);
        let other = body.name.as_ref();
        references.extend(parent.map(|parent| BodyReference { other, optional: Some("parent"), ..parent }));
    }
    for particle in &statements.particles {
        let parent = particle.parent.as_ref().map(BodyReference::to);
        references.extend(parent.map(|parent| BodyReference { optional: Some("parent"), ..parent }));
    }
    references.extend(statements.points.iter().map(|point| BodyReference::to(&point.body)));
    references.extend(statements.formal.iter().flatten().map(BodyReference::to));
    references.extend(wanted.frames.iter().map(BodyReference::to));
    references
        .extend(wanted.reactions.iter().map(|joint| BodyReference { joint: true, ..BodyReference::to(&joint.link) }));
    for clause in &statements.forces {
        let body = clause.body();
        references.extend(body.map(BodyReference::to));
        let left_out = |argument: &ElementArgument| argument.required.is_none().then_some(argument.word);
        let second = clause.other();
        references.extend(second.map(|(written, argument)| BodyReference {
            other: body,
            optional: left_out(argument),
            ..BodyReference::to(written)
        }));
    }
    references
}

/// Notes that no body, frame or joint is called so, with the nearest name, or all of them.
fn refuse_reference(reference: &BodyReference<'_>, statements: &Statements, context: &mut Context) {
    let &BodyReference { written, other, optional, joint } = reference;
    let names: Vec<String> = statements
        .bodies
        .iter()
        .map(BodyClause::word)
        .filter(|name| other.is_none_or(|other| *name != word(other)))
        .collect();
    let joints: Vec<(&str, bool)> = statements.joints_of_file.iter().map(|name| (name.as_str(), true)).collect();
    let joints = if joint { joints } else { Vec::new() };
    let table: Vec<(&str, ())> = names.iter().map(|name| (name.as_str(), ())).collect();
    let both: Vec<(&str, bool)> = table.iter().map(|(name, ())| (*name, false)).chain(joints.iter().copied()).collect();
    // Joints are numbered more often than not.
    let near = words::all_nearest(&written.unraw().to_string(), &both);
    let renamed = statements.links_of_file.iter().find(|(name, _)| written.unraw() == name);
    let remedy = match near.first() {
        _ if renamed.is_some() => renamed
            .map(|(name, called)| format!("the link `{name}` of the file is called `{called}`"))
            .unwrap_or_default(),
        Some(_) if near.iter().all(|(_, joint)| *joint) => format!("did you mean the joint {}?", words::list(&near)),
        Some((first, _)) => format!("did you mean `{first}`?"),
        None if statements.has_unnamed_body() && table.len() == 1 => format!("the only body is `{UNNAMED}`"),
        None if !joints.is_empty() => {
            format!("expected a link ({}) or the joint that carries it ({})", words::list(&table), words::list(&joints))
        }
        None if !table.is_empty() => format!("expected {}", words::list(&table)),
        None => match optional {
            Some(argument) => format!("there is no other: leave `{argument}` out"),
            None => format!("add `body({written}, …)` or `frame({written}, …)`"),
        },
    };
    let problem = if statements.points.iter().any(|point| same(&point.name, written)) {
        format!("`{written}` is a point, not a body or frame")
    } else if joints.is_empty() {
        format!("no body or frame is called `{written}`")
    } else {
        format!("no body, frame or joint is called `{written}`")
    };
    context.error(written.span(), format!("{problem}; {remedy}"));
}

/// No body is, by whatever way, its own parent.
fn check_cycles(bodies: &[BodyClause], context: &mut Context) {
    let known = places(bodies);
    let parent = |body: &BodyClause| body.parent.as_ref().and_then(|name| known.get(&word(name)).copied());
    let parents: Vec<Option<usize>> = bodies.iter().map(parent).collect();
    let (mut seen, mut placed) = (vec![false; bodies.len()], vec![false; bodies.len()]);
    for start in 0..bodies.len() {
        let mut cycle = vec![start];
        let mut next = parents[start];
        while let Some(index) = next
            && index != start
            && cycle.len() <= bodies.len()
        {
            cycle.push(index);
            // What is placed already leads to the observer.
            next = parents[index].filter(|_| !placed[index]);
        }
        if next.is_none() {
            cycle.iter().for_each(|&index| placed[index] = true);
        }
        if next != Some(start) || cycle.iter().any(|&index| seen[index]) {
            continue;
        }
        cycle.iter().for_each(|&index| seen[index] = true);
        if let Some(parent) = &bodies[start].parent {
            let names: Vec<String> = cycle.iter().map(|&index| format!("`{}`", bodies[index].word())).collect();
            let frames = cycle.iter().filter(|&&index| bodies[index].massless).count();
            let (one, several) = match frames {
                0 => ("body", "bodies"),
                all if all == cycle.len() => ("frame", "frames"),
                _ => ("body or frame", "bodies and frames"),
            };
            let message = match names.as_slice() {
                [own] => format!("the {one} {own} is its own parent"),
                [a, b] => format!("the {several} {a} and {b} are each other's parent"),
                [rest @ .., last] => {
                    format!("the parents of the {several} {} and {last} go round in a circle", rest.join(", "))
                }
                [] => continue,
            };
            context.error(
                parent.span(),
                format!("{message}; one {one} must be placed in the observer's frame: leave one `parent` out"),
            );
        }
    }
}
