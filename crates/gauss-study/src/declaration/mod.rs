//! Declaration of a study: its seed, its parameters, its results.

mod check;
mod content;
mod sampler;
mod text;

pub use content::Declaration;
pub use sampler::Sampler;
