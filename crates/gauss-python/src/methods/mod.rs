//! Methods of kernels over rows of arrays: what each is called, what it reads and gives, and how it is computed.

mod asked;
mod called;
mod table;
mod words;

pub use table::{Sizes, System, Table, Work};
pub use words::{Argument, Id, SPECS, Size, Slot, Spec};
