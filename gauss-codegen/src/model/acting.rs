//! What acts on one body in a chart: the same body as a system, whose only coordinate is its pose, so that everything that acts
//! is said, and checked, as it is of systems.

use super::assembly;
use super::bodies;
use super::context::Context;
use super::declarations::Names;
use super::fields::Reader;
use super::naming;
use super::statements::Statements;
use super::{BodyClause, Coordinate, CoordinateKind, Expression, ExpressionKind, Property, Role, Shape};
use proc_macro2::{Ident, Span};

/// The coordinate: expressions cannot name it.
const POSE: &str = "__pose";

/// Makes the statements those of a system and checks them; `scalar` is what proposed types are made of.
pub(super) fn check(
    statements: &mut Statements,
    reader: &Reader<'_>,
    shapes: &[Shape],
    owners: &[(Role, usize)],
    scalar: &str,
    context: &mut Context,
) {
    place(statements);
    let uncertain = statements.missed;
    naming::check(statements, &reader.fields, context);
    bodies::check(statements, reader, scalar, context);
    let unused = assembly::check_expressions(statements, reader, shapes, scalar, uncertain, context);
    if context.is_clean() {
        assembly::check_effect(statements, &unused, owners, context);
    }
}

/// Adds the coordinate and the body that has it for its pose.
fn place(statements: &mut Statements) {
    let pose = Ident::new(POSE, Span::call_site());
    let of_pose = |property: Property| {
        let name = Expression { kind: ExpressionKind::Name(pose.clone()), span: pose.span() };
        Some(Expression { kind: ExpressionKind::Property(Box::new(name), property), span: pose.span() })
    };
    statements.bodies.push(BodyClause {
        name: None,
        massless: false,
        parent: None,
        position: of_pose(Property::Position),
        rotation: of_pose(Property::Rotation),
        given: Vec::new(),
        span: pose.span(),
    });
    let coordinate = Coordinate { ident: pose.clone(), kind: CoordinateKind::Pose };
    statements.coordinates = Some(Names { clause: pose, names: vec![coordinate], complete: true });
}
