//! Mass data that are written in clauses, `mass = 2.0` or `inertia = [a, a, c]`, in place of fields: numbers known when
//! the code is generated, equal moments, and components that are zero stay out of it. Of the fluid about any body:
//! `added_mass = x`.

use super::attributes::{self, Clause};
use super::context::Context;
use super::role_words::ROLES;
use super::{arguments, arithmetic};
use crate::algebra::Rational;
use crate::model::scene::clauses::{RoleClause, RoleValue};
use crate::model::scene::expression::{Expression, ExpressionKind};
use crate::terms::{Role, Shape};

/// The role that a word of a clause means.
pub fn role(word: &str) -> Option<Role> {
    ROLES.iter().find(|(name, _)| *name == word).map(|&(_, role)| role)
}

/// Reads `role = value` into the list; where a role is given twice, the first value counts.
pub fn read(role: Role, clause: &Clause, list: &mut Vec<RoleClause>, context: &mut Context) {
    let word = role.word();
    let example = match role {
        Role::CenterOfMass | Role::CenterOfBuoyancy => "[0, 0, l]",
        Role::Inertia | Role::CentralInertia => "[a, a, c]",
        Role::AddedMass => "[a, b, c, d, e, f]",
        _ => "2.0",
    };
    let Some(tokens) = arguments::equals(clause, example, context) else { return };
    let mistakes = context.count();
    let value = match role {
        Role::AddedMass => {
            arithmetic::read_coefficients(word, "an added mass is", tokens, context).map(RoleValue::Coefficients)
        }
        Role::Inertia | Role::CentralInertia if arithmetic::is_list_of_six(tokens) => {
            arithmetic::read_coefficients(word, "an inertia is", tokens, context).map(RoleValue::Coefficients)
        }
        _ => arithmetic::read(word, tokens, context).map(RoleValue::Expression),
    };
    // A body whose mass data were misread has them: that is told once.
    let one = ExpressionKind::Number { value: Rational::one(), twin: None };
    let misread = matches!(role, Role::Mass | Role::Inertia | Role::CentralInertia) && context.count() > mistakes;
    let stand_in = || RoleValue::Expression(Expression { kind: one, span: clause.name.span() });
    if let Some(value) = value.or_else(|| misread.then(stand_in)) {
        add(RoleClause { role, shape: Shape::Other, value, span: clause.name.span() }, list, context);
    }
}

/// Adds one to a list that has none of its role.
pub fn add(clause: RoleClause, list: &mut Vec<RoleClause>, context: &mut Context) {
    if list.iter().any(|other| other.role == clause.role) {
        context.error(clause.span, format!("`{}` is given twice; keep one of the two", clause.role.word()));
    } else {
        list.push(clause);
    }
}

/// A clause `word` without `=`, where it is the role of a field.
pub fn belongs_to_field(clause: &Clause) -> bool {
    !matches!(clause.value, attributes::Content::Equals(_))
}
