//! How many digits a program loses: its error in double precision at sample states, in units of what a change of every
//! input and parameter in its last place does.
//!
//! - `states`: states of a scene that reach what makes digits cancel.
//! - `random`: choices that are the same in every run.
//! - `tape`: programs that are run many times, on numbers of several kinds.
//! - `trial`: results in 106 binary digits, their conditioning, and the loss of a program beside them.

mod random;
mod states;
mod tape;
#[cfg(test)]
mod tests;
mod trial;

pub use states::{States, sample_states};
pub use trial::{Loss, Point, Trial, Tried, taken, usable};
