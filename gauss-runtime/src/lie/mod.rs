//! The rotation and motion groups: exponential, logarithm, and the inverse derivative of the exponential.
//!
//! | group | module | element | algebra (body frame) |
//! |---|---|---|---|
//! | SO(3) | [`so3`] | unit quaternion | ω |
//! | SE(3) | [`se3`] | isometry (R, b) | (u, ω), pole O |
//! | SE(2) | [`se2`] | plane isometry | (u₁, u₂, ω) |
//!
//! [`carried`] multiplies elements that are known beyond the precision of their components, for long runs.
//!
//! Everything is left-trivialised: an increment σ acts on the right, `q ∘ exp(σ)`, so that its derivative is the body
//! velocity. Each function is written once over [`coefficients`], which hold for every angle.

pub mod carried;
pub mod coefficients;
pub mod se2;
pub mod se3;
pub mod so3;

#[cfg(test)]
mod tests;
