//! The clauses and fields of a system put together: every name known, every kind right, nothing missing.

use super::bodies;
use super::constraints;
use super::context::Context;
use super::fields::{Field, Reader};
use super::forces;
use super::kinds;
use super::motion;
use super::naming::{self, same};
use super::places::Place;
use super::scene::Clauses;
use super::scope::{Meaning, Scope};
use super::shapes::{Element, Kind};
use super::statements::{Statement, Statements};
use super::validate;
use super::{Expression, ForceClause, Role, Scalar, Shape, SystemField, SystemModel};
use proc_macro2::{Ident, Span};
use syn::ext::IdentExt;
use syn::{DeriveInput, GenericParam};

/// The checked system; `None` when something is wrong, which is then noted.
pub(super) fn system(
    input: &DeriveInput,
    clauses: Clauses,
    mut reader: Reader<'_>,
    context: &mut Context,
) -> Option<SystemModel> {
    let mut statements = clauses.statements.unwrap_or_default();
    for clause in &clauses.of_one_body {
        refuse_clause_of_one_body(clause, context);
    }
    mark_named(&statements, &mut reader);
    let scalar = validate::common_scalar(&reader.fields);
    let scalar_name = validate::scalar_name(scalar.as_ref(), input);
    let (shapes, owners) = validate::shapes(&reader, scalar.as_ref(), &scalar_name, "system", context);
    let uncertain = statements.missed;

    naming::check(&statements, &reader.fields, context);
    motion::check_kinematics(&statements, uncertain, context);
    check_masses(input, &statements, &reader, &owners, &scalar_name, uncertain, context);
    bodies::check(&statements, &reader, &scalar_name, context);
    let scope = scope(&statements, &reader.fields, &shapes, &scalar_name, uncertain);
    for (place, expression) in expressions(&statements) {
        // Of constraints the kind is needed as well.
        if !matches!(place, Place::Constraint(_)) {
            kinds::check(expression, place, &scope, context);
        }
    }
    forces::check(&statements, context);
    constraints::check(&mut statements, &scope, uncertain, context);
    if statements.coordinates.is_none() && !uncertain {
        let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
        context.error(span, "the system has no coordinates; add `coordinates(…)` with their names");
    }
    if context.is_clean() {
        motion::check_dependence(&statements, &expressions(&statements), context);
        forces::check_effect(&statements, context);
    }
    let scalar = match scalar {
        Some(scalar) => scalar,
        None => scalar_without_fields(input, &reader.fields, context)?,
    };
    let fields = reader.fields.iter().zip(shapes).map(|(field, shape)| SystemField {
        ident: field.ident.clone(),
        role: field.role.as_ref().map(|claim| claim.role),
        shape,
        documentation: field.documentation.clone(),
    });
    let fields = fields.collect();
    let coordinates = statements.coordinates?.names;
    let mut kinematics = Vec::new();
    if let Some(written) = &statements.kinematics {
        for coordinate in &coordinates {
            let (_, rate) = written.rates.iter().find(|(name, _)| same(name, &coordinate.ident))?;
            kinematics.push((coordinate.ident.clone(), rate.clone()?));
        }
    }
    Some(SystemModel {
        ident: input.ident.clone(),
        visibility: input.vis.clone(),
        generics: input.generics.clone(),
        scalar,
        runtime: clauses.runtime,
        fields,
        coordinates,
        speeds: statements.speeds.map(|speeds| speeds.names),
        kinematics,
        bodies: statements.bodies,
        particles: statements.particles,
        points: statements.points,
        constraints: statements.constraints,
        independent: statements.independent.map(|independent| independent.names),
        limit: statements.limit.and_then(|(_, limit)| limit),
        potential: statements.potential.and_then(|(_, potential)| potential),
        inputs: statements.inputs.map_or_else(Vec::new, |inputs| inputs.names),
        forces: statements.forces,
    })
}

