//! Reading of `modes(panel, coordinates = [a, b], translation = [[0, 0, d], …], …)`, and the shape of what is given,
//! there or in a file.

use super::arguments::{self, brackets, known};
use super::attributes::{self, Clause, Owner};
use super::context::Context;
use super::words::Table;
use super::{arithmetic, placements};
use crate::algebra::Rational;
use crate::model::scene::expression::{Expression, ExpressionKind};
use crate::model::scene::modes::{GivenIntegral, Integral, ModesClause};
use proc_macro2::{Delimiter, Ident, Span, TokenTree};
use syn::LitStr;

const EXAMPLE: &str = "panel, coordinates = [a, b], file = \"panel.json\"";
const ARGUMENTS: &Table<()> = &[
    ("coordinates", ()),
    ("file", ()),
    ("translation", ()),
    ("rotation", ()),
    ("mass", ()),
    ("damping", ()),
    ("stiffness", ()),
    ("inertia", ()),
    ("shortening", ()),
    ("gyroscopic", ()),
    ("second_inertia", ()),
];

/// The file of a clause.
pub struct ModesFile {
    /// As it is written, from the folder of the package.
    pub path: String,
    /// The string.
    pub span: Span,
}

/// A clause, and the file that its integrals are yet to come from.
pub struct ModesInput {
    pub clause: ModesClause,
    pub file: Option<ModesFile>,
}

/// Lists of lists of scalars, as deep as they are written.
pub enum NestedList {
    Scalar(Expression),
    List(Vec<NestedList>, Span),
}

/// `None` if something is missing or wrong, which is noted.
pub fn read(clause: &Clause, context: &mut Context) -> Option<ModesInput> {
    let earlier = context.count();
    let group = brackets(clause, EXAMPLE, context)?;
    let owner = Owner::Action { word: "modes", example: "an argument such as `coordinates = [a, b]`" };
    let (arguments, _) = arguments::arguments(group, owner, context);
    let (mut body, mut coordinates, mut file, mut written) = (None, None, None, Vec::new());
    let mut given = Vec::new();
    for (index, argument) in arguments.iter().enumerate() {
        if index == 0 && placements::may_be_name(argument, ARGUMENTS) {
            body = arguments::name(&argument.name, "body", context);
            continue;
        }
        if !known(argument, "modes", ARGUMENTS, &mut given, context) {
            continue;
        }
        match argument.word().as_str() {
            "coordinates" => coordinates = read_names(argument, context),
            "file" => file = read_file(argument, context),
            _ => written.push(argument),
        }
    }
    if context.count() > earlier {
        return None;
    }
    let span = clause.name.span();
    if body.is_none() {
        context.error(span, format!("modes are those of a body; write `modes({EXAMPLE})`"));
    }
    if coordinates.is_none() {
        context.error(span, "modes need a coordinate each; add `coordinates = [a, b]` with names of `coordinates(…)`");
    }
    let (body, coordinates): (Ident, Vec<Ident>) = (body?, coordinates?);
    if let (Some(file), Some(argument)) = (&file, written.first()) {
        context.error(
            argument.name.span(),
            format!("`{}` is in the file `{}`; keep one of the two", argument.name, file.path),
        );
    }
    let n = coordinates.len();
    let integrals: Vec<_> = written.into_iter().map(|argument| read_integral(argument, n, context)).collect();
    let integrals = integrals.into_iter().collect::<Option<_>>()?;
    Some(ModesInput { clause: ModesClause { body, coordinates, integrals, file: None, span }, file })
}

/// `[a, b]`: names.
fn read_names(argument: &Clause, context: &mut Context) -> Option<Vec<Ident>> {
    let tokens = attributes::flat(arguments::equals(argument, "[a, b]", context)?.iter().cloned().collect());
    let mut names = Vec::new();
    match tokens.as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => {
            for piece in attributes::pieces(group.stream(), "the name of a coordinate", context) {
                match piece.as_slice() {
                    [TokenTree::Ident(name)] => names.push(name.clone()),
                    [first, ..] => context.error(
                        attributes::start(first),
                        format!("expected the name of a coordinate, found {}", attributes::written(&piece)),
                    ),
                    [] => {}
                }
            }
        }
        [TokenTree::Ident(name)] => names.push(name.clone()),
        _ => {}
    }
    if names.is_empty() {
        let message = "`coordinates` are those of the modes, in their order; write `coordinates = [a, b]`";
        context.error(argument.name.span(), message);
        return None;
    }
    Some(names)
}

