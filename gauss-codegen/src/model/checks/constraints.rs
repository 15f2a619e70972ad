//! Rules for constraints, and for the speeds that stay independent under them.

use crate::model::language::context::Context;
use crate::model::language::kind::ValueKind;
use crate::model::language::statements::{Statement, Statements};
use crate::model::language::words::{self, same, word};
use crate::model::names::kinds;
use crate::model::names::moving_names::MovingNames;
use crate::model::names::places::ExpressionPlace;
use crate::model::names::scope::Scope;
use crate::model::scene::clauses::{ConstraintClause, ConstraintLevel, SpeedKind};
use proc_macro2::Ident;

/// Checks names and kinds in the constraints, and notes which of them are vectors. Returns for each whether it is
/// without mistakes.
pub fn check_kinds(statements: &mut Statements, scope: &Scope, context: &mut Context) -> Vec<bool> {
    let check = |constraint: &mut ConstraintClause| {
        let place = ExpressionPlace::Constraint(constraint.kind);
        let kind = kinds::check(&constraint.expression, place, scope, context);
        constraint.vector = kind == Some(ValueKind::Vector);
        kind.is_some()
    };
    statements.constraints.iter_mut().map(check).collect()
}

/// Checks what is constrained, in those that are `well`, and the speeds that stay independent.
pub fn check(statements: &Statements, well: &[bool], uncertain: bool, context: &mut Context) {
    let moving = MovingNames::new(statements);
    for (constraint, _) in statements.constraints.iter().zip(well).filter(|(_, well)| **well) {
        check_motion(constraint, &moving, context);
    }
    check_independent(statements, uncertain, context);
    check_redundant(statements, uncertain, context);
}

/// Motion has something to do with whether a constraint holds.
fn check_motion(constraint: &ConstraintClause, moving: &MovingNames, context: &mut Context) {
    let expression = &constraint.expression;
    let in_velocity = moving.in_velocity(expression);
    if !in_velocity && !moving.in_place(expression) {
        context.error(
            constraint.span,
            "the constraint names nothing that moves, so no motion makes it hold; \
             name a coordinate, a speed, or a body or point that moves",
        );
    } else if constraint.kind == ConstraintLevel::Velocity && !in_velocity {
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
    // Beside a chart, coordinates whose rates are the speeds leave some speeds without a name.
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
    // One word for each speed: those of a vector share theirs.
    let mut speeds = statements.speeds_of_chart.clone();
    speeds.extend(own.iter().flat_map(|speeds| &speeds.names).flat_map(|speed| {
        let count = if speed.kind == SpeedKind::Vector { 3 } else { 1 };
        std::iter::repeat_n(word(&speed.ident), count)
    }));
    let complete = own.is_none_or(|speeds| speeds.complete);
    let mut kept = vec![false; speeds.len()];
    for named in &independent.names {
        let name = &named.ident;
        let own: Vec<usize> = (0..speeds.len()).filter(|&k| word(name) == speeds[k]).collect();
        if own.is_empty() {
            if complete {
                refuse_name(name, &speeds, statements, context);
            }
            continue;
        }
        let own = match named.component {
            None => own.as_slice(),
            Some(k) if own.len() > 1 && k < own.len() => &own[k..=k],
            Some(_) => {
                context.error(name.span(), format!("`{name}` is one speed and has no components; write `{name}`"));
                continue;
            }
        };
        if own.iter().any(|&k| kept[k]) {
            context.error(name.span(), format!("`{named}` is named independent twice; remove one of the two"));
        }
        own.iter().for_each(|&k| kept[k] = true);
    }
    if complete && !kept.is_empty() && kept.iter().all(|kept| *kept) {
        context.error(
            independent.clause.span(),
            "all speeds are named independent, and none is left to solve the constraints for; \
             leave out as many as there are constraints",
        );
    }
}

/// `redundant` has constraints to be about, which keep their multipliers.
fn check_redundant(statements: &Statements, uncertain: bool, context: &mut Context) {
    let Some(redundant) = &statements.redundant else { return };
    if statements.constraints.is_empty() && !statements.missed_any(&[Statement::Constraint]) && !uncertain {
        context.error(
            redundant.span(),
            "without constraints none can depend on others; add `constraint(…)`, or remove `redundant`",
        );
    }
    if let Some(independent) = &statements.independent {
        context.error(
            independent.clause.span(),
            "constraints that may depend on one another cannot be solved for speeds when the code is written; remove \
             `independent` to have them kept with multipliers, or remove `redundant`",
        );
    }
}

/// Notes that a name is none of the speeds.
fn refuse_name(name: &Ident, speeds: &[String], statements: &Statements, context: &mut Context) {
    let mut table: Vec<(&str, ())> = speeds.iter().map(|speed| (speed.as_str(), ())).collect();
    table.dedup();
    let coordinate = statements.coordinates.iter().flat_map(|names| &names.names).any(|other| same(&other.ident, name));
    let problem = if coordinate { "is a coordinate, not a speed" } else { "is no speed" };
    // Between single letters every name is near; a coordinate is no misspelt speed.
    let single = word(name).chars().count() == 1;
    let near = if coordinate || single { None } else { words::nearest(&word(name), &table) };
    let remedy = match near {
        Some((near, ())) => format!("did you mean `{near}`?"),
        None if table.is_empty() => "add it to `speeds(…)`".into(),
        None => format!("expected {}", words::list(&table)),
    };
    context.error(name.span(), format!("`{name}` {problem}; {remedy}"));
}
