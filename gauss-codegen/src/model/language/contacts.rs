//! Clauses of what may touch: contacts by their gap, and ranges of what has stops.

use super::arguments::{self, brackets, equals, known, value};
use super::arithmetic;
use super::attributes::{Clause, Content, Owner};
use super::context::Context;
use super::placements::may_be_name;
use super::words::{Table, word};
use crate::model::scene::contacts::{ContactClause, Touching};
use crate::model::scene::expression::{Expression, ExpressionKind};
use proc_macro2::{Ident, Span};
use quote::format_ident;
use syn::ext::IdentExt;

const CONTACT: &Table<()> = &[("gap", ()), ("slip", ()), ("friction", ()), ("restitution", ())];
const RANGE: &Table<()> = &[("along", ()), ("from", ()), ("to", ()), ("restitution", ())];
/// Words of `stop(…)` and of other programs for the limits of a range.
const LIMITS: &Table<&str> =
    &[("least", "from"), ("min", "from"), ("lower", "from"), ("most", "to"), ("max", "to"), ("upper", "to")];

/// `contact(name, gap = …, slip = …, friction = …, restitution = …)`; `None` if something is missing or wrong, which is
/// noted.
pub fn read_contact(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = Written::read(clause, "contact", CONTACT, "name, gap = …", context)?;
    let gap = written.value("gap", "z - r", context);
    let slips = written.find("slip").map_or(Some(Vec::new()), |argument| {
        arithmetic::read_one_or_two("slip", equals(argument, "v", context)?, context)
    });
    let friction = written.value("friction", "mu", context);
    let restitution = written.value("restitution", "e", context);
    if written.lacks("gap") {
        context.error(clause.name.span(), "a contact needs its gap, which may not become negative; add `gap = z - r`");
    }
    if let Some(friction) = written.find("friction").filter(|_| written.lacks("slip")) {
        context.error(
            friction.name.span(),
            "friction acts along a slip; add `slip = v`, the velocity along the tangent, or `slip = [u, v]` of two \
             tangents that are normal to each other",
        );
    }
    if let Some(slip) = written.find("slip").filter(|_| written.lacks("friction")) {
        context
            .error(slip.name.span(), "without friction the slip does nothing; add `friction = mu`, or remove `slip`");
    }
    let names = vec![written.name?];
    let touching = Touching::Gap { gap: gap?, slips: slips? };
    Some(ContactClause { names, touching, friction, restitution })
}

/// `range(x, from = …, to = …, restitution = …)` of the coordinate x, or `range(name, along = …, …)`; `None` if
/// something is missing or wrong, which is noted.
pub fn read_range(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = Written::read(clause, "range", RANGE, "x, from = a, to = b", context)?;
    let along = match written.find("along") {
        Some(argument) => value(argument, "x", context),
        None => written.name.clone().map(|name| Expression { span: name.span(), kind: ExpressionKind::Name(name) }),
    };
    let from = written.value("from", "a", context);
    let to = written.value("to", "b", context);
    let restitution = written.value("restitution", "e", context);
    if written.lacks("from") && written.lacks("to") {
        context.error(clause.name.span(), "a range needs a limit; add `from = a`, `to = b`, or both");
    }
    let name = written.name.as_ref()?;
    let limits = [("from", &from), ("to", &to)].into_iter().filter(|(_, limit)| limit.is_some());
    let names: Vec<Ident> =
        limits.map(|(end, _)| format_ident!("{}_{end}", name.unraw(), span = name.span())).collect();
    if names.is_empty() {
        return None;
    }
    let touching = Touching::Range { along: along?, from, to };
    Some(ContactClause { names, touching, friction: None, restitution })
}

/// A clause as it is written: its name, and its arguments, each of them once and known.
struct Written {
    name: Option<Ident>,
    arguments: Vec<Clause>,
    /// Words that misspelt arguments may stand for, which are not missing too.
    misspelt: Vec<&'static str>,
    /// Each argument could be read.
    complete: bool,
}

impl Written {
    /// `None` if there is nothing in brackets, which is noted.
    fn read(
        clause: &Clause,
        noun: &'static str,
        table: &'static Table<()>,
        example: &'static str,
        context: &mut Context,
    ) -> Option<Self> {
        let group = brackets(clause, example, context)?;
        let place = Owner::Action { word: noun, example: "an argument such as `restitution = 0.5`" };
        let (arguments, complete) = arguments::arguments(group, place, context);
        let mut read = Self { name: None, arguments: Vec::new(), misspelt: Vec::new(), complete };
        let (mut given, mut named) = (Vec::new(), !complete);
        for (index, argument) in arguments.into_iter().enumerate() {
            if index == 0 && may_be_name(&argument, table) {
                named = true;
                if matches!(argument.value, Content::Absent) {
                    read.name = arguments::name(&argument.name, noun, context);
                }
            } else if let Some(&(other, limit)) = LIMITS
                .iter()
                .find(|(other, limit)| argument.name == other && table.iter().any(|(word, ())| word == limit))
            {
                context
                    .error(argument.name.span(), format!("unknown argument of `{noun}`: `{other}`; write `{limit}`"));
                read.misspelt.push(limit);
            } else if known(&argument, noun, table, &mut given, context) {
                read.arguments.push(argument);
            } else {
                read.misspelt.extend(arguments::meant(&word(&argument.name), table));
            }
        }
        if !named {
            read.refuse_unnamed(clause.name.span(), noun, example, context);
        }
        Some(read)
    }

    fn refuse_unnamed(&self, span: Span, noun: &str, example: &str, context: &mut Context) {
        let why = match noun {
            "range" => "the coordinate that it limits, or a name of its own with `along = …`",
            _ => "a name, by which a run tells its forces",
        };
        context.error(span, format!("a {noun} needs {why}; write `{noun}({example})`"));
    }

    fn find(&self, word: &str) -> Option<&Clause> {
        self.arguments.iter().find(|argument| argument.word() == word)
    }

    /// The argument `word` is not there, nor misspelt.
    fn lacks(&self, word: &str) -> bool {
        self.complete && self.find(word).is_none() && !self.misspelt.contains(&word)
    }

    /// The expression of an argument, where it is given.
    fn value(&self, word: &str, example: &str, context: &mut Context) -> Option<Expression> {
        value(self.find(word)?, example, context)
    }
}
