//! Clauses of force elements, checked: a row of the table of elements with what its arguments are.

use super::clauses::Coefficients;
use super::elements::{ArgumentType, DISSIPATION, DRIVE, ElementArgument, Row, argument};
use super::expression::Expression;
use proc_macro2::{Ident, Span};

/// `force(…)`, `spring(…)`, `damping = …`, `central_gravity(…)` and the like: a force element.
#[derive(Clone)]
pub struct ForceClause {
    /// Name of its generalised force, different from those of the other elements; `None` if it has no name.
    pub name: Option<Ident>,
    pub row: &'static Row,
    /// In the order of the row.
    pub given: Vec<ArgumentValue>,
    /// The word that the clause begins with.
    pub span: Span,
}

/// An argument with its value.
#[derive(Clone)]
pub struct ArgumentValue {
    pub argument: &'static ElementArgument,
    /// The coordinate on whose rate it acts, of a drive.
    pub coordinate: Option<Ident>,
    pub value: ArgumentContent,
}

/// Value that is given to an argument.
#[derive(Clone)]
pub enum ArgumentContent {
    Expression(Expression),
    /// A body or a frame.
    Reference(Ident),
    Axes(ForceAxes),
    Coefficients(Coefficients),
}

/// The axes that the components of a force or a torque are taken in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceAxes {
    /// e, of the body that it acts on.
    Body,
    /// k.
    Observer,
}

impl From<Expression> for ArgumentContent {
    fn from(value: Expression) -> ArgumentContent {
        ArgumentContent::Expression(value)
    }
}

impl From<Ident> for ArgumentContent {
    fn from(name: Ident) -> ArgumentContent {
        ArgumentContent::Reference(name)
    }
}

impl From<ForceAxes> for ArgumentContent {
    fn from(axes: ForceAxes) -> ArgumentContent {
        ArgumentContent::Axes(axes)
    }
}

impl ForceClause {
    /// Without arguments.
    pub fn new(row: &'static Row, name: Option<Ident>, span: Span) -> ForceClause {
        ForceClause { name, row, given: Vec::new(), span }
    }

    /// `drive(…)`.
    pub fn drive(name: Option<Ident>, rates: Vec<(Ident, Expression)>, span: Span) -> ForceClause {
        let mut clause = ForceClause::new(&DRIVE, name, span);
        let given = |(coordinate, value): (Ident, Expression)| ArgumentValue {
            argument: &DRIVE.arguments[0],
            coordinate: Some(coordinate),
            value: value.into(),
        };
        clause.given = rates.into_iter().map(given).collect();
        clause
    }

    /// `damping = …`.
    pub fn dissipation(name: Option<Ident>, function: Expression, span: Span) -> ForceClause {
        ForceClause::new(&DISSIPATION, name, span).with(argument::VALUE, Some(function))
    }

    /// Adds the argument `word` of its row, if there is a value.
    pub fn with(mut self, word: &str, value: Option<impl Into<ArgumentContent>>) -> ForceClause {
        let argument = self.row.find(word);
        debug_assert!(argument.is_some(), "`{}` has no argument `{word}`", self.row.word);
        let given = argument.zip(value);
        self.given.extend(given.map(|(argument, value)| ArgumentValue {
            argument,
            coordinate: None,
            value: value.into(),
        }));
        self
    }

    /// Noun in messages.
    pub fn noun(&self) -> &'static str {
        self.row.noun
    }

    /// The argument `word` of its row, if it is given.
    pub fn find(&self, word: &str) -> Option<&ArgumentValue> {
        debug_assert!(self.row.find(word).is_some(), "`{}` has no argument `{word}`", self.row.word);
        self.given.iter().find(|given| given.argument.word == word)
    }

    /// The argument `word`, where that is an expression.
    pub fn expression(&self, word: &str) -> Option<&Expression> {
        match &self.find(word)?.value {
            ArgumentContent::Expression(value) => Some(value),
            ArgumentContent::Reference(_) | ArgumentContent::Axes(_) | ArgumentContent::Coefficients(_) => None,
        }
    }

    /// The argument `word`, where that is six coefficients or a matrix.
    pub fn coefficients(&self, word: &str) -> Option<&Coefficients> {
        match &self.find(word)?.value {
            ArgumentContent::Coefficients(value) => Some(value),
            ArgumentContent::Reference(_) | ArgumentContent::Axes(_) | ArgumentContent::Expression(_) => None,
        }
    }

    /// The body or frame that it acts on, if it names one.
    pub fn body(&self) -> Option<&Ident> {
        self.reference(ArgumentType::Body).map(|(name, _)| name)
    }

    /// The body or frame on which the reaction acts, if it names one, and the argument that names it.
    pub fn other(&self) -> Option<(&Ident, &'static ElementArgument)> {
        self.reference(ArgumentType::Other)
    }

    fn reference(&self, takes: ArgumentType) -> Option<(&Ident, &'static ElementArgument)> {
        self.given.iter().find(|given| given.argument.takes == takes).and_then(|given| match &given.value {
            ArgumentContent::Reference(name) => Some((name, given.argument)),
            ArgumentContent::Expression(_) | ArgumentContent::Axes(_) | ArgumentContent::Coefficients(_) => None,
        })
    }

    /// Axes that are given, else those of the body.
    pub fn axes(&self) -> ForceAxes {
        let axes =
            |given: &ArgumentValue| if let ArgumentContent::Axes(axes) = given.value { Some(axes) } else { None };
        self.given.iter().find_map(axes).unwrap_or(ForceAxes::Body)
    }

    /// Forces on the rates of coordinates, of a drive.
    pub fn rates(&self) -> impl Iterator<Item = (&Ident, &Expression)> {
        self.given.iter().filter_map(|given| match &given.value {
            ArgumentContent::Expression(value) => Some((given.coordinate.as_ref()?, value)),
            ArgumentContent::Reference(_) | ArgumentContent::Axes(_) | ArgumentContent::Coefficients(_) => None,
        })
    }

    /// Its expressions with their arguments, and which of six it is.
    pub fn expressions(&self) -> Vec<(&'static ElementArgument, usize, &Expression)> {
        let mut all = Vec::new();
        for ArgumentValue { argument, value, .. } in &self.given {
            match value {
                ArgumentContent::Expression(value) => all.push((*argument, 0, value)),
                ArgumentContent::Coefficients(value) => {
                    all.extend(value.entries().enumerate().map(|(k, entry)| (*argument, k, entry)));
                }
                ArgumentContent::Reference(_) | ArgumentContent::Axes(_) => {}
            }
        }
        all
    }

    /// Calls `change` with each of its expressions.
    pub fn each_expression(&mut self, change: &mut dyn FnMut(&mut Expression)) {
        for given in &mut self.given {
            match &mut given.value {
                ArgumentContent::Expression(value) => change(value),
                ArgumentContent::Coefficients(value) => value.each_expression(change),
                ArgumentContent::Reference(_) | ArgumentContent::Axes(_) => {}
            }
        }
    }
}
