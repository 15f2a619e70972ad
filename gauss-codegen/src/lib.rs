//! The library behind `#[derive(GaussDynamics)]`: a struct in; programs, equations and code of its kernel out.
#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

mod accuracy;
mod algebra;
mod derivation;
mod derivatives;
pub mod description;
mod emit;
mod error;
mod expand;
mod formulation;
mod kernel;
mod lowering;
mod mass_laws;
pub mod mathml;
mod mechanics;
mod methods;
mod mistakes;
mod model;
pub mod parameters;
pub mod program;
pub mod scene;
pub mod targets;
mod terms;
mod tex;
mod translate;
mod words;

pub use algebra::Notation;
pub use derivation::{Bodies, Derivation, LinkData, LinkKind};
pub use emit::fallback;
pub use expand::{expand, expand_without_vectors};
pub use model::item;
pub use scene::{Clause, Field, Mistake, Scene, Value};
