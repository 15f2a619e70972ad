//! Clauses that declare functions of one number: those of the user's own, and tables.

use super::arguments::{self, brackets, equals, known};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::placements::may_be_name;
use super::words::{self, Table};
use crate::terms::{FunctionKind, UserFunction};
use proc_macro2::{Ident, TokenTree};
use quote::ToTokens;
use syn::Path;
use syn::parse::Parser;
use syn::spanned::Spanned;

const FUNCTION: &Table<()> = &[("derivative", ()), ("second", ()), ("third", ())];
const TABLE: &Table<()> = &[("points", ()), ("kind", ())];
const KINDS: &Table<bool> = &[("linear", false), ("cubic", true)];

const IN_FUNCTION: Owner = Owner::Action { word: "function", example: "an argument such as `derivative = slope`" };
const IN_TABLE: Owner = Owner::Action { word: "table", example: "an argument such as `points = POINTS`" };

/// `function(lift, derivative = lift_slope)`, or
/// `function(lift = aero::lift, derivative = aero::lift_slope, second = …)`.
pub fn read_function(clause: &Clause, context: &mut Context) -> Option<UserFunction> {
    let group = brackets(clause, "lift, derivative = lift_slope", context)?;
    let (arguments, _) = arguments::arguments(group, IN_FUNCTION, context);
    let (first, further) = named(clause, &arguments, FUNCTION, "function", "derivative = …", context)?;
    let name = arguments::name(&first.name, "function", context)?;
    let own = match first.value {
        Content::Absent => Some(Path::from(name.clone())),
        _ => path(first, "a function `fn(f64) -> f64`", context),
    };
    let mut given = Vec::new();
    let mut derivatives = [None, None, None];
    for argument in further {
        if known(argument, "function", FUNCTION, &mut given, context) {
            let place = FUNCTION.iter().position(|(word, ())| *word == argument.word()).unwrap_or_default();
            derivatives[place] = Some((argument, path(argument, "a function `fn(f64) -> f64`", context)));
        }
    }
    let mut paths = vec![own?];
    for (k, derivative) in derivatives.into_iter().enumerate() {
        match derivative {
            Some((argument, _)) if paths.len() <= k => {
                let word = FUNCTION[k - 1].0;
                context.error(argument.name.span(), format!("derivatives are given in order; add `{word} = …`"));
                return None;
            }
            Some((_, path)) => paths.push(path?),
            None => {}
        }
    }
    let span = paths[0].span();
    let kind = FunctionKind::Rust(paths.iter().map(Path::to_token_stream).collect());
    Some(UserFunction { name, kind, span })
}

/// `table(lift, points = POINTS)`, or `table(lift, points = POINTS, kind = cubic)`.
pub fn read_table(clause: &Clause, context: &mut Context) -> Option<UserFunction> {
    let group = brackets(clause, "lift, points = POINTS", context)?;
    let (arguments, complete) = arguments::arguments(group, IN_TABLE, context);
    let (first, further) = named(clause, &arguments, TABLE, "table", "points = …", context)?;
    let name = arguments::name(&first.name, "table", context)?;
    let mut given = Vec::new();
    let (mut points, mut cubic) = (None, Some(false));
    for argument in further {
        match argument.word().as_str() {
            _ if !known(argument, "table", TABLE, &mut given, context) => {}
            "points" => points = Some(path(argument, "a constant array of points `[[x, y], …]`", context)),
            _ => {
                let word = argument.bare_word(KINDS, context);
                cubic = word.and_then(|word| words::resolve("kind of table", &word.ident, KINDS, context).ok());
            }
        }
    }
    if points.is_none() && complete {
        context.error(
            clause.name.span(),
            "a table needs its points; add `points = POINTS` and `const POINTS: [[f64; 2]; 2] = [[x, y], …];`",
        );
    }
    let kind = if cubic? { FunctionKind::Cubic } else { FunctionKind::Linear };
    let points = points??;
    Some(UserFunction { name, kind: kind(points.to_token_stream()), span: points.span() })
}

/// The first argument, which names the function, and the others.
fn named<'a>(
    clause: &Clause,
    arguments: &'a [Clause],
    table: &Table<()>,
    noun: &str,
    example: &str,
    context: &mut Context,
) -> Option<(&'a Clause, &'a [Clause])> {
    let (first, further) = arguments.split_first()?;
    let own = !table.iter().any(|(word, ())| first.word() == *word);
    if may_be_name(first, table) || (own && noun == "function" && matches!(first.value, Content::Equals(_))) {
        return Some((first, further));
    }
    context.error(
        clause.name.span(),
        format!("{} needs a name to be called by; write `{noun}(name, {example})`", words::a(noun)),
    );
    None
}

/// The path that an argument is said to be.
fn path(argument: &Clause, what: &str, context: &mut Context) -> Option<Path> {
    let tokens = attributes::flat(equals(argument, "name", context)?.to_vec().into_iter().collect());
    let parsed = Path::parse_mod_style.parse2(tokens.iter().cloned().collect());
    match (parsed, tokens.first()) {
        (Ok(path), _) => Some(path),
        (Err(_), Some(first)) => {
            let name: &Ident = &argument.name;
            let remedy = match first {
                TokenTree::Punct(bar) if bar.as_char() == '|' => "; closures have no name: write a `fn`",
                _ => "",
            };
            context.error(
                attributes::start(first),
                format!("`{name}` is the path of {what}, found {}{remedy}", attributes::found(first)),
            );
            None
        }
        _ => None,
    }
}
