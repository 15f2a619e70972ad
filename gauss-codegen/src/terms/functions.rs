//! Functions of numbers that the user gives.

use proc_macro2::{Ident, Span, TokenStream};

/// `function(lift, derivative = …)` or `table(lift, …)`: a function of one number, or a table of up to three.
#[derive(Clone)]
pub struct UserFunction {
    /// Its name in expressions.
    pub name: Ident,
    /// Kind of the function.
    pub kind: FunctionKind,
    /// Place where the function, or the points or values of the table, are named.
    pub span: Span,
}

/// A function that the user gives.
#[derive(Clone)]
pub enum FunctionKind {
    /// Paths of functions of the user's own, of one number: itself, its derivative, and so on.
    Rust(Vec<TokenStream>),
    /// Values at points.
    Table(Table),
}

/// A function given by its values at points.
#[derive(Clone)]
pub struct Table {
    /// The grid on which the values are given; none: `values` are points [x, y].
    pub axes: Vec<Axis>,
    /// The path of a constant array, of as many dimensions as there are axes.
    pub values: TokenStream,
    /// Interpolation between the points.
    pub joined: Interpolation,
}

/// The numbers of one variable at which a table has values.
#[derive(Clone)]
pub struct Axis {
    /// The path of a constant array of numbers that increase.
    pub path: TokenStream,
    /// Name of the variable in messages: the last word of the path, in small letters.
    pub variable: String,
    /// Place where it is named.
    pub span: Span,
}

/// Interpolation between the points of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Interpolation {
    /// Straight lines.
    Linear,
    /// Cubics with the slopes of parabolas through three neighbours.
    Hermite,
    /// Natural cubic spline.
    Cubic,
}

impl FunctionKind {
    /// Number of derivatives by each variable: of a table, until nothing is left.
    pub fn derivatives(&self) -> u8 {
        match self {
            FunctionKind::Rust(paths) => paths.len().saturating_sub(1) as u8,
            FunctionKind::Table(Table { joined: Interpolation::Linear, .. }) => 1,
            FunctionKind::Table(_) => 3,
        }
    }

    /// Number of continuous derivatives by each variable; `None`: it is smooth.
    pub fn continuous(&self) -> Option<u8> {
        match self {
            FunctionKind::Rust(_) => None,
            FunctionKind::Table(table) => Some(match table.joined {
                Interpolation::Linear => 0,
                Interpolation::Hermite => 1,
                Interpolation::Cubic => 2,
            }),
        }
    }

    /// Variables of the function, in words for messages.
    pub fn variables(&self) -> Vec<String> {
        match self {
            FunctionKind::Table(Table { axes, .. }) if !axes.is_empty() => {
                axes.iter().map(|axis| axis.variable.clone()).collect()
            }
            _ => vec!["x".to_owned()],
        }
    }
}
