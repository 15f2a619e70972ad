//! `#[gauss(…)]` as clauses: `name`, `name = value` and `name(…)`, separated by commas.
//!
//! Attributes are cut at their commas before anything is parsed, so a mistake in one clause hides none in the next.

use super::context::Context;
use super::words::{self, Table};
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::{Attribute, Expr, ExprLit, Lit, LitStr, MacroDelimiter, Meta};

/// Owner of an attribute, for the wording of messages.
#[derive(Clone, Copy)]
pub enum Owner {
    Struct,
    Field,
    /// In the brackets of `kinematics(…)`.
    Kinematics,
    /// In the brackets of `body(…)`.
    Body,
    /// In the brackets of `frame(…)`.
    Frame,
    /// In the brackets of `particle(…)`.
    Particle,
    /// In the brackets of `point(…)`.
    Point,
    /// In the brackets of `constraint(…)`.
    Constraint,
    /// In the brackets of `states(…)`.
    States,
    /// In the brackets of `define(…)`.
    Define,
    /// In the brackets of a clause of a force element, which begins with this word.
    Action {
        word: &'static str,
        example: &'static str,
    },
}

impl Owner {
    fn example(self) -> &'static str {
        match self {
            Owner::Struct => "a clause such as `chart = hybrid`",
            Owner::Field => "a role such as `mass`",
            Owner::Kinematics => "an equation such as `x = v`",
            Owner::Body | Owner::Frame | Owner::Particle => "an argument such as `position = [x, y, 0]`",
            Owner::Point => "an argument such as `at = [l, 0, 0]`",
            Owner::Constraint => "`position = …` or `velocity = …`",
            Owner::States => "the rate of a state such as `x = (u - x) / tau`",
            Owner::Define => "a definition such as `u = body.relative_velocity`",
            Owner::Action { example, .. } => example,
        }
    }

    /// Whose words these are.
    fn owner(self) -> &'static str {
        match self {
            Owner::Struct | Owner::Field => "gauss",
            Owner::Kinematics => "kinematics",
            Owner::Body => "body",
            Owner::Frame => "frame",
            Owner::Particle => "particle",
            Owner::Point => "point",
            Owner::Constraint => "constraint",
            Owner::States => "states",
            Owner::Define => "define",
            Owner::Action { word, .. } => word,
        }
    }
}

/// One clause.
pub struct Clause {
    pub name: Ident,
    pub value: Content,
}

/// Tokens after the name of a clause.
pub enum Content {
    /// Nothing.
    Absent,
    /// `= tokens`; there is at least one token.
    Equals(Vec<TokenTree>),
    /// `(tokens)`.
    Brackets(Group),
    /// Something wrong, already noted.
    Malformed,
}

/// A bare word with what stands in brackets after it: `hybrid`, `jet(euler_zyx)`.
pub struct Word {
    pub ident: Ident,
    pub arguments: Option<Group>,
}

impl Clause {
    /// The name without `r#`.
    pub fn word(&self) -> String {
        self.name.unraw().to_string()
    }

    /// The clause as it was written, for messages that name it.
    pub fn written(&self) -> String {
        match &self.value {
            Content::Equals(tokens) => format!("{} = {}", self.name, written(tokens)),
            Content::Brackets(group) => format!("{}{}", self.name, written(&[TokenTree::Group(group.clone())])),
            Content::Absent | Content::Malformed => self.name.to_string(),
        }
    }

    /// The value as a bare word of `table`. Mistakes are noted, with `table` for the remedy.
    pub fn bare_word<T: Copy>(&self, table: &Table<T>, context: &mut Context) -> Option<Word> {
        let name = &self.name;
        let tokens = match &self.value {
            Content::Malformed => return None,
            Content::Equals(tokens) => flat(tokens.iter().cloned().collect()),
            Content::Absent => {
                context.error(
                    name.span(),
                    format!("`{name}` needs a value; write `{name} = …` with {}", words::list(table)),
                );
                return None;
            }
            Content::Brackets(group) => {
                let inner = written(&flat(group.stream()));
                let remedy = if inner.is_empty() {
                    format!("write `{name} = …` with {}", words::list(table))
                } else {
                    format!("write `{name} = {inner}`")
                };
                context
                    .error(group.span_open(), format!("the value of `{name}` follows `=`, without brackets; {remedy}"));
                return None;
            }
        };
        let (ident, rest) = match tokens.split_first() {
            Some((TokenTree::Ident(ident), rest)) => (ident, rest),
            Some((other, _)) => {
                not_a_word(name, Some(name), other, table, context);
                return None;
            }
            None => return None,
        };
        let (arguments, rest) = match rest.split_first() {
            Some((TokenTree::Group(group), rest)) if group.delimiter() == Delimiter::Parenthesis => {
                (Some(group.clone()), rest)
            }
            _ => (None, rest),
        };
        if let Some(extra) = rest.first() {
            context.error(
                start(extra),
                format!(
                    "expected `,` after `{}`, found {}; separate clauses by commas",
                    self.written_until(rest.len()),
                    found(extra)
                ),
            );
            return None;
        }
        Some(Word { ident: ident.clone(), arguments })
    }

