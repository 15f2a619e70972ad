//! Losses of programs to rounding: errors in double precision at sample states, in units of the effect of a change of
//! every input and parameter in its last place.
//!
//! - `states`: states of a scene that reach what makes digits cancel.
//! - `random`: choices that are the same in every run.
//! - `tape`: programs that are run many times, on numbers of several kinds.
//! - `flat`: programs as one list of steps, with a first-order analysis of their rounding.
//! - `moves`, `loss_search`: a search for the states at which programs lose most; `figure`: what is said of it.
//! - `trial`: results in 106 binary digits, their conditioning, and the loss of a program beside them.

mod figure;
mod flat;
mod loss_search;
mod moves;
mod random;
mod states;
mod tape;
#[cfg(test)]
mod tests;
mod trial;

pub use figure::Figure;
pub use loss_search::{Forms, LossFigures, LossSearchInput};
pub use states::{Samples, States, SymbolNumbers};
pub use trial::{DecidingState, Loss, Trial, TrialResult};
