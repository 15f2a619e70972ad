//! Rules for contacts.

use crate::model::language::context::Context;
use crate::model::language::statements::Statements;
use crate::model::language::words::{same, word};
use crate::model::names::kinds;
use crate::model::names::moving_names::MovingNames;
use crate::model::names::scope::Scope;
use crate::model::scene::contacts::{ContactClause, ContactGeometry, Copies, Counterpart, PointContact};
use crate::model::scene::expression::{Expression, ExpressionKind, Property};

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
    let moving = MovingNames::new(statements);
    let check_slips = |slips: &[Expression], context: &mut Context| {
        for slip in slips.iter().filter(|slip| !moving.in_velocity(slip)) {
            context.error(
                slip.span,
                "the slip contains no velocity of anything that moves; write `tip.velocity`, a speed, or the time \
                 derivative `rate(…)`",
            );
        }
    };
    for (clause, _) in statements.contacts.iter().zip(well).filter(|(_, well)| **well) {
        check_axes(clause, context);
        match &clause.touching {
            ContactGeometry::Gap { gap, slips, spin, rolls } => {
                if !moving.in_place(gap) {
                    context.error(
                        gap.span,
                        "the gap names nothing that moves, so it never closes; name a coordinate, or a body or point \
                         that moves",
                    );
                }
                check_slips(slips, context);
                for turn in spin.iter().chain(rolls).filter(|turn| !moving.in_velocity(turn)) {
                    context.error(
                        turn.span,
                        "this contains no velocity of anything that moves; write a component of \
                         `ball.angular_velocity`, a speed, or the time derivative `rate(…)`",
                    );
                }
            }
            ContactGeometry::Slip { slips, .. } => check_slips(slips, context),
            ContactGeometry::Point(contact) => check_point(statements, clause, contact, &moving, context),
            ContactGeometry::Range { along, .. } if !moving.in_place(along) => context.error(
                along.span,
                "the range is that of nothing that moves, as a locked coordinate is; name a coordinate, or a body or point \
                 that moves",
            ),
            ContactGeometry::Range { .. } => {}
        }
    }
}

/// Friction of two axes has two slips, and no drilling.
fn check_axes(clause: &ContactClause, context: &mut Context) {
    if let (Some(_), [_, second]) = (&clause.drilling, &clause.friction[..]) {
        context.error(
            second.span,
            "friction of drilling goes with the same friction along both tangents; write one coefficient, or remove \
             `drilling`",
        );
    }
    if let ContactGeometry::Gap { slips, .. } | ContactGeometry::Slip { slips, .. } = &clause.touching
        && let ([_], [_, second]) = (&slips[..], &clause.friction[..])
    {
        context.error(second.span, "along one slip there is one friction; remove the second, or write `slip = [u, v]`");
    }
}

/// Something moves; a body turns what has friction away from its point, or has an axis; tangents are known.
fn check_point(
    statements: &Statements,
    clause: &ContactClause,
    contact: &PointContact,
    moving: &MovingNames,
    context: &mut Context,
) {
    let other = match &contact.against {
        Counterpart::Sphere { center, .. } => Some(center),
        Counterpart::Plane { .. } | Counterpart::Ground(_) => None,
    };
    let end = match &contact.copies {
        Copies::Ends(end) => Some(end),
        _ => None,
    };
    if !contact.places().any(|point| moving.in_place(point)) {
        context.error(
            contact.point.span,
            "the point does not move, so it never touches; name a coordinate, or a body or point that moves",
        );
    }
    check_capsule(&contact.against, statements, context);
    let rubs = !clause.friction.is_empty();
    let turns = contact.rim.is_some() || contact.semi_axes.is_some() || matches!(contact.copies, Copies::Corners(_));
    let needs_body = turns || (contact.radius.is_some() && rubs);
    let mut needing = vec![&contact.point];
    needing.extend(end);
    let needing = needing.into_iter().filter(|_| needs_body);
    let turned = match &contact.against {
        Counterpart::Sphere { center, end, radius, .. } if rubs && (end.is_some() || radius.is_some()) => {
            Some(center).filter(|center| moving.in_place(center))
        }
        _ => None,
    };
    for point in needing.chain(turned).filter(|point| !is_of_body(point, statements)) {
        context.error(
            point.span,
            "a box, a rim, an ellipsoid, or a sphere with friction, turns with its body; write `point = ball.position` of the \
             body, or the name of a point that is fixed in it",
        );
    }
    if (clause.drilling.is_some() || clause.rolling.is_some()) && !needs_body {
        let touched = other.filter(|center| moving.in_place(center));
        for point in std::iter::once(&contact.point).chain(end).chain(touched) {
            check_turning(point, statements, context);
        }
    }
    if let Counterpart::Sphere { center, along: None, .. } = &contact.against
        && rubs
    {
        context.error(
            center.span,
            "the tangents of two spheres turn with their line of centers; add `along = [0, 0, 1]`, a direction that this \
             line never has",
        );
    }
    if let Counterpart::Plane { normal: Some(normal), along: None, .. } = &contact.against
        && !clause.friction.is_empty()
        && normal.literal_components().is_none()
    {
        context.error(
            normal.span,
            "the tangents of a normal that is not written in numbers are not known; add `along = [1, 0, 0]`, a direction \
             that is not that of the normal",
        );
    }
}

/// Both ends of a capsule that is touched are points of one body.
fn check_capsule(against: &Counterpart, statements: &Statements, context: &mut Context) {
    let Counterpart::Sphere { center, end: Some(end), .. } = against else { return };
    let [first, last] = [center, end].map(|point| owner(point, statements));
    if first.is_none() || first != last {
        context.error(
            end.span,
            "a capsule is one body: write `other` and `other_end` as points of one, or as `hull.position`",
        );
    }
}

/// The point of what drills or rolls is one of a body.
fn check_turning(point: &Expression, statements: &Statements, context: &mut Context) {
    if !is_of_body(point, statements) {
        context.error(
            point.span,
            "what drills or rolls turns with its body; write `point = ball.position` of the body, or the name of a point \
             that is fixed in it",
        );
    }
}

/// A point that is fixed in a body or a frame, or the O of one.
fn is_of_body(point: &Expression, statements: &Statements) -> bool {
    owner(point, statements).is_some()
}

/// The body or the frame of such a point.
fn owner(point: &Expression, statements: &Statements) -> Option<String> {
    match &point.kind {
        ExpressionKind::Name(name) => {
            statements.points.iter().find(|point| same(&point.name, name)).map(|point| word(&point.body))
        }
        ExpressionKind::Property(owner, Property::Position) => match &owner.kind {
            ExpressionKind::Name(name) => {
                statements.bodies.iter().any(|body| body.word() == word(name)).then(|| word(name))
            }
            _ => None,
        },
        _ => None,
    }
}