    /// The clause without its last `dropped` tokens.
    fn written_until(&self, dropped: usize) -> String {
        match &self.value {
            Content::Equals(tokens) => {
                format!("{} = {}", self.name, written(&tokens[..tokens.len().saturating_sub(dropped)]))
            }
            _ => self.name.to_string(),
        }
    }
}

/// Notes that `token` stands where a word of `table` belongs; a string literal gets the word that it quotes as remedy.
/// `owner` is what takes the word; `clause` is its name when the word follows `=`, and none when it stands in brackets.
pub fn not_a_word<T: Copy>(
    owner: &Ident,
    clause: Option<&Ident>,
    token: &TokenTree,
    table: &Table<T>,
    context: &mut Context,
) {
    let quoted = match token {
        TokenTree::Literal(literal) => syn::parse_str::<LitStr>(&literal.to_string()).ok().map(|text| text.value()),
        _ => None,
    };
    let message = match quoted {
        Some(text) => {
            let head = text.split('(').next().unwrap_or_default().trim();
            let remedy = match words::nearest(head, table) {
                Some((name, _)) => {
                    // Brackets of a well-spelt word are kept: "jet(euler_zyx)" → jet(euler_zyx).
                    let word = if name == head { text.trim() } else { name };
                    match clause {
                        Some(clause) => format!("write `{clause} = {word}`"),
                        None => format!("write `{owner}({word})`"),
                    }
                }
                None => format!("expected {}", words::list(table)),
            };
            format!("`{owner}` takes a bare word, not a string; {remedy}")
        }
        None => format!("`{owner}` takes a word, found {}; expected {}", found(token), words::list(table)),
    };
    context.error(start(token), message);
}

/// All clauses of the `gauss` attributes among `attributes`, in order.
pub fn clauses(attributes: &[Attribute], place: Owner, context: &mut Context) -> Vec<Clause> {
    let mut clauses = Vec::new();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("gauss")) {
        match &attribute.meta {
            Meta::List(list) if !matches!(list.delimiter, MacroDelimiter::Paren(_)) => {
                context.error_at(
                    &list.path,
                    format!("`gauss` takes round brackets; write `#[gauss(…)]` with {}", place.example()),
                );
            }
            Meta::List(list) if !list.tokens.is_empty() => split(list.tokens.clone(), place, &mut clauses, context),
            Meta::List(list) => {
                context.error_at(&list.path, format!("`#[gauss()]` is empty; write {} or remove it", place.example()));
            }
            Meta::Path(path) => {
                context.error_at(
                    path,
                    format!("`#[gauss]` is empty; write `#[gauss(…)]` with {} or remove it", place.example()),
                );
            }
            Meta::NameValue(pair) => {
                let remedy = match &pair.value {
                    Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => format!("write `#[gauss({})]`", text.value()),
                    Expr::Path(word) => format!("write `#[gauss({})]`", written(&flat(word.to_token_stream()))),
                    _ => format!("write `#[gauss(…)]` with {}", place.example()),
                };
                context.error_at(&pair.path, format!("`gauss` takes its clauses in brackets, not after `=`; {remedy}"));
            }
        }
    }
    clauses
}

/// Cuts tokens at their commas and reads each piece as a clause.
pub fn split(tokens: TokenStream, place: Owner, clauses: &mut Vec<Clause>, context: &mut Context) {
    for piece in pieces(tokens, place.example(), context) {
        clauses.extend(clause(piece, place, context));
    }
}

