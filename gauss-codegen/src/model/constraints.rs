//! What must hold of constraints, and of the speeds that stay independent under them.

use super::context::Context;
use super::kinds::{self, Kind};
use super::moving::Moving;
use super::names;
use super::naming::{same, word};
use super::places::Place;
use super::scope::Scope;
use super::statements::{Statement, Statements};
use super::{ConstraintClause, ConstraintKind};

/// Checks names and kinds in the constraints, and says which are vectors; and which are without mistakes.
pub(super) fn check_kinds(statements: &mut Statements, scope: &Scope, context: &mut Context) -> Vec<bool> {
    let check = |constraint: &mut ConstraintClause| {
        let place = Place::Constraint(constraint.kind);
        let kind = kinds::check(&constraint.expression, place, scope, context);
        constraint.vector = kind == Some(Kind::Vector);
        kind.is_some()
    };
    statements.constraints.iter_mut().map(check).collect()
}

/// Checks what is constrained, in those that are `well`, and the speeds that stay independent.
pub(super) fn check(statements: &Statements, well: &[bool], uncertain: bool, context: &mut Context) {
    let moving = Moving::new(statements);
    for (constraint, _) in statements.constraints.iter().zip(well).filter(|(_, well)| **well) {
        check_motion(constraint, &moving, context);
    }
    check_independent(statements, uncertain, context);
}

/// Motion has something to do with whether a constraint holds.
fn check_motion(constraint: &ConstraintClause, moving: &Moving, context: &mut Context) {
    let expression = &constraint.expression;
    let in_velocity = moving.in_velocity(expression);
    if !in_velocity && !moving.in_place(expression) {
        context.error(
            constraint.span,
            "the constraint names nothing that moves, so no motion makes it hold; \
             name a coordinate, a speed, or a body or point that moves",
        );
    } else if constraint.kind == ConstraintKind::Velocity && !in_velocity {
        context.error(
            constraint.span,
            "the constraint contains no velocity of anything that moves; write `constraint(position = …)`, \
             or the time derivative `rate(…)`",
        );
    }
}

/// `independent` names some of the speeds, once each, where there is something to solve for the others.
fn check_independent(statements: &Statements, uncertain: bool, context: &mut Context) {
    let Some(independent) = &statements.independent else { return };
    if statements.constraints.is_empty() && !statements.missed_any(&[Statement::Constraint]) && !uncertain {
        context.error(
            independent.clause.span(),
            "without constraints all speeds are independent; add `constraint(…)`, or remove `independent`",
        );
    }
    let own = statements.speeds.as_ref();
    // Coordinates beside a chart whose rates are the speeds leave some without a name.
    let unnamed = own.is_none() && statements.coordinates.is_some();
    if unnamed || (own.is_none() && !statements.in_chart) {
        if !uncertain {
            context.error(
                independent.clause.span(),
                "`independent` names speeds, and without `speeds(…)` they have no names; \
                 add `speeds(…)` and `kinematics(…)`, or remove `independent`",
            );
        }
        return;
    }
    let mut table = statements.speeds_of_chart.clone();
    table.extend(own.iter().flat_map(|speeds| &speeds.names).map(|speed| word(&speed.ident)));
    table.dedup();
    let complete = own.is_none_or(|speeds| speeds.complete);
    let table: Vec<(&str, ())> = table.iter().map(|name| (name.as_str(), ())).collect();
    for (index, name) in independent.names.iter().enumerate() {
        if independent.names[..index].iter().any(|earlier| same(earlier, name)) {
            context.error(name.span(), format!("`{name}` is named independent twice; remove one of the two"));
        } else if !table.iter().any(|(speed, ())| word(name) == **speed) && complete {
            let coordinate =
                statements.coordinates.iter().flat_map(|names| &names.names).any(|other| same(&other.ident, name));
            let problem = if coordinate { "is a coordinate, not a speed" } else { "is no speed" };
            // Between single letters every name is near; a coordinate is no misspelt speed.
            let single = word(name).chars().count() == 1;
            let near = if coordinate || single { None } else { names::nearest(&word(name), &table) };
            let remedy = match near {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None if table.is_empty() => "add it to `speeds(…)`".into(),
                None => format!("expected {}", names::list(&table)),
            };
            context.error(name.span(), format!("`{name}` {problem}; {remedy}"));
        }
    }
    let all_named = table.iter().all(|(speed, ())| independent.names.iter().any(|name| word(name) == **speed));
    if all_named && complete && !table.is_empty() {
        context.error(
            independent.clause.span(),
            "all speeds are named independent, and none is left to solve the constraints for; \
             leave out as many as there are constraints",
        );
    }
}
