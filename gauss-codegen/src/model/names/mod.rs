//! What names mean in expressions, where expressions stand, and which kinds of values they have.

pub mod declared;
pub mod definitions;
pub mod expressions;
pub mod inputs;
pub mod kinds;
pub mod moving;
pub mod naming;
pub mod places;
pub mod scope;
