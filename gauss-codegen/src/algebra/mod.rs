//! Exact symbolic algebra: hash-consed expressions with rational coefficients, their derivatives, a polynomial normal
//! form and printing. Nothing here knows about bodies, frames or charts.
//!
//! Two representations, for two purposes:
//! - [`Expr`]: a node of a shared graph. Sums and products are kept as they were built (flattened and collected, never
//!   multiplied out), so a quantity that occurs a hundred times exists once. Kernels are made from these.
//! - [`Polynomial`]: the multiplied-out normal form modulo the relations of the atoms (`cos² = 1 − sin²`, denominators,
//!   and in proofs the relations of a rotation matrix). Equal expressions have equal normal forms, so this one decides
//!   identities, cancels what can cancel, and is what a reader wants to see printed.

mod budget;
mod cosines;
mod differences;
mod differentiate;
mod doubled;
mod dual;
mod elementary;
mod evaluate;
mod expression;
mod function;
mod graph;
#[cfg(test)]
pub mod ideal;
mod large;
mod limbs;
mod linear;
mod map;
mod node;
mod operators;
mod orthogonal;
mod parts;
mod polynomial;
mod precise;
mod print;
mod rational;
mod stages;
mod substitute;
#[cfg(test)]
mod tests;

pub use differences::without_differences;
pub use differentiate::Along;
pub use doubled::Doubled;
pub use dual::Dual;
pub use evaluate::{Evaluation, Number, Scalar, Tangents};
pub use function::{BinaryFunction, Function, OwnFunction};
pub use graph::{Expr, Graph, NodeView};
pub use linear::{Factored, FactoredColumns, Solver, inverse_of_symmetric, solve_pairs, solve_saddle, solve_symmetric};
pub use map::{Key, Map, Set, joined};
pub use orthogonal::LeastSquares;
pub use parts::Parts;
pub use polynomial::{Expander, Polynomial};
pub use precise::Precise;
pub use print::{Notation, decimal, print, print_definition, print_parts, print_short, print_with};
pub use rational::Rational;
pub use substitute::Substitution;
