//! Ways to arrange one and the same equations; the kernel takes what costs least.
//!
//! - `free_link`: links that nothing else moves with, in their body axes; `balance`: the balance there, solved.
//! - `short`: multiplied out, where that is short.
//! - `articulated`: link by link.
//! - `orthogonal`: C as a sum of squares, whose elements may differ by many powers of ten.

pub mod articulated;
pub mod balance;
pub mod free_link;
pub mod halves;
pub mod orthogonal;
pub mod short;
