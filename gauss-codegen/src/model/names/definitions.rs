//! Definitions: expressions with names. Each is checked by itself and then once more wherever its name stands, since
//! what it may contain depends on that. Afterwards its tree takes the place of its name: behind the model only
//! printed equations know of it.

use super::places::{ExpressionPlace, Holder};
use super::scope::{Meaning, Scope};
use super::{expressions, kinds};
use crate::model::language::context::Context;
use crate::model::language::declarations::{Definition, Origin};
use crate::model::language::nesting::{self, LEVELS};
use crate::model::language::statements::Statements;
use crate::model::language::words::{same, word};
use crate::model::scene::expression::{BinaryOperator, Expression, ExpressionKind};
use proc_macro2::{Ident, Span};
use std::collections::{HashMap, HashSet};

/// Parts that all expressions together may have when definitions are written out: far more than anyone
/// writes, and few enough that the trees are built in no time.
const LIMIT: usize = 100_000;

/// Checks every definition by itself, in order, and tells the scope what each stands for.
pub fn check(definitions: &[Definition], scope: &mut Scope, context: &mut Context) {
    refuse_circles(definitions, scope, context);
    for Definition { expression, origin, .. } in definitions {
        let expression = expression.as_ref();
        let place = match origin {
            Origin::Define | Origin::Rate => ExpressionPlace::Definition,
            Origin::Lock => ExpressionPlace::Constant { word: "value", of: Holder::Lock },
            Origin::Motion => ExpressionPlace::Motion,
        };
        let well = expression.and_then(|e| kinds::check(e, place, scope, context).and(Some(e)));
        scope.define(well.cloned());
    }
}

/// Refuses definitions that name one another in a circle, so that no order of them helps: each circle once, at the name
/// in its first definition that leads around. A definition that names itself is told when it is read.
fn refuse_circles(definitions: &[Definition], scope: &mut Scope, context: &mut Context) {
    let named: Vec<Vec<(usize, Ident)>> =
        definitions.iter().map(|definition| named_definitions(definition, scope)).collect();
    let mut told = HashSet::new();
    for start in 0..definitions.len() {
        if told.contains(&start) {
            continue;
        }
        let Some(circle) = shortest_circle(start, &named) else { continue };
        let [_, next, ..] = circle[..] else { continue };
        told.extend(circle.iter().copied());
        let names: Vec<String> = circle.iter().map(|&k| format!("`{}`", definitions[k].name)).collect();
        let message = match names.as_slice() {
            [a, b] => format!("the definitions {a} and {b} name each other, so that neither has a value"),
            [rest @ .., last] => {
                format!(
                    "the definitions {} and {last} name one another in a circle, so that none has a value",
                    rest.join(", ")
                )
            }
            [] => continue,
        };
        let at =
            named[start].iter().find(|(k, _)| *k == next).map_or(definitions[start].name.span(), |(_, at)| at.span());
        let remedy = format!("write one of them without the other{}", if names.len() == 2 { "" } else { "s" });
        context.error(at, format!("{message}; {remedy}"));
    }
    scope.note_circular(told);
}

/// The other definitions that one names, each where it is named first.
fn named_definitions(definition: &Definition, scope: &Scope) -> Vec<(usize, Ident)> {
    let mut named: Vec<(usize, Ident)> = Vec::new();
    let Some(expression) = &definition.expression else { return named };
    expression.walk(&mut |part| {
        if let ExpressionKind::Name(name) = &part.kind
            && let Ok(&Meaning::Definition(index)) = scope.find(name, |_| true)
            && !named.iter().any(|(known, _)| *known == index)
        {
            named.push((index, name.clone()));
        }
    });
    named
}

/// The fewest definitions that lead from one back to it, in the order in which they name each other; at least two.
fn shortest_circle(start: usize, named: &[Vec<(usize, Ident)>]) -> Option<Vec<usize>> {
    let mut before: Vec<Option<usize>> = vec![None; named.len()];
    let mut reached = vec![start];
    let mut k = 0;
    while let Some(&from) = reached.get(k) {
        k += 1;
        for &(to, _) in &named[from] {
            if to == start && from != start {
                let mut circle: Vec<usize> = std::iter::successors(Some(from), |&k| before[k]).collect();
                circle.reverse();
                return Some(circle);
            }
            if to != start && before[to].is_none() {
                before[to] = Some(from);
                reached.push(to);
            }
        }
    }
    None
}

