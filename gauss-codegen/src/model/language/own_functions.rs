//! Clauses that declare functions: those of the user's own, of one number, and tables of up to three.

use super::arguments::{self, brackets, equals, known};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::placements::may_be_name;
use super::words::{self, Table};
use crate::algebra::MOST_VARIABLES;
use crate::terms::{self, Axis, FunctionKind, Interpolation, UserFunction};
use proc_macro2::{Delimiter, Ident, TokenTree};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Path, Token};

const FUNCTION: &Table<()> = &[("derivative", ()), ("second", ()), ("third", ())];
const TABLE: &Table<()> = &[("points", ()), ("axes", ()), ("values", ()), ("kind", ())];
const KINDS: &Table<Interpolation> =
    &[("linear", Interpolation::Linear), ("hermite", Interpolation::Hermite), ("cubic", Interpolation::Cubic)];

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

/// `table(lift, points = POINTS)`, `table(drag, axes = [ALPHA, MACH], values = DRAG)`, with `kind = cubic` or another.
pub fn read_table(clause: &Clause, context: &mut Context) -> Option<UserFunction> {
    let group = brackets(clause, "lift, points = POINTS", context)?;
    let (arguments, complete) = arguments::arguments(group, IN_TABLE, context);
    let (first, further) = named(clause, &arguments, TABLE, "table", "points = …", context)?;
    let name = arguments::name(&first.name, "table", context)?;
    let mut given = Vec::new();
    let (mut points, mut axes, mut values, mut joined) = (None, None, None, Some(Interpolation::Linear));
    for argument in further {
        match argument.word().as_str() {
            _ if !known(argument, "table", TABLE, &mut given, context) => {}
            "points" => points = Some((argument, path(argument, "a constant array of points `[[x, y], …]`", context))),
            "axes" => axes = Some((argument, read_axes(argument, context))),
            "values" => values = Some((argument, path(argument, "a constant array of values on the grid", context))),
            _ => {
                let word = argument.bare_word(KINDS, context);
                joined = word.and_then(|word| words::resolve("kind of table", &word.ident, KINDS, context).ok());
            }
        }
    }
    let (axes, values) = match (points, axes, values) {
        (Some((_, points)), None, None) => (Vec::new(), points),
        (None, Some((_, axes)), Some((_, values))) => (axes?, values),
        (found, axes, values) => {
            if complete {
                refuse_mixture(clause, [found.map(|f| f.0), axes.map(|a| a.0), values.map(|v| v.0)], context);
            }
            return None;
        }
    };
    let (values, joined) = (values?, joined?);
    let span = values.span();
    let kind = FunctionKind::Table(terms::Table { axes, values: values.to_token_stream(), joined });
    Some(UserFunction { name, kind, span })
}

/// A table by neither points alone nor axes with values.
fn refuse_mixture(clause: &Clause, [points, axes, values]: [Option<&Clause>; 3], context: &mut Context) {
    let (at, message) = match (points, axes, values) {
        (Some(points), ..) => (
            points,
            "a table is given by `points = …`, or by `axes = […]` and `values = …` on their grid; remove one of them",
        ),
        (None, Some(axes), _) => (axes, "a table with axes needs its values; add `values = VALUES`"),
        (None, None, Some(values)) => (values, "values of a table need the axes of their grid; add `axes = [X, Y]`"),
        _ => (
            clause,
            "a table needs its points; add `points = POINTS` and `const POINTS: [[f64; 2]; 2] = [[x, y], …];`, or \
             `axes = [X, Y]` and `values = VALUES`",
        ),
    };
    context.error(at.name.span(), message);
}

/// `axes = [ALPHA, MACH]`: one to three paths of constants.
fn read_axes(argument: &Clause, context: &mut Context) -> Option<Vec<Axis>> {
    let tokens = attributes::flat(equals(argument, "[X, Y]", context)?.to_vec().into_iter().collect());
    let shape =
        "`axes` are constant arrays of numbers that increase; write `axes = [X, Y]` and `const X: [f64; N] = …;`";
    let [TokenTree::Group(list)] = tokens.as_slice() else {
        let at = tokens.first().map_or(argument.name.span(), attributes::start);
        context.error(at, shape);
        return None;
    };
    if list.delimiter() != Delimiter::Bracket {
        context.error(list.span_open(), shape);
        return None;
    }
    let paths = match Punctuated::<Path, Token![,]>::parse_terminated.parse2(list.stream()) {
        Ok(paths) => paths,
        Err(error) => {
            context.error(error.span(), shape);
            return None;
        }
    };
    if paths.is_empty() || paths.len() > MOST_VARIABLES {
        let at = paths.iter().nth(MOST_VARIABLES).map_or(list.span_open(), Spanned::span);
        context.error(at, format!("a table has one, two or three axes, found {}", paths.len()));
        return None;
    }
    let axis = |path: &Path| Axis {
        path: path.to_token_stream(),
        variable: path.segments.last().map_or_else(String::new, |last| last.ident.unraw().to_string().to_lowercase()),
        span: path.span(),
    };
    Some(paths.iter().map(axis).collect())
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