/// `chart` and `motion` choose among what one body has; a system says both by its own clauses.
fn refuse_clause_of_one_body(clause: &Ident, context: &mut Context) {
    let instead = if clause.unraw() == "chart" {
        "the quasi-velocities of a system are its `speeds`, or the rates of its `coordinates`"
    } else {
        "what a system is free to do is said by its `coordinates` and `speeds`"
    };
    context.error(
        clause.span(),
        format!("`{clause}` is for one body without coordinates of its own; {instead}: remove `{clause}`"),
    );
}

/// Every expression, with its place; those of constraints come after the others.
fn expressions(statements: &Statements) -> Vec<(Place, &Expression)> {
    let mut all = Vec::new();
    let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
    for (name, rate) in statements.kinematics.iter().flat_map(|kinematics| &kinematics.rates) {
        let kind = coordinates().find(|coordinate| same(&coordinate.ident, name)).map(|coordinate| coordinate.kind);
        all.extend(rate.as_ref().map(|rate| (Place::Kinematics(kind), rate)));
    }
    for body in &statements.bodies {
        all.extend(body.position.as_ref().map(|position| (Place::Position, position)));
        all.extend(body.rotation.as_ref().map(|rotation| (Place::Rotation, rotation)));
    }
    for particle in &statements.particles {
        all.push((Place::Mass, &particle.mass));
        all.push((Place::Particle { parent: particle.parent.is_some() }, &particle.position));
    }
    all.extend(statements.points.iter().map(|point| (Place::At, &point.at)));
    if let Some((_, Some(potential))) = &statements.potential {
        all.push((Place::Potential, potential));
    }
    all.extend(statements.forces.iter().flat_map(ForceClause::expressions));
    all.extend(statements.constraints.iter().map(|clause| (Place::Constraint(clause.kind), &clause.expression)));
    all
}

/// Fields that expressions name are computed with, as those with roles are.
fn mark_named(statements: &Statements, reader: &mut Reader<'_>) {
    let all = expressions(statements);
    for field in &mut reader.fields {
        let word = field.ident.unraw().to_string();
        let usable = matches!(field.reading.kind, Kind::Known(Shape::Scalar | Shape::Vector3));
        field.computed |= usable && all.iter().any(|(_, expression)| expression.names(&word));
    }
}

/// Something has mass, and roles belong to the unnamed body.
fn check_masses(
    input: &DeriveInput,
    statements: &Statements,
    reader: &Reader<'_>,
    owners: &[(Role, usize)],
    scalar: &str,
    uncertain: bool,
    context: &mut Context,
) {
    let known = |role: Role| owners.iter().any(|(owner, _)| *owner == role) || reader.meant.contains(&role);
    for field in &reader.fields {
        validate::check_companion(field, known, scalar, context);
    }
    let bodies = statements.massive().count();
    if statements.has_unnamed_body() {
        // Of several unnamed bodies none is meant to have the roles: they must get names first.
        if bodies == 1 && !uncertain {
            for role in [Role::Mass, Role::Inertia] {
                if !known(role) {
                    validate::missing_role(input, role, scalar, context);
                }
            }
        }
        return;
    }
    if uncertain || statements.missed_any(&[Statement::Body, Statement::Particle]) {
        return;
    }
    if bodies == 0 && statements.particles.is_empty() {
        let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
        let body_field = reader.fields.iter().any(|field| field.role.as_ref().is_some_and(|c| c.role == Role::Body));
        // Of a field without its clause, or a role without its body, it is said there what to add.
        if !body_field {
            context.error(
                span,
                "the system has no body and no particle, so nothing in it has mass; \
                 add `body(position = […], rotation = …)` or `particle(mass = …, position = […])`",
            );
        }
        return;
    }
    for field in &reader.fields {
        let Some(claim) = &field.role else { continue };
        if matches!(claim.role, Role::Gravity | Role::Body) {
            continue;
        }
        let word = claim.role.word();
        context.error(
            claim.span,
            format!(
                "the role `{word}` belongs to a body without a name, and this system has none; \
                 add `body(position = […], rotation = …)`, or remove the role: expressions can name `{}` without it",
                field.ident
            ),
        );
    }
}

