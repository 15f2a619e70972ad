//! Fields that are six by six, or the diagonal of that: the coefficients of drags, and added masses.

use crate::model::language::context::Context;
use crate::model::language::fields::ReadField;
use crate::model::language::shapes::TypeKind;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, same, word};
use crate::model::names::scope::Scope;
use crate::model::scene::clauses::{Coefficients, RoleValue};
use crate::model::scene::forces::ArgumentContent;
use crate::terms::Shape;
use proc_macro2::Ident;

/// The fields that are six by six or the diagonal of that, with what they are: the coefficients of drags, and added
/// masses.
pub fn fields<'a>(statements: &'a Statements) -> Vec<(&'a Ident, String)> {
    let mut all: Vec<(&Coefficients, String)> = Vec::new();
    for clause in &statements.forces {
        let what = format!("the coefficients of {} are", words::a(clause.noun()));
        all.extend(clause.given.iter().filter_map(|given| match &given.value {
            ArgumentContent::Coefficients(coefficients) => Some((coefficients, what.clone())),
            ArgumentContent::Expression(_) | ArgumentContent::Reference(_) | ArgumentContent::Axes(_) => None,
        }));
    }
    for clause in statements.all_role_clauses() {
        if let RoleValue::Coefficients(coefficients) = &clause.value {
            all.push((coefficients, "an added mass is".into()));
        }
    }
    let field = |(coefficients, what): (&'a Coefficients, String)| match coefficients {
        Coefficients::Field(name) => Some((name, what)),
        Coefficients::Diagonal(_) => None,
    };
    all.into_iter().filter_map(field).collect()
}

/// Coefficients that are fields are six or a matrix.
pub fn check(statements: &Statements, fields: &[ReadField<'_>], scope: &Scope, scalar: &str, context: &mut Context) {
    let expected = format!(
        "six scalars in a list `[a, b, c, d, e, f]`, a `Vector6<{scalar}>` (diagonal) or a `Matrix6<{scalar}>` (full)"
    );
    for (name, what) in self::fields(statements) {
        let message = match fields.iter().find(|field| same(field.ident, name)) {
            Some(field) => match field.reading.kind {
                TypeKind::Known(Shape::Vector6 | Shape::Matrix6) => continue,
                TypeKind::Alias => format!(
                    "the kind of the field `{name}` cannot be read from {}; write `Vector6<{scalar}>` or `Matrix6<{scalar}>` \
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
                    let remedy = match words::nearest(&word(name), &table) {
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
