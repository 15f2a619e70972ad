//! Coordinates that are held, `lock(elbow = 0.5)`, or driven, `motion(crank = w * t)`: the value becomes the definition
//! of the name, and the coordinate is gone before anything is derived. Joints of files with one coordinate are held
//! where the file is read. What acts on a driven coordinate stays, since it is part of the force that drives it.

use crate::algebra::Rational;
use crate::model::language::context::Context;
use crate::model::language::declarations::{Definition, Names, Origin};
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, same, word};
use crate::model::names::moving_names::MovingNames;
use crate::model::scene::clauses::{CoordinateClause, CoordinateKind, SpeedKind};
use crate::model::scene::contacts::ContactGeometry;
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind, FunctionName};
use crate::model::scene::forces::ForceClause;
use proc_macro2::{Ident, Span};

/// A lock or a motion, in words of messages.
struct Words {
    noun: &'static str,
    state: &'static str,
    verb: &'static str,
}

/// Words of messages about the clause that a definition comes from.
fn words_of(origin: Origin) -> Words {
    match origin {
        Origin::Motion => Words { noun: "motion", state: "driven", verb: "drives" },
        Origin::Lock | Origin::Define | Origin::Rate => Words { noun: "lock", state: "locked", verb: "holds" },
    }
}

/// Puts definitions in the place of coordinates that are locked or driven, and of their speeds.
pub fn apply(statements: &mut Statements, context: &mut Context) {
    let locks = std::mem::take(&mut statements.locks);
    let Some(first) = locks.first().map(|lock| (lock.name.span(), lock.origin)) else { return };
    let earlier = context.count();
    let mut definitions: Vec<Definition> = Vec::new();
    for lock in locks {
        if let Some(other) = definitions.iter().find(|earlier| same(&earlier.name, &lock.name)) {
            let [state, known] = [&lock, other].map(|clause| words_of(clause.origin).state);
            let problem = if state == known { format!("{state} twice") } else { "both locked and driven".to_owned() };
            context.error(lock.name.span(), format!("`{}` is {problem}; keep one of the two", lock.name));
            continue;
        }
        // What a file holds is no coordinate any more.
        if !statements.locked_in_file.iter().any(|name| same(name, &lock.name)) && !hold(&lock, statements, context) {
            continue;
        }
        if lock.origin == Origin::Motion {
            statements.driven.push(lock.name.clone());
            load_drive(&lock.name, statements, context);
        } else {
            refuse_actions(&lock.name, statements, context);
        }
        let speed = speed(&lock, statements, context);
        definitions.push(lock);
        definitions.extend(speed);
    }
    put_before(definitions, &mut statements.definitions);
    leave_out_contacts(statements);
    let left = statements
        .coordinates
        .as_ref()
        .map_or(statements.in_chart, |names| statements.in_chart || !names.complete || !names.names.is_empty());
    if !left && !statements.missed && context.count() == earlier {
        let (span, origin) = first;
        let message = match origin {
            Origin::Motion => {
                "all coordinates are driven or locked, so that nothing is left to find; leave one of them free, or ask \
                 `inverse_dynamics` of the scene without motions for the forces"
            }
            _ => "all coordinates are locked, so that nothing moves; leave one of them free",
        };
        context.error(span, message);
    }
}

/// Leaves contacts of a file out whose parts only driven joints move: nothing that is left to find has a part in them.
fn leave_out_contacts(statements: &mut Statements) {
    if statements.driven.is_empty() {
        return;
    }
    let moving = MovingNames::new(statements);
    statements.contacts.retain(|contact| match &contact.touching {
        ContactGeometry::Point(point) if contact.of_file => point.places().any(|place| moving.in_place(place)),
        _ => true,
    });
}

/// Puts definitions before others, but behind those that they name.
fn put_before(first: Vec<Definition>, others: &mut Vec<Definition>) {
    let mut left: Vec<Option<Definition>> = first.into_iter().chain(std::mem::take(others)).map(Some).collect();
    let names: Vec<String> = left.iter().flatten().map(|definition| word(&definition.name)).collect();
    // Of those that wait the last is looked at; in a circle, which is refused elsewhere, the first stands first.
    for start in 0..left.len() {
        let mut waiting = vec![start];
        while let Some(&last) = waiting.last() {
            let own = left[last].as_ref().and_then(|definition| definition.expression.as_ref());
            let needs = |k: &usize| left[*k].is_some() && !waiting.contains(k);
            let named = own.and_then(|own| (0..left.len()).filter(needs).find(|&k| own.names(&names[k])));
            match named {
                Some(named) => waiting.push(named),
                None => {
                    waiting.pop();
                    others.extend(left[last].take());
                }
            }
        }
    }
}

