//! Rules for a scene as a whole, beyond its single expressions.

pub mod bodies;
pub mod coefficients;
pub mod constraints;
pub mod contacts;
pub mod field_shapes;
pub mod forces;
pub mod masses;
pub mod modes;
pub mod motion;
