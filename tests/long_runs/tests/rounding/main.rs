//! How rounding grows over tens of thousands of steps and more, on the bodies typed by hand that the tests of the
//! runtime have: a kernel would add rounding of its own.

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

mod compensated;
mod energy_momentum;
mod free_motion;
#[path = "../../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;
