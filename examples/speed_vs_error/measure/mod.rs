//! The computing part: scenes, equations, methods, and the measurement itself. The test `speed_vs_error` runs it too.
//!
//! | module | holds |
//! |---|---|
//! | [`catalogue`] | all scenes: one entry each, what is told [`about`] it and its methods |
//! | [`scene`] | data of a scene, and the error against its end |
//! | [`bodies`], [`systems`] | the scenes as structs for the derive, in every chart |
//! | [`methods`] | the methods of Gauss: one line each |
//! | [`free_motion`] | what moves free bodies without looking at forces |
//! | [`by_hand`], [`by_hand_systems`] | the equations of every scene by hand |
//! | [`baselines`] | what others offer, on those |
//! | [`entry`] | a method on one set of equations, as a run that can be timed; kernels are [`counted`] |
//! | [`study`] | errors, times, energies |
//! | [`comparison`] | fronts, and who is faster at which error |

pub mod about;
pub mod baselines;
pub mod bodies;
pub mod by_hand;
pub mod by_hand_systems;
pub mod catalogue;
pub mod comparison;
pub mod counted;
pub mod entry;
pub mod free_motion;
pub mod methods;
pub mod scene;
pub mod study;
pub mod systems;
