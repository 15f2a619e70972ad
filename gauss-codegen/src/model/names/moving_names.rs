//! Names that change when coordinates or speeds do.

use crate::model::language::statements::Statements;
use crate::model::language::words::{TIME, UNNAMED, word};
use crate::model::scene::clauses::BodyClause;
use crate::model::scene::expression::{Expression, ExpressionKind, FunctionName};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};

/// Moving things, by name.
pub struct MovingNames {
    /// Coordinates; bodies, frames and points that are placed by them.
    places: HashSet<String>,
    speeds: HashSet<String>,
    /// Bodies and frames that are fixed in others, with these; `None`: in the observer's frame.
    fixed: HashMap<String, Option<String>>,
}

impl MovingNames {
    pub fn new(statements: &Statements) -> MovingNames {
        Self::beside(HashSet::new(), statements)
    }

    /// The same with driven coordinates, which move, though not as anything acts.
    pub fn with_driven(statements: &Statements) -> MovingNames {
        Self::beside(statements.driven.iter().map(word).collect(), statements)
    }

    fn beside(mut places: HashSet<String>, statements: &Statements) -> MovingNames {
        places.extend(statements.coordinates.iter().flat_map(|names| &names.names).map(|name| word(&name.ident)));
        places.extend(statements.in_chart.then(|| UNNAMED.to_owned()));
        let speeds = statements.speeds.iter().flat_map(|names| &names.names).map(|name| word(&name.ident)).collect();
        // A child may be written before its parent: round after round adds those that are moved by what moves.
        for _ in &statements.bodies {
            let known = places.len();
            for body in &statements.bodies {
                let name = body.word();
                let moved = body.parent.as_ref().is_some_and(|parent| places.contains(&word(parent)))
                    || body.position.iter().chain(&body.rotation).any(|e| names_any(e, &places));
                if moved {
                    places.insert(name);
                }
            }
            if places.len() == known {
                break;
            }
        }
        for point in &statements.points {
            if places.contains(&word(&point.body)) {
                places.insert(word(&point.name));
            }
        }
        let mut varying = places.clone();
        varying.insert(TIME.to_owned());
        let is_fixed = |body: &&BodyClause| {
            let placed = body.parent.is_some() || !places.contains(&body.word());
            placed && !body.position.iter().chain(&body.rotation).any(|e| names_any(e, &varying))
        };
        let bodies = statements.bodies.iter().filter(is_fixed);
        let fixed = bodies.map(|body| (body.word(), body.parent.as_ref().map(word))).collect();
        MovingNames { places, speeds, fixed }
    }

    /// Whether two bodies or frames never move relative to each other.
    pub fn are_joined(&self, a: &Ident, b: &Ident) -> bool {
        self.carrier(word(a)) == self.carrier(word(b))
    }

    /// Parent in which a body or a frame is fixed; `None`: the observer's frame.
    fn carrier(&self, name: String) -> Option<String> {
        let mut carrier = Some(name);
        // As often as there are bodies: parents that go round in a circle are refused elsewhere.
        for _ in 0..self.fixed.len() {
            match carrier.as_ref().and_then(|name| self.fixed.get(name)) {
                Some(parent) => carrier = parent.clone(),
                None => break,
            }
        }
        carrier
    }

    /// Whether a coordinate, a body, a frame or a point moves.
    pub fn moves(&self, name: &Ident) -> bool {
        self.places.contains(&word(name))
    }

    /// Whether some part of an expression is the name of something that moves.
    pub fn in_place(&self, expression: &Expression) -> bool {
        names_any(expression, &self.places)
    }

    /// Whether some part of an expression is a velocity of something that moves.
    pub fn in_velocity(&self, expression: &Expression) -> bool {
        let mut found = names_any(expression, &self.speeds);
        expression.walk(&mut |part| {
            found |= match &part.kind {
                ExpressionKind::Call(FunctionName::Rate, arguments) => {
                    arguments.iter().any(|argument| names_any(argument, &self.places))
                }
                ExpressionKind::Property(body, property) if property.is_velocity() => names_any(body, &self.places),
                _ => false,
            };
        });
        found
    }
}

fn names_any(expression: &Expression, words: &HashSet<String>) -> bool {
    let mut found = false;
    expression.walk(&mut |part| {
        found |= matches!(&part.kind, ExpressionKind::Name(name) if words.contains(&word(name)));
    });
    found
}
