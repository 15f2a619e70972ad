//! Rules for forces and inputs.

use crate::model::language::context::Context;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, same, word};
use crate::model::names::moving_names::MovingNames;
use crate::model::scene::clauses::CoordinateKind;
use crate::model::scene::elements::{ArgumentType, ElementKind, argument};
use crate::model::scene::expression::{Expression, ExpressionKind, Property};
use crate::model::scene::forces::ForceClause;
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};

/// Checks which coordinates are driven, reactions and limits, as far as names and numbers alone show mistakes.
pub fn check(statements: &Statements, context: &mut Context) {
    let coordinates = statements.coordinates.iter().flat_map(|names| &names.names);
    let mut kinds = HashMap::new();
    coordinates.for_each(|q| _ = kinds.entry(word(&q.ident)).or_insert(q.kind));
    statements.driven.iter().for_each(|q| _ = kinds.entry(word(q)).or_insert(CoordinateKind::Scalar));
    let armatures: Vec<&Ident> = statements.armatures.iter().map(|(name, _)| name).collect();
    check_drive(&armatures, ["given an armature twice", ARMATURE], (statements, &kinds), context);
    for clause in &statements.forces {
        let driven: Vec<&Ident> = clause.rates().map(|(name, _)| name).collect();
        let words = ["driven twice in one clause", "a drive acts on rates"];
        check_drive(&driven, words, (statements, &kinds), context);
        if let (Some(body), Some((other, _))) = (clause.body(), clause.other())
            && same(body, other)
        {
            let noun = clause.noun();
            let message = format!("the {noun} on `{body}` and its reaction on `{body}` cancel; name another body");
            context.error(other.span(), message);
        }
        if clause.row.kind == ElementKind::Stop {
            check_limits(clause, context);
        }
    }
}

/// The limits of a stop in their order, its width positive, where they are numbers.
fn check_limits(clause: &ForceClause, context: &mut Context) {
    let literal = |word: &str| clause.expression(word).and_then(Expression::literal);
    if let Some(least) = clause.expression(argument::LEAST)
        && let Some((a, b)) = least.literal().zip(literal(argument::MOST))
        && a >= b
    {
        context.error(least.span, "the lower limit of a stop is below its upper limit; exchange the two");
    }
    if let Some(width) = clause.expression(argument::WIDTH)
        && width.literal().is_some_and(|width| width <= 0.0)
    {
        let message = "the width of a stop is the distance over which it sets in; write a positive number";
        context.error(width.span, message);
    }
}

/// Description of an armature, in words.
const ARMATURE: &str = "an armature turns with the rates";

/// Scalar coordinates, of armatures all, each of them once; what is done to them, and what does it, in words.
fn check_drive(
    rates: &[&Ident],
    [done, doing]: [&str; 2],
    (statements, kinds): (&Statements, &HashMap<String, CoordinateKind>),
    context: &mut Context,
) {
    let (any, noun) = (doing == ARMATURE, if doing == ARMATURE { "coordinates" } else { "scalar coordinates" });
    let mut earlier = HashSet::new();
    for &name in rates {
        if !earlier.insert(word(name)) {
            context.error(name.span(), format!("`{name}` is {done}; write the sum of the two"));
            continue;
        }
        match kinds.get(&word(name)).copied() {
            Some(CoordinateKind::Scalar) => {}
            Some(_) if any => {}
            Some(CoordinateKind::Rotation) => context.error(
                name.span(),
                format!(
                    "`{name}` is a rotation, and its angular velocity is driven by a torque; \
                     write `torque(body = …, value = …)`"
                ),
            ),
            Some(CoordinateKind::Pose) => context.error(
                name.span(),
                format!(
                    "`{name}` is a pose, and its twist is driven by forces and torques; \
                     write `force(body = …, value = …)` and `torque(body = …, value = …)`"
                ),
            ),
            None if statements.coordinates.as_ref().is_some_and(|names| names.complete) && !statements.missed => {
                let is_speed =
                    statements.speeds.iter().flat_map(|names| &names.names).any(|speed| same(&speed.ident, name));
                let problem = if is_speed { "is a speed, not a coordinate" } else { "is no coordinate" };
                let coordinates = statements.coordinates.iter().flat_map(|names| &names.names);
                let expected: Vec<String> =
                    coordinates.filter(|q| any || q.kind == CoordinateKind::Scalar).map(|q| word(&q.ident)).collect();
                let table: Vec<(&str, ())> = expected.iter().map(|name| (name.as_str(), ())).collect();
                // Between single letters every name is near; a speed is no misspelt coordinate.
                let single = word(name).chars().count() == 1;
                let near = if is_speed || single { None } else { words::nearest(&word(name), &table) };
                let remedy = match near {
                    Some((near, ())) => format!("did you mean `{near}`?"),
                    None if table.is_empty() => "write `force(…)` or `torque(…)`".into(),
                    None => format!("expected {}", words::list(&table)),
                };
                context.error(name.span(), format!("`{name}` {problem}, and {doing} of {noun}; {remedy}"));
            }
            None => {}
        }
    }
}

