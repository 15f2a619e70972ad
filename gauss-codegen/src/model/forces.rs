//! What must hold of forces and inputs.

use super::context::Context;
use super::fields::ReadField;
use super::moving::Moving;
use super::names;
use super::naming::{same, word};
use super::places::Place;
use super::scope::Scope;
use super::shapes::Kind;
use super::statements::Statements;
use super::{
    Coefficients, CoordinateKind, Expression, ExpressionKind, Extent, ForceClause, ForceKind, GivenValue, Property,
    Shape,
};
use proc_macro2::Ident;

impl ForceClause {
    /// What it is called in messages.
    pub fn noun(&self) -> &'static str {
        match self.kind {
            ForceKind::AtPoint { .. } | ForceKind::OnBody { .. } => "force",
            ForceKind::Torque { .. } => "torque",
            ForceKind::Wrench { .. } => "wrench",
            ForceKind::Drive { .. } => "drive",
            ForceKind::Spring { .. } => "spring",
            ForceKind::Stop { .. } => "stop",
            ForceKind::Drag { .. } => "drag",
            ForceKind::Dissipation(_) => "dissipation function",
        }
    }

    /// Its expressions, with their places.
    pub(super) fn expressions(&self) -> Vec<(Place, &Expression)> {
        match &self.kind {
            ForceKind::AtPoint { at, value } => vec![(Place::ForcePoint, at), (Place::Force, value)],
            ForceKind::OnBody { at, value, .. } => {
                at.iter().map(|at| (Place::ForceAt { bound: false }, at)).chain([(Place::Force, value)]).collect()
            }
            ForceKind::Torque { value, .. } => vec![(Place::Torque, value)],
            ForceKind::Wrench { at, force, torque, .. } => {
                let at = at.iter().map(|at| (Place::ForceAt { bound: true }, at));
                let force = force.iter().map(|force| (Place::Force, force));
                at.chain(force).chain(torque.iter().map(|torque| (Place::Torque, torque))).collect()
            }
            ForceKind::Drive { rates } => rates.iter().map(|(_, value)| (Place::Drive, value)).collect(),
            ForceKind::Spring { extent, stiffness, length, damping } => {
                let constants =
                    [("stiffness", Some(stiffness)), ("length", length.as_ref()), ("damping", damping.as_ref())];
                extended("a spring", extent, &constants)
            }
            ForceKind::Stop { extent, least, most, stiffness, width, damping } => {
                let constants = [
                    ("lower limit", least.as_ref()),
                    ("upper limit", most.as_ref()),
                    ("stiffness", Some(stiffness)),
                    ("width", Some(width)),
                    ("damping", damping.as_ref()),
                ];
                extended("a stop", extent, &constants)
            }
            ForceKind::Drag { linear, quadratic, .. } => {
                let entries = linear.iter().chain(quadratic).flat_map(Coefficients::entries);
                entries.map(|entry| (Place::Coefficient, entry)).collect()
            }
            ForceKind::Dissipation(function) => vec![(Place::Dissipation, function)],
        }
    }
}

impl ForceKind {
    /// The body that its place is in, if its place is in the axes of a body.
    pub(super) fn body_with_place(&self) -> Option<&Ident> {
        match self {
            ForceKind::OnBody { body, .. } | ForceKind::Wrench { body, .. } => Some(body),
            _ => None,
        }
    }