/// `"panel.json"`.
fn read_file(argument: &Clause, context: &mut Context) -> Option<ModesFile> {
    const EXAMPLE: &str = "\"panel.json\"";
    let tokens = attributes::flat(arguments::equals(argument, EXAMPLE, context)?.iter().cloned().collect());
    let text = match tokens.as_slice() {
        [TokenTree::Literal(literal)] => syn::parse_str::<LitStr>(&literal.to_string()).ok(),
        _ => None,
    };
    let span = tokens.first().map_or(argument.name.span(), attributes::start);
    match text.map(|text| text.value()).filter(|path| !path.is_empty()) {
        Some(path) => Some(ModesFile { path, span }),
        None => {
            let message = "`file` is the path of a file from the folder of the package, in quotes; write `file = \
                           \"panel.json\"`";
            context.error(span, message);
            None
        }
    }
}

fn read_integral(argument: &Clause, n: usize, context: &mut Context) -> Option<GivenIntegral> {
    let (_, integral) = Integral::ALL.into_iter().find(|(word, _)| argument.word() == *word)?;
    let example = if integral.is_matrix() { "[k, k]" } else { "[[0, 0, d], [0, 0, d]]" };
    let nested = nested(&argument.word(), arguments::equals(argument, example, context)?, context)?;
    match shaped(nested, integral, n) {
        Ok(entries) => Some(GivenIntegral { integral, entries, span: argument.name.span() }),
        Err((span, message)) => {
            context.error(span, message);
            None
        }
    }
}

/// Lists in brackets, and scalars in them.
fn nested(word: &str, tokens: &[TokenTree], context: &mut Context) -> Option<NestedList> {
    let flat = attributes::flat(tokens.iter().cloned().collect());
    match flat.as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => {
            let pieces = attributes::pieces(group.stream(), "an entry", context).into_iter();
            let entries: Vec<_> = pieces.map(|piece| nested(word, &piece, context)).collect();
            Some(NestedList::List(entries.into_iter().collect::<Option<_>>()?, group.span_open()))
        }
        _ => arithmetic::read(word, tokens, context).map(NestedList::Scalar),
    }
}

/// The entries of an integral of n modes, one after the other. A matrix may be given by its diagonal.
///
/// # Errors
/// What has another shape, where it is.
pub fn shaped(nested: NestedList, integral: Integral, n: usize) -> Result<Vec<Expression>, (Span, String)> {
    let word = integral.word();
    if let NestedList::List(rows, _) = &nested
        && integral.is_matrix()
        && rows.len() == n
        && rows.iter().all(|row| matches!(row, NestedList::Scalar(_)))
    {
        return Ok(on_diagonal(nested, n));
    }
    let mut entries = Vec::new();
    flatten(nested, &integral.sizes(n), &mut word.to_owned(), &mut entries)?;
    Ok(entries)
}

/// A square matrix with these on its diagonal.
fn on_diagonal(nested: NestedList, n: usize) -> Vec<Expression> {
    let NestedList::List(rows, span) = nested else { return Vec::new() };
    let zero = Expression { kind: ExpressionKind::Number { value: Rational::zero(), twin: None }, span };
    let mut entries = vec![zero; n * n];
    for (k, row) in rows.into_iter().enumerate() {
        if let NestedList::Scalar(e) = row {
            entries[k * n + k] = e;
        }
    }
    entries
}

fn flatten(
    nested: NestedList,
    sizes: &[usize],
    path: &mut String,
    entries: &mut Vec<Expression>,
) -> Result<(), (Span, String)> {
    let top = !path.contains('[');
    match (nested, sizes) {
        (NestedList::Scalar(e), []) => entries.push(e),
        (NestedList::List(_, span), []) => {
            return Err((span, format!("`{path}` is a number, found a list")));
        }
        (NestedList::Scalar(e), [size, ..]) => {
            let modes = if top { ", one for each mode" } else { "" };
            return Err((e.span, format!("`{path}` is a list of {size}{modes}, found a scalar")));
        }
        (NestedList::List(rows, span), [size, rest @ ..]) => {
            if rows.len() != *size {
                let modes = if top { ", one for each mode" } else { "" };
                let message = format!("`{path}` is a list of {size}{modes}, found {}", rows.len());
                return Err((span, message));
            }
            let length = path.len();
            for (k, row) in rows.into_iter().enumerate() {
                path.push_str(&format!("[{k}]"));
                flatten(row, rest, path, entries)?;
                path.truncate(length);
            }
        }
    }
    Ok(())
}
