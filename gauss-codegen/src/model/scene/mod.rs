//! Scene as the user wrote it, checked: plain data, the result of this room.

pub mod clauses;
pub mod contacts;
pub mod elements;
pub mod expression;
pub mod forces;
pub mod limbs;
pub mod model;
pub mod modes;
