//! Quantities of a state: powers and forces, frames, pose and momentum of a body, sums over the system.

pub mod forced;
pub mod framed;
pub mod pose;
pub mod rigid_body;
pub mod whole;
