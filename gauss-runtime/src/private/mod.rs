//! Functions for generated code, and for nothing else: no promise of stability is made here.
//!
//! Generated code is arithmetic on scalars; this module takes the user's containers apart and puts results together,
//! turns poses into configurations and back, checks parameters, and has the traits and types that generated code
//! implements and names.

mod check;
mod columns;
mod contacts;
mod containers;
mod eigenvalues;
pub mod limbs;
mod one_body;
// Vectors pay where they have fused products; elsewhere programs are done number by number.
#[cfg(all(feature = "wide", target_feature = "avx", target_feature = "fma"))]
pub mod packs;
#[cfg(not(all(feature = "wide", target_feature = "avx", target_feature = "fma")))]
#[path = "without_packs.rs"]
pub mod packs;
mod poses;
mod samples;
mod warnings;

pub use crate::__with_vectors_0_1_0 as with_vectors;
pub use crate::accuracy::{Accuracy, Loss};
pub use crate::centroidal::{CentroidalSystem, GravityTorques};
pub use crate::chart::{Chart, ChartError, EulerSequence, RotationChart};
pub use crate::configuration::Configuration;
pub use crate::constraint::{ConstrainedSystem, ProjectionError, dependence, project};
pub use crate::contact::{
    Contact, ContactFrame, ContactSystem, ImpulseDynamics, ImpulseResponse, impulse_terms, impulse_velocities,
};
pub use crate::description::{DescribedSystem, Equations, FrameOperations, OperationCount, Operations};
pub use crate::driven::{DrivenSystem, DrivingForce};
pub use crate::error::{DragKind, ParameterError, ParameterWarnings};
pub use crate::forces::{Element, ForcedSystem};
pub use crate::frames::{ByFrame, FrameMotion, FrameName, FramedSystem, JacobianRates};
pub use crate::hessian::{Hessian, HessianSystem};
pub use crate::identification::{InertialRegressor, ParametricSystem};
pub use crate::inverse::{InverseLinearization, InverseLinearizedSystem};
pub use crate::linearize::{LinearModel, Linearization, LinearizedSystem};
pub use crate::reactions::{ContactReactions, Reactions};
pub use crate::real::Real;
pub use crate::series::{Series, TaylorSystem};
pub use crate::system::{Evaluated, GaussSystem, RigidBodySystem, Smoothness};
pub use crate::table::{Cubic, Grid, Joined, Linear, axis};
pub use check::ParameterCheck;
pub use columns::{Bundle, columns, each_column, filled, multiple, only_column, put, subtract_multiple, zeros};
pub use contacts::{contact_columns, impulse_terms_of_halves};
pub use containers::{components, entries, isometry2, isometry3, matrix, product, quaternion, vector};
pub(crate) use eigenvalues::eigenvalues;
pub use nalgebra::{Isometry2, Isometry3, IsometryMatrix3, SMatrix, SVector, UnitQuaternion};
pub use one_body::{configuration_of_pose, determinacy_of_speeds, pose_from_rows, speeds_of_twist};
pub use packs::Rows;
pub use poses::{
    center_jacobian, chart_of_pose, frame_pose, free_pose, plane_chart_of_pose, plane_of_pose, pose_from_quaternion,
    pose_of_chart, pose_of_plane, pose_of_plane_chart, pose_of_rotation, pose_of_rotation_chart,
    rotation_chart_of_pose, rotation_of_pose, unmoved, unmoved_in_plane, unturned,
};
pub use samples::{sample_time, samples};
pub use warnings::WarningCheck;

/// A part of a long program, as a function of its own: compilers take longer than in proportion for longer ones.
#[inline(never)]
pub fn apart<R>(part: impl FnOnce() -> R) -> R {
    part()
}

/// [`Real::fma`] of a type that is known.
#[inline(always)]
pub fn fma_f64(a: f64, b: f64, c: f64) -> f64 {
    Real::fma(a, b, c)
}

/// [`Real::fma`] of a type that is known.
#[inline(always)]
pub fn fma_f32(a: f32, b: f32, c: f32) -> f32 {
    Real::fma(a, b, c)
}

#[cfg(test)]
mod tests {
    /// The derive makes the name from its own version, which is that of this crate: both are pinned to each other.
    #[test]
    fn the_name_carries_the_version() {
        let version = concat!(
            env!("CARGO_PKG_VERSION_MAJOR"),
            "_",
            env!("CARGO_PKG_VERSION_MINOR"),
            "_",
            env!("CARGO_PKG_VERSION_PATCH")
        );
        assert_eq!(module_path!(), std::format!("gauss_runtime::__private_{version}::tests"));
        let root = include_str!("../lib.rs");
        assert!(root.contains(&std::format!("pub mod __crates_{version} {{")));
        // Macros are exported from the root of the crate, beside what users see.
        for (name, file) in [
            ("with_vectors", include_str!("packs.rs")),
            ("with_vectors", include_str!("without_packs.rs")),
            ("packs_of_one", include_str!("../simd/packed.rs")),
        ] {
            assert!(file.contains(&std::format!("macro_rules! __{name}_{version} {{")), "{name}");
        }
    }
}
