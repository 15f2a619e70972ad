//! What must hold of forces and inputs.

use super::context::Context;
use super::moving::Moving;
use super::names;
use super::naming::{same, word};
use super::places::Place;
use super::statements::Statements;
use super::{CoordinateKind, Expression, ForceClause, ForceKind};
use proc_macro2::Ident;

impl ForceClause {
    /// What it is called in messages.
    pub(super) fn noun(&self) -> &'static str {
        match self.kind {
            ForceKind::AtPoint { .. } | ForceKind::OnBody { .. } => "force",
            ForceKind::Torque { .. } => "torque",
            ForceKind::Drive { .. } => "drive",
            ForceKind::Spring { .. } => "spring",
            ForceKind::Dissipation(_) => "dissipation function",
        }
    }

    /// Its expressions, with their places.
    pub(super) fn expressions(&self) -> Vec<(Place, &Expression)> {
        match &self.kind {
            ForceKind::AtPoint { at, value } => vec![(Place::ForcePoint, at), (Place::Force, value)],
            ForceKind::OnBody { at, value, .. } => {
                at.iter().map(|at| (Place::ForceAt, at)).chain([(Place::Force, value)]).collect()
            }
            ForceKind::Torque { value, .. } => vec![(Place::Torque, value)],
            ForceKind::Drive { rates } => rates.iter().map(|(_, value)| (Place::Drive, value)).collect(),
            ForceKind::Spring { from, to, stiffness, length, damping } => {
                let ends = [(Place::SpringEnd, from), (Place::SpringEnd, to), (Place::Spring("stiffness"), stiffness)];
                let length = length.iter().map(|length| (Place::Spring("length"), length));
                ends.into_iter()
                    .chain(length)
                    .chain(damping.iter().map(|damping| (Place::Spring("damping"), damping)))
                    .collect()
            }
            ForceKind::Dissipation(function) => vec![(Place::Dissipation, function)],
        }
    }
}

/// What names alone show: which coordinates are driven, and reactions.
pub(super) fn check(statements: &Statements, context: &mut Context) {
    for clause in &statements.forces {
        match &clause.kind {
            ForceKind::Drive { rates } => check_drive(rates, statements, context),
            ForceKind::Torque { body, reaction: Some(reaction), .. } if same(body, reaction) => context.error(
                reaction.span(),
                format!("the torque on `{body}` and its reaction on `{body}` cancel; name another body"),
            ),
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
            ForceKind::Spring { from, to, .. } if !moving.in_place(from) && !moving.in_place(to) => {
                "neither end of the spring moves; name a coordinate, or a body or point that moves".into()
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

fn at_rest(noun: &str, body: &Ident) -> String {
    format!("`{body}` does not move, so the {noun} does nothing; name a body that moves")
}
