//! Methods that are chosen at run time, and the choice among them by measuring.

#[cfg(feature = "alloc")]
pub mod measure;
pub mod method;
