//! What comes out: the scene as the user wrote it, checked; plain data.

pub mod clauses;
pub mod contacts;
pub mod elements;
pub mod expression;
pub mod forces;
pub mod limbs;
pub mod model;
pub mod modes;
