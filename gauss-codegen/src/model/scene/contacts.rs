//! Clauses of what may touch, checked.

use super::expression::Expression;
use proc_macro2::Ident;

/// `contact(name, …)`, or `range(name, …)`, which is one contact for each of its limits.
#[derive(Clone)]
pub struct ContactClause {
    /// Of each contact: one, or `x_from` and `x_to` of a range.
    pub names: Vec<Ident>,
    /// What may touch.
    pub touching: Touching,
    /// The coefficient μ: a scalar of t, q, z, inputs, fields and numbers; only with slip.
    pub friction: Option<Expression>,
    /// The coefficient e: a scalar of fields and numbers.
    pub restitution: Option<Expression>,
}

/// What may touch.
#[derive(Clone)]
pub enum Touching {
    /// `gap = …, slip = …`.
    Gap {
        /// A scalar of t and q that is not negative.
        gap: Expression,
        /// One or two scalars of t, q and z with friction, else none.
        slips: Vec<Expression>,
    },
    /// `along = …, from = …, to = …`: scalars of t and q. One limit at least.
    Range {
        /// What stays between the limits.
        along: Expression,
        /// The lower limit.
        from: Option<Expression>,
        /// The upper limit.
        to: Option<Expression>,
    },
}

impl ContactClause {
    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match &mut self.touching {
            Touching::Gap { gap, slips } => {
                change(gap);
                slips.iter_mut().for_each(&mut *change);
            }
            Touching::Range { along, from, to } => {
                change(along);
                from.iter_mut().chain(to).for_each(&mut *change);
            }
        }
        self.friction.iter_mut().chain(&mut self.restitution).for_each(change);
    }
}
