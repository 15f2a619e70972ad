//! Scenes as MJCF, read again here and by MuJoCo; what has no counterpart.

mod again;
#[path = "../common/mod.rs"]
mod common;
mod contacts;
mod every;
mod mujoco;
mod refusals;
mod scenes;