/// Takes a coordinate away; whether there is one that can be held, otherwise the reason is noted.
fn hold(lock: &Definition, statements: &mut Statements, context: &mut Context) -> bool {
    let (name, span, driven) = (&lock.name, lock.name.span(), lock.origin == Origin::Motion);
    let is_modal = statements.modal_coordinates().any(|modal| same(modal, name));
    let found = statements.coordinates.as_ref().and_then(|names| {
        let place = names.names.iter().position(|coordinate| same(&coordinate.ident, name))?;
        Some((place, names.names[place].kind))
    });
    let reason = match found {
        None => {
            let known = statements.coordinates.as_ref().is_none_or(|names| names.complete);
            if known && !statements.missed {
                context.error(span, unknown(lock, statements));
            }
            return false;
        }
        Some(_) if is_modal && driven => {
            "is the coordinate of a mode, whose force is none of a drive; hold it by `constraint(position = …)`"
        }
        Some(_) if is_modal => {
            "is the coordinate of a mode, and a body whose modes are held is rigid; leave them out of \
                                `modes(…)`"
        }
        Some((_, CoordinateKind::Scalar)) => "",
        Some((_, CoordinateKind::Rotation)) if driven => {
            "is a rotation, and a motion is one number; write the `rotation` of its body as a function of `t`"
        }
        Some((_, CoordinateKind::Pose)) if driven => {
            "is a pose, and a motion is one number; write the `position` and `rotation` of its body as functions of `t`, \
             or `base(…)` of a file"
        }
        Some((_, CoordinateKind::Rotation)) => {
            "is a rotation, and a lock is one number; write a constant `rotation` of its body, or make the joint of the \
             file a fixed one"
        }
        Some((_, CoordinateKind::Pose)) => {
            "is a pose, and a lock is one number; write a constant `position` and `rotation` of its body, or \
             `base = fixed` of a file"
        }
    };
    if !reason.is_empty() {
        context.error(span, format!("`{name}` {reason}"));
    } else if let (Some((place, _)), Some(coordinates)) = (found, &mut statements.coordinates) {
        coordinates.names.remove(place);
        return true;
    }
    false
}

/// Message about a name that no coordinate has.
fn unknown(lock: &Definition, statements: &Statements) -> String {
    let (name, Words { noun, verb, .. }) = (&lock.name, words_of(lock.origin));
    let own = statements.coordinates.iter().flat_map(|Names { names, .. }: &Names<CoordinateClause>| names);
    let own = own.filter(|coordinate| coordinate.kind == CoordinateKind::Scalar).map(|own| word(&own.ident));
    let own: Vec<String> = own.collect();
    let table: Vec<(&str, ())> = own.iter().map(|name| (name.as_str(), ())).collect();
    let remedy = match words::nearest(&word(name), &table).filter(|_| word(name).chars().count() > 1) {
        Some((near, ())) => format!("did you mean `{near}`?"),
        None if table.is_empty() => "there is none with a name and one number".to_owned(),
        None => format!("expected {}", words::list(&table)),
    };
    format!("`{name}` is no coordinate, and a {noun} {verb} one; {remedy}")
}

/// Refuses what acts on the rate of a locked coordinate and on nothing else, and takes it away.
fn refuse_actions(name: &Ident, statements: &mut Statements, context: &mut Context) {
    let mut refuse = |acts: bool, span: Span, what: &str| {
        if acts {
            let message = format!("`{name}` is locked, so that nothing {what} it; remove this, or the lock");
            context.error(span, message);
        }
        !acts
    };
    for clause in &mut statements.forces {
        clause.given.retain(|given| {
            let rate = given.coordinate.as_ref().filter(|rate| same(rate, name));
            refuse(rate.is_some(), rate.map_or(clause.span, Ident::span), "drives")
        });
    }
    statements.armatures.retain(|(rate, _)| refuse(same(rate, name), rate.span(), "turns with"));
    statements.contacts.retain(|contact| {
        let ContactGeometry::Slip { slips, named: true } = &contact.touching else { return true };
        let is_it = |slip: &&Expression| matches!(&slip.kind, ExpressionKind::Name(slip) if same(slip, name));
        let slip = slips.iter().find(is_it);
        refuse(slip.is_some(), slip.map_or(name.span(), |slip| slip.span), "brakes")
    });
}

