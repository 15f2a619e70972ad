//! Definitions: expressions with names. Each is checked by itself and then once more wherever its name stands, since what it may
//! contain depends on that. Afterwards its tree takes the place of its name, so that nothing behind the model knows of it.

use super::kinds;
use super::places::Place;
use super::scope::Scope;
use crate::model::language::context::Context;
use crate::model::language::declarations::Definition;
use crate::model::language::statements::Statements;
use crate::model::language::words::word;
use crate::model::scene::expression::{Expression, ExpressionKind};
use proc_macro2::Ident;
use syn::ext::IdentExt;

/// Parts that a definition may have when those that it names are written out: far more than anyone writes, and few enough
/// that the tree is built in no time.
const LIMIT: usize = 100_000;

/// Checks every definition by itself, in order, and tells the scope what each stands for.
pub fn check(definitions: &[Definition], scope: &mut Scope, context: &mut Context) {
    let mut sizes: Vec<usize> = Vec::new();
    for (index, Definition { name, expression }) in definitions.iter().enumerate() {
        let size = expression.as_ref().map_or(0, |expression| size(expression, &definitions[..index], &sizes));
        let well = match expression {
            Some(_) if size > LIMIT => {
                context.error(
                    name.span(),
                    format!(
                        "`{name}` has more than {LIMIT} parts when the definitions that it names are written out; name them \
                         less often"
                    ),
                );
                None
            }
            Some(expression) => kinds::check(expression, Place::Definition, scope, context).and(Some(expression)),
            None => None,
        };
        // Of those that name it it is not said again.
        sizes.push(if size > LIMIT { 1 } else { size });
        scope.define(well.cloned());
    }
}

/// How many parts an expression has with earlier definitions written out.
fn size(expression: &Expression, earlier: &[Definition], sizes: &[usize]) -> usize {
    let mut total = 0;
    expression.walk(&mut |part| {
        let own = match &part.kind {
            ExpressionKind::Name(name) => find(earlier, name).map_or(1, |index| sizes[index]),
            _ => 1,
        };
        total += own;
    });
    total
}

fn find(definitions: &[Definition], name: &Ident) -> Option<usize> {
    definitions.iter().position(|definition| word(&definition.name) == word(name))
}

/// Definitions whose names stand nowhere.
pub fn unused(statements: &Statements, all: &[&Expression]) -> Vec<Ident> {
    let definitions = &statements.definitions;
    let named = |name: &Ident| {
        let word = name.unraw().to_string();
        let by_definition = definitions.iter().filter_map(|other| other.expression.as_ref());
        all.iter().copied().chain(by_definition).any(|expression| expression.names(&word))
    };
    definitions.iter().map(|definition| &definition.name).filter(|name| !named(name)).cloned().collect()
}

/// Puts definitions in the place of their names, everywhere.
pub fn inline(statements: &mut Statements) {
    let mut written_out: Vec<(Ident, Expression)> = Vec::new();
    for definition in std::mem::take(&mut statements.definitions) {
        let Some(mut expression) = definition.expression else { continue };
        replace(&mut expression, &written_out);
        written_out.push((definition.name, expression));
    }
    if !written_out.is_empty() {
        statements.each_expression(&mut |expression| replace(expression, &written_out));
    }
}

fn replace(expression: &mut Expression, definitions: &[(Ident, Expression)]) {
    if let ExpressionKind::Name(name) = &expression.kind {
        if let Some((_, meant)) = definitions.iter().find(|(defined, _)| word(defined) == word(name)) {
            *expression = meant.clone();
        }
        return;
    }
    expression.each_part(&mut |part| replace(part, definitions));
}
