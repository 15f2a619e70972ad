//! The clauses and fields of a system put together: every name known, every kind right, nothing missing.

use super::bodies;
use super::context::Context;
use super::fields::{Field, Reader};
use super::functions::FUNCTIONS;
use super::kinds::{self, Place};
use super::names;
use super::scene::Clauses;
use super::scope::{Meaning, Scope, TIME};
use super::shapes::{Element, Kind};
use super::statements::{Names, Statements};
use super::validate;
use super::{Coordinate, CoordinateKind, Expression, Role, Scalar, Shape, Speed, SpeedKind, SystemField, SystemModel};
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
    let statements = clauses.statements.unwrap_or_default();
    for clause in &clauses.of_one_body {
        refuse_clause_of_one_body(clause, context);
    }
    mark_named(&statements, &mut reader);
    let scalar = validate::common_scalar(&reader.fields);
    let scalar_name = validate::scalar_name(scalar.as_ref(), input);
    let (shapes, owners) = validate::shapes(&reader, scalar.as_ref(), &scalar_name, "system", context);
    let uncertain = clauses.unsupported || reader.unsupported || statements.missed;

    check_names(&statements, &reader.fields, context);
    check_kinematics(&statements, uncertain, context);
    check_masses(input, &statements, &reader, &owners, &scalar_name, uncertain, context);
    bodies::check(&statements, &reader, &scalar_name, context);
    check_expressions(&statements, &scope(&statements, &reader.fields, &shapes, &scalar_name, uncertain), context);
    if statements.coordinates.is_none() && !uncertain {
        let span = statements.first.as_ref().map_or(input.ident.span(), Ident::span);
        context.error(span, "the system has no coordinates; add `coordinates(…)` with the names of scalars");
    }
    if context.is_clean() {
        check_dependence(&statements, context);
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
            let (_, rate) = written.rates.iter().find(|(name, _)| same(name, coordinate))?;
            kinematics.push((coordinate.clone(), rate.clone()?));
        }
    }
    Some(SystemModel {
        ident: input.ident.clone(),
        visibility: input.vis.clone(),
        generics: input.generics.clone(),
        scalar,
        runtime: clauses.runtime,
        fields,
        coordinates: coordinates.into_iter().map(|ident| Coordinate { ident, kind: CoordinateKind::Scalar }).collect(),
        speeds: statements
            .speeds
            .map(|speeds| speeds.names.into_iter().map(|ident| Speed { ident, kind: SpeedKind::Scalar }).collect()),
        kinematics,
        bodies: statements.bodies,
        particles: statements.particles,
        points: Vec::new(),
        constraints: Vec::new(),
        independent: None,
        limit: None,
        potential: statements.potential.and_then(|(_, potential)| potential),
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

/// Every expression, with its place.
fn expressions(statements: &Statements) -> Vec<(Place, &Expression)> {
    let mut all = Vec::new();
    if let Some(kinematics) = &statements.kinematics {
        all.extend(kinematics.rates.iter().filter_map(|(_, rate)| rate.as_ref()).map(|rate| (Place::Kinematics, rate)));
    }
    for body in &statements.bodies {
        all.extend(body.position.as_ref().map(|position| (Place::Position, position)));
        all.extend(body.rotation.as_ref().map(|rotation| (Place::Rotation, rotation)));
    }
    for particle in &statements.particles {
        all.push((Place::Mass, &particle.mass));
        all.push((Place::Position, &particle.position));
    }
    if let Some((_, Some(potential))) = &statements.potential {
        all.push((Place::Potential, potential));
    }
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

/// Coordinates, speeds and fields have different names, and none that expressions use already.
fn check_names(statements: &Statements, fields: &[Field<'_>], context: &mut Context) {
    let mut taken: Vec<(&Ident, &str)> = Vec::new();
    let declared = |names: &'_ Option<Names>| names.as_ref().map(|names| names.names.clone()).unwrap_or_default();
    let (coordinates, speeds) = (declared(&statements.coordinates), declared(&statements.speeds));
    let all = fields
        .iter()
        .map(|field| (field.ident, "field"))
        .chain(coordinates.iter().map(|name| (name, "coordinate")))
        .chain(speeds.iter().map(|name| (name, "speed")));
    for (name, noun) in all {
        let word = name.unraw().to_string();
        if word == TIME {
            context.error(name.span(), format!("`{TIME}` is time in expressions and cannot name a {noun}; rename it"));
        } else if FUNCTIONS.iter().any(|(function, _)| *function == word) {
            context.error(
                name.span(),
                format!("`{word}` is a function of expressions and cannot name a {noun}; rename it"),
            );
        } else if let Some((_, earlier)) = taken.iter().find(|(earlier, _)| same(earlier, name)) {
            match (*earlier, noun) {
                // Two fields of one name are the compiler's to refuse.
                ("field", "field") => {}
                (earlier, noun) if earlier == noun => {
                    context.error(name.span(), format!("the {noun} `{word}` is declared twice; remove one of the two"));
                }
                (earlier, noun) => {
                    context
                        .error(name.span(), format!("`{word}` names a {earlier} and a {noun}; rename one of the two"));
                }
            }
        }
        taken.push((name, noun));
    }
}

/// Whether expressions use the word already.
fn is_reserved(word: &str) -> bool {
    word == TIME || FUNCTIONS.iter().any(|(function, _)| *function == word)
}

/// With speeds of its own a system needs one equation for each coordinate; without, it needs none.
fn check_kinematics(statements: &Statements, uncertain: bool, context: &mut Context) {
    let coordinates = statements.coordinates.as_ref();
    match (&statements.speeds, &statements.kinematics) {
        (None, None) => {}
        (Some(speeds), None) => {
            if !uncertain {
                let equations: Vec<String> =
                    coordinates.iter().flat_map(|names| &names.names).map(|name| format!("{name} = …")).collect();
                let equations = if equations.is_empty() { "x = …".into() } else { equations.join(", ") };
                context.error(
                    speeds.clause.span(),
                    format!("`speeds` do not say how the coordinates change; add `kinematics({equations})`"),
                );
            }
            return;
        }
        (None, Some(kinematics)) => {
            if !uncertain {
                context.error(
                    kinematics.clause.span(),
                    "`kinematics` needs `speeds`, which it expresses the rates of the coordinates in; \
                     add `speeds(…)`, or remove `kinematics` to have these rates for speeds",
                );
            }
        }
        (Some(_), Some(_)) => {}
    }
    let (Some(kinematics), Some(coordinates)) = (&statements.kinematics, coordinates) else { return };
    let table: Vec<(String, ())> = coordinates.names.iter().map(|name| (name.unraw().to_string(), ())).collect();
    let table: Vec<(&str, ())> = table.iter().map(|(name, ())| (name.as_str(), ())).collect();
    let mut meant: Vec<String> = Vec::new();
    for (index, (name, _)) in kinematics.rates.iter().enumerate() {
        let word = name.unraw().to_string();
        if kinematics.rates[..index].iter().any(|(earlier, _)| same(earlier, name)) {
            context.error(name.span(), format!("`{word}` has kinematics twice; keep one of the two"));
            continue;
        }
        if table.iter().any(|(known, ())| *known == word) {
            continue;
        }
        let is_speed = statements.speeds.iter().flat_map(|speeds| &speeds.names).any(|speed| same(speed, name));
        // Between single letters every name is near; a speed is no misspelt coordinate.
        let near = if is_speed || word.chars().count() == 1 { None } else { names::nearest(&word, &table) };
        meant.extend(near.map(|(near, ())| near.to_owned()));
        if coordinates.complete {
            let problem = if is_speed { "is a speed, not a coordinate" } else { "is no coordinate" };
            let remedy = match near {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None if table.is_empty() => "add it to `coordinates(…)`".into(),
                None => format!("expected {}", names::list(&table)),
            };
            context.error(name.span(), format!("`{word}` {problem}; {remedy}"));
        }
    }
    if !kinematics.complete || statements.speeds.is_none() {
        return;
    }
    for (index, coordinate) in coordinates.names.iter().enumerate() {
        let word = coordinate.unraw().to_string();
        // A name that must change, or go, needs no kinematics yet.
        let refused = is_reserved(&word) || coordinates.names[..index].iter().any(|earlier| same(earlier, coordinate));
        if refused {
            continue;
        }
        if !kinematics.rates.iter().any(|(name, _)| same(name, coordinate)) && !meant.contains(&word) {
            context.error(
                coordinate.span(),
                format!("the coordinate `{word}` has no kinematics; add `{word} = …` to `kinematics(…)`"),
            );
        }
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
    let unnamed = statements.bodies.iter().any(|body| body.name.is_none());
    if unnamed {
        // Of several unnamed bodies none is meant to have the roles: they must get names first.
        if statements.bodies.len() == 1 && !uncertain {
            for role in [Role::Mass, Role::Inertia] {
                if !known(role) {
                    validate::missing_role(input, role, scalar, context);
                }
            }
        }
        return;
    }
    if uncertain || statements.missed_body {
        return;
    }
    if statements.bodies.is_empty() && statements.particles.is_empty() {
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
    let complete = |names: &Option<Names>| names.as_ref().is_none_or(|names| names.complete);
    // Without a clause of coordinates, or of speeds where there are kinematics, every name is one that is missing there.
    let complete = !uncertain
        && statements.coordinates.is_some()
        && (statements.speeds.is_some() || statements.kinematics.is_none())
        && complete(&statements.coordinates)
        && complete(&statements.speeds);
    let mut scope = Scope::new(complete);
    for name in statements.coordinates.iter().flat_map(|names| &names.names) {
        scope.add(name, Meaning::Coordinate);
    }
    for name in statements.speeds.iter().flat_map(|names| &names.names) {
        scope.add(name, Meaning::Speed);
    }
    for (field, shape) in fields.iter().zip(shapes) {
        scope.add(field.ident, meaning(field, *shape, scalar));
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
        (Shape::RigidBody, _) => Meaning::Unusable(format!(
            "`{name}` is a body; expressions name coordinates, speeds and fields that are scalars or vectors"
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

fn check_expressions(statements: &Statements, scope: &Scope, context: &mut Context) {
    for (place, expression) in expressions(statements) {
        kinds::check(expression, place, scope, context);
    }
}

/// Speeds that no rate depends on, and coordinates that no mass depends on, have no equation of motion: A of (3.4) is
/// singular. What this sees in the names alone is said here; the rest shows when A is formed.
fn check_dependence(statements: &Statements, context: &mut Context) {
    let Some(coordinates) = &statements.coordinates else { return };
    let all = expressions(statements);
    let named = |name: &Ident, places: &[Place]| {
        let word = name.unraw().to_string();
        all.iter().any(|(place, expression)| places.contains(place) && expression.names(&word))
    };
    match &statements.speeds {
        Some(speeds) => {
            for speed in speeds.names.iter().filter(|speed| !named(speed, &[Place::Kinematics])) {
                context.error(
                    speed.span(),
                    format!(
                        "no velocity depends on the speed `{speed}`, so nothing determines its rate; \
                         name it in `kinematics(…)` or remove it"
                    ),
                );
            }
            if let Some(excess) = speeds.names.get(coordinates.names.len()) {
                context.error(
                    excess.span(),
                    format!(
                        "there are more speeds ({}) than coordinates ({}), so the velocities do not determine them; \
                         remove {}",
                        speeds.names.len(),
                        coordinates.names.len(),
                        speeds.names.len() - coordinates.names.len()
                    ),
                );
            }
        }
        None => {
            for name in coordinates.names.iter().filter(|name| !named(name, &[Place::Position, Place::Rotation])) {
                context.error(
                    name.span(),
                    format!(
                        "no position and no rotation depends on the coordinate `{name}`, so nothing determines its \
                         acceleration; name it in one of them or remove it"
                    ),
                );
            }
        }
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

fn same(a: &Ident, b: &Ident) -> bool {
    a.unraw() == b.unraw()
}
