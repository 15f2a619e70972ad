//! Quantities of a state: powers and forces, frames, reactions of joints, driving forces, pose and momentum of a body,
//! sums over the system.

pub mod driven;
pub mod forced;
pub mod framed;
pub mod pose;
pub mod reactions;
pub mod rigid_body;
pub mod whole;
