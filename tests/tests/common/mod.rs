//! What the property tests share.
//!
//! | file | what it holds |
//! |---|---|
//! | `dual` | a scalar that carries its derivative |
//! | `body` | a derived kernel of any chart and scalar; its flow in dual numbers |
//! | `groups` | configurations of several factors, random ones |
//! | `kernels` | two kernels of one system in every method |
//! | `parameters` | random bodies |
//! | `states` | random poses and twists |
//! | `scenes` | macros that stamp derived structs |
//! | `agreement` | equal up to the bounds |

// Every test binary uses a part of this.
#![allow(dead_code, unused_macros, unused_imports)]

pub mod agreement;
pub mod body;
pub mod dual;
pub mod groups;
pub mod kernels;
pub mod parameters;
#[macro_use]
pub mod scenes;
pub mod states;

/// Numbers that carry a bound on their own rounding error.
pub type Bounded = gauss_bounded::Bounded<f64>;
