//! What a method of one step is: the seam at which methods are added.

pub(in crate::integrate) mod checks;
pub(in crate::integrate) mod iteration;
pub mod one_step;