/// Cuts tokens at their commas. Invisible groups are opened where a piece begins, since there they hold names or whole
/// clauses; further on they may hold an expression, which must stay one operand.
pub fn pieces(tokens: TokenStream, example: &str, context: &mut Context) -> Vec<Vec<TokenTree>> {
    let mut pieces = vec![Vec::new()];
    cut(tokens, &mut pieces, example, context);
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

fn cut(tokens: TokenStream, pieces: &mut Vec<Vec<TokenTree>>, example: &str, context: &mut Context) {
    for token in tokens {
        let begins = pieces.last().is_none_or(Vec::is_empty);
        match token {
            TokenTree::Punct(comma) if comma.as_char() == ',' => {
                if begins {
                    context.error(comma.span(), format!("expected {example} before `,`"));
                } else {
                    pieces.push(Vec::new());
                }
            }
            TokenTree::Group(group) if begins && group.delimiter() == Delimiter::None => {
                cut(group.stream(), pieces, example, context);
            }
            other => match pieces.last_mut() {
                Some(piece) => piece.push(other),
                None => pieces.push(vec![other]),
            },
        }
    }
}

/// Reads the tokens between two commas.
fn clause(piece: Vec<TokenTree>, place: Owner, context: &mut Context) -> Option<Clause> {
    let mut tokens = piece.into_iter();
    let name = match tokens.next()? {
        TokenTree::Ident(name) => name,
        TokenTree::Literal(literal) => {
            let remedy = match (syn::parse_str::<LitStr>(&literal.to_string()), place) {
                (Ok(text), Owner::Struct | Owner::Field) => {
                    format!("write `#[gauss({})]` without quotes", text.value())
                }
                _ => format!("write {}", place.example()),
            };
            let owner = place.owner();
            context.error(literal.span(), format!("`{owner}` takes words, found {literal}; {remedy}"));
            return None;
        }
        other => {
            context.error(start(&other), format!("expected {}, found {}", place.example(), found(&other)));
            return None;
        }
    };
    let value = match tokens.next() {
        None => Content::Absent,
        Some(TokenTree::Punct(equals)) if equals.as_char() == '=' => {
            let rest: Vec<TokenTree> = tokens.collect();
            if rest.is_empty() {
                context.error(equals.span(), format!("nothing follows `{name} =`; write a value or remove the clause"));
                Content::Malformed
            } else {
                Content::Equals(rest)
            }
        }
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis => match tokens.next() {
            None => Content::Brackets(group),
            Some(extra) => {
                context.error(
                    start(&extra),
                    format!("expected `,` after `{name}(…)`, found {}; separate clauses by commas", found(&extra)),
                );
                Content::Malformed
            }
        },
        Some(other) => {
            context.error(start(&other), format!("expected `=` or `,` after `{name}`, found {}", found(&other)));
            Content::Malformed
        }
    };
    Some(Clause { name, value })
}

/// The tokens, taken out of the invisible groups that `macro_rules!` puts around its fragments.
pub fn flat(tokens: TokenStream) -> Vec<TokenTree> {
    let mut flattened = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => flattened.extend(flat(group.stream())),
            other => flattened.push(other),
        }
    }
    flattened
}

/// Place at which a mistake at `token` is shown: a bracketed group by its opening bracket.
pub fn start(token: &TokenTree) -> Span {
    match token {
        TokenTree::Group(group) => group.span_open(),
        other => other.span(),
    }
}

/// `token` in a message.
pub fn found(token: &TokenTree) -> String {
    match token {
        TokenTree::Literal(literal) => format!("the literal `{literal}`"),
        TokenTree::Group(group) => match group.delimiter() {
            Delimiter::Parenthesis => "`(`".into(),
            Delimiter::Bracket => "`[`".into(),
            Delimiter::Brace => "`{`".into(),
            Delimiter::None => "an interpolated fragment".into(),
        },
        other => format!("`{other}`"),
    }
}

/// Tokens as their author would write them, near enough for a message.
pub fn written(tokens: &[TokenTree]) -> String {
    let mut text = String::new();
    let mut after_word = false;
    for token in tokens {
        let word = matches!(token, TokenTree::Ident(_) | TokenTree::Literal(_));
        if word && after_word {
            text.push(' ');
        }
        match token {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::None => ("", ""),
                };
                text.push_str(open);
                text.push_str(&written(&flat(group.stream())));
                text.push_str(close);
            }
            TokenTree::Punct(comma) if comma.as_char() == ',' => text.push_str(", "),
            other => text.push_str(&other.to_string()),
        }
        after_word = word;
    }
    text
}
