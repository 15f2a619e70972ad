//! Fields that are six by six, or the diagonal of that: the coefficients of drags, and added masses.

use super::clauses::{Coefficients, ForceKind, GivenValue};
use super::context::Context;
use super::fields::ReadField;
use super::names::{self, same, word};
use super::roles::Shape;
use super::scope::Scope;
use super::shapes::TypeKind;
use super::statements::Statements;
use proc_macro2::Ident;

/// The fields that are six by six or the diagonal of that, with what they are: the coefficients of drags, and added masses.
pub(super) fn fields(statements: &Statements) -> Vec<(&Ident, &'static str)> {
    let mut all: Vec<(&Coefficients, &str)> = Vec::new();
    for clause in &statements.forces {
        let ForceKind::Drag { linear, quadratic, .. } = &clause.kind else { continue };
        all.extend(linear.iter().chain(quadratic).map(|coefficients| (coefficients, "the coefficients of a drag are")));
    }
    for given in statements.given.iter().chain(statements.bodies.iter().flat_map(|body| &body.given)) {
        if let GivenValue::Coefficients(coefficients) = &given.value {
            all.push((coefficients, "an added mass is"));
        }
    }
    let field = |(coefficients, what)| match coefficients {
        &Coefficients::Field(ref name) => Some((name, what)),
        Coefficients::Diagonal(_) => None,
    };
    all.into_iter().filter_map(field).collect()
}

/// Coefficients that are fields are six or a matrix.
pub(super) fn check(
    statements: &Statements,
    fields: &[ReadField<'_>],
    scope: &Scope,
    scalar: &str,
    context: &mut Context,
) {
    let expected = format!(
        "six scalars in a list `[a, b, c, d, e, f]`, a `Vector6<{scalar}>` (diagonal) or a `Matrix6<{scalar}>` (full)"
    );
    for (name, what) in self::fields(statements) {
        let message = match fields.iter().find(|field| same(field.ident, name)) {
            Some(field) => match field.reading.kind {
                TypeKind::Known(Shape::Vector6 | Shape::Matrix6) => continue,
                TypeKind::Alias => format!(
                    "what the field `{name}` is cannot be read from {}; write `Vector6<{scalar}>` or `Matrix6<{scalar}>` \
                     for its type",
                    field.reading.name
                ),
                _ => format!("the type of the field `{name}` is {}, and {what} {expected}", field.reading.name),
            },
            None => match scope.find(name, |_| false) {
                Ok(meaning) => {
                    format!("`{name}` is {}, and {what} {expected}", meaning.described())
                }
                Err(None) => continue,
                Err(Some(_)) => {
                    let six = |field: &&ReadField<'_>| {
                        matches!(field.reading.kind, TypeKind::Known(Shape::Vector6 | Shape::Matrix6))
                    };
                    let names: Vec<String> = fields.iter().filter(six).map(|field| word(field.ident)).collect();
                    let table: Vec<(&str, ())> = names.iter().map(|name| (name.as_str(), ())).collect();
                    let remedy = match names::nearest(&word(name), &table) {
                        Some((near, ())) if word(name).chars().count() > 1 => format!("did you mean `{near}`?"),
                        _ => format!("add `{name}: Matrix6<{scalar}>`, or write a list of six scalars"),
                    };
                    format!("no field is called `{name}`; {remedy}")
                }
            },
        };
        context.error(name.span(), message);
    }
}
