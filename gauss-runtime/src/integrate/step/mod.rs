//! Methods of one step: the seam at which methods are added.

pub(in crate::integrate) mod checks;
pub(in crate::integrate) mod iteration;
pub mod one_step;
pub(in crate::integrate) mod start;
