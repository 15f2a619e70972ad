//! What generated code calls, and nothing else should: no promise of stability is made here.
//!
//! Generated code is arithmetic on scalars; this module takes the user's containers apart and puts results together, turns
//! poses into configurations and back, and checks parameters.

mod check;
mod containers;
mod eigenvalues;
mod poses;
mod warnings;

pub use crate::constraint::project;
pub use crate::error::DragKind;
pub use crate::series::Series;
pub use check::ParameterCheck;
pub use containers::{components, entries, isometry2, isometry3, matrix, product, quaternion, vector};
pub(crate) use eigenvalues::eigenvalues;
pub use poses::{
    chart_of_pose, free_pose, plane_chart_of_pose, plane_of_pose, pose_from_quaternion, pose_of_chart, pose_of_plane,
    pose_of_plane_chart, pose_of_rotation, pose_of_rotation_chart, rotation_chart_of_pose, rotation_of_pose,
};
pub use warnings::WarningCheck;
