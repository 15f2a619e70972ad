//! Directions in which the equations are differentiated, and rates of all numbers of a state.

pub mod component_rates;
pub mod hessian;
pub mod implicit;
pub mod inverse;
pub mod linearize;
pub mod parametric;
pub mod regressor;
pub mod rigid;
pub mod second;
