//! Clauses of what acts: forces, torques, drives and springs.

use super::attributes::{Clause, Place, Value};
use super::context::Context;
use super::names::{self, Table};
use super::placements::{may_be_name, read_reference};
use super::statements::{self, brackets, known, value};
use super::{Expression, ForceAxes, ForceClause, ForceKind};
use proc_macro2::{Ident, Span};

const FORCE: &Table<()> = &[("at", ()), ("value", ()), ("body", ()), ("axes", ())];
const TORQUE: &Table<()> = &[("body", ()), ("value", ()), ("axes", ()), ("reaction", ())];
const SPRING: &Table<()> = &[("from", ()), ("to", ()), ("stiffness", ()), ("length", ()), ("damping", ())];
const AXES: &Table<ForceAxes> = &[("body", ForceAxes::Body), ("observer", ForceAxes::Observer)];

/// An element in its clause: its name, if it has one, and its arguments, each of them once and in its table.
struct Element {
    noun: &'static str,
    span: Span,
    name: Option<Ident>,
    arguments: Vec<Clause>,
    /// Words that misspelt arguments may stand for, which are not missing too.
    misspelt: Vec<&'static str>,
    /// Each argument could be read.
    complete: bool,
}

impl Element {
    /// `None` if there is nothing in brackets, which is noted.
    fn read(
        clause: &Clause,
        noun: &'static str,
        place: Place,
        table: &Table<()>,
        example: &str,
        context: &mut Context,
    ) -> Option<Element> {
        let group = brackets(clause, example, context)?;
        let (written, complete) = statements::arguments(group, place, context);
        let mut element = Element {
            noun,
            span: clause.name.span(),
            name: None,
            arguments: Vec::new(),
            misspelt: Vec::new(),
            complete,
        };
        let mut given = Vec::new();
        for (index, argument) in written.into_iter().enumerate() {
            if index == 0 && may_be_name(&argument, table) {
                if matches!(argument.value, Value::Absent) {
                    element.name = statements::name(&argument.name, noun, context);
                }
            } else if noun == "torque" && argument.word() == "at" {
                context.error(
                    argument.name.span(),
                    "a torque has no point: it does the same wherever it acts on its body; remove `at`",
                );
            } else if known(&argument, noun, table, &mut given, context) {
                element.arguments.push(argument);
            } else {
                element.misspelt.extend(names::nearest(&argument.word(), table).map(|(name, ())| name));
            }
        }
        Some(element)
    }

    fn find(&self, word: &str) -> Option<&Clause> {
        self.arguments.iter().find(|argument| argument.word() == word)
    }

    fn expression(&self, word: &str, example: &str, context: &mut Context) -> Option<Expression> {
        value(self.find(word)?, example, context)
    }

    /// A body or a frame.
    fn reference(&self, word: &str, context: &mut Context) -> Option<Ident> {
        read_reference(self.find(word)?, "a body or a frame", context)
    }

    fn axes(&self, context: &mut Context) -> Option<ForceAxes> {
        let word = self.find("axes")?.bare_word(AXES, context)?;
        let axes = names::resolve("axes", &word.ident, AXES, context).ok()?;
        if let Some(arguments) = word.arguments {
            let ident = &word.ident;
            context
                .error(arguments.span_open(), format!("`{ident}` takes nothing in brackets; write `axes = {ident}`"));
        }
        Some(axes)
    }

    /// Notes that the argument `word` is missing, if it is.
    fn require(&self, word: &str, what: &str, example: &str, context: &mut Context) {
        if self.complete && self.find(word).is_none() && !self.misspelt.contains(&word) {
            context.error(self.span, format!("a {} needs {what}; add `{word} = {example}`", self.noun));
        }
    }

    fn clause(self, kind: ForceKind) -> ForceClause {
        ForceClause { name: self.name, kind, span: self.span }
    }
}

/// What is given, or `None` for what is not; the outer `None` if it could not be read.
fn optional<T>(given: Option<&Clause>, read: Option<T>) -> Option<Option<T>> {
    match (given, read) {
        (Some(_), None) => None,
        (_, read) => Some(read),
    }
}

