//! Clauses of what may touch: contacts by their gap, and ranges of what has stops.

use super::arguments::{self, brackets, equals, known, value};
use super::arithmetic;
use super::attributes::{Clause, Content, Owner};
use super::context::Context;
use super::placements::may_be_name;
use super::words::{Table, word};
use crate::model::scene::contacts::{Against, ContactClause, PointContact, Touching};
use crate::model::scene::expression::{Expression, ExpressionKind};
use proc_macro2::{Ident, Span};
use quote::format_ident;
use syn::ext::IdentExt;

const CONTACT: &Table<()> = &[
    ("gap", ()),
    ("slip", ()),
    ("point", ()),
    ("radius", ()),
    ("rim", ()),
    ("axis", ()),
    ("plane", ()),
    ("height", ()),
    ("along", ()),
    ("other", ()),
    ("other_radius", ()),
    ("friction", ()),
    ("restitution", ()),
];
/// The first goes with the second alone.
const NEEDS: &Table<&str> = &[
    ("radius", "point"),
    ("rim", "point"),
    ("plane", "point"),
    ("height", "point"),
    ("along", "point"),
    ("other", "point"),
    ("axis", "rim"),
    ("rim", "axis"),
    ("other_radius", "other"),
];
/// The first does not go with the second, and why.
const EXCLUDES: &[(&str, &str, &str)] = &[
    ("gap", "point", "`point` already gives the gap; remove `gap`, or remove `point`"),
    ("slip", "point", "the slip of a point follows from its motion; remove `slip`"),
    ("rim", "radius", "`rim` is the radius of a disk and `radius` that of a sphere; keep one of the two"),
    ("rim", "other", "a rim touches a plane alone; write the gap to another sphere as `gap = …`"),
    ("plane", "other", "a point touches a plane or another sphere; write a clause for each"),
    ("height", "other", "a point touches a plane or another sphere; write a clause for each"),
    ("along", "other", "tangents are those of a plane; remove `along`"),
    ("friction", "other", "tangents of two spheres turn with them; write `gap = …` with `slip = …` for friction"),
];
const RANGE: &Table<()> = &[("along", ()), ("from", ()), ("to", ()), ("restitution", ())];
/// Words of `stop(…)` and of other programs for the limits of a range.
const LIMITS: &Table<&str> =
    &[("least", "from"), ("min", "from"), ("lower", "from"), ("most", "to"), ("max", "to"), ("upper", "to")];

/// `contact(name, gap = …, …)` or `contact(name, point = …, …)`; `None` if something is missing or wrong, which is
/// noted.
pub fn read_contact(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = Written::read(clause, "contact", CONTACT, "name, gap = …", context)?;
    let of_point = !written.lacks("point");
    let touching = if of_point { written.of_point(context) } else { written.of_gap(context) };
    let friction = written.value("friction", "mu", context);
    let restitution = written.value("restitution", "e", context);
    if written.lacks("gap") && !of_point {
        context.error(
            clause.name.span(),
            "a contact needs what may not become negative, or a point that touches; add `gap = z - r` or `point = tip`",
        );
    }
    let well = written.is_consistent(context);
    if let Some(friction) = written.find("friction").filter(|_| !of_point && written.lacks("slip")) {
        context.error(
            friction.name.span(),
            "friction acts along a slip; add `slip = v`, the velocity along the tangent, or `slip = [u, v]` of two \
             tangents that are normal to each other",
        );
    }
    if let Some(slip) = written.find("slip").filter(|_| !of_point && written.lacks("friction")) {
        context
            .error(slip.name.span(), "without friction the slip does nothing; add `friction = mu`, or remove `slip`");
    }
    let names = vec![written.name?];
    Some(ContactClause { names, touching: touching.filter(|_| well)?, friction, restitution })
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
            // Every contact has a name, so that a word alone is no argument without its value.
            let alone = matches!(argument.value, Content::Absent);
            if index == 0 && (alone || may_be_name(&argument, table)) {
                named = true;
                if alone {
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

    /// What a gap is said to be, with slips.
    fn of_gap(&self, context: &mut Context) -> Option<Touching> {
        let gap = self.value("gap", "z - r", context);
        let slips = self.find("slip").map_or(Some(Vec::new()), |argument| {
            arithmetic::read_one_or_two("slip", equals(argument, "v", context)?, context)
        });
        Some(Touching::Gap { gap: gap?, slips: slips? })
    }

    /// What touches at a point, or about it.
    fn of_point(&self, context: &mut Context) -> Option<Touching> {
        let mut value = |word: &str, example: &str| self.value(word, example, context);
        let (point, radius) = (value("point", "tip"), value("radius", "r"));
        let (rim, axis) = (value("rim", "r"), value("axis", "[0, 0, 1]"));
        let (normal, height, along) = (value("plane", "[0, 0, 1]"), value("height", "h"), value("along", "[1, 0, 0]"));
        let (other, other_radius) = (value("other", "top"), value("other_radius", "r"));
        let against = match other {
            Some(center) => Against::Sphere { center, radius: other_radius },
            None => Against::Plane { normal, height, along },
        };
        let rim = rim.zip(axis).map(|(radius, axis)| [radius, axis]);
        Some(Touching::Point(Box::new(PointContact { point: point?, radius, rim, against })))
    }

    /// Whether the arguments of a contact go together; if not, that is noted.
    fn is_consistent(&self, context: &mut Context) -> bool {
        let earlier = context.count();
        for (word, needed) in NEEDS {
            if let Some(argument) = self.find(word).filter(|_| self.lacks(needed)) {
                let message = format!("`{word}` goes with `{needed} = …`; add it, or remove `{word}`");
                context.error(argument.name.span(), message);
            }
        }
        for (word, other, why) in EXCLUDES {
            if let Some(argument) = self.find(word).filter(|_| self.find(other).is_some()) {
                context.error(argument.name.span(), why);
            }
        }
        context.count() == earlier
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
