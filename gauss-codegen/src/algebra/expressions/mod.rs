//! Expressions as nodes of one graph: how they are made, rewritten and differentiated.

pub mod alike;
pub mod budget;
pub mod differentiate;
pub mod expression;
pub mod function;
pub mod graph;
pub mod node;
pub mod operators;
pub mod stages;
pub mod substitute;
