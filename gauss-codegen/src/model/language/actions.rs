//! Clauses of force elements, read by their table; armatures and the medium.

use super::arguments::{self, brackets, equals, known, value};
use super::arithmetic;
use super::attributes::{Clause, Content, Owner};
use super::context::Context;
use super::placements::{may_be_name, read_reference};
use super::words::{self, Table, UNNAMED};
use crate::model::scene::elements::{ArgumentRule, ArgumentType, ClauseForm, ElementArgument, Row, argument};
use crate::model::scene::expression::Expression;
use crate::model::scene::forces::{ArgumentContent, ArgumentValue, ForceAxes, ForceClause};
use proc_macro2::{Ident, Span};

const IN_MEDIUM: Owner = Owner::Action { word: "medium", example: "an argument such as `velocity = [c, 0, 0]`" };
const IN_ARMATURE: Owner = Owner::Action { word: "armature", example: "an inertia such as `theta = 0.1`" };
const MEDIUM: &Table<()> = &[("velocity", ())];
const AXES: &Table<ForceAxes> = &[("body", ForceAxes::Body), ("observer", ForceAxes::Observer)];

/// The clause of an element; `None` if something is missing or wrong, which is noted. In a chart it always acts on the
/// one body.
pub fn read(row: &'static Row, clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    match row.form {
        ClauseForm::Arguments => read_arguments(row, clause, in_chart, context),
        ClauseForm::Rates => read_rates(row, clause, context),
        ClauseForm::Value => {
            let function = value(clause, row.example, context)?;
            Some(ForceClause::dissipation(None, function, clause.name.span()))
        }
    }
}

fn read_arguments(row: &'static Row, clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    let mut written = ElementSyntax::read(row, clause, in_chart, context)?;
    let mut read = ForceClause::new(row, written.name.take(), written.span);
    let mut whole = true;
    for argument in row.arguments {
        let value = match written.find(argument.word) {
            Some(clause) => {
                let value = read_value(row, argument, clause, context);
                whole &= value.is_some();
                value
            }
            None if in_chart && argument.takes == ArgumentType::Body => {
                Some(ArgumentContent::Reference(Ident::new(UNNAMED, written.span)))
            }
            None => None,
        };
        read.given.extend(value.map(|value| ArgumentValue { argument, coordinate: None, value }));
    }
    for rule in row.rules {
        whole &= written.obeys(rule, context);
    }
    for argument in row.arguments {
        if let Some(what) = argument.required {
            whole &= written.require(argument.word, what, argument.example, context);
        }
    }
    whole.then_some(read)
}

/// Reads the value of an argument; `None` if it is wrong, which is noted.
fn read_value(
    row: &Row,
    argument: &ElementArgument,
    clause: &Clause,
    context: &mut Context,
) -> Option<ArgumentContent> {
    Some(match argument.takes {
        ArgumentType::Body | ArgumentType::Other => {
            ArgumentContent::Reference(read_reference(clause, "a body or a frame", context)?)
        }
        ArgumentType::Axes => ArgumentContent::Axes(read_axes(clause, context)?),
        ArgumentType::Coefficients(_) | ArgumentType::Matrix { .. } => {
            let what = format!("the `{}` coefficients of {} are", argument.word, words::a(row.noun));
            let tokens = equals(clause, argument.example, context)?;
            ArgumentContent::Coefficients(arithmetic::read_coefficients(argument.word, &what, tokens, context)?)
        }
        ArgumentType::Point
        | ArgumentType::Force
        | ArgumentType::Torque
        | ArgumentType::FlowVelocity
        | ArgumentType::Drive
        | ArgumentType::Dissipation
        | ArgumentType::End
        | ArgumentType::Along
        | ArgumentType::Constant { .. }
        | ArgumentType::Center => ArgumentContent::Expression(value(clause, argument.example, context)?),
    })
}

