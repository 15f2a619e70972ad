//! Mistakes of a scene, each where it is written: what every step after `parse` refuses with.

use proc_macro2::Span;

/// One mistake or more.
#[derive(Debug)]
pub struct Error {
    first: (Span, String),
    others: Vec<(Span, String)>,
}

pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { first: (span, message.into()), others: Vec::new() }
    }
}

impl IntoIterator for Error {
    type Item = (Span, String);
    type IntoIter = std::iter::Chain<std::iter::Once<(Span, String)>, std::vec::IntoIter<(Span, String)>>;

    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self.first).chain(self.others)
    }
}

/// Mistakes that are reported together.
#[derive(Default)]
pub struct Mistakes(Vec<(Span, String)>);

impl Mistakes {
    /// Notes one.
    pub fn push(&mut self, span: Span, message: String) {
        self.0.push((span, message));
    }

    /// # Errors
    /// All of them.
    pub fn finish(self) -> Result<()> {
        let mut all = self.0.into_iter();
        all.next().map_or(Ok(()), |first| Err(Error { first, others: all.collect() }))
    }
}
