//! The structs of a file.
//!
//! Of the file only the tokens are read, and of those only the structs: the rest is the compiler's, and may be nested
//! as deeply as that reads it.

use std::path::Path;

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use syn::{DeriveInput, Error};

/// A struct as it is written, with its attributes.
struct Found {
    name: Ident,
    tokens: TokenStream,
    derived: bool,
}

/// The structs of these names, wherever in the modules of the file they are; without names all that derive their
/// dynamics.
///
/// # Errors
/// A sentence for every name that no struct has; that there is no struct at all; at its place what is no struct.
pub fn find(file: TokenStream, names: &[String]) -> Result<Vec<DeriveInput>, Error> {
    let all = gather(file);
    let read = |found: &Found| gauss_codegen::item(found.tokens.clone());
    let derived = || all.iter().filter(|found| found.derived);
    if names.is_empty() {
        let none = || Error::new(proc_macro2::Span::call_site(), "no struct of this file derives GaussDynamics");
        derived().next().ok_or_else(none)?;
        return collected(derived().map(read));
    }
    collected(names.iter().map(|name| match all.iter().find(|found| found.name == name) {
        Some(found) => read(found),
        None => {
            let known: Vec<String> = derived().map(|found| found.name.to_string()).collect();
            let list = if known.is_empty() { "none that derives GaussDynamics".to_owned() } else { known.join(", ") };
            let message = format!("there is no struct `{name}` in this file; there is {list}");
            Err(Error::new(proc_macro2::Span::call_site(), message))
        }
    }))
}

/// Every mistake with its place.
pub fn located(file: &Path, mistakes: &Error) -> String {
    let lines = mistakes.into_iter().map(|mistake| {
        let start = mistake.span().start();
        format!("{}:{}:{}: {mistake}", file.display(), start.line, start.column + 1)
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// All of them, or all mistakes.
fn collected(all: impl Iterator<Item = Result<DeriveInput, Error>>) -> Result<Vec<DeriveInput>, Error> {
    let (mut items, mut mistakes) = (Vec::new(), None::<Error>);
    for item in all {
        match (item, &mut mistakes) {
            (Ok(item), _) => items.push(item),
            (Err(error), Some(before)) => before.combine(error),
            (Err(error), none) => *none = Some(error),
        }
    }
    mistakes.map_or(Ok(items), Err)
}

/// Structs of a file and of the modules in it, in their order.
fn gather(file: TokenStream) -> Vec<Found> {
    let mut found = Vec::new();
    // What is left of the levels around the one that is read.
    let mut levels = vec![(Vec::<TokenTree>::new(), file.into_iter())];
    while let Some((before, rest)) = levels.last_mut() {
        let Some(token) = rest.next() else {
            levels.pop();
            continue;
        };
        let inside = match &token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let is_module =
                    matches!(before.as_slice(), [.., TokenTree::Ident(word), TokenTree::Ident(_)] if word == "mod");
                is_module.then(|| group.stream())
            }
            _ => None,
        };
        let ends = match &token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            TokenTree::Punct(punct) => punct.as_char() == ';',
            _ => false,
        };
        before.push(token);
        if ends {
            found.extend(of_item(&std::mem::take(before)));
        }
        if let Some(inside) = inside {
            levels.push((Vec::new(), inside.into_iter()));
        }
    }
    found
}

/// The struct that the tokens up to the end of an item are.
fn of_item(tokens: &[TokenTree]) -> Option<Found> {
    let is_word = |token: &TokenTree, text: &str| matches!(token, TokenTree::Ident(word) if word == text);
    let keyword = tokens.iter().position(|token| is_word(token, "struct"))?;
    let Some(TokenTree::Ident(name)) = tokens.get(keyword + 1) else { return None };
    // Before it: how it is seen, and attributes.
    let mut start = keyword;
    if matches!(tokens[..start].last(), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis) {
        start -= 1;
    }
    if tokens[..start].last().is_some_and(|token| is_word(token, "pub")) {
        start -= 1;
    }
    let mut derived = false;
    while let [.., TokenTree::Punct(sign), TokenTree::Group(group)] = &tokens[..start] {
        if sign.as_char() != '#' || group.delimiter() != Delimiter::Bracket {
            break;
        }
        derived |= derives(group.stream());
        start -= 2;
    }
    Some(Found { name: name.clone(), tokens: tokens[start..].iter().cloned().collect(), derived })
}

/// Whether an attribute is `derive(…)` with GaussDynamics in it.
fn derives(attribute: TokenStream) -> bool {
    let tokens: Vec<TokenTree> = attribute.into_iter().collect();
    let [TokenTree::Ident(word), TokenTree::Group(list)] = tokens.as_slice() else { return false };
    let named = |token: TokenTree| matches!(token, TokenTree::Ident(word) if word == "GaussDynamics");
    word == "derive" && list.stream().into_iter().any(named)
}
