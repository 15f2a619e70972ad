//! Clauses of what may touch: contacts by their gap, ranges of what has stops, and dry friction.

use super::arguments::{self, brackets, equals, known, value};
use super::arithmetic;
use super::attributes::{Clause, Content, Owner};
use super::context::Context;
use super::placements::may_be_name;
use super::words::{Table, same, word};
use crate::model::scene::contacts::{ContactClause, ContactGeometry, Copies, Counterpart, PointContact};
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
    ("semi_axes", ()),
    ("length", ()),
    ("edges", ()),
    ("end", ()),
    ("plane", ()),
    ("height", ()),
    ("over", ()),
    ("along", ()),
    ("other", ()),
    ("other_end", ()),
    ("other_radius", ()),
    ("friction", ()),
    ("restitution", ()),
    ("drilling", ()),
    ("spin", ()),
    ("rolling", ()),
    ("roll", ()),
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
    ("length", "rim"),
    ("semi_axes", "point"),
    ("edges", "point"),
    ("end", "point"),
    ("over", "height"),
    ("other_end", "other"),
    ("other_radius", "other"),
    ("drilling", "friction"),
    ("rolling", "friction"),
    ("spin", "drilling"),
    ("roll", "rolling"),
];
/// The first does not go with the second, and why.
const EXCLUDES: &[(&str, &str, &str)] = &[
    ("gap", "point", "`point` already gives the gap; remove `gap`, or remove `point`"),
    (
        "slip",
        "point",
        "the slip of a point follows from its motion; remove `slip`, or write the gap in place of `point` as well: \
         `gap = …, slip = …`",
    ),
    ("spin", "point", "the spin of a point follows from the motion of its body; remove `spin`"),
    ("roll", "point", "how a point rolls follows from the motion of its body; remove `roll`"),
    ("rim", "radius", "`rim` is the radius of a disk and `radius` that of a sphere; keep one of the two"),
    ("rim", "other", "a rim touches a plane alone; write the gap to another sphere as `gap = …`"),
    ("plane", "other", "a point touches a plane or another sphere; write a clause for each"),
    ("height", "other", "a point touches a plane or another sphere; write a clause for each"),
    ("semi_axes", "radius", "an ellipsoid has three semi-axes and a sphere a radius; keep one of the two"),
    ("semi_axes", "rim", "an ellipsoid has three semi-axes and a disk has a rim; write a clause for each"),
    ("semi_axes", "edges", "an ellipsoid has no corners; write a clause for each"),
    ("semi_axes", "end", "a capsule has spheres at its ends; write a clause for each ellipsoid"),
    ("semi_axes", "other", "an ellipsoid touches a plane alone: its distance from a sphere has no closed form"),
    (
        "semi_axes",
        "over",
        "which point of an ellipsoid is nearest to such a ground has no closed form; remove `semi_axes`",
    ),
    ("edges", "rim", "a box has corners and a disk has a rim; write a clause for each"),
    ("edges", "end", "a box has corners and a capsule has two ends; write a clause for each"),
    ("end", "rim", "a capsule has two ends and a disk has a rim; for a cylinder write `length = …` with the rim"),
    ("edges", "other", "corners touch a plane or a ground; write the gap to a sphere as `gap = …`"),
    (
        "end",
        "other_end",
        "the distance of two capsules has a kink where they are parallel; write spheres of one of them",
    ),
    (
        "end",
        "other",
        "of a sphere and a capsule the sphere comes first: write its center as `point`, `other` and `other_end`",
    ),
    ("over", "plane", "a height over the horizontal place makes its own normals; remove `plane`"),
    ("over", "along", "a height over the horizontal place makes its own tangents; remove `along`"),
    ("radius", "over", "which point of a sphere is nearest to such a ground has no closed form; remove `radius`"),
    ("rim", "over", "which point of a rim is nearest to such a ground has no closed form; write points of the rim"),
];
const DRY_FRICTION: &Table<()> = &[("slip", ()), ("bound", ())];
const RANGE: &Table<()> = &[("along", ()), ("from", ()), ("to", ()), ("restitution", ())];
/// Words of `stop(…)` and of other programs for the limits of a range.
const LIMITS: &Table<&str> =
    &[("least", "from"), ("min", "from"), ("lower", "from"), ("most", "to"), ("max", "to"), ("upper", "to")];

