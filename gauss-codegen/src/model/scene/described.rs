//! The file that a scene comes from.

use proc_macro2::Span;

/// A robot that was read from a file.
#[derive(Clone)]
pub struct Described {
    /// Where the file is: the generated code names it, so that an edit compiles the struct anew.
    pub path: String,
    /// As it is written.
    pub file: String,
    /// The string of the clause.
    pub span: Span,
    /// What a reader of the equations should know of the file.
    pub remarks: Vec<Remark>,
}

/// Something to know of a file, with its place in it.
#[derive(Clone)]
pub struct Remark {
    pub text: String,
    /// Something that acts in the file does not act in the equations.
    pub ignored: bool,
}
