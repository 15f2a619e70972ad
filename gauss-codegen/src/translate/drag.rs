//! Coefficients of drag, for warnings.

use crate::algebra::Expr;

/// The coefficients of a drag.
#[derive(Clone)]
pub struct DragMatrix<'g> {
    /// The field, or the element whose clause lists them.
    pub label: String,
    pub quadratic: bool,
    /// Six by six, order (u, ω), body axes, pole O.
    pub entries: Vec<Vec<Expr<'g>>>,
}
