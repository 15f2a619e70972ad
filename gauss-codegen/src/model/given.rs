//! Mass data that are written in clauses, `mass = 2.0` or `inertia = [a, a, c]`, in place of fields: numbers known when the
//! code is generated, equal moments, and components that are zero stay out of it. Of the fluid about any body: `added_mass = x`.

use super::arithmetic;
use super::attributes::{self, Clause};
use super::context::Context;
use super::fields::ReadField;
use super::kinds::{self, Kind};
use super::naming::same;
use super::places::Place;
use super::roles::ROLES;
use super::scope::Scope;
use super::shapes;
use super::statements;
use super::validate;
use super::{BodyClause, Coefficients, Expression, ExpressionKind, Role, Shape};
use proc_macro2::Span;

/// `role = value`, of the body that has it.
#[derive(Clone)]
pub struct Given {
    /// Any but that of being a body.
    pub role: Role,
    /// Scalar or vector; of an added mass six, or six by six.
    pub shape: Shape,
    /// Of fields and numbers.
    pub value: GivenValue,
    /// The word of the role.
    pub span: Span,
}

/// What a role is said to be.
#[derive(Clone)]
pub enum GivenValue {
    /// A scalar or a vector.
    Expression(Expression),
    /// An added mass.
    Coefficients(Coefficients),
}

impl Given {
    /// Its expressions, with their places.
    pub(super) fn expressions(&self) -> Vec<(Place, &Expression)> {
        match &self.value {
            GivenValue::Expression(value) => vec![(Place::Given(self.role), value)],
            GivenValue::Coefficients(value) => value.entries().map(|entry| (ENTRY, entry)).collect(),
        }
    }

    /// Calls `change` with each of its expressions.
    pub(super) fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.value {
            GivenValue::Expression(value) => change(value),
            GivenValue::Coefficients(value) => value.each_expression(change),
        }
    }

    /// It is of the body itself, not of the fluid about it.
    pub fn is_of_matter(&self) -> bool {
        matches!(self.role, Role::Mass | Role::CenterOfMass | Role::Inertia)
    }
}

/// Where an entry of an added mass stands.
pub(super) const ENTRY: Place = Place::Constant { word: "entry", noun: "an added mass" };

/// The role that a word of a clause means.
pub(super) fn role(word: &str) -> Option<Role> {
    ROLES.iter().find(|(name, _)| *name == word).map(|&(_, role)| role)
}

/// Reads `role = value` into the list; of what is given twice the first counts.
pub(super) fn read(role: Role, clause: &Clause, list: &mut Vec<Given>, context: &mut Context) {
    let word = role.word();
    let example = match role {
        Role::CenterOfMass | Role::CenterOfBuoyancy => "[0, 0, l]",
        Role::Inertia => "[a, a, c]",
        Role::AddedMass => "[a, b, c, d, e, f]",
        _ => "2.0",
    };
    let Some(tokens) = statements::equals(clause, example, context) else { return };
    let value = match role {
        Role::AddedMass => arithmetic::read_coefficients(word, tokens, context).map(GivenValue::Coefficients),
        _ => arithmetic::read(word, tokens, context).map(GivenValue::Expression),
    };
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
pub(super) fn check(list: &mut [Given], fields: &[ReadField<'_>], scope: &Scope, context: &mut Context) {
    for given in list {
        match &given.value {
            GivenValue::Coefficients(Coefficients::Field(name)) => {
                let field = fields.iter().find(|field| same(field.ident, name));
                // What is no such field is noted with those of drags.
                if let Some(shapes::Kind::Known(shape)) = field.map(|field| field.reading.kind) {
                    given.shape = shape;
                }
                continue;
            }
            GivenValue::Coefficients(Coefficients::Diagonal(entries)) => {
                given.shape = Shape::Vector6;
                for entry in entries {
                    kinds::check(entry, ENTRY, scope, context);
                }
                continue;
            }
            GivenValue::Expression(value) => match kinds::check(value, Place::Given(given.role), scope, context) {
                Some(Kind::Scalar) => given.shape = Shape::Scalar,
                Some(Kind::Vector) => given.shape = Shape::Vector3,
                _ => continue,
            },
        }
        if let Some((span, rule)) = broken_rule(given) {
            context.error(span, rule);
        }
    }
}

/// What literal numbers alone show to be wrong. The rest is checked when a kernel is made, because it depends on the motion: of a body
/// in the plane one moment of inertia matters.
fn broken_rule(given: &Given) -> Option<(Span, String)> {
    let GivenValue::Expression(value) = &given.value else { return None };
    let parts: Vec<&Expression> = match &value.kind {
        ExpressionKind::Vector(parts) => parts.iter().map(|part| &**part).collect(),
        _ => vec![value],
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

/// What the fluid does to a body with a name needs gravity, and something that it displaces.
pub(super) fn check_fluid(body: &BodyClause, gravity: bool, scalar: &str, context: &mut Context) {
    let Some(name) = &body.name else { return };
    for given in &body.given {
        let displaced = body.given.iter().any(|other| other.role == Role::DisplacedMass);
        match given.role {
            Role::DisplacedMass => {
                let known = |role: Role| role != Role::Gravity || gravity;
                validate::check_companion(given.role, given.span, known, scalar, context);
            }
            Role::CenterOfBuoyancy if !displaced => context.error(
                given.span,
                format!(
                    "`{}` of `{name}` needs `displaced_mass`; without a displaced mass nothing acts there: add \
                     `displaced_mass = …`",
                    given.role.word()
                ),
            ),
            _ => {}
        }
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
