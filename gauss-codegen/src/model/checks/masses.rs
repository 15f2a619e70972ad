//! Rules for mass data: something has mass, roles belong to a body, nothing is said twice.

use super::field_shapes;
use crate::model::language::context::Context;
use crate::model::language::fields::{ReadField, Reader};
use crate::model::language::kind::ValueKind;
use crate::model::language::shapes::TypeKind;
use crate::model::language::statements::{Statement, Statements};
use crate::model::language::words::same;
use crate::model::names::expressions;
use crate::model::names::kinds;
use crate::model::names::places::ExpressionPlace;
use crate::model::names::scope::Scope;
use crate::model::scene::clauses::{BodyClause, Coefficients, RoleClause, RoleValue};
use crate::model::scene::expression::{Expression, ExpressionKind};
use crate::terms::{Role, Shape};
use proc_macro2::{Ident, Span};
use syn::DeriveInput;

/// Something has mass, and roles belong to the unnamed body.
pub fn check_roles(
    input: &DeriveInput,
    statements: &Statements,
    reader: &Reader<'_>,
    owners: &[(Role, usize)],
    scalar: &str,
    uncertain: bool,
    context: &mut Context,
) {
    let has_clause = |role: Role| statements.role_clauses.iter().any(|clause| clause.role == role);
    let known =
        |role: Role| owners.iter().any(|(owner, _)| *owner == role) || reader.meant.contains(&role) || has_clause(role);
    let claimed = |role: Role| owners.iter().any(|(owner, _)| *owner == role) || has_clause(role);
    refuse_both(claimed, input.ident.span(), &input.ident.to_string(), context);
    // One inertia is as good as the other.
    let known = |role: Role| known(role) || (role == Role::Inertia && known(Role::CentralInertia));
    // An accelerating medium pushes the displaced mass as gravity does.
    let pushed = statements.medium.is_some();
    let known = |role: Role| known(role) || (role == Role::Gravity && pushed);
    check_unnamed(input, statements, known, scalar, uncertain, context);
    for claim in reader.fields.iter().filter_map(|field| field.role.as_ref()) {
        field_shapes::check_companion(claim.role, claim.span, known, scalar, context);
    }
    check_twice(&statements.role_clauses, &reader.fields, known, scalar, context);
    statements.massive().for_each(|body| check_fluid(body, known(Role::Gravity), scalar, context));
    if statements.has_unnamed_body() {
        return;
    }
    if uncertain || statements.missed_any(&[Statement::Body, Statement::Particle]) {
        return;
    }
    if statements.massive().count() == 0 && statements.particles.is_empty() && statements.armatures.is_empty() {
        refuse_massless(input, statements, reader, context);
    } else {
        refuse_ownerless(statements, reader, context);
    }
}

/// The body without a name has a mass and an inertia.
fn check_unnamed(
    input: &DeriveInput,
    statements: &Statements,
    known: impl Fn(Role) -> bool,
    scalar: &str,
    uncertain: bool,
    context: &mut Context,
) {
    // Of several unnamed bodies none is meant to have the roles: they must get names first.
    let alone = statements.has_unnamed_body() && statements.massive().count() == 1;
    if let (Some(clause), [false, false]) = (&statements.of_chart, [Role::Mass, Role::Inertia].map(&known)) {
        let [mass, inertia] = [Role::Mass, Role::Inertia].map(|role| role.example(scalar));
        context.error(
            clause.span(),
            format!(
                "`{clause}` moves a body without a name, and `{}` has no mass data of one; add `{mass}` and `{inertia}`, \
                 or remove `{clause}`: what else moves is said by `coordinates` and `speeds`",
                input.ident
            ),
        );
    } else if statements.in_chart || (alone && !uncertain) {
        for role in [Role::Mass, Role::Inertia].into_iter().filter(|role| !known(*role)) {
            field_shapes::missing_role(input, role, scalar, context);
        }
    }
}

/// Refuses a system in which nothing has mass. A field without its clause and a role without its body have messages of
/// their own, with what to add.
fn refuse_massless(input: &DeriveInput, statements: &Statements, reader: &Reader<'_>, context: &mut Context) {
    let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
    if !reader.fields.iter().any(|field| field.role.as_ref().is_some_and(|claim| claim.role == Role::Body)) {
        context.error(
            span,
            "the system has no body and no particle, so nothing in it has mass; \
             add `body(position = […], rotation = …)` or `particle(mass = …, position = […])`",
        );
    }
}

/// Mass data of a body without a name, where there is none.
fn refuse_ownerless(statements: &Statements, reader: &Reader<'_>, context: &mut Context) {
    for clause in statements.role_clauses.iter().filter(|clause| clause.role != Role::Gravity) {
        let word = clause.role.word();
        context.error(
            clause.span,
            format!(
                "`{word}` is that of a body without a name, and this system has none; write it in the clause of the body: \
                 `body(name, {word} = …)`"
            ),
        );
    }
    for field in &reader.fields {
        let Some(claim) = &field.role else { continue };
        if matches!(claim.role, Role::Gravity | Role::Body) {
            continue;
        }
        let word = claim.role.word();
        context.error(
            claim.span,
            format!(
                "the role `{word}` belongs to a body without a name, and this system has none; \
                 add `body(position = […], rotation = …)`, or remove the role: expressions can name `{}` without it",
                field.ident
            ),
        );
    }
}

