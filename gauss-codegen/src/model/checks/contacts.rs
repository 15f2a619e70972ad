//! What must hold of contacts.

use crate::model::language::context::Context;
use crate::model::language::statements::Statements;
use crate::model::names::kinds;
use crate::model::names::moving::Moving;
use crate::model::names::scope::Scope;
use crate::model::scene::contacts::{ContactClause, Touching};

/// Checks names and kinds in the contacts. Returns for each clause whether it is without mistakes.
pub fn check_kinds(statements: &Statements, scope: &Scope, context: &mut Context) -> Vec<bool> {
    let check = |clause: &ContactClause| {
        let earlier = context.count();
        for (place, expression) in clause.placed() {
            kinds::check(expression, place, scope, context);
        }
        context.count() == earlier
    };
    statements.contacts.iter().map(check).collect()
}

/// Checks that gaps and slips are those of something that moves, in the clauses that are `well`.
pub fn check(statements: &Statements, well: &[bool], context: &mut Context) {
    let moving = Moving::new(statements);
    for (clause, _) in statements.contacts.iter().zip(well).filter(|(_, well)| **well) {
        match &clause.touching {
            Touching::Gap { gap, slips } => {
                if !moving.in_place(gap) {
                    context.error(
                        gap.span,
                        "the gap names nothing that moves, so it never closes; name a coordinate, or a body or point \
                         that moves",
                    );
                }
                for slip in slips.iter().filter(|slip| !moving.in_velocity(slip)) {
                    context.error(
                        slip.span,
                        "the slip contains no velocity of anything that moves; write `tip.velocity`, a speed, or the \
                         time derivative `rate(…)`",
                    );
                }
            }
            Touching::Range { along, .. } if !moving.in_place(along) => context.error(
                along.span,
                "the range is that of nothing that moves; name a coordinate, or a body or point that moves",
            ),
            Touching::Range { .. } => {}
        }
    }
}
