//! Scenes as MJCF and URDF, read again here, by MuJoCo and by Pinocchio; what has no counterpart.

mod again;
#[path = "../common/mod.rs"]
mod common;
mod contacts;
mod every;
mod loops;
mod mujoco;
mod pinocchio;
mod python;
mod refusals;
mod scenes;
mod urdf;
