//! Programs in other languages than Rust. A target is a module that reads [`Program`](crate::program::Program)s and writes text.

pub mod c;
