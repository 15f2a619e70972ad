//! The mistakes found so far. Reading goes on after a mistake, so that one compilation shows them all.

use proc_macro2::Span;
use quote::ToTokens;
use std::fmt::Display;
use syn::Error;

/// Collects mistakes in the order in which they are found.
#[derive(Default)]
#[must_use = "`finish` reports the mistakes"]
pub struct Context {
    mistakes: Option<Error>,
    count: usize,
}

impl Context {
    /// Notes a mistake at one token.
    pub fn error(&mut self, span: Span, message: impl Display) {
        self.push(Error::new(span, message));
    }

    /// Notes a mistake that covers all of `tokens`.
    pub fn error_at(&mut self, tokens: impl ToTokens, message: impl Display) {
        self.push(Error::new_spanned(tokens, message));
    }

    /// Whether nothing is wrong so far; checks that could only repeat an earlier mistake ask this first.
    pub fn is_clean(&self) -> bool {
        self.mistakes.is_none()
    }

    /// Number of mistakes so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The value, or every mistake combined.
    pub fn finish<T>(self, value: Option<T>) -> Result<T, Error> {
        match (self.mistakes, value) {
            (Some(mistakes), _) => Err(mistakes),
            (None, Some(value)) => Ok(value),
            // Reading gives up only after noting why; this is said rather than panicked should that ever be untrue.
            (None, None) => Err(Error::new(
                Span::call_site(),
                "bug in gauss-derive: the struct was refused without a reason; please report it",
            )),
        }
    }

    fn push(&mut self, mistake: Error) {
        self.count += 1;
        match &mut self.mistakes {
            Some(mistakes) => mistakes.combine(mistake),
            None => self.mistakes = Some(mistake),
        }
    }
}
