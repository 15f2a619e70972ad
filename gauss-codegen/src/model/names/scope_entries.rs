//! Declarations of a scene, for expressions to name.

use super::scope::{DeclaredFunction, Meaning, Scope};
use crate::model::language::fields::ReadField;
use crate::model::language::shapes::TypeKind;
use crate::model::language::statements::{Statement, Statements};
use crate::model::language::words::UNNAMED;
use crate::terms::Shape;
use proc_macro2::{Ident, Span};

/// Collects the names that expressions may use.
pub fn scope(
    statements: &Statements,
    fields: &[ReadField<'_>],
    shapes: &[Shape],
    scalar: &str,
    uncertain: bool,
) -> Scope {
    let coordinates = statements.coordinates.as_ref();
    let speeds = statements.speeds.as_ref();
    let inputs = statements.inputs.as_ref();
    // Without a clause of coordinates, or of speeds where there are kinematics, every name is one that is missing
    // there.
    let complete = !uncertain
        && !statements.missed_any(&[
            Statement::Frame,
            Statement::Point,
            Statement::States,
            Statement::Define,
            Statement::Function,
            Statement::Table,
        ])
        && coordinates.map_or(statements.in_chart, |names| names.complete)
        && speeds.map_or(statements.kinematics.is_none(), |names| names.complete)
        && inputs.is_none_or(|names| names.complete);
    let mut scope = Scope::new(complete);
    for coordinate in coordinates.iter().flat_map(|names| &names.names) {
        scope.add(&coordinate.ident, Meaning::Coordinate(coordinate.kind));
    }
    for speed in speeds.iter().flat_map(|names| &names.names) {
        scope.add(&speed.ident, Meaning::Speed(speed.kind));
    }
    for state in &statements.states {
        scope.add(&state.name, Meaning::State);
    }
    for input in inputs.iter().flat_map(|names| &names.names) {
        scope.add(&input.ident, Meaning::Input(input.kind));
    }
    for (index, definition) in statements.definitions.iter().enumerate() {
        scope.add(&definition.name, Meaning::Definition(index));
    }
    for (field, shape) in fields.iter().zip(shapes) {
        scope.add(field.ident, meaning(field, *shape, scalar));
    }
    // A body whose field is missing, or something else, is a body all the same.
    for name in statements.massive().filter_map(|body| body.name.as_ref()) {
        scope.add(name, Meaning::Body);
    }
    if statements.has_unnamed_body() {
        scope.add(&Ident::new(UNNAMED, Span::call_site()), Meaning::Body);
    }
    for name in statements.frames() {
        scope.add(name, Meaning::Frame);
    }
    for function in &statements.functions {
        let declared =
            DeclaredFunction { kink: function.kind.continuous() == Some(0), variables: function.kind.variables() };
        scope.add(&function.name, Meaning::Function(declared));
    }
    for point in &statements.points {
        scope.add(&point.name, Meaning::Point);
    }
    scope
}

fn meaning(field: &ReadField<'_>, shape: Shape, scalar: &str) -> Meaning {
    let name = field.ident;
    let found = &field.reading.name;
    // The shape by role serves where the type is an alias; a wrong scalar is noted where it is written.
    let shape = match field.reading.kind {
        TypeKind::Known(known) if shape == Shape::Other => known,
        _ => shape,
    };
    match (shape, field.reading.kind) {
        (Shape::Scalar, _) => Meaning::Scalar,
        (Shape::Vector3, _) => Meaning::Vector,
        (Shape::RigidBody | Shape::CentralBody, _) if field.role.is_some() => Meaning::Body,
        (Shape::RigidBody | Shape::CentralBody, _) => Meaning::Unusable(format!(
            "the field `{name}` has no role; a body is a field `#[gauss(body)] {name}: RigidBody<{scalar}>` with a clause \
             `body({name}, …)`"
        )),
        (Shape::Other, TypeKind::Alias) => Meaning::Unusable(format!(
            "the kind of the field `{name}` cannot be read from {found}; write `{scalar}` or `Vector3<{scalar}>` for its type"
        )),
        _ => Meaning::Unusable(format!(
            "the type of the field `{name}` is {found}, and expressions name scalars and vectors only: \
             `{scalar}` or `Vector3<{scalar}>`"
        )),
    }
}
