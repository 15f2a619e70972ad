//! One account: the power and the generalised force of an element; the methods of a kernel that give all of them.

use crate::algebra::Expr;

use crate::mechanics::formula::{Formula, Method};

/// One element in the accounts.
pub struct Account<'g> {
    pub name: String,
    /// It is part of the potential energy.
    pub conservative: bool,
    /// `∫∂v_P/∂z^α·dF`, one for each speed.
    pub forces: Vec<Expr<'g>>,
    pub power: Expr<'g>,
    /// The part of the power that changes the energy: all of it, or what a damper takes beside a potential.
    pub outside: Option<Expr<'g>>,
}

/// Name of weight and buoyancy.
pub const GRAVITY: &str = "gravity";
/// Powers, generalised forces (speeds by elements, row by row), and dE/dt: the powers of what is not in the energy, and
/// ∂U/∂t.
pub fn account_formulas<'g>(accounts: &[Account<'g>], explicit_power: Expr<'g>) -> Vec<Formula<'g>> {
    let Some(first) = accounts.first() else { return Vec::new() };
    let single = |method, outputs| Formula { method, arrangements: vec![outputs] };
    let rows = (0..first.forces.len()).flat_map(|row| accounts.iter().map(move |account| account.forces[row]));
    let outside = accounts.iter().filter_map(|account| account.outside);
    vec![
        single(Method::Powers, accounts.iter().map(|account| account.power).collect()),
        single(Method::ElementForces, rows.collect()),
        single(Method::SuppliedPower, vec![outside.fold(explicit_power, |sum, power| sum + power)]),
    ]
}
