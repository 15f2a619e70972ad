//! The computing parts of the examples `speed_vs_error` and `hard_cases`: here, so that their tests run what they run.

#[path = "../speed_vs_error/measure/mod.rs"]
pub mod measure;
#[path = "../hard_cases/suite/mod.rs"]
pub mod suite;
