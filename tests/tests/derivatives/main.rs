//! Derivatives of systems and of their steps, against dual numbers; functions and tables with theirs.

#[macro_use]
#[path = "../common/mod.rs"]
mod common;

mod discrete;
mod duals;
mod functions;
mod hessian;
mod linearize;
mod regressor;
mod tables;
