//! Mass data that are written in clauses, `mass = 2.0` or `inertia = [a, a, c]`, in place of fields: numbers known when the
//! code is generated, equal moments, and components that are zero stay out of it.

use super::arithmetic;
use super::attributes::{self, Clause};
use super::context::Context;
use super::fields::ReadField;
use super::kinds::{self, Kind};
use super::naming::same;
use super::places::Place;
use super::roles::ROLES;
use super::scope::Scope;
use super::statements;
use super::validate;
use super::{BodyClause, Expression, ExpressionKind, Role, Shape};
use proc_macro2::Span;

/// `role = value`, of the body that has it.
#[derive(Clone)]
pub struct Given {
    /// Any but that of being a body.
    pub role: Role,
    /// Scalar or vector.
    pub shape: Shape,
    /// Of fields and numbers.
    pub value: Expression,
    /// The word of the role.
    pub span: Span,
}

/// The role that a word of a clause means.
pub(super) fn role(word: &str) -> Option<Role> {
    ROLES.iter().find(|(name, _)| *name == word).map(|&(_, role)| role)
}

/// Reads `role = value` into the list; of what is given twice the first counts.
pub(super) fn read(role: Role, clause: &Clause, list: &mut Vec<Given>, context: &mut Context) {
    let word = role.word();
    if role == Role::AddedMass {
        context.error(
            clause.name.span(),
            "the added mass is a field, a matrix or its diagonal; write `#[gauss(added_mass)]` on one",
        );
        return;
    }
    let example = match role {
        Role::CenterOfMass | Role::CenterOfBuoyancy => "[0, 0, l]",
        Role::Inertia => "[a, a, c]",
        _ => "2.0",
    };
    let value = statements::equals(clause, example, context).and_then(|tokens| arithmetic::read(word, tokens, context));
    if let Some(value) = value {
        add(Given { role, shape: Shape::Other, value, span: clause.name.span() }, list, context);
    }
}

/// Adds one to a list that has none of its role.
pub(super) fn add(given: Given, list: &mut Vec<Given>, context: &mut Context) {
    if list.iter().any(|other| other.role == given.role) {
        context.error(given.span, format!("`{}` is given twice; keep one of the two", given.role.word()));
    } else {
        list.push(given);
    }
}

/// Settles the shapes, and refuses numbers that no body has.
pub(super) fn check(list: &mut [Given], scope: &Scope, context: &mut Context) {
    for given in list {
        match kinds::check(&given.value, Place::Given(given.role), scope, context) {
            Some(Kind::Scalar) => given.shape = Shape::Scalar,
            Some(Kind::Vector) => given.shape = Shape::Vector3,
            _ => continue,
        }
        if let Some((span, rule)) = broken_rule(given) {
            context.error(span, rule);
        }
    }
}

/// What literal numbers alone show to be wrong. The rest is checked when a kernel is made, because it depends on the motion: of a body
/// in the plane one moment of inertia matters.
fn broken_rule(given: &Given) -> Option<(Span, String)> {
    let parts: Vec<&Expression> = match &given.value.kind {
        ExpressionKind::Vector(parts) => parts.iter().map(|part| &**part).collect(),
        _ => vec![&given.value],
    };
    let word = given.role.word();
    let (least, positive) = match given.role {
        Role::Mass => ("positive", true),
        Role::Inertia | Role::DisplacedMass => ("zero or more", false),
        _ => return None,
    };
    let wrong = |part: &&Expression| part.literal().is_some_and(|number| number < 0.0 || (positive && number == 0.0));
    let part = parts.into_iter().find(wrong)?;
    Some((part.span, format!("`{word}` must be {least}, found {}", part.literal()?)))
}

/// A clause `word` without `=`, where it is the role of a field.
pub(super) fn belongs_to_field(clause: &Clause) -> bool {
    !matches!(clause.value, attributes::Value::Equals(_))
}

/// What a field says is not said by a clause too; `known` are the roles that something plays.
pub(super) fn check_roles(
    list: &[Given],
    fields: &[ReadField<'_>],
    known: impl Fn(Role) -> bool,
    scalar: &str,
    context: &mut Context,
) {
    for given in list {
        let word = given.role.word();
        let owner = fields.iter().find(|field| field.role.as_ref().is_some_and(|claim| claim.role == given.role));
        if let Some(field) = owner {
            context.error(
                given.span,
                format!("`{word}` is given here and by the field `{}`; keep one of the two", field.ident),
            );
        }
        validate::check_companion(given.role, given.span, &known, scalar, context);
    }
}

/// A named body has its mass data from a field or from its clause, from there all of them.
pub(super) fn check_named(body: &BodyClause, fields: &[ReadField<'_>], context: &mut Context) {
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
    let has = |role: Role| body.given.iter().any(|given| given.role == role);
    for role in [Role::Mass, Role::Inertia] {
        if !has(role) {
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
