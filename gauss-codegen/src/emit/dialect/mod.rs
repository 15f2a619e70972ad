//! The dialect of Rust that kernels are written in: statements, vectors, arguments of functions.

pub mod arguments;
pub mod limbs;
pub mod packs;
pub mod program;
