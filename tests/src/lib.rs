//! What the tests of both crates share: reference solutions, an integrator of order 8, and the comparison of the two.
//!
//! | module | holds |
//! |---|---|
//! | [`scene`] | a reference solution, read from `data/reference` |
//! | [`double_double`] | a scalar of some 31 digits |
//! | [`pages`] | sections of Markdown pages that tests write |
//! | [`top`] | a heavy top in any scalar |
//! | [`random`] | random numbers |
//! | [`order8`] | the Dormand–Prince method of order 8 on the group, with step control |
//! | [`integrals`] | what a motion conserves |
//! | [`laws`] | what holds for every system at every state, and for two descriptions of one |
//! | [`trajectory`] | a system of any configuration run over a reference solution |
//! | [`nonholonomic`] | states of rigid bodies by name, and the power of constraints that do work |
//! | [`watchdog`] | tests that fail instead of waiting for ever |
//! | [`compare`] | a kernel run from the initial to the final state of a scene, and how far it ends from it |

pub mod compare;
pub mod double_double;
pub mod integrals;
pub mod laws;
pub mod nonholonomic;
pub mod order8;
pub mod pages;
pub mod random;
pub mod scene;
pub mod top;
pub mod trajectory;
pub mod watchdog;
