//! From expressions to straight-line programs: constants hoisted, common factors pulled out, common parts shared,
//! multiply-adds fused, everything counted.
//!
//! - `lower`: the functions of a kernel together.
//! - `choice`: of several arrangements of a function, the one that is taken.
//! - `hoist`: what depends on parameters alone becomes a constant, computed once; `constants`: those that are read.
//! - `factor`: common factors of the terms of a sum are pulled out.
//! - `network`: sums and products of many terms; parts that occur more than once are split off.
//! - `write`: networks as instructions. `passes`: which passes are made on the way.
//! - `tangent`, `adjoint`: derivatives of programs along directions, forward and backward.
//! - `hessian`: second derivatives of one number.
//! - `derivatives`: derivatives of functions by what moves; `parametric`: by parameters.
//! - `columns`: derivatives that are the solutions of one linear system, solved for together.
//! - `derivative_programs`: all of these as one list. `expected_outputs`: what each should compute.
//! - `check`: programs against the expressions that they were made from.
//!
//! Knows nothing of frames or bodies. Every program is checked before it is handed out (see [`Kernel::lower`]), and the
//! shape of each after every pass in debug builds. Here the inputs of code are symbols; [`crate::program`] says what
//! code is.

mod adjoint;
mod check;
mod choice;
mod columns;
mod constants;
mod derivative_programs;
mod derivatives;
mod expected_outputs;
mod factor;
mod hessian;
mod hoist;
mod lower;
mod network;
mod parametric;
mod passes;
mod tangent;
#[cfg(test)]
mod tests;
mod write;

pub use crate::program::{Counts, Smoothness};
pub use choice::{Aim, Candidates};
pub use columns::{LoweredColumns, TOGETHER};
pub use derivative_programs::{Derivative, DerivativeRequest, Differentiation};
pub use lower::{Derivatives, Kernel, Literals, LoweredFunction};
#[cfg(test)]
pub use passes::Pass;
pub use passes::Passes;
pub use write::{Operand, Operation, Program};
