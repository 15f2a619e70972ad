//! Methods by name as controls of runs.

use gauss_runtime::integrate::{JacobianMethod, MethodControl, MethodError, MethodPlace};
use gauss_runtime::prelude::*;

use super::request::{Control, Request};

/// The control of a run by the method that was chosen by name.
///
/// # Errors
/// A method that needs a clause.
pub fn method<R, P>(request: &Request<'_>) -> Result<MethodControl<f64, R, P>, String>
where
    R: MethodPlace<JacobianMethod>,
    P: MethodPlace<Taylor>,
{
    let Control::Smooth(method, setting) = request.control else { return Err(no_contacts()) };
    let control: MethodControl<f64, R, P> = method.control(setting).map_err(|error| match error {
        MethodError::Clause(method, clause) => lacks(method.name(), clause),
        other => other.to_string(),
    })?;
    let within = request.input.changes_within();
    Ok(if within.is_finite() { control.input_changes_within(within) } else { control })
}

/// Message that a run with contacts needs some.
pub fn no_contacts() -> String {
    lacks("of contacts", "contact(…)")
}

/// Message that a method needs a clause, which its struct does not say.
pub fn lacks(method: &str, clause: &str) -> String {
    format!(
        "the method {method} needs `#[gauss({clause})]` at the struct, which does not say it; models of `gauss.load` \
         take `clauses=[\"{clause}\"]`"
    )
}
