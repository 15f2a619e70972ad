#![doc = include_str!("../README.md")]
#![deny(missing_docs, unsafe_code)]

mod backends;
#[cfg(feature = "cache")]
mod cache;
mod checks;
mod configuration;
mod contacts;
mod error;
mod kernel;
mod model;
mod names;
mod system;

pub use backends::{Backend, Compiled, Interpreter};
#[cfg(feature = "cranelift")]
pub use backends::{Cranelift, Effort};
#[cfg(feature = "cache")]
pub use cache::Cache;
pub use configuration::{MixedConfiguration, MixedVector};
pub use contacts::SystemWithContacts;
pub use error::{CallError, KernelError, Misgiven, Mistake, Mistakes, Place};
pub use gauss_codegen::description::{ContactDescription, Description, Quantity, QuantityKind, Remark};
pub use gauss_codegen::{Clause, Field, Notation, Scene};
pub use kernel::{Kernel, Method};
pub use model::Model;
#[doc(hidden)]
pub use names::{kept, kept_axes};
pub use system::{Inputs, NoSystem, System};
