//! Meanings of names in expressions, the places of expressions, and the kinds of their values.

pub mod definitions;
pub mod expressions;
mod holder;
pub mod inputs;
pub mod kinds;
pub mod moving_names;
pub mod naming;
pub mod places;
pub mod scope;
pub mod scope_entries;