fn read_axes(clause: &Clause, context: &mut Context) -> Option<ForceAxes> {
    let word = clause.bare_word(AXES, context)?;
    let axes = words::resolve("axes", &word.ident, AXES, context).ok()?;
    if let Some(arguments) = word.arguments {
        let ident = &word.ident;
        context.error(arguments.span_open(), format!("`{ident}` takes nothing in brackets; write `axes = {ident}`"));
    }
    Some(axes)
}

/// An element as it is written: its name, if it has one, and its arguments, each of them once and in its row.
struct ElementSyntax {
    row: &'static Row,
    span: Span,
    in_chart: bool,
    name: Option<Ident>,
    arguments: Vec<Clause>,
    /// Words that misspelt arguments may stand for, which are not missing too.
    misspelt: Vec<&'static str>,
    /// Each argument could be read.
    complete: bool,
}

impl ElementSyntax {
    /// `None` if there is nothing in brackets, which is noted.
    fn read(row: &'static Row, clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ElementSyntax> {
        let table = row.words();
        let group = brackets(clause, row.example, context)?;
        let place = Owner::Action { word: row.word, example: row.argument };
        let (arguments, complete) = arguments::arguments(group, place, context);
        let span = clause.name.span();
        let mut read =
            ElementSyntax { row, span, in_chart, name: None, arguments: Vec::new(), misspelt: Vec::new(), complete };
        let mut given = Vec::new();
        for (index, argument) in arguments.into_iter().enumerate() {
            let word = argument.word();
            if index == 0 && may_be_name(&argument, &table) {
                if matches!(argument.value, Content::Absent) {
                    read.name = arguments::name(&argument.name, row.noun, context);
                }
            } else if let Some((_, message)) = row.refused.iter().find(|(refused, _)| *refused == word) {
                context.error(argument.name.span(), *message);
                // What it lacks is what that says.
                read.complete = false;
            } else if known(&argument, row.word, &table, &mut given, context) {
                read.arguments.push(argument);
            } else {
                read.misspelt.extend(arguments::meant(&word, &table));
                // Whoever asks for another law is not told what this one lacks.
                read.complete &= arguments::law(&word, &table).is_none();
            }
        }
        Some(read)
    }

    fn find(&self, word: &str) -> Option<&Clause> {
        self.arguments.iter().find(|argument| argument.word() == word)
    }

    /// Whether the argument is there, or known without it; notes that it is missing, if it is.
    fn require(&self, word: &str, what: &str, example: &str, context: &mut Context) -> bool {
        if self.find(word).is_some() || (self.in_chart && word == argument::BODY) {
            return true;
        }
        if self.lacks(word) {
            context.error(self.span, format!("{} needs {what}; add `{word} = {example}`", words::a(self.row.noun)));
        }
        false
    }

    /// The argument `word` is not there, nor misspelt.
    fn lacks(&self, word: &str) -> bool {
        self.complete && self.find(word).is_none() && !self.misspelt.contains(&word)
    }

    /// Whether a rule holds; if not, that is noted.
    fn obeys(&self, rule: &ArgumentRule, context: &mut Context) -> bool {
        match *rule {
            ArgumentRule::Extent => self.has_extent(context),
            ArgumentRule::Somewhere => self.is_somewhere(context),
            ArgumentRule::OneOf(words, what) => {
                if words.iter().all(|word| self.lacks(word)) {
                    context.error(self.span, format!("{} needs {what} or both", words::a(self.row.noun)));
                }
                words.iter().any(|word| self.find(word).is_some())
            }
            ArgumentRule::With([first, second], what) => {
                let example = self.row.find(second).map_or("…", |argument| argument.example);
                self.find(first).is_none() || self.require(second, what, example, context)
            }
            ArgumentRule::OnlyWith([word, other], message) => {
                if let Some(argument) = self.find(word).filter(|_| self.lacks(other)) {
                    context.error(argument.name.span(), message);
                }
                true
            }
        }
    }

