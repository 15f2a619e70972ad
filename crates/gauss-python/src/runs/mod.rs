//! Many runs, their types forgotten: numbers in, columns of numbers out.

mod many;
mod measured;
mod touching;

pub use many::{Many, ManyEnds, ensemble};
pub use measured::batch_time;
pub use touching::{TOUCHED, touching};
#[cfg(feature = "loaded")]
pub use touching::{one_by_one, request};
