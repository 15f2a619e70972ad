//! Depth of tokens and expressions. What reads them calls itself once a level, so depth is refused before anything is
//! read: within the compiler a macro has a few megabytes of stack, and an overflow could not be reported.

use proc_macro2::token_stream::IntoIter;
use proc_macro2::{Group, Span, TokenStream, TokenTree};

use crate::model::scene::expression::Expression;

/// Brackets within brackets, and operators before operators, that are read.
pub const DEEPEST: usize = 128;

/// Levels of an expression, of which a pair of brackets can be two: a call and an operator in it.
pub const LEVELS: usize = 2 * DEEPEST;

/// Brackets within brackets up to which syn can be given the tokens of attributes.
const BRACKETS: usize = 500;

/// Tokens of one level while they are counted.
struct TokenLevel {
    rest: IntoIter,
    /// The levels around it.
    around: usize,
    /// Signs before signs, and calls on calls, of the operand that is being read.
    operand: usize,
    /// Tokens that only other languages put between operands; they can nest to the right without brackets.
    foreign: usize,
    /// Angle brackets of types that are open.
    angles: usize,
    /// Kind of the token before.
    after: PrecedingToken,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum PrecedingToken {
    /// The sign of an attribute, whose tokens are read by themselves.
    Hash,
    Operator,
    Word,
    Operand,
}

impl TokenLevel {
    fn new(tokens: TokenStream, around: usize) -> Self {
        Self { rest: tokens.into_iter(), around, operand: 0, foreign: 0, angles: 0, after: PrecedingToken::Operator }
    }

    fn depth(&self) -> usize {
        self.around + self.operand + self.foreign + self.angles
    }

    /// Counts a token; the tokens inside of it, if it has brackets.
    fn read(&mut self, token: TokenTree) -> Option<TokenStream> {
        let before = self.after;
        self.after = match &token {
            TokenTree::Punct(sign) => {
                match sign.as_char() {
                    ',' | ';' => (self.operand, self.foreign) = (0, 0),
                    '+' | '-' | '*' | '/' if matches!(before, PrecedingToken::Word | PrecedingToken::Operand) => {
                        self.operand = 0
                    }
                    '-' => self.operand += 1,
                    '.' => self.operand += 1,
                    '<' => self.angles += 1,
                    '>' => self.angles = self.angles.saturating_sub(1),
                    _ => self.foreign += 1,
                }
                if sign.as_char() == '#' { PrecedingToken::Hash } else { PrecedingToken::Operator }
            }
            TokenTree::Ident(_) => {
                self.foreign += usize::from(before == PrecedingToken::Word);
                PrecedingToken::Word
            }
            TokenTree::Literal(_) | TokenTree::Group(_) => PrecedingToken::Operand,
        };
        match token {
            TokenTree::Group(group) if before != PrecedingToken::Hash || is_parsed(&group) => Some(group.stream()),
            _ => None,
        }
    }
}

/// Whether syn reads the contents of an attribute: `#[name = …]`, whose value is an expression.
fn is_parsed(attribute: &Group) -> bool {
    attribute.stream().into_iter().any(|token| matches!(token, TokenTree::Punct(sign) if sign.as_char() == '='))
}

/// The first token that is too deep, if there is one.
pub fn too_deep(tokens: TokenStream) -> Option<Span> {
    let mut levels = vec![TokenLevel::new(tokens, 0)];
    while let Some(level) = levels.last_mut() {
        let Some(token) = level.rest.next() else {
            levels.pop();
            continue;
        };
        let span = token.span();
        let inner = level.read(token);
        let depth = level.depth();
        if depth > DEEPEST {
            return Some(span);
        }
        if let Some(inner) = inner {
            levels.push(TokenLevel::new(inner, depth + 1));
        }
    }
    None
}

/// The same for an item as a whole, in whose attributes only brackets are counted: what they say is read afterwards.
pub fn item_too_deep(tokens: TokenStream) -> Option<Span> {
    let mut levels = vec![tokens.clone().into_iter()];
    while let Some(level) = levels.last_mut() {
        match level.next() {
            Some(TokenTree::Group(group)) if levels.len() > BRACKETS => return Some(group.span_open()),
            Some(TokenTree::Group(group)) => levels.push(group.stream().into_iter()),
            Some(_) => {}
            None => {
                levels.pop();
            }
        }
    }
    too_deep(tokens)
}

/// The number of nested levels of an expression; `named` gives that of a name.
pub fn depth(expression: &Expression, named: &dyn Fn(&Expression) -> usize) -> usize {
    let mut deepest = 0;
    expression.parts(&mut |part| deepest = deepest.max(depth(part, named)));
    1 + deepest + named(expression)
}
