//! Exact symbolic algebra: hash-consed expressions with rational coefficients, their derivatives, a polynomial normal
//! form and printing. Nothing here knows about bodies, frames or charts.
//!
//! Two representations, for two purposes:
//! - [`Expr`]: a node of a shared graph. Sums and products are kept as they were built (flattened and collected, never
//!   multiplied out), so a quantity that occurs a hundred times exists once. Kernels are made from these.
//! - [`Polynomial`]: the multiplied-out normal form modulo the relations of the atoms (`cos² = 1 − sin²`, denominators,
//!   and in proofs the relations of a rotation matrix). Equal expressions have equal normal forms, so this one decides
//!   identities, cancels what can cancel, and is what a reader wants to see printed.

mod dependent;
mod expressions;
mod large;
mod linear;
mod map;
mod naming;
mod normal_form;
mod numbers;
mod orthogonal;
mod parts;
mod print;
mod rational;
#[cfg(test)]
mod tests;

pub use dependent::{ConstrainedSolution, solve_dependent};
pub use expressions::differentiate::FlowDerivative;
pub use expressions::function::{BinaryFunction, Function, MOST_VARIABLES, OwnFunction};
pub use expressions::graph::{Expr, Graph, NodeView};
pub use expressions::substitute::Substitution;
pub use linear::{
    FactoredColumns, Factorisation, Solver, inverse_of_symmetric, solve_pairs, solve_saddle, solve_symmetric,
};
pub use map::{Key, Map, Set, joined};
pub use normal_form::differences::without_differences;
#[cfg(test)]
pub use normal_form::ideal;
pub use normal_form::polynomial::{Expander, Polynomial};
pub use numbers::doubled::Doubled;
pub use numbers::dual::Dual;
pub use numbers::evaluate::{Evaluation, Number, Scalar, Tangents};
pub use numbers::precise::Precise;
pub use numbers::rounded::ErrorBound;
pub use orthogonal::LeastSquares;
pub use parts::{LONG, Parts};
pub use print::{Notation, decimal, print, print_definition, print_parts, print_short, print_with};
pub use rational::Rational;
