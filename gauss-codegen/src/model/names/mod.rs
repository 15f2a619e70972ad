//! Meanings of names in expressions, the places of expressions, and the kinds of their values.

pub mod declared;
pub mod definitions;
pub mod expressions;
pub mod inputs;
pub mod kinds;
pub mod moving;
pub mod naming;
pub mod places;
pub mod scope;
