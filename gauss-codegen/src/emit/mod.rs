//! Programs as Rust, equations as documentation.
//!
//! - `program`: instructions as `let` statements.
//! - `arguments`: where the symbols of a program come from: parts of `q`, `z`, `p`, the fields of the kernel.
//! - `parameters`: `kernel()`: the parameters read, checked, and turned into constants.
//! - `system_parameters`: the same for systems.
//! - `body`: what is particular to one body in a chart.
//! - `kernel`: the kernel struct and its implementations of the runtime's traits.
//! - `series`: the recurrences of power series in time.
//! - `linearize`: derivatives by the state.
//! - `identification`: derivatives by parameters, and the regressor.
//! - `documentation`: equations and costs as text, LaTeX and rustdoc.

mod arguments;
mod assigned;
mod body;
mod documentation;
mod identification;
mod kernel;
mod linearize;
mod parameters;
mod program;
mod series;
#[cfg(test)]
mod specialisation_tests;
mod system;
mod system_parameters;
#[cfg(test)]
mod system_tests;
#[cfg(test)]
mod tests;

pub use documentation::{equations, method_name};
pub use kernel::{Derived, Plain, Subject, emit};
pub use system::SystemSubject;
