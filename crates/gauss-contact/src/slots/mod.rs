//! Contacts whose places come at run time: points and planes that a collision library finds.
//!
//! A slot has a point p in the axes of one frame and a plane, by a point o and a normal n, in the axes of another one
//! or at rest. Its gap is `n · (r − o)`, r the point in the axes of the plane, less the radius where it is a sphere: a
//! function of q as exact as those of clauses, with poses, Jacobians and accelerations of the frames from the kernel.
//! The data are constants between two answers of the library: of each step, where it is asked before each.

mod envelope;
mod place;
mod slot;
mod system;

pub use slot::{Slot, SlotError, SlotField, SlotRule};
pub use system::Slots;
