//! The back ends that carry programs out: machine code and the interpreter.

mod backend;
#[cfg(feature = "cranelift")]
mod cranelift;
mod functions;
mod interpreter;
#[cfg(all(feature = "cranelift", target_arch = "x86_64"))]
mod lanes;
#[cfg(all(feature = "cranelift", not(target_arch = "x86_64")))]
#[path = "no_lanes.rs"]
mod lanes;
#[cfg(feature = "cranelift")]
mod machine;

pub(crate) use backend::MOST_ARGUMENTS;
pub use backend::{Backend, Compiled, CompiledLanes};
#[cfg(feature = "cranelift")]
pub use cranelift::{Cranelift, Effort};
pub use interpreter::Interpreter;
pub(crate) use interpreter::interpreted;
