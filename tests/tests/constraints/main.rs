//! Constraints of places and of speeds: what they keep, what they bear, and bodies that roll.

mod holonomic;
mod linkages;
mod nonholonomic;
mod reactions;
mod rolling;
