//! Free bodies, tops and splitting methods on the bodies typed by hand that the tests of the runtime have.

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

#[path = "../../src/elliptic.rs"]
#[allow(dead_code, reason = "free bodies need more")]
mod elliptic;
mod free;
mod splitting;
#[path = "../../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../src/top_orbit.rs"]
mod top_orbit;
mod tops;
#[path = "../../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;