/// `force(…)`; `None` if something is missing or wrong, which is noted.
pub(super) fn read_force(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, "force", Place::Force, FORCE, "at = …, value = [fx, fy, fz]", context)?;
    let at = element.expression("at", "[l, 0, 0]", context);
    let body = element.reference("body", context);
    let value = element.expression("value", "[fx, fy, fz]", context);
    let axes = element.axes(context);
    let on_body = element.find("body").is_some();
    let somewhere =
        on_body || element.find("at").is_some() || ["at", "body"].iter().any(|w| element.misspelt.contains(w));
    if element.complete && !somewhere {
        context.error(
            element.span,
            "a force needs the point where it acts; add `at = …`, or `body = …` for a point of a body",
        );
    }
    element.require("value", "its components", "[fx, fy, fz]", context);
    if let Some(axes) = element.find("axes").filter(|_| !on_body && !element.misspelt.contains(&"body")) {
        context.error(axes.name.span(), "without `body` a force is in observer axes; add `body = …`, or remove `axes`");
    }
    let kind = if on_body {
        let at = optional(element.find("at"), at)?;
        let axes = optional(element.find("axes"), axes)?.unwrap_or(ForceAxes::Body);
        ForceKind::OnBody { body: body?, at, value: value?, axes }
    } else {
        ForceKind::AtPoint { at: at?, value: value? }
    };
    Some(element.clause(kind))
}

/// `torque(…)`; `None` if something is missing or wrong, which is noted.
pub(super) fn read_torque(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, "torque", Place::Torque, TORQUE, "body = …, value = [mx, my, mz]", context)?;
    let body = element.reference("body", context);
    let value = element.expression("value", "[mx, my, mz]", context);
    let axes = element.axes(context);
    let reaction = element.reference("reaction", context);
    element.require("body", "the body that it acts on", "…", context);
    element.require("value", "its components", "[mx, my, mz]", context);
    let axes = optional(element.find("axes"), axes)?.unwrap_or(ForceAxes::Body);
    let reaction = optional(element.find("reaction"), reaction)?;
    Some(element.clause(ForceKind::Torque { body: body?, value: value?, axes, reaction }))
}

/// `spring(…)`; `None` if something is missing or wrong, which is noted.
pub(super) fn read_spring(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, "spring", Place::Spring, SPRING, "from = …, to = …, stiffness = k", context)?;
    let from = element.expression("from", "arm.position", context);
    let to = element.expression("to", "[0, 0, h]", context);
    let stiffness = element.expression("stiffness", "k", context);
    let length = element.expression("length", "l", context);
    let damping = element.expression("damping", "c", context);
    element.require("from", "the point where it begins", "…", context);
    element.require("to", "the point where it ends", "…", context);
    element.require("stiffness", "its force by elongation", "k", context);
    let length = optional(element.find("length"), length)?;
    let damping = optional(element.find("damping"), damping)?;
    Some(element.clause(ForceKind::Spring { from: from?, to: to?, stiffness: stiffness?, length, damping }))
}

/// `drive(…)`; `None` if nothing is driven or something is wrong, which is noted.
pub(super) fn read_drive(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let group = brackets(clause, "theta = …", context)?;
    let (arguments, complete) = statements::arguments(group, Place::Drive, context);
    let (mut name, mut rates) = (None, Vec::new());
    let mut certain = complete;
    for (index, argument) in arguments.iter().enumerate() {
        match argument.value {
            Value::Absent if index == 0 => name = statements::name(&argument.name, "drive", context),
            Value::Malformed => certain = false,
            _ => match value(argument, "k * theta", context) {
                Some(value) => rates.push((argument.name.clone(), value)),
                None => certain = false,
            },
        }
    }
    if certain && rates.is_empty() {
        context.error(
            clause.name.span(),
            "a drive needs a coordinate with the generalised force on its rate; write `drive(theta = …)`",
        );
    }
    let kind = ForceKind::Drive { rates };
    let clause = ForceClause { name, kind, span: clause.name.span() };
    matches!(&clause.kind, ForceKind::Drive { rates } if certain && !rates.is_empty()).then_some(clause)
}
