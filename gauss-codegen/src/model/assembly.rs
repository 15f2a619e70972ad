//! The clauses and fields of a scene put together: every name known, every kind right, nothing missing.

use super::bodies;
use super::constraints;
use super::context::Context;
use super::definitions;
use super::dimensions;
use super::fields::{ReadField, Reader};
use super::forces;
use super::given;
use super::kinds;
use super::motion;
use super::naming::{self, same, word};
use super::places::Place;
use super::scene::Clauses;
use super::scope::{Meaning, Scope, UNNAMED};
use super::shapes::Kind;
use super::statements::{Statement, Statements};
use super::validate;
use super::{BodyClause, Expression, Field, ForceKind, Given, InChart, Model, Role, Scalar, Shape, Wanted};
use proc_macro2::{Ident, Span};
use syn::{DeriveInput, Path};

/// The checked scene; `None` when something is wrong, which is then noted.
pub(super) fn model(
    input: &DeriveInput,
    clauses: Clauses,
    mut reader: Reader<'_>,
    context: &mut Context,
) -> Option<Model> {
    let Clauses { in_chart, runtime, wanted, mut statements, .. } = clauses;
    let is_empty = statements.is_empty();
    if in_chart.is_some() {
        statements.bodies.insert(0, body_in_chart());
    }
    mark_named(&statements, &mut reader);
    let scalar = validate::common_scalar(&reader.fields);
    let scalar_name = validate::scalar_name(scalar.as_ref(), input);
    let whole = if in_chart.is_some() { "body" } else { "system" };
    let (shapes, owners) = validate::shapes(&reader, scalar.as_ref(), &scalar_name, whole, context);
    let uncertain = statements.missed;

    // A body in a chart about which nothing else is said has no names that anything could confuse.
    if in_chart.is_none() || !is_empty {
        naming::check(&statements, &reader.fields, context);
    }
    motion::check_kinematics(&statements, uncertain, context);
    check_masses(input, &statements, &reader, &owners, &scalar_name, uncertain, context);
    bodies::check(&statements, &reader, &scalar_name, context);
    let unused = check_expressions(&mut statements, &reader, &shapes, &scalar_name, uncertain, context);
    if in_chart.is_none() && statements.coordinates.is_none() && !uncertain {
        let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
        context.error(span, "the system has no coordinates; add `coordinates(…)` with their names");
    }
    if context.is_clean() {
        motion::check_dependence(&statements, &expressions(&statements), context);
        check_effect(&statements, &unused, &owners, context);
    }
    let scalar = match scalar {
        Some(scalar) => scalar,
        None => validate::scalar_without_fields(input, &reader.fields, context)?,
    };
    let fields = fields(&reader, &shapes);
    assembled(input, (runtime, wanted, scalar, in_chart), fields, statements)
}

/// The body without a name, where a chart says where it is.
fn body_in_chart() -> BodyClause {
    BodyClause {
        name: None,
        massless: false,
        parent: None,
        position: None,
        rotation: None,
        given: Vec::new(),
        span: Span::call_site(),
    }
}

/// Checks names and kinds in all expressions, and writes the definitions out; gives back those that are not used.
fn check_expressions(
    statements: &mut Statements,
    reader: &Reader<'_>,
    shapes: &[Shape],
    scalar: &str,
    uncertain: bool,
    context: &mut Context,
) -> Vec<Ident> {
    let earlier = context.count();
    let mut scope = scope(statements, &reader.fields, shapes, scalar, uncertain);
    definitions::check(&statements.definitions, &mut scope, context);
    for (place, expression) in expressions(statements) {
        // Of constraints and mass data the kind is needed as well.
        let later = matches!(place, Place::Constraint(_) | Place::Given(_)) || place == given::ENTRY;
        if !later {
            kinds::check(expression, place, &scope, context);
        }
    }
    let all = std::iter::once(&mut statements.given).chain(statements.bodies.iter_mut().map(|body| &mut body.given));
    all.for_each(|given| given::check(given, &reader.fields, &scope, context));
    forces::check(statements, context);
    forces::check_coefficients(statements, &reader.fields, &scope, scalar, context);
    let well = constraints::check_kinds(statements, &scope, context);
    let all: Vec<&Expression> = expressions(statements).into_iter().map(|(_, expression)| expression).collect();
    let unused = definitions::unused(statements, &all);
    // Only what is well otherwise has dimensions.
    if context.count() == earlier {
        dimensions::check(statements, &reader.fields, context);
    }
    definitions::inline(statements);
    constraints::check(statements, &well, uncertain, context);
    unused
}

