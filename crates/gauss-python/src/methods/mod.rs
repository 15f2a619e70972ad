//! Methods of kernels over rows of arrays: what each is called, what it reads and gives, and how it is computed.

mod asked;
mod called;
mod system;
mod table;
mod words;

pub use system::System;
pub use table::{Sizes, Table, Work};
pub use words::{Argument, Id, SPECS, Size, Slot, Spec};