/// Every load has an effect, and every input a use. Checked only where all else is well, since the clause that is
/// missed may be one that could not be read.
pub fn check_effect(statements: &Statements, context: &mut Context) {
    let moving = MovingNames::with_driven(statements);
    for clause in &statements.forces {
        if let Some(message) = without_effect(clause, &moving) {
            context.error(clause.span, message);
        }
    }
    let mut used = HashSet::new();
    let of_forces =
        statements.forces.iter().flat_map(|clause| clause.expressions()).map(|(_, _, expression)| expression);
    let of_contacts = statements.contacts.iter().flat_map(|clause| clause.friction.iter().chain(&clause.rolling));
    let of_states = statements.states.iter().filter_map(|state| state.rate.as_ref());
    of_forces.chain(of_contacts).chain(of_states).for_each(|expression| expression.put_names(&mut used));
    for input in statements.inputs.iter().flat_map(|names| &names.names) {
        let ident = &input.ident;
        if !used.contains(&word(ident)) {
            context.error(
                ident.span(),
                format!("the input `{ident}` is used nowhere; name it in the value of a force, or remove it"),
            );
        }
    }
}

/// Why a force element does nothing, if that is so.
fn without_effect(clause: &ForceClause, moving: &MovingNames) -> Option<String> {
    let noun = clause.noun();
    let all_rest = |takes: ArgumentType| {
        let mut all = clause.expressions().into_iter().filter(|(argument, ..)| argument.takes == takes).peekable();
        all.peek().is_some() && all.all(|(_, _, e)| !moving.in_place(e))
    };
    match (clause.body(), clause.other()) {
        (Some(body), Some((other, _))) if !moving.moves(body) && !moving.moves(other) => {
            return Some(format!("neither `{body}` nor `{other}` moves, so the {noun} does nothing; remove it"));
        }
        (Some(body), Some((other, _))) if moving.are_joined(body, other) => {
            let message = format!(
                "`{body}` and `{other}` never move relative to each other, so the {noun} does nothing; name another body"
            );
            return Some(message);
        }
        (Some(body), None) if !moving.moves(body) => {
            return Some(format!("`{body}` does not move, so the {noun} does nothing; name a body that moves"));
        }
        (None, _) if all_rest(ArgumentType::Point) => {
            let message = format!(
                "the point of the {noun} is at rest, where it does nothing: it names no coordinate, and no body or point \
                 that moves; add `body = …` if it is meant in the axes of a body"
            );
            return Some(message);
        }
        _ => {}
    }
    if all_rest(ArgumentType::End) {
        return Some(format!("neither end of the {noun} moves; name a coordinate, or a body or point that moves"));
    }
    if all_rest(ArgumentType::Along) {
        return Some(format!(
            "the extent of the {noun} does not change: it names no coordinate, and no body or point that moves"
        ));
    }
    let function = clause.expressions().into_iter().find(|(argument, ..)| argument.takes == ArgumentType::Dissipation);
    function.filter(|(_, _, function)| !moving.in_velocity(function)).map(|_| {
        "the dissipation function contains no velocity of anything that moves, so it brakes nothing; name a speed, or a \
         velocity such as `rate(…)`"
            .into()
    })
}

/// Something depends on the velocity of the medium. `fluid`: some body has added mass, or displaces some of it.
pub fn check_medium(statements: &Statements, fluid: bool, context: &mut Context) {
    let Some((name, _)) = &statements.medium else { return };
    let relative = |part: &Expression| matches!(part.kind, ExpressionKind::Property(_, Property::RelativeVelocity));
    let felt = statements.forces.iter().any(|clause| {
        let mut found = clause.row.kind == ElementKind::Drag;
        clause.expressions().iter().for_each(|(_, _, e)| e.walk(&mut |part| found |= relative(part)));
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
