//! Declaration of a study: its seed, its parameters, its results.

mod check;
mod declared;
mod kept;
mod sampler;

pub use declared::Declaration;
pub use sampler::Sampler;
