//! Coordinates that are held, `lock(elbow = 0.5)`: a lock becomes the definition of the name, and the coordinate is
//! gone before anything is derived. Joints of files with one coordinate are held where the file is read.

use crate::algebra::Rational;
use crate::model::language::context::Context;
use crate::model::language::declarations::{Definition, Names};
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, same, word};
use crate::model::scene::clauses::{CoordinateClause, CoordinateKind, SpeedKind};
use crate::model::scene::contacts::ContactGeometry;
use crate::model::scene::expression::{Expression, ExpressionKind};
use proc_macro2::{Ident, Span};

/// Puts definitions in the place of coordinates that are locked, and of their speeds.
pub fn apply(statements: &mut Statements, context: &mut Context) {
    let locks = std::mem::take(&mut statements.locks);
    let Some(first) = locks.first().map(|lock| lock.name.span()) else { return };
    let earlier = context.count();
    let mut definitions: Vec<Definition> = Vec::new();
    for lock in locks {
        if definitions.iter().any(|earlier| same(&earlier.name, &lock.name)) {
            context.error(lock.name.span(), format!("`{}` is locked twice; keep one of the two", lock.name));
            continue;
        }
        // What a file holds is no coordinate any more.
        if !statements.locked_in_file.iter().any(|name| same(name, &lock.name)) && !hold(&lock, statements, context) {
            continue;
        }
        refuse_actions(&lock.name, statements, context);
        definitions.extend(zero_speed(&lock.name, statements, context));
        definitions.push(lock);
    }
    statements.definitions.splice(0..0, definitions);
    let left = statements
        .coordinates
        .as_ref()
        .map_or(statements.in_chart, |names| statements.in_chart || !names.complete || !names.names.is_empty());
    if !left && !statements.missed && context.count() == earlier {
        context.error(first, "all coordinates are locked, so that nothing moves; leave one of them free");
    }
}

/// Takes a coordinate away; whether there is one that can be held, otherwise the reason is noted.
fn hold(lock: &Definition, statements: &mut Statements, context: &mut Context) -> bool {
    let (name, span) = (&lock.name, lock.name.span());
    let is_modal = statements.modal_coordinates().any(|modal| same(modal, name));
    let found = statements.coordinates.as_ref().and_then(|names| {
        let place = names.names.iter().position(|coordinate| same(&coordinate.ident, name))?;
        Some((place, names.names[place].kind))
    });
    let reason = match found {
        None => {
            let known = statements.coordinates.as_ref().is_none_or(|names| names.complete);
            if known && !statements.missed {
                context.error(span, unknown(name, statements));
            }
            return false;
        }
        Some(_) if is_modal => {
            "is the coordinate of a mode, and a body whose modes are held is rigid; leave them out of \
                                `modes(…)`"
        }
        Some((_, CoordinateKind::Scalar)) => "",
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
fn unknown(name: &Ident, statements: &Statements) -> String {
    let own = statements.coordinates.iter().flat_map(|Names { names, .. }: &Names<CoordinateClause>| names);
    let own = own.filter(|coordinate| coordinate.kind == CoordinateKind::Scalar).map(|own| word(&own.ident));
    let own: Vec<String> = own.collect();
    let table: Vec<(&str, ())> = own.iter().map(|name| (name.as_str(), ())).collect();
    let remedy = match words::nearest(&word(name), &table).filter(|_| word(name).chars().count() > 1) {
        Some((near, ())) => format!("did you mean `{near}`?"),
        None if table.is_empty() => "there is none with a name and one number".to_owned(),
        None => format!("expected {}", words::list(&table)),
    };
    format!("`{name}` is no coordinate, and a lock holds one; {remedy}")
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

/// Takes away the speed of a locked coordinate, where the struct has speeds; its definition is zero.
fn zero_speed(name: &Ident, statements: &mut Statements, context: &mut Context) -> Option<Definition> {
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
            "the rate of `{name}` is no speed alone, and a lock leaves that one out; write `{name} = v` with a speed `v`, \
             or `constraint(velocity = …)` in place of the lock"
        );
        context.error(name.span(), message);
        return None;
    };
    let speed = speeds.names.remove(own).ident;
    if let Some(independent) = &mut statements.independent {
        independent.names.retain(|part| {
            let is_it = same(&part.ident, &speed);
            if is_it {
                context
                    .error(part.ident.span(), format!("`{speed}` is zero, since `{name}` is locked; remove it here"));
            }
            !is_it
        });
    }
    let zero = Expression { kind: ExpressionKind::Number { value: Rational::zero(), twin: None }, span: rate.span };
    Some(Definition { name: speed, expression: Some(zero), locked: true })
}