/// Refuses what would be too long or too deep with definitions written out; whether nothing is.
pub fn check_sizes(statements: &Statements, context: &mut Context) -> bool {
    let definitions = &statements.definitions;
    let mut written = DefinitionSizes { known: HashMap::new(), total: 0 };
    for Definition { name, expression, .. } in definitions {
        let (size, depth) = expression.as_ref().map_or((0, 0), |expression| written.measure(expression));
        if !written.accepts((size, depth), name.span(), &format!("`{name}`"), context) {
            return false;
        }
        // Of two with one name, which is noted elsewhere, the first.
        written.known.entry(word(name)).or_insert((size, depth));
    }
    expressions::all(statements).into_iter().all(|(_, expression)| {
        let measured = written.measure(expression);
        written.accepts(measured, expression.span, "this", context)
    })
}

/// Definitions written out, as far as they are measured.
struct DefinitionSizes {
    /// Parts and levels of each, by its name.
    known: HashMap<String, (usize, usize)>,
    total: usize,
}

impl DefinitionSizes {
    /// Parts and levels of the definition that a name stands for.
    fn find(&self, expression: &Expression) -> Option<(usize, usize)> {
        let ExpressionKind::Name(name) = &expression.kind else { return None };
        self.known.get(&word(name)).copied()
    }

    /// Parts and levels.
    fn measure(&self, expression: &Expression) -> (usize, usize) {
        let mut size = 0_usize;
        expression.walk(&mut |part| size = size.saturating_add(self.find(part).map_or(1, |(size, _)| size)));
        let named = |part: &Expression| self.find(part).map_or(0, |(_, depth)| depth);
        (size, nesting::depth(expression, &named))
    }

    fn accepts(&mut self, (size, depth): (usize, usize), span: Span, what: &str, context: &mut Context) -> bool {
        self.total = self.total.saturating_add(size);
        let found = match (self.total > LIMIT, depth > LEVELS) {
            (true, _) => format!("up to {what} expressions have more than {LIMIT} parts"),
            (_, true) => format!("{what} is nested more than {LEVELS} levels deep"),
            _ => return true,
        };
        context.error(span, format!("{found} when definitions are written out; name them less often"));
        false
    }
}

/// Definitions whose names stand nowhere.
pub fn unused(statements: &Statements, all: &[&Expression]) -> Vec<Ident> {
    let definitions = &statements.definitions;
    let mut named = HashSet::new();
    for expression in all.iter().copied().chain(definitions.iter().filter_map(|other| other.expression.as_ref())) {
        expression.put_names(&mut named);
    }
    let names =
        definitions.iter().filter(|definition| !definition.origin.is_moved()).map(|definition| &definition.name);
    names.filter(|name| !named.contains(&word(name))).cloned().collect()
}

/// Puts definitions in the place of their names, everywhere; gives them back, written out, in order. In the place of a
/// coordinate that is driven stands f(t) and, under its old name, how far it is from there: that is zero, and what is
/// known of it is how everything would change by it.
pub fn inline(statements: &mut Statements) -> Vec<(Ident, Expression)> {
    let mut written_out: HashMap<String, Expression> = HashMap::new();
    // The same with driven coordinates where they are: a motion that names another does not follow it away.
    let mut given: HashMap<String, Expression> = HashMap::new();
    let mut named = Vec::new();
    for definition in std::mem::take(&mut statements.definitions) {
        let Some(mut expression) = definition.expression else { continue };
        let mut own = expression.clone();
        replace(&mut own, &given);
        if statements.driven.iter().any(|driven| same(driven, &definition.name)) {
            expression = with_distance(own.clone(), &definition.name);
        } else {
            replace(&mut expression, &written_out);
        }
        given.entry(word(&definition.name)).or_insert(own);
        named.push((definition.name.clone(), expression.clone()));
        written_out.entry(word(&definition.name)).or_insert(expression);
    }
    if !written_out.is_empty() {
        statements.each_expression(&mut |expression| replace(expression, &written_out));
    }
    named
}

/// `f + x`.
fn with_distance(motion: Expression, name: &Ident) -> Expression {
    let span = motion.span;
    let away = Expression { kind: ExpressionKind::Name(name.clone()), span };
    Expression { kind: ExpressionKind::Binary(BinaryOperator::Add, Box::new(motion), Box::new(away)), span }
}

fn replace(expression: &mut Expression, definitions: &HashMap<String, Expression>) {
    if let ExpressionKind::Name(name) = &expression.kind {
        if let Some(meant) = definitions.get(&word(name)) {
            *expression = meant.clone();
        }
        return;
    }
    expression.each_part(&mut |part| replace(part, definitions));
}