/// What expressions may name.
fn scope(statements: &Statements, fields: &[Field<'_>], shapes: &[Shape], scalar: &str, uncertain: bool) -> Scope {
    let coordinates = statements.coordinates.as_ref();
    let speeds = statements.speeds.as_ref();
    let inputs = statements.inputs.as_ref();
    // Without a clause of coordinates, or of speeds where there are kinematics, every name is one that is missing there.
    let complete = !uncertain
        && !statements.missed_any(&[Statement::Frame, Statement::Point])
        && coordinates.is_some_and(|names| names.complete)
        && speeds.map_or(statements.kinematics.is_none(), |names| names.complete)
        && inputs.is_none_or(|names| names.complete);
    let unnamed = statements.has_unnamed_body().then(|| bodies::unnamed(scalar));
    let mut scope = Scope::new(complete, unnamed);
    for coordinate in coordinates.iter().flat_map(|names| &names.names) {
        scope.add(&coordinate.ident, Meaning::Coordinate(coordinate.kind));
    }
    for speed in speeds.iter().flat_map(|names| &names.names) {
        scope.add(&speed.ident, Meaning::Speed(speed.kind));
    }
    for input in inputs.iter().flat_map(|names| &names.names) {
        scope.add(&input.ident, Meaning::Input(input.kind));
    }
    for (field, shape) in fields.iter().zip(shapes) {
        scope.add(field.ident, meaning(field, *shape, scalar));
    }
    // A body whose field is missing, or something else, is a body all the same.
    for name in statements.massive().filter_map(|body| body.name.as_ref()) {
        scope.add(name, Meaning::Body);
    }
    for name in statements.frames() {
        scope.add(name, Meaning::Frame);
    }
    for point in &statements.points {
        scope.add(&point.name, Meaning::Point);
    }
    scope
}

fn meaning(field: &Field<'_>, shape: Shape, scalar: &str) -> Meaning {
    let name = field.ident;
    let found = &field.reading.name;
    // The shape by role serves where the type is an alias; a wrong scalar is noted where it is written.
    let shape = match field.reading.kind {
        Kind::Known(known) if shape == Shape::Other => known,
        _ => shape,
    };
    match (shape, field.reading.kind) {
        (Shape::Scalar, _) => Meaning::Scalar,
        (Shape::Vector3, _) => Meaning::Vector,
        (Shape::RigidBody, _) if field.role.is_some() => Meaning::Body,
        (Shape::RigidBody, _) => Meaning::Unusable(format!(
            "the field `{name}` has no role; a body is a field `#[gauss(body)] {name}: RigidBody<{scalar}>` with a clause \
             `body({name}, …)`"
        )),
        (Shape::Other, Kind::Alias) => Meaning::Unusable(format!(
            "what the field `{name}` is cannot be read from {found}; write `{scalar}` or `Vector3<{scalar}>` for its type"
        )),
        _ => Meaning::Unusable(format!(
            "the type of the field `{name}` is {found}, and expressions name scalars and vectors only: \
             `{scalar}` or `Vector3<{scalar}>`"
        )),
    }
}

/// The scalar of a system none of whose fields shows one.
fn scalar_without_fields(input: &DeriveInput, fields: &[Field<'_>], context: &mut Context) -> Option<Scalar> {
    let generic = input.generics.params.iter().any(|parameter| matches!(parameter, GenericParam::Type(_)));
    let hidden = fields.iter().find(|field| field.computed && matches!(field.reading.element, Element::Hidden));
    match hidden {
        None if !generic => Some(Scalar::F64),
        _ => {
            if context.is_clean() {
                let span: Span = hidden.map_or(input.ident.span(), |field| field.ident.span());
                context.error(
                    span,
                    "the scalar cannot be read from any field that the system computes with; \
                     write `f64`, `f32` or a type parameter in one of them",
                );
            }
            None
        }
    }
}