/// `contact(name, gap = …, …)` or `contact(name, point = …, …)`; `None` if something is missing or wrong, which is
/// noted.
pub fn read_contact(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = ContactSyntax::read(clause, "contact", CONTACT, "name, gap = …", context)?;
    let of_point = !written.lacks("point");
    let touching = if of_point { written.of_point(context) } else { written.of_gap(context) };
    let friction = written.one_or_two("friction", "mu", context);
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
    written.check_turns(of_point, context);
    let (drilling, rolling) = (written.value("drilling", "2 * r / 3", context), written.value("rolling", "d", context));
    let (name, touching) = (written.name?, touching.filter(|_| well)?);
    let numbered = |k| format_ident!("{}_{k}", name.unraw(), span = name.span());
    let names: Vec<Ident> = match &touching {
        ContactGeometry::Point(contact) if contact.copies.count() > 1 => {
            (0..contact.copies.count()).map(numbered).collect()
        }
        _ => vec![name],
    };
    let rolls = |name: &Ident| rolling.as_ref().map(|_| format_ident!("{}_rolling", name.unraw(), span = name.span()));
    let names = names.into_iter().flat_map(|name| [Some(name.clone()), rolls(&name)]).flatten().collect();
    Some(ContactClause {
        names,
        touching,
        friction: friction?,
        restitution,
        drilling,
        rolling,
        of_file: false,
        links: [None, None],
    })
}

/// `dry_friction(x, bound = …)` of the coordinate or the speed x, or `dry_friction(name, slip = …, bound = …)`; `None`
/// if something is missing or wrong, which is noted.
pub fn read_dry_friction(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = ContactSyntax::read(clause, "dry_friction", DRY_FRICTION, "x, bound = f", context)?;
    let named = written.find("slip").is_none();
    let slips = match (named, &written.name) {
        (true, Some(name)) => Some(vec![Expression { span: name.span(), kind: ExpressionKind::Name(name.clone()) }]),
        _ => written.one_or_two("slip", "v", context),
    };
    let bound = written.one_or_two("bound", "f", context);
    if written.lacks("bound") {
        context.error(clause.name.span(), "dry friction needs the largest force that it has; add `bound = f`");
    }
    let names = vec![written.name?];
    let touching = ContactGeometry::Slip { slips: slips?, named };
    let friction = bound.filter(|bound| !bound.is_empty())?;
    Some(ContactClause {
        names,
        touching,
        friction,
        restitution: None,
        drilling: None,
        rolling: None,
        of_file: false,
        links: [None, None],
    })
}

/// `range(x, from = …, to = …, restitution = …)` of the coordinate x, or `range(name, along = …, …)`; `None` if
/// something is missing or wrong, which is noted.
pub fn read_range(clause: &Clause, context: &mut Context) -> Option<ContactClause> {
    let written = ContactSyntax::read(clause, "range", RANGE, "x, from = a, to = b", context)?;
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
    let touching = ContactGeometry::Range { along: along?, from, to };
    Some(ContactClause {
        names,
        touching,
        friction: Vec::new(),
        restitution,
        drilling: None,
        rolling: None,
        of_file: false,
        links: [None, None],
    })
}

/// Three lengths along the axes of a body; `what` and `word` say of what shape.
fn three(lengths: Expression, [what, word]: [&str; 2], context: &mut Context) -> Option<[Expression; 3]> {
    match lengths.kind {
        ExpressionKind::Vector(lengths) => Some(lengths.map(|length| *length)),
        _ => {
            let message = format!("the {what} are three lengths in brackets; write `{word} = [a, b, c]`");
            context.error(lengths.span, message);
            None
        }
    }
}

/// Names of the horizontal coordinates by `over = …`.
fn horizontal(argument: &Clause, context: &mut Context) -> Option<Vec<Ident>> {
    let wording = ("name or two, those of the horizontal coordinates", ["x", "[x, y]"]);
    let names = arithmetic::read_one_or_two("over", wording, equals(argument, "[x, y]", context)?, context)?;
    let name = |name: &Expression| match &name.kind {
        ExpressionKind::Name(name) => Some(name.clone()),
        _ => {
            context.error(name.span, "`over` gives names to the horizontal coordinates; write `over = [x, y]`");
            None
        }
    };
    names.iter().map(name).collect()
}

/// Puts the horizontal coordinates in the place of their names.
fn place_over(height: &mut Expression, names: &[Ident]) {
    if let ExpressionKind::Name(name) = &height.kind
        && let Some(k) = names.iter().position(|known| same(known, name))
    {
        height.kind = ExpressionKind::Horizontal(name.clone(), k);
    }
    height.each_part(&mut |part| place_over(part, names));
}