    /// `along = …`, or `from = …` and `to = …`.
    fn has_extent(&self, context: &mut Context) -> bool {
        let [along, from, to] = [argument::ALONG, argument::FROM, argument::TO];
        match (self.find(along), self.find(from).or(self.find(to))) {
            (Some(_), Some(end)) => {
                let message = format!(
                    "`along` already gives the coordinate of the {}; remove it, or remove `{}`",
                    self.row.noun, end.name
                );
                context.error(end.name.span(), message);
                false
            }
            (Some(_), None) => true,
            (None, None) if self.complete && ![along, from, to].iter().any(|w| self.misspelt.contains(w)) => {
                let message = format!(
                    "a {} needs its extent; add `from = …` and `to = …`, two points, or `along = …`, a scalar",
                    self.row.noun
                );
                context.error(self.span, message);
                false
            }
            (None, _) if self.misspelt.contains(&along) => false,
            (None, _) => {
                let begins = self.require(from, "the point where it begins", "…", context);
                self.require(to, "the point where it ends", "…", context) && begins
            }
        }
    }

    /// `at = …`, or `body = …`.
    fn is_somewhere(&self, context: &mut Context) -> bool {
        let on_body = self.find(argument::BODY).is_some();
        let misspelt = |word: &str| self.misspelt.contains(&word);
        let there = on_body || self.find(argument::AT).is_some();
        if self.complete && !there && ![argument::AT, argument::BODY].into_iter().any(misspelt) {
            let remedy = if self.in_chart {
                "add `at = …` in body axes from O, or `body = body` for a force at O"
            } else {
                "add `at = …`, or `body = …` for a point of a body"
            };
            context.error(self.span, format!("{} needs the point where it acts; {remedy}", words::a(self.row.noun)));
        }
        let on_none = !self.in_chart && !on_body && !misspelt(argument::BODY);
        if let Some(axes) = self.find(argument::AXES).filter(|_| on_none) {
            let message = "without `body` a force is in observer axes; add `body = …`, or remove `axes`";
            context.error(axes.name.span(), message);
        }
        there || self.in_chart
    }
}

/// `drive(theta = …)`; `None` if nothing is driven or something is wrong, which is noted.
fn read_rates(row: &'static Row, clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let group = brackets(clause, row.example, context)?;
    let place = Owner::Action { word: row.word, example: row.argument };
    let (arguments, complete) = arguments::arguments(group, place, context);
    let (mut name, mut rates) = (None, Vec::new());
    let mut certain = complete;
    for (index, argument) in arguments.iter().enumerate() {
        match argument.value {
            Content::Absent if index == 0 => name = arguments::name(&argument.name, row.noun, context),
            Content::Malformed => certain = false,
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
    (certain && !rates.is_empty()).then(|| ForceClause::drive(name, rates, clause.name.span()))
}

/// `armature(elbow = a, wrist = b)`: coordinates with the inertia of their rates. What is wrong is noted.
pub fn read_armature(clause: &Clause, context: &mut Context) -> Vec<(Ident, Expression)> {
    let Some(group) = brackets(clause, "theta = …", context) else { return Vec::new() };
    let (arguments, _) = arguments::arguments(group, IN_ARMATURE, context);
    let read = |argument: &Clause, context: &mut Context| match argument.value {
        Content::Malformed => None,
        _ => Some((argument.name.clone(), value(argument, "a", context)?)),
    };
    arguments.iter().filter_map(|argument| read(argument, context)).collect()
}

/// The velocity of `medium(velocity = …)`; `None` if it is missing or wrong, which is noted.
pub fn read_medium(clause: &Clause, context: &mut Context) -> Option<Expression> {
    let group = brackets(clause, "velocity = [cx, cy, cz]", context)?;
    let (arguments, complete) = arguments::arguments(group, IN_MEDIUM, context);
    let (mut velocity, mut given, mut misspelt) = (None, Vec::new(), false);
    for argument in &arguments {
        if known(argument, "medium", MEDIUM, &mut given, context) {
            velocity = velocity.or(value(argument, "[cx, cy, cz]", context));
        } else {
            misspelt |= arguments::meant(&argument.word(), MEDIUM).is_some();
        }
    }
    if complete && given.is_empty() && !misspelt {
        context.error(clause.name.span(), "a medium needs its velocity; add `velocity = [cx, cy, cz]`");
    }
    velocity
}