/// Everything that is written does something. Asked only where all else is well.
fn check_effect(statements: &Statements, unused: &[Ident], owners: &[(Role, usize)], context: &mut Context) {
    forces::check_effect(statements, context);
    let given = statements.given.iter().chain(statements.bodies.iter().flat_map(|body| &body.given));
    let mut roles = owners.iter().map(|(role, _)| *role).chain(given.map(|given| given.role));
    let fluid = roles.any(|role| matches!(role, Role::AddedMass | Role::DisplacedMass));
    forces::check_medium(statements, fluid, context);
    for name in unused {
        context.error(name.span(), format!("`{name}` is defined and never used; remove it"));
    }
}

/// The fields with their shapes.
fn fields(reader: &Reader<'_>, shapes: &[Shape]) -> Vec<Field> {
    let field = |(field, &shape): (&ReadField<'_>, &Shape)| Field {
        ident: field.ident.clone(),
        role: field.role.as_ref().map(|claim| claim.role),
        shape,
        unit: field.unit.clone(),
        documentation: field.documentation.clone(),
    };
    reader.fields.iter().zip(shapes).map(field).collect()
}

/// The model; `None` if the coordinates or the kinematics are not known, which is then noted.
fn assembled(
    input: &DeriveInput,
    (runtime, wanted, scalar, in_chart): (Path, Wanted, Scalar, Option<InChart>),
    fields: Vec<Field>,
    mut statements: Statements,
) -> Option<Model> {
    statements.place_at_points();
    let coordinates = match statements.coordinates {
        Some(coordinates) => coordinates.names,
        None => in_chart.map(|_| Vec::new())?,
    };
    let mut kinematics = Vec::new();
    if let Some(written) = &statements.kinematics {
        for coordinate in &coordinates {
            let (_, rate) = written.rates.iter().find(|(name, _)| same(name, &coordinate.ident))?;
            kinematics.push((coordinate.ident.clone(), rate.clone()?));
        }
    }
    Some(Model {
        ident: input.ident.clone(),
        visibility: input.vis.clone(),
        generics: input.generics.clone(),
        scalar,
        runtime,
        wanted,
        fields,
        in_chart,
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
        given: statements.given,
        medium: statements.medium.and_then(|(_, velocity)| velocity),
        attractions: statements.attractions,
        forces: statements.forces,
    })
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
    let given = statements.given.iter().chain(statements.bodies.iter().flat_map(|body| &body.given));
    all.extend(given.flat_map(Given::expressions));
    for particle in &statements.particles {
        all.push((Place::Mass, &particle.mass));
        all.push((Place::Particle { parent: particle.parent.is_some() }, &particle.position));
    }
    all.extend(statements.points.iter().map(|point| (Place::At, &point.at)));
    if let Some((_, Some(potential))) = &statements.potential {
        all.push((Place::Potential, potential));
    }
    if let Some((_, Some(velocity))) = &statements.medium {
        all.push((Place::Medium, velocity));
    }
    for clause in &statements.attractions {
        all.push((Place::Constant { word: "gravitational parameter", noun: "central gravity" }, &clause.mu));
        all.extend(clause.center.as_ref().map(|center| (Place::Center, center)));
    }
    for clause in &statements.forces {
        let on = clause.kind.body_with_place();
        for (place, expression) in clause.expressions() {
            match place {
                // What a point of the body itself is called says where that is in the body.
                Place::ForceAt { .. } if on.is_some_and(|body| statements.own_point(body, expression).is_some()) => {}
                Place::ForceAt { .. } if statements.in_chart => all.push((Place::ForceAt { bound: true }, expression)),
                place => all.push((place, expression)),
            }
        }
    }
    all.extend(statements.constraints.iter().map(|clause| (Place::Constraint(clause.kind), &clause.expression)));
    all
}

/// Fields that expressions name are computed with, as those with roles are.
fn mark_named(statements: &Statements, reader: &mut Reader<'_>) {
    let coefficients = forces::coefficient_fields(statements);
    for field in &mut reader.fields {
        field.computed |= match field.reading.kind {
            Kind::Known(Shape::Scalar | Shape::Vector3) => statements.name(&word(field.ident)),
            Kind::Known(Shape::Vector6 | Shape::Matrix6) => {
                coefficients.iter().any(|(name, _)| same(name, field.ident))
            }
            _ => false,
        };
    }
}

