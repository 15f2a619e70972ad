//! Bodies with constant inertia: their free motion, exactly or by an integrable discretisation.
//!
//! | file | holds |
//! |---|---|
//! | [`inertia`] | principal axes, and the increment that a free motion makes |
//! | [`free_flow`] | [`FreeFlow`]: the exact motion over any span of time |
//! | [`moser_veselov`] | [`MoserVeselov`]: the discrete Moser–Veselov method with its corrections to order 10 |

mod corrections;
mod elliptic;
pub mod free_flow;
pub mod inertia;
pub mod moser_veselov;

pub use free_flow::FreeFlow;
pub use inertia::{FreeMotion, PrincipalAxes, Turn};
pub use moser_veselov::MoserVeselov;

#[cfg(test)]
mod elliptic_values;
#[cfg(test)]
mod free_tests;
