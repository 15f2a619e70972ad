#![doc = include_str!("../README.md")]
#![deny(missing_docs, unsafe_code)]

mod backends;
mod checks;
mod configuration;
mod error;
mod kernel;
mod model;
mod names;
mod system;

pub use backends::{Backend, Compiled, Interpreter};
#[cfg(feature = "cranelift")]
pub use backends::{Cranelift, Effort};
pub use configuration::{MixedConfiguration, MixedVector};
pub use error::{CallError, KernelError, Misgiven, Mistake, Mistakes, Place};
pub use gauss_codegen::description::{Description, Quantity, QuantityKind, Remark};
pub use gauss_codegen::{Clause, Field, Notation, Scene};
pub use kernel::{Kernel, Method};
pub use model::Model;
#[doc(hidden)]
pub use names::kept;
pub use system::{Inputs, NoSystem, System};