impl Statements {
    /// Whether some expression names `word`.
    pub(super) fn name(&self, word: &str) -> bool {
        let definitions = self.definitions.iter().filter_map(|definition| definition.expression.as_ref());
        let all = expressions(self);
        all.iter().map(|(_, expression)| *expression).chain(definitions).any(|expression| expression.names(word))
    }

    /// Calls `change` with every expression.
    pub(super) fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        let rates = self.kinematics.iter_mut().flat_map(|kinematics| &mut kinematics.rates);
        rates.filter_map(|(_, rate)| rate.as_mut()).for_each(&mut *change);
        for body in &mut self.bodies {
            body.position.iter_mut().chain(&mut body.rotation).for_each(&mut *change);
        }
        let of_bodies = self.bodies.iter_mut().flat_map(|body| &mut body.given);
        self.given.iter_mut().chain(of_bodies).for_each(|given| given.each_expression(change));
        for particle in &mut self.particles {
            change(&mut particle.mass);
            change(&mut particle.position);
        }
        self.points.iter_mut().for_each(|point| change(&mut point.at));
        self.constraints.iter_mut().for_each(|constraint| change(&mut constraint.expression));
        for (_, value) in self.potential.iter_mut().chain(&mut self.medium) {
            value.iter_mut().for_each(&mut *change);
        }
        for clause in &mut self.attractions {
            change(&mut clause.mu);
            clause.center.iter_mut().for_each(&mut *change);
        }
        self.forces.iter_mut().for_each(|clause| clause.kind.each_expression(change));
    }

    /// Writes the places of points in the place of their names, where forces act in the axes of the body that has them.
    fn place_at_points(&mut self) {
        let mut forces = std::mem::take(&mut self.forces);
        for clause in &mut forces {
            let Some(body) = clause.kind.body_with_place().cloned() else { continue };
            if let ForceKind::OnBody { at: Some(at), .. } | ForceKind::Wrench { at: Some(at), .. } = &mut clause.kind
                && let Some(point) = self.own_point(&body, at)
            {
                *at = point.at.clone();
            }
        }
        self.forces = forces;
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
    let given = |role: Role| statements.given.iter().any(|given| given.role == role);
    let known =
        |role: Role| owners.iter().any(|(owner, _)| *owner == role) || reader.meant.contains(&role) || given(role);
    // An accelerating medium pushes the displaced mass as gravity does.
    let pushed = statements.medium.is_some();
    let known = |role: Role| known(role) || (role == Role::Gravity && pushed);
    let bodies = statements.massive().count();
    // Of several unnamed bodies none is meant to have the roles: they must get names first.
    if let (Some(clause), [false, false]) = (&statements.of_chart, [Role::Mass, Role::Inertia].map(known)) {
        let [mass, inertia] = [Role::Mass, Role::Inertia].map(|role| role.example(scalar));
        context.error(
            clause.span(),
            format!(
                "`{clause}` moves a body without a name, and `{}` has no mass data of one; add `{mass}` and `{inertia}`, \
                 or remove `{clause}`: what else moves is said by `coordinates` and `speeds`",
                input.ident
            ),
        );
    } else if statements.in_chart || (statements.has_unnamed_body() && bodies == 1 && !uncertain) {
        for role in [Role::Mass, Role::Inertia] {
            if !known(role) {
                validate::missing_role(input, role, scalar, context);
            }
        }
    }
    for claim in reader.fields.iter().filter_map(|field| field.role.as_ref()) {
        validate::check_companion(claim.role, claim.span, known, scalar, context);
    }
    given::check_roles(&statements.given, &reader.fields, known, scalar, context);
    statements.massive().for_each(|body| given::check_fluid(body, known(Role::Gravity), scalar, context));
    if statements.has_unnamed_body() {
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
    for given in statements.given.iter().filter(|given| given.role != Role::Gravity) {
        let word = given.role.word();
        context.error(
            given.span,
            format!(
                "`{word}` is that of a body without a name, and this system has none; write it in the clause of the body: \
                 `body(name, {word} = …)`"
            ),
        );
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
fn scope(statements: &Statements, fields: &[ReadField<'_>], shapes: &[Shape], scalar: &str, uncertain: bool) -> Scope {
    let coordinates = statements.coordinates.as_ref();
    let speeds = statements.speeds.as_ref();
    let inputs = statements.inputs.as_ref();
    // Without a clause of coordinates, or of speeds where there are kinematics, every name is one that is missing there.
    let complete = !uncertain
        && !statements.missed_any(&[Statement::Frame, Statement::Point, Statement::Define])
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
