//! What must hold between the bodies of a system: their names, their fields and their parents.

use super::context::Context;
use super::fields::{Field, Reader};
use super::names;
use super::statements::Statements;
use super::{BodyClause, Role};
use proc_macro2::Ident;
use syn::ext::IdentExt;

/// Checks the clauses and the fields of bodies against one another; `scalar` is what proposed types are made of.
pub(super) fn check(statements: &Statements, reader: &Reader<'_>, scalar: &str, context: &mut Context) {
    check_names(&statements.bodies, scalar, context);
    check_fields(statements, reader, scalar, context);
    check_parents(statements, context);
}

/// The bodies that have names.
fn named(bodies: &[BodyClause]) -> impl Iterator<Item = (&Ident, &BodyClause)> {
    bodies.iter().filter_map(|body| body.name.as_ref().map(|name| (name, body)))
}

/// Only one body can do without a name, and no two have one.
fn check_names(bodies: &[BodyClause], scalar: &str, context: &mut Context) {
    for (index, body) in bodies.iter().enumerate() {
        match &body.name {
            None if bodies.len() > 1 => context.error(
                body.span,
                format!(
                    "a body without a name must be the only one, and there are {}; write `body(name, …)` with a field \
                     `#[gauss(body)] name: RigidBody<{scalar}>`",
                    bodies.len()
                ),
            ),
            Some(name) if named(&bodies[..index]).any(|(earlier, _)| same(earlier, name)) => context.error(
                name.span(),
                format!("two bodies are called `{name}`; each has a field of its own: rename one of the two"),
            ),
            _ => {}
        }
    }
}

/// Each named body has a field, and each field that is a body has a clause.
fn check_fields(statements: &Statements, reader: &Reader<'_>, scalar: &str, context: &mut Context) {
    let is_body = |field: &Field<'_>| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body);
    let unclaimed: Vec<(String, ())> = reader
        .fields
        .iter()
        .filter(|field| is_body(field) && !named(&statements.bodies).any(|(name, _)| same(name, field.ident)))
        .map(|field| (field.ident.unraw().to_string(), ()))
        .collect();
    let table: Vec<(&str, ())> = unclaimed.iter().map(|(name, ())| (name.as_str(), ())).collect();
    // A field whose name is misspelt in its clause is not also a field without a clause.
    let mut meant: Vec<String> = Vec::new();
    for (index, (name, _)) in named(&statements.bodies).enumerate() {
        if named(&statements.bodies).take(index).any(|(earlier, _)| same(earlier, name)) {
            continue;
        }
        let field = reader.fields.iter().find(|field| same(field.ident, name));
        match field {
            Some(field) if is_body(field) => {}
            // Its role is wrong, which is noted.
            Some(_) if reader.meant.contains(&Role::Body) => {}
            Some(field) => {
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
            None => {
                let near = names::nearest(&name.unraw().to_string(), &table);
                let remedy = match near {
                    Some((near, ())) => {
                        meant.push(near.into());
                        format!("did you mean `{near}`?")
                    }
                    None => format!("add `#[gauss(body)] {name}: RigidBody<{scalar}>`"),
                };
                context.error(name.span(), format!("the body `{name}` has no field with its mass data; {remedy}"));
            }
        }
    }
    if statements.missed || statements.missed_body {
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
                    "the field `{name}` is a body, but no clause says where it is; \
                     add `body({name}, position = […], rotation = …)` above `struct`"
                ),
            );
        }
    }
}

/// Parents are bodies of the system, and no body is, by whatever way, its own.
fn check_parents(statements: &Statements, context: &mut Context) {
    let bodies = &statements.bodies;
    let index_of = |name: &Ident| bodies.iter().position(|body| body.name.as_ref().is_some_and(|n| same(n, name)));
    let mut parents: Vec<Option<usize>> = Vec::new();
    for body in bodies {
        let parent = body.parent.as_ref().and_then(index_of);
        parents.push(parent);
        if let (Some(written), None) = (&body.parent, parent)
            && !statements.missed_body
        {
            let owned: Vec<String> = named(bodies)
                .filter(|(name, _)| !body.name.as_ref().is_some_and(|own| same(own, name)))
                .map(|(name, _)| name.unraw().to_string())
                .collect();
            let table: Vec<(&str, ())> = owned.iter().map(|name| (name.as_str(), ())).collect();
            let remedy = match names::nearest(&written.unraw().to_string(), &table) {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None if table.is_empty() => "there is no other body: leave `parent` out".into(),
                None => format!("expected {}", names::list(&table)),
            };
            context.error(written.span(), format!("no body is called `{written}`; {remedy}"));
        }
    }
    let mut seen = vec![false; bodies.len()];
    for start in 0..bodies.len() {
        let mut cycle = vec![start];
        let mut next = parents[start];
        while let Some(index) = next
            && index != start
            && cycle.len() <= bodies.len()
        {
            cycle.push(index);
            next = parents[index];
        }
        if next != Some(start) || cycle.iter().any(|&index| seen[index]) {
            continue;
        }
        cycle.iter().for_each(|&index| seen[index] = true);
        if let Some(parent) = &bodies[start].parent {
            let names: Vec<String> =
                cycle.iter().filter_map(|&index| bodies[index].name.as_ref()).map(|name| format!("`{name}`")).collect();
            let message = match names.as_slice() {
                [own] => format!("the body {own} is its own parent"),
                [a, b] => format!("the bodies {a} and {b} are each other's parent"),
                [rest @ .., last] => {
                    format!("the parents of the bodies {} and {last} go round in a circle", rest.join(", "))
                }
                [] => continue,
            };
            context.error(
                parent.span(),
                format!("{message}; one body must be placed in the observer's frame: leave one `parent` out"),
            );
        }
    }
}

fn same(a: &Ident, b: &Ident) -> bool {
    a.unraw() == b.unraw()
}
