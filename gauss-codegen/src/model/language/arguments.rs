//! Contents of the brackets of a clause: its arguments, names, values and units.

use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::words::{self, Table};
use super::{arithmetic, synonyms, units};
use crate::model::scene::expression::Expression;
use proc_macro2::{Group, Ident, Span, TokenTree};
use syn::LitStr;

/// The clause that says a unit.
pub const UNIT: &str = "unit";

/// The brackets of a clause that needs them.
pub fn brackets<'a>(clause: &'a Clause, example: &str, context: &mut Context) -> Option<&'a Group> {
    let name = &clause.name;
    match &clause.value {
        Content::Malformed => None,
        Content::Brackets(group) if !group.stream().is_empty() => Some(group),
        Content::Brackets(group) => {
            context.error(group.span_open(), format!("`{name}()` is empty; write `{name}({example})` or remove it"));
            None
        }
        Content::Absent => {
            context.error(name.span(), format!("`{name}` is empty; write `{name}({example})`"));
            None
        }
        Content::Equals(tokens) => {
            let span = tokens.first().map_or(name.span(), attributes::start);
            context.error(span, format!("`{name}` takes brackets, not `=`; write `{name}({example})`"));
            None
        }
    }
}

/// A name that expressions can use: no keyword.
pub fn name(ident: &Ident, noun: &str, context: &mut Context) -> Option<Ident> {
    // The tokens of macros have keywords and `_` as identifiers; syn's have not.
    match syn::parse2::<Ident>(TokenTree::Ident(ident.clone()).into()) {
        Ok(ident) => Some(ident),
        Err(_) => {
            context.error(ident.span(), format!("`{ident}` is a keyword of Rust and cannot name {}", words::a(noun)));
            None
        }
    }
}

/// The arguments in the brackets of a clause, and whether all of them could be read.
pub fn arguments(group: &Group, place: Owner, context: &mut Context) -> (Vec<Clause>, bool) {
    let mut arguments = Vec::new();
    attributes::split(group.stream(), place, &mut arguments, context);
    let written = attributes::pieces(group.stream(), "", &mut Context::default()).len();
    let complete = written == arguments.len();
    (arguments, complete)
}

/// The expression that an argument is said to be.
pub fn value(argument: &Clause, example: &str, context: &mut Context) -> Option<Expression> {
    arithmetic::read(&argument.word(), equals(argument, example, context)?, context)
}

/// Tokens after `=`.
pub fn equals<'a>(argument: &'a Clause, example: &str, context: &mut Context) -> Option<&'a [TokenTree]> {
    let name = &argument.name;
    match &argument.value {
        Content::Malformed => None,
        Content::Equals(tokens) => Some(tokens),
        Content::Absent => {
            context.error(name.span(), format!("`{name}` needs a value; write `{name} = {example}`"));
            None
        }
        Content::Brackets(group) => {
            context.error(
                group.span_open(),
                format!("the value of `{name}` follows `=`, without brackets; write `{name} = {example}`"),
            );
            None
        }
    }
}

/// Whether an argument is in the table, and that it is new; if not, that is noted.
pub fn known<T: Copy>(
    argument: &Clause,
    owner: &str,
    table: &Table<T>,
    given: &mut Vec<String>,
    context: &mut Context,
) -> bool {
    let word = argument.word();
    // The message reads "unknown argument of `body`: `positon`; …".
    let noun = format!("argument of `{owner}`:");
    if let Some((name, note)) =
        synonyms::argument(&word, table).filter(|(name, _)| !given.iter().any(|word| word == name))
    {
        context.error(argument.name.span(), format!("unknown {noun} `{word}`; write `{name}`{note}"));
        return false;
    }
    if let Some(remedy) = law(&word, table) {
        context.error(argument.name.span(), format!("unknown {noun} `{word}`; {remedy}"));
        return false;
    }
    if words::resolve(&noun, &argument.name, table, context).is_err() {
        return false;
    }
    if given.contains(&word) {
        context.error(argument.name.span(), format!("`{word}` is given twice; keep one of the two"));
    }
    given.push(word);
    true
}

/// Replacement for an argument that is none, but a law of friction.
pub fn law<T: Copy>(word: &str, table: &Table<T>) -> Option<&'static str> {
    let is_one = table.iter().any(|(name, _)| *name == word);
    synonyms::instead(word, synonyms::LAWS).filter(|_| !is_one)
}

/// The argument that an unknown word stands for, so that it is not missing as well.
pub fn meant<T: Copy>(word: &str, table: &Table<T>) -> Option<&'static str> {
    synonyms::argument(word, table)
        .or_else(|| words::nearest(word, table).map(|(name, _)| (name, "")))
        .map(|(name, _)| name)
}

/// The unit in quotes that follows `=`, which is at `span` if nothing does: its text and where it is written; `owner`
/// has it.
pub fn read_unit(owner: &Ident, tokens: &[TokenTree], span: Span, context: &mut Context) -> Option<(String, Span)> {
    let tokens = attributes::flat(tokens.iter().cloned().collect());
    let text = match tokens.as_slice() {
        [TokenTree::Literal(literal)] => syn::parse_str::<LitStr>(&literal.to_string()).ok(),
        _ => None,
    };
    let span = tokens.first().map_or(span, attributes::start);
    let Some(text) = text.map(|text| text.value()) else {
        let written = attributes::written(&tokens);
        let plain = |c: char| c.is_alphanumeric() || " */^()-".contains(c);
        let example = if written.is_empty() || !written.chars().all(plain) { "N s/m" } else { written.as_str() };
        context.error(span, format!("a unit stands in quotes after `=`; write `{owner} = \"{example}\"`"));
        return None;
    };
    match units::read(&text) {
        Ok(_) => Some((text, span)),
        Err(message) => {
            context.error(span, message);
            None
        }
    }
}