    /// Calls `change` with each of its expressions.
    pub(super) fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match self {
            ForceKind::AtPoint { at, value } => [at, value].into_iter().for_each(change),
            ForceKind::OnBody { at, value, .. } => at.iter_mut().chain([value]).for_each(change),
            ForceKind::Torque { value, .. } | ForceKind::Dissipation(value) => change(value),
            ForceKind::Wrench { at, force, torque, .. } => at.iter_mut().chain(force).chain(torque).for_each(change),
            ForceKind::Drive { rates } => rates.iter_mut().for_each(|(_, value)| change(value)),
            ForceKind::Spring { extent, stiffness, length, damping } => {
                extent.each_expression(change);
                [stiffness].into_iter().chain(length).chain(damping).for_each(change);
            }
            ForceKind::Stop { extent, least, most, stiffness, width, damping } => {
                extent.each_expression(change);
                [stiffness, width].into_iter().chain(least).chain(most).chain(damping).for_each(change);
            }
            ForceKind::Drag { linear, quadratic, .. } => {
                linear.iter_mut().chain(quadratic).for_each(|coefficients| coefficients.each_expression(change));
            }
        }
    }
}

/// The expressions of a spring or a stop.
fn extended<'a>(
    noun: &'static str,
    extent: &'a Extent,
    constants: &[(&'static str, Option<&'a Expression>)],
) -> Vec<(Place, &'a Expression)> {
    let mut all = match extent {
        Extent::Between { from, to } => vec![(Place::End(noun), from), (Place::End(noun), to)],
        Extent::Along(along) => vec![(Place::Along(noun), along)],
    };
    let constant = |&(word, constant): &(_, Option<&'a Expression>)| Some((Place::Constant { word, noun }, constant?));
    all.extend(constants.iter().filter_map(constant));
    all
}

impl Coefficients {
    pub(super) fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        if let Coefficients::Diagonal(entries) = self {
            entries.iter_mut().for_each(|entry| change(entry));
        }
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = &Expression> {
        let entries = match self {
            Coefficients::Diagonal(entries) => Some(entries),
            Coefficients::Field(_) => None,
        };
        entries.into_iter().flatten().map(|entry| &**entry)
    }
}

/// The fields that are six by six or the diagonal of that, with what they are: the coefficients of drags, and added masses.
pub(super) fn coefficient_fields(statements: &Statements) -> Vec<(&Ident, &'static str)> {
    let mut all: Vec<(&Coefficients, &str)> = Vec::new();
    for clause in &statements.forces {
        let ForceKind::Drag { linear, quadratic, .. } = &clause.kind else { continue };
        all.extend(linear.iter().chain(quadratic).map(|coefficients| (coefficients, "the coefficients of a drag are")));
    }
    for given in statements.given.iter().chain(statements.bodies.iter().flat_map(|body| &body.given)) {
        if let GivenValue::Coefficients(coefficients) = &given.value {
            all.push((coefficients, "an added mass is"));
        }
    }
    let field = |(coefficients, what)| match coefficients {
        &Coefficients::Field(ref name) => Some((name, what)),
        Coefficients::Diagonal(_) => None,
    };
    all.into_iter().filter_map(field).collect()
}

/// Coefficients that are fields are six or a matrix.
pub(super) fn check_coefficients(
    statements: &Statements,
    fields: &[ReadField<'_>],
    scope: &Scope,
    scalar: &str,
    context: &mut Context,
) {
    let expected = format!(
        "six scalars in a list `[a, b, c, d, e, f]`, a `Vector6<{scalar}>` (diagonal) or a `Matrix6<{scalar}>` (full)"
    );
    for (name, what) in coefficient_fields(statements) {
        let message = match fields.iter().find(|field| same(field.ident, name)) {
            Some(field) => match field.reading.kind {
                Kind::Known(Shape::Vector6 | Shape::Matrix6) => continue,
                Kind::Alias => format!(
                    "what the field `{name}` is cannot be read from {}; write `Vector6<{scalar}>` or `Matrix6<{scalar}>` \
                     for its type",
                    field.reading.name
                ),
                _ => format!("the type of the field `{name}` is {}, and {what} {expected}", field.reading.name),
            },
            None => match scope.find(name, |_| false) {
                Ok(meaning) => {
                    format!("`{name}` is {}, and {what} {expected}", meaning.described())
                }
                Err(None) => continue,
                Err(Some(_)) => {
                    let six = |field: &&ReadField<'_>| {
                        matches!(field.reading.kind, Kind::Known(Shape::Vector6 | Shape::Matrix6))
                    };
                    let names: Vec<String> = fields.iter().filter(six).map(|field| word(field.ident)).collect();
                    let table: Vec<(&str, ())> = names.iter().map(|name| (name.as_str(), ())).collect();
                    let remedy = match names::nearest(&word(name), &table) {
                        Some((near, ())) if word(name).chars().count() > 1 => format!("did you mean `{near}`?"),
                        _ => format!("add `{name}: Matrix6<{scalar}>`, or write a list of six scalars"),
                    };
                    format!("no field is called `{name}`; {remedy}")
                }
            },
        };
        context.error(name.span(), message);
    }
}

/// What names and numbers alone show: which coordinates are driven, reactions, limits.
pub(super) fn check(statements: &Statements, context: &mut Context) {
    for clause in &statements.forces {
        match &clause.kind {
            ForceKind::Drive { rates } => check_drive(rates, statements, context),
            ForceKind::Torque { body, reaction: Some(reaction), .. } if same(body, reaction) => context.error(
                reaction.span(),
                format!("the torque on `{body}` and its reaction on `{body}` cancel; name another body"),
            ),
            ForceKind::Stop { least, most, width, .. } => {
                let literal = |limit: &Option<Expression>| limit.as_ref().and_then(Expression::literal);
                if let (Some(first), Some((a, b))) = (least, literal(least).zip(literal(most)))
                    && a >= b
                {
                    context.error(first.span, "the lower limit of a stop is below its upper limit; exchange the two");
                }
                if width.literal().is_some_and(|width| width <= 0.0) {
                    context.error(
                        width.span,
                        "the width of a stop is the distance over which it sets in; write a positive number",
                    );
                }
            }
            _ => {}
        }
    }
}

/// Scalar coordinates, each of them once.
fn check_drive(rates: &[(Ident, Expression)], statements: &Statements, context: &mut Context) {
    let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
    let scalars: Vec<String> =
        coordinates().filter(|q| q.kind == CoordinateKind::Scalar).map(|q| word(&q.ident)).collect();
    let table: Vec<(&str, ())> = scalars.iter().map(|name| (name.as_str(), ())).collect();
    for (index, (name, _)) in rates.iter().enumerate() {
        if rates[..index].iter().any(|(earlier, _)| same(earlier, name)) {
            context.error(name.span(), format!("`{name}` is driven twice in one clause; write the sum of the two"));
            continue;
        }
        match coordinates().find(|q| same(&q.ident, name)).map(|q| q.kind) {
            Some(CoordinateKind::Scalar) => {}
            Some(CoordinateKind::Rotation) => context.error(
                name.span(),
                format!(
                    "`{name}` is a rotation, and what drives its angular velocity is a torque; \
                     write `torque(body = …, value = …)`"
                ),
            ),
            Some(CoordinateKind::Pose) => context.error(
                name.span(),
                format!(
                    "`{name}` is a pose, and what drives its twist are forces and torques; \
                     write `force(body = …, value = …)` and `torque(body = …, value = …)`"
                ),
            ),
            None if statements.coordinates.as_ref().is_some_and(|names| names.complete) && !statements.missed => {
                let is_speed =
                    statements.speeds.iter().flat_map(|names| &names.names).any(|speed| same(&speed.ident, name));
                let problem = if is_speed { "is a speed, not a coordinate" } else { "is no coordinate" };
                // Between single letters every name is near; a speed is no misspelt coordinate.
                let single = word(name).chars().count() == 1;
                let near = if is_speed || single { None } else { names::nearest(&word(name), &table) };
                let remedy = match near {
                    Some((near, ())) => format!("did you mean `{near}`?"),
                    None if table.is_empty() => "write `force(…)` or `torque(…)`".into(),
                    None => format!("expected {}", names::list(&table)),
                };
                context.error(
                    name.span(),
                    format!("`{name}` {problem}, and a drive acts on rates of scalar coordinates; {remedy}"),
                );
            }
            None => {}
        }
    }
}

/// What acts does something, and inputs are for something. Asked only where all else is well, since what could not be read
/// may be what is missed.
pub(super) fn check_effect(statements: &Statements, context: &mut Context) {
    let moving = Moving::new(statements);
    for clause in &statements.forces {
        let message = match &clause.kind {
            ForceKind::AtPoint { at, .. } if !moving.in_place(at) => {
                "the point of the force is at rest, where it does nothing: it names no coordinate, and no body or point \
                 that moves; add `body = …` if it is meant in the axes of a body"
                    .into()
            }
            ForceKind::OnBody { body, .. } if !moving.moves(body) => at_rest("force", body),
            ForceKind::Torque { body, reaction: None, .. } if !moving.moves(body) => at_rest("torque", body),
            ForceKind::Torque { body, reaction: Some(reaction), .. }
                if !moving.moves(body) && !moving.moves(reaction) =>
            {
                format!("neither `{body}` nor `{reaction}` moves, so the torque does nothing; remove it")
            }
            ForceKind::Wrench { body, .. } if !moving.moves(body) => at_rest("wrench", body),
            ForceKind::Drag { body, .. } if !moving.moves(body) => at_rest("drag", body),
            ForceKind::Spring { extent, .. } | ForceKind::Stop { extent, .. } if !extent.varies(&moving) => {
                let noun = clause.noun();
                match extent {
                    Extent::Between { .. } => {
                        format!("neither end of the {noun} moves; name a coordinate, or a body or point that moves")
                    }
                    Extent::Along(_) => format!(
                        "what the {noun} acts along does not change: it names no coordinate, and no body or point that moves"
                    ),
                }
            }
            ForceKind::Dissipation(function) if !moving.in_velocity(function) => {
                "the dissipation function contains no velocity of anything that moves, so it brakes nothing; name a \
                 speed, or a velocity such as `rate(…)`"
                    .into()
            }
            _ => continue,
        };
        context.error(clause.span, message);
    }
    let expressions: Vec<&Expression> =
        statements.forces.iter().flat_map(|clause| clause.expressions()).map(|(_, expression)| expression).collect();
    for input in statements.inputs.iter().flat_map(|names| &names.names) {
        let ident = &input.ident;
        if !expressions.iter().any(|expression| expression.names(&word(ident))) {
            context.error(
                ident.span(),
                format!("the input `{ident}` is used nowhere; name it in the value of a force, or remove it"),
            );
        }
    }
}

/// Something depends on the velocity of the medium. `fluid`: some body has added mass, or displaces some of it.
pub(super) fn check_medium(statements: &Statements, fluid: bool, context: &mut Context) {
    let Some((name, _)) = &statements.medium else { return };
    let relative = |part: &Expression| matches!(part.kind, ExpressionKind::Property(_, Property::RelativeVelocity));
    let felt = statements.forces.iter().any(|clause| {
        let mut found = matches!(clause.kind, ForceKind::Drag { .. });
        clause.expressions().iter().for_each(|(_, e)| e.walk(&mut |part| found |= relative(part)));
        found
    });
    if !felt && !fluid {
        context.error(
            name.span(),
            "nothing in the scene feels the medium; add `drag(…)`, name `.relative_velocity` of a body in a force, give \
             the body a field with the role `added_mass`, or remove `medium`",
        );
    }
}

impl Extent {
    fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        match self {
            Extent::Between { from, to } => [from, to].into_iter().for_each(change),
            Extent::Along(along) => change(along),
        }
    }

    fn varies(&self, moving: &Moving) -> bool {
        match self {
            Extent::Between { from, to } => moving.in_place(from) || moving.in_place(to),
            Extent::Along(along) => moving.in_place(along),
        }
    }
}

fn at_rest(noun: &str, body: &Ident) -> String {
    format!("`{body}` does not move, so the {noun} does nothing; name a body that moves")
}
