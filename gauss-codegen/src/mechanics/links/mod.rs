//! Bodies, frames and particles, each relative to its parent, and sums over them by recursion.

pub mod central;
pub mod centroidal;
pub mod floating;
pub mod forces;
pub mod formal;
pub mod frames;
pub mod inertia;
pub mod link;
pub mod path;
pub mod regroup;
pub mod tree;
pub mod weight;
pub mod working;
