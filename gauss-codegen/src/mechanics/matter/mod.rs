//! Matter as symbols, and integrals over it by moments.

pub mod added_mass;
pub mod body;
pub mod flow;
pub mod modes;
pub mod moments;
pub mod rotor;
pub mod weight;
