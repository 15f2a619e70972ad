//! Frames, rotations, and how one body moves in each chart.

pub mod chart;
pub mod coordinate;
pub mod motion;
pub mod rotation;
pub mod turn;
pub mod vector;
