//! Derivatives of the equations: by the state, by parameters, by inertial parameters.

pub mod columns;
pub mod hessian;
pub mod inverse;
pub mod linearized;
pub mod parametric;
pub mod regressor;