/// Puts forces in the place of dry friction along a driven coordinate, and takes its limits of a file away. Which way
/// such friction acts is known from the motion, but for the instants at which it rests, where none is counted.
fn load_drive(name: &Ident, statements: &mut Statements, context: &mut Context) {
    let is_it = |e: &Expression| matches!(&e.kind, ExpressionKind::Name(other) if same(other, name));
    let mut frictions: Vec<ForceClause> = Vec::new();
    statements.contacts.retain(|contact| match &contact.touching {
        ContactGeometry::Slip { slips, named: true } if slips.iter().any(is_it) => {
            let [bound] = contact.friction.as_slice() else { return true };
            let span = slips.first().map_or(name.span(), |slip| slip.span);
            frictions.push(ForceClause::drive(None, vec![(name.clone(), against(name, bound, span))], span));
            false
        }
        ContactGeometry::Range { along, .. } if is_it(along) => {
            if !contact.of_file {
                let message = format!("`{name}` is driven, so that no limit keeps it; remove this, or the motion");
                context.error(along.span, message);
            }
            false
        }
        _ => true,
    });
    statements.forces.extend(frictions);
}

/// `−bound · signum(rate(x))`.
fn against(name: &Ident, bound: &Expression, span: Span) -> Expression {
    let of = |kind: ExpressionKind| Expression { kind, span };
    let rate = of(ExpressionKind::Call(FunctionName::Rate, vec![of(ExpressionKind::Name(name.clone()))]));
    let way = of(ExpressionKind::Call(FunctionName::Signum, vec![rate]));
    let force = of(ExpressionKind::Binary(BinaryOperator::Multiply, Box::new(bound.clone()), Box::new(way)));
    of(ExpressionKind::Negate(Box::new(force)))
}

/// Takes away the speed of a coordinate that is locked or driven, where the struct has speeds; its definition is zero,
/// or the rate of the motion.
fn speed(lock: &Definition, statements: &mut Statements, context: &mut Context) -> Option<Definition> {
    let (name, origin, Words { noun, state, .. }) = (&lock.name, lock.origin, words_of(lock.origin));
    let rates = &mut statements.kinematics.as_mut()?.rates;
    let place = rates.iter().position(|(coordinate, _)| same(coordinate, name))?;
    let (_, rate) = rates.remove(place);
    let rate = rate?;
    let speeds = statements.speeds.as_mut()?;
    let own = match &rate.kind {
        ExpressionKind::Name(rate) => {
            speeds.names.iter().position(|z| z.kind == SpeedKind::Scalar && same(&z.ident, rate))
        }
        _ => None,
    };
    let Some(own) = own else {
        let message = format!(
            "the rate of `{name}` is no speed alone, and a {noun} leaves that one out; write `{name} = v` with a speed \
             `v`, or `constraint(velocity = …)` in place of the {noun}"
        );
        context.error(name.span(), message);
        return None;
    };
    let speed = speeds.names.remove(own).ident;
    if let Some(independent) = &mut statements.independent {
        independent.names.retain(|part| {
            let is_it = same(&part.ident, &speed);
            if is_it {
                let known = if origin == Origin::Motion { "known" } else { "zero" };
                let message = format!("`{speed}` is {known}, since `{name}` is {state}; remove it here");
                context.error(part.ident.span(), message);
            }
            !is_it
        });
    }
    let (kind, origin) = match origin {
        Origin::Motion => {
            let own = Expression { kind: ExpressionKind::Name(name.clone()), span: rate.span };
            (ExpressionKind::Call(FunctionName::Rate, vec![own]), Origin::Rate)
        }
        _ => (ExpressionKind::Number { value: Rational::zero(), twin: None }, Origin::Lock),
    };
    Some(Definition { name: speed, expression: Some(Expression { kind, span: rate.span }), origin })
}