/// A body has one inertia, about O or about its centre of mass.
fn refuse_both(known: impl Fn(Role) -> bool, span: Span, name: &str, context: &mut Context) {
    if known(Role::Inertia) && known(Role::CentralInertia) {
        let words = [Role::Inertia, Role::CentralInertia].map(Role::word);
        context.error(span, format!("`{name}` has both `{}` and `{}`; keep one of the two", words[0], words[1]));
    }
}

/// Settles the shapes, and refuses numbers that no body has; one that moves `alone` needs a mass of its own.
pub fn check(list: &mut [RoleClause], alone: bool, fields: &[ReadField<'_>], scope: &Scope, context: &mut Context) {
    for clause in list {
        match &clause.value {
            RoleValue::Coefficients(Coefficients::Field(name)) => {
                let field = fields.iter().find(|field| same(field.ident, name));
                // What is no such field is noted with those of drags.
                if let Some(TypeKind::Known(shape)) = field.map(|field| field.reading.kind) {
                    clause.shape = shape;
                }
                continue;
            }
            RoleValue::Coefficients(Coefficients::Diagonal(entries)) => {
                // Of an inertia the upper triangle, row by row.
                clause.shape = if clause.role == Role::AddedMass { Shape::Vector6 } else { Shape::Matrix3 };
                for entry in entries {
                    kinds::check(entry, expressions::entry(clause.role), scope, context);
                }
                continue;
            }
            RoleValue::Expression(value) => {
                match kinds::check(value, ExpressionPlace::Role(clause.role), scope, context) {
                    Some(ValueKind::Scalar) => clause.shape = Shape::Scalar,
                    Some(ValueKind::Vector) => clause.shape = Shape::Vector3,
                    _ => continue,
                }
            }
        }
        if let Some((span, rule)) = broken_rule(clause, alone) {
            context.error(span, rule);
        }
    }
}

/// Rule that literal numbers alone show to be broken. The rest is checked when a kernel is made, because it depends on
/// the motion: of a body in the plane one moment of inertia matters.
fn broken_rule(clause: &RoleClause, alone: bool) -> Option<(Span, String)> {
    let RoleValue::Expression(value) = &clause.value else { return None };
    let parts: Vec<&Expression> = match &value.kind {
        ExpressionKind::Vector(parts) => parts.iter().map(|part| &**part).collect(),
        _ => vec![value],
    };
    let word = clause.role.word();
    let (least, positive) = match clause.role {
        Role::Mass if alone => ("positive", true),
        Role::Mass | Role::Inertia | Role::CentralInertia | Role::DisplacedMass => ("zero or more", false),
        _ => return None,
    };
    let wrong = |part: &&Expression| part.literal().is_some_and(|number| number < 0.0 || (positive && number == 0.0));
    let part = parts.into_iter().find(wrong)?;
    Some((part.span, format!("`{word}` must be {least}, found {}", part.literal()?)))
}

/// Refuses clauses for quantities that a field gives already; `known` are the roles that something plays.
pub fn check_twice(
    list: &[RoleClause],
    fields: &[ReadField<'_>],
    known: impl Fn(Role) -> bool,
    scalar: &str,
    context: &mut Context,
) {
    for clause in list {
        let word = clause.role.word();
        let owner = fields.iter().find(|field| field.role.as_ref().is_some_and(|claim| claim.role == clause.role));
        if let Some(field) = owner {
            context.error(
                clause.span,
                format!("`{word}` is given here and by the field `{}`; keep one of the two", field.ident),
            );
        }
        field_shapes::check_companion(clause.role, clause.span, &known, scalar, context);
    }
}

/// Checks that a body with a name in a fluid has gravity, and something that it displaces.
pub fn check_fluid(body: &BodyClause, gravity: bool, scalar: &str, context: &mut Context) {
    let Some(name) = &body.name else { return };
    for clause in &body.role_clauses {
        let displaced = body.role_clauses.iter().any(|other| other.role == Role::DisplacedMass);
        match clause.role {
            Role::DisplacedMass => {
                let known = |role: Role| role != Role::Gravity || gravity;
                field_shapes::check_companion(clause.role, clause.span, known, scalar, context);
            }
            Role::CenterOfBuoyancy if !displaced => context.error(
                clause.span,
                format!(
                    "`{}` of `{name}` needs `displaced_mass`; without a displaced mass nothing acts there: add \
                     `displaced_mass = …`",
                    clause.role.word()
                ),
            ),
            _ => {}
        }
    }
}

/// A named body has its mass data from a field or from its clause, from there all of them.
pub fn check_named(body: &BodyClause, fields: &[ReadField<'_>], context: &mut Context) {
    let Some(name) = &body.name else { return };
    if let Some(field) = fields.iter().find(|field| same(field.ident, name)) {
        context.error(
            name.span(),
            format!(
                "the mass data of the body `{name}` are given here and by the field `{}`; keep one of the two",
                field.ident
            ),
        );
    }
    let has = |role: Role| body.role_clauses.iter().any(|clause| clause.role == role);
    refuse_both(has, body.span, &name.to_string(), context);
    for role in [Role::Mass, Role::Inertia] {
        if !has(role) && (role == Role::Mass || !has(Role::CentralInertia)) {
            let remedy = if role == Role::Inertia { ", or write a `particle`" } else { "" };
            context.error(
                body.span,
                format!(
                    "the body `{name}` has some of its mass data here, but no `{}`; add `{} = …`{remedy}",
                    role.word(),
                    role.word()
                ),
            );
        }
    }
}
