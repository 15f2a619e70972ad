//! Functions of one number that the user gives.

use proc_macro2::{Ident, Span, TokenStream};

/// `function(lift, derivative = …)` or `table(lift, points = …)`: a function of one number.
#[derive(Clone)]
pub struct UserFunction {
    /// Its name in expressions.
    pub name: Ident,
    /// What it is.
    pub kind: FunctionKind,
    /// Where the function or its points are named.
    pub span: Span,
}

/// A function of one number that the user gives.
#[derive(Clone)]
pub enum FunctionKind {
    /// Paths of functions of the user's own: itself, its derivative, and so on.
    Rust(Vec<TokenStream>),
    /// The path of a constant array of points [x, y], joined by straight lines.
    Linear(TokenStream),
    /// The same, joined by the natural cubic spline.
    Cubic(TokenStream),
}

impl FunctionKind {
    /// How often it can be differentiated: of a table, until nothing is left.
    pub fn derivatives(&self) -> u8 {
        match self {
            FunctionKind::Rust(paths) => paths.len().saturating_sub(1) as u8,
            FunctionKind::Linear(_) => 1,
            FunctionKind::Cubic(_) => 3,
        }
    }

    /// How many derivatives are continuous; `None`: it is smooth.
    pub fn continuous(&self) -> Option<u8> {
        match self {
            FunctionKind::Rust(_) => None,
            FunctionKind::Linear(_) => Some(0),
            FunctionKind::Cubic(_) => Some(2),
        }
    }
}
