#![doc = include_str!("../README.md")]
#![deny(missing_docs, unsafe_code)]

// `model` (text or file → what kernels share), `checks` (what `kernel()` checks, of `gauss_codegen::parameters`, by
// the functions that generated code calls), `configuration` (groups that are known at run time), `tables` (arrays of
// tables), `kernel` (methods by name), `rows` (the same of many states), `system` (for `Simulation`, with room that
// the program says), `contacts` (for runs with contacts, with room for their rows), `cache` (a folder of derivations),
// `names` (what outlives models), `joints` (scenes as trees of joints), `mjcf`, `urdf` (documents of these), `error`;
// `backends`: `cranelift` (programs → machine code), `lanes` (the same for several rows at once), `machine` (their
// memory and their calls: the only `unsafe`), `interpreter`, `functions` that all call.
mod backends;
#[cfg(feature = "cache")]
mod cache;
mod checks;
mod configuration;
mod contacts;
mod error;
mod joints;
mod kernel;
mod mjcf;
mod model;
mod names;
mod rows;
mod system;
mod tables;
mod urdf;

pub use backends::{Backend, Compiled, CompiledLanes, Interpreter};
#[cfg(feature = "cranelift")]
pub use backends::{Cranelift, Effort};
#[cfg(feature = "cache")]
pub use cache::Cache;
pub use configuration::{MixedConfiguration, MixedVector};
pub use contacts::SystemWithContacts;
pub use error::{CallError, KernelError, Misgiven, Mistake, Mistakes, Place, TableMistake, TableMistakes};
pub use gauss_codegen::description::{ContactDescription, Description, Quantity, QuantityKind, Remark};
pub use gauss_codegen::program::{Functions, UnknownMethods};
pub use gauss_codegen::{Clause, Field, Notation, Scene, targets};
pub use joints::DocumentError;
pub use kernel::{Kernel, Method};
pub use mjcf::Mjcf;
pub use model::Model;
#[doc(hidden)]
pub use names::{kept, kept_axes};
pub use system::{Inputs, NoSystem, System};
pub use tables::{Array, Tables};
pub use urdf::Urdf;