/// A clause as it is written: its name, and its arguments, each of them once and known.
struct ContactSyntax {
    name: Option<Ident>,
    arguments: Vec<Clause>,
    /// Words that misspelt arguments may stand for, which are not missing too.
    misspelt: Vec<&'static str>,
    /// Each argument could be read.
    complete: bool,
}

impl ContactSyntax {
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
                let word = word(&argument.name);
                read.misspelt.extend(arguments::meant(&word, table));
                read.complete &= arguments::law(&word, table).is_none();
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
            "dry_friction" => "the coordinate or the speed that it resists, or a name of its own with `slip = …`",
            _ => "a name, by which a run tells its forces",
        };
        let what = noun.replace('_', " ");
        let article = if noun == "dry_friction" { "" } else { "a " };
        context.error(span, format!("{article}{what} needs {why}; write `{noun}({example})`"));
    }

    /// Reads a gap with slips.
    fn of_gap(&self, context: &mut Context) -> Option<ContactGeometry> {
        let (gap, spin) = (self.value("gap", "z - r", context), self.value("spin", "w", context));
        let (slips, rolls) = (self.one_or_two("slip", "v", context), self.one_or_two("roll", "w", context));
        Some(ContactGeometry::Gap { gap: gap?, slips: slips?, spin, rolls: rolls? })
    }

    /// Drilling and rolling have their rates, where no point says them.
    fn check_turns(&self, of_point: bool, context: &mut Context) {
        let rates = [
            (
                "drilling",
                "spin",
                "friction of drilling acts along a spin; add `spin = w`, the angular velocity about the normal",
            ),
            (
                "rolling",
                "roll",
                "rolling resistance acts along angular velocities; add `roll = w`, that about the tangent, or `roll = [a, b]` \
                 of two tangents",
            ),
        ];
        for (word, rate, message) in rates.into_iter().filter(|_| !of_point) {
            if let Some(argument) = self.find(word).filter(|_| self.lacks(rate)) {
                context.error(argument.name.span(), message);
            }
        }
    }

    /// The expressions of an argument that has one for each tangent; none where it is not given.
    fn one_or_two(&self, word: &'static str, example: &str, context: &mut Context) -> Option<Vec<Expression>> {
        let Some(argument) = self.find(word) else { return Some(Vec::new()) };
        let wording = ("scalar or two, one for each tangent", ["v", "[u, v]"]);
        arithmetic::read_one_or_two(word, wording, equals(argument, example, context)?, context)
    }

    /// Reads a contact at a point, or about it.
    fn of_point(&self, context: &mut Context) -> Option<ContactGeometry> {
        let mut value = |word: &str, example: &str| self.value(word, example, context);
        let (point, radius) = (value("point", "tip"), value("radius", "r"));
        let (rim, axis) = (value("rim", "r"), value("axis", "[0, 0, 1]"));
        let (length, end) = (value("length", "l"), value("end", "toe"));
        let (edges, semi_axes) = (value("edges", "[a, b, c]"), value("semi_axes", "[a, b, c]"));
        let (normal, height, along) = (value("plane", "[0, 0, 1]"), value("height", "h"), value("along", "[1, 0, 0]"));
        let (other, end_of_other) = (value("other", "top"), value("other_end", "toe"));
        let other_radius = value("other_radius", "r");
        let over = self.find("over").map(|argument| horizontal(argument, context));
        let edges = edges.map(|edges| three(edges, ["edges of a box", "edges"], context));
        let semi_axes = semi_axes.map(|axes| three(axes, ["semi-axes of an ellipsoid", "semi_axes"], context));
        let against = match (other, over) {
            (Some(center), _) => Counterpart::Sphere { center, end: end_of_other, radius: other_radius, along },
            (None, Some(names)) => {
                let mut height = height?;
                place_over(&mut height, &names?);
                Counterpart::Ground(height)
            }
            (None, None) => Counterpart::Plane { normal, height, along },
        };
        let copies = match (edges, end, length) {
            (Some(edges), ..) => Copies::Corners(edges?),
            (_, Some(end), _) => Copies::Ends(end),
            (.., Some(length)) => Copies::Rims(length),
            _ => Copies::One,
        };
        let rim = rim.zip(axis).map(|(radius, axis)| [radius, axis]);
        let semi_axes = match semi_axes {
            Some(axes) => Some(axes?),
            None => None,
        };
        Some(ContactGeometry::Point(Box::new(PointContact { point: point?, radius, rim, semi_axes, copies, against })))
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
