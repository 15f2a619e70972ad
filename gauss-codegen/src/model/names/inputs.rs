//! `input.elbow`: inputs by what they are called outside of expressions, as files of robots call joints and actuators.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use super::naming::declared;
use crate::model::language::context::Context;
use crate::model::language::fields::ReadField;
use crate::model::language::functions::PROPERTIES;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, INPUT, word};
use crate::model::scene::expression::{Expression, ExpressionKind};

/// Puts the names of inputs in the place of `input.elbow` in all expressions; notes what is no input.
pub fn name(statements: &mut Statements, fields: &[ReadField<'_>], context: &mut Context) {
    let own_meaning = declared(statements, fields).iter().any(|(name, _)| word(name) == INPUT);
    let inputs: Vec<(String, Ident)> = statements
        .inputs
        .iter()
        .flat_map(|names| &names.names)
        .map(|input| (input.called.unraw().to_string(), input.ident.clone()))
        .collect();
    let mut unknown: Vec<Ident> = Vec::new();
    let mut change = |expression: &mut Expression| replace(expression, &inputs, own_meaning, &mut unknown);
    statements.each_expression(&mut change);
    statements.definitions.iter_mut().filter_map(|own| own.expression.as_mut()).for_each(change);
    // Inputs of a file that could not be read are unknown, too.
    if statements.missed {
        return;
    }
    let table: Vec<(&str, ())> = inputs.iter().map(|(called, _)| (called.as_str(), ())).collect();
    for name in unknown {
        let found = name.unraw();
        let message = match (words::nearest(&found.to_string(), &table), own_meaning) {
            (_, true) => format!("`{INPUT}` has no `.{found}`"),
            (Some((near, ())), _) => format!("there is no input `{found}`; did you mean `{INPUT}.{near}`?"),
            (None, _) => format!("there is no input `{found}`; `input({found})` declares one"),
        };
        context.error(name.span(), message);
    }
}

fn replace(expression: &mut Expression, inputs: &[(String, Ident)], own_meaning: bool, unknown: &mut Vec<Ident>) {
    let asked = match &expression.kind {
        ExpressionKind::Input(name) => Some(name.unraw().to_string()),
        // Words that are properties of bodies and vectors as well.
        ExpressionKind::Component(base, index) if is_input(base) => {
            ["x", "y", "z"].get(*index).map(|w| (*w).to_owned())
        }
        ExpressionKind::Property(base, property) if is_input(base) => {
            PROPERTIES.iter().find(|(_, known)| known == property).map(|(word, _)| (*word).to_owned())
        }
        _ => None,
    };
    let Some(asked) = asked else {
        return expression.each_part(&mut |part| replace(part, inputs, own_meaning, unknown));
    };
    match (inputs.iter().find(|(called, _)| *called == asked), &expression.kind) {
        (Some((_, input)), _) if !own_meaning => {
            let name = Ident::new(&input.unraw().to_string(), expression.span);
            expression.kind = ExpressionKind::Name(name);
        }
        (_, ExpressionKind::Input(name)) => unknown.push(name.clone()),
        _ => {}
    }
}

fn is_input(expression: &Expression) -> bool {
    matches!(&expression.kind, ExpressionKind::Name(name) if word(name) == INPUT)
}
