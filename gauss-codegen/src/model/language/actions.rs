//! Clauses of force elements: forces, torques, wrenches, drags, springs, stops, drives, central gravity and the medium.

use super::arguments::{self, brackets, equals, known, value};
use super::arithmetic;
use super::attributes::{Clause, Content, Owner};
use super::context::Context;
use super::placements::{may_be_name, read_reference};
use super::words::{self, Table, UNNAMED};
use crate::model::scene::clauses::{Attraction, Coefficients, Extent, ForceAxes, ForceClause, ForceKind};
use crate::model::scene::expression::Expression;
use proc_macro2::{Ident, Span};

/// How a force element is written.
struct Form {
    /// What it is called in messages.
    noun: &'static str,
    /// What its clause begins with.
    word: &'static str,
    arguments: &'static Table<()>,
    /// All that stands in its brackets.
    example: &'static str,
    /// One argument, for messages.
    argument: &'static str,
}

const FORCE: Form = Form {
    noun: "force",
    word: "force",
    arguments: &[("at", ()), ("value", ()), ("body", ()), ("axes", ())],
    example: "at = …, value = [fx, fy, fz]",
    argument: "an argument such as `value = [0, 0, f]`",
};
const TORQUE: Form = Form {
    noun: "torque",
    word: "torque",
    arguments: &[("body", ()), ("value", ()), ("axes", ()), ("reaction", ())],
    example: "body = …, value = [mx, my, mz]",
    argument: "an argument such as `value = [0, 0, f]`",
};
const WRENCH: Form = Form {
    noun: "wrench",
    word: "wrench",
    arguments: &[("body", ()), ("at", ()), ("force", ()), ("torque", ()), ("axes", ())],
    example: "body = …, force = [fx, fy, fz], torque = [mx, my, mz]",
    argument: "an argument such as `force = [0, 0, f]`",
};
const DRAG: Form = Form {
    noun: "drag",
    word: "drag",
    arguments: &[("body", ()), ("linear", ()), ("quadratic", ())],
    example: "body = …, linear = …, quadratic = …",
    argument: "an argument such as `linear = d`",
};
const SPRING: Form = Form {
    noun: "spring",
    word: "spring",
    arguments: &[("from", ()), ("to", ()), ("along", ()), ("stiffness", ()), ("length", ()), ("damping", ())],
    example: "from = …, to = …, stiffness = k",
    argument: "an argument such as `stiffness = k`",
};
const FRICTION: Form = Form {
    noun: "friction law",
    word: "friction",
    arguments: &[("from", ()), ("to", ()), ("along", ()), ("viscous", ()), ("dry", ()), ("width", ())],
    example: "along = …, viscous = d",
    argument: "an argument such as `viscous = d`",
};
const STOP: Form = Form {
    noun: "stop",
    word: "stop",
    arguments: &[
        ("from", ()),
        ("to", ()),
        ("along", ()),
        ("least", ()),
        ("most", ()),
        ("stiffness", ()),
        ("width", ()),
        ("damping", ()),
    ],
    example: "along = …, least = a, most = b, stiffness = k, width = e",
    argument: "an argument such as `stiffness = k`",
};
const ATTRACTION: Form = Form {
    noun: "attraction",
    word: "central_gravity",
    arguments: &[("mu", ()), ("center", ())],
    example: "mu = gm",
    argument: "an argument such as `mu = gm`",
};
const IN_MEDIUM: Owner = Owner::Action { word: "medium", example: "an argument such as `velocity = [c, 0, 0]`" };
const IN_DRIVE: Owner = Owner::Action { word: "drive", example: "a generalised force such as `theta = -k * theta`" };
const IN_ARMATURE: Owner = Owner::Action { word: "armature", example: "an inertia such as `theta = 0.1`" };
const MEDIUM: &Table<()> = &[("velocity", ())];
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
    fn read(clause: &Clause, form: &Form, context: &mut Context) -> Option<Element> {
        let (noun, table) = (form.noun, form.arguments);
        let group = brackets(clause, form.example, context)?;
        let place = Owner::Action { word: form.word, example: form.argument };
        let (written, complete) = arguments::arguments(group, place, context);
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
                if matches!(argument.value, Content::Absent) {
                    element.name = arguments::name(&argument.name, noun, context);
                }
            } else if noun == "torque" && argument.word() == "at" {
                context.error(
                    argument.name.span(),
                    "a torque has no point: it does the same wherever it acts on its body; remove `at`",
                );
            } else if known(&argument, form.word, table, &mut given, context) {
                element.arguments.push(argument);
            } else {
                element.misspelt.extend(arguments::meant(&argument.word(), table));
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

    /// The body or frame that it acts on: in a chart the only body, unless it is written.
    fn body(&self, in_chart: bool, context: &mut Context) -> Option<Ident> {
        match self.find("body") {
            None if in_chart => Some(Ident::new(UNNAMED, self.span)),
            _ => self.reference("body", context),
        }
    }

    fn require_body(&self, in_chart: bool, context: &mut Context) {
        if !in_chart {
            self.require("body", "the body that it acts on", "…", context);
        }
    }

    fn coefficients(&self, word: &str, context: &mut Context) -> Option<Coefficients> {
        arithmetic::read_coefficients(word, equals(self.find(word)?, "[a, b, c, d, e, f]", context)?, context)
    }

    /// `from = …, to = …` or `along = …`; what is missing of it, or too much, is noted.
    fn extent(&self, context: &mut Context) -> Option<Extent> {
        let along = self.expression("along", "theta", context);
        let from = self.expression("from", "arm.position", context);
        let to = self.expression("to", "[0, 0, h]", context);
        match (self.find("along"), self.find("from").or(self.find("to"))) {
            (Some(_), Some(end)) => {
                let message = format!(
                    "`along` already gives the coordinate of the {}; remove it, or remove `{}`",
                    self.noun, end.name
                );
                context.error(end.name.span(), message);
                None
            }
            (Some(_), None) => along.map(Extent::Along),
            (None, None) if self.complete && !["along", "from", "to"].iter().any(|w| self.misspelt.contains(w)) => {
                let message = format!(
                    "a {} needs what it acts along; add `from = …` and `to = …`, two points, or `along = …`, a scalar",
                    self.noun
                );
                context.error(self.span, message);
                None
            }
            (None, _) if self.misspelt.contains(&"along") => None,
            (None, _) => {
                self.require("from", "the point where it begins", "…", context);
                self.require("to", "the point where it ends", "…", context);
                Some(Extent::Between { from: from?, to: to? })
            }
        }
    }

    fn axes(&self, context: &mut Context) -> Option<ForceAxes> {
        let word = self.find("axes")?.bare_word(AXES, context)?;
        let axes = words::resolve("axes", &word.ident, AXES, context).ok()?;
        if let Some(arguments) = word.arguments {
            let ident = &word.ident;
            context
                .error(arguments.span_open(), format!("`{ident}` takes nothing in brackets; write `axes = {ident}`"));
        }
        Some(axes)
    }

    /// Notes that the argument `word` is missing, if it is.
    fn require(&self, word: &str, what: &str, example: &str, context: &mut Context) {
        if self.lacks(word) {
            context.error(self.span, format!("{} needs {what}; add `{word} = {example}`", words::a(self.noun)));
        }
    }

    /// The argument `word` is not there, nor misspelt.
    fn lacks(&self, word: &str) -> bool {
        self.complete && self.find(word).is_none() && !self.misspelt.contains(&word)
    }

    /// Notes that neither of two arguments is there, if it is so; `what` it needs ends with both of them.
    fn require_one(&self, first: &str, second: &str, what: &str, context: &mut Context) {
        if self.lacks(first) && self.lacks(second) {
            context.error(self.span, format!("a {} needs {what} or both", self.noun));
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

/// `force(…)`; `None` if something is missing or wrong, which is noted. In a chart it always acts on the one body.
pub fn read_force(clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &FORCE, context)?;
    let at = element.expression("at", "[l, 0, 0]", context);
    let body = element.body(in_chart, context);
    let value = element.expression("value", "[fx, fy, fz]", context);
    let axes = element.axes(context);
    let on_body = element.find("body").is_some();
    let somewhere =
        on_body || element.find("at").is_some() || ["at", "body"].iter().any(|w| element.misspelt.contains(w));
    if element.complete && !somewhere {
        let remedy = if in_chart {
            "add `at = …` in body axes from O, or `body = body` for a force at O"
        } else {
            "add `at = …`, or `body = …` for a point of a body"
        };
        context.error(element.span, format!("a force needs the point where it acts; {remedy}"));
    }
    element.require("value", "its components", "[fx, fy, fz]", context);
    let on_none = !in_chart && !on_body && !element.misspelt.contains(&"body");
    if let Some(axes) = element.find("axes").filter(|_| on_none) {
        context.error(axes.name.span(), "without `body` a force is in observer axes; add `body = …`, or remove `axes`");
    }
    let kind = if on_body || in_chart {
        let at = optional(element.find("at"), at)?;
        let axes = optional(element.find("axes"), axes)?.unwrap_or(ForceAxes::Body);
        ForceKind::OnBody { body: body?, at, value: value?, axes }
    } else {
        ForceKind::AtPoint { at: at?, value: value? }
    };
    Some(element.clause(kind))
}

/// `torque(…)`; `None` if something is missing or wrong, which is noted. In a chart it always acts on the one body.
pub fn read_torque(clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &TORQUE, context)?;
    let body = element.body(in_chart, context);
    let value = element.expression("value", "[mx, my, mz]", context);
    let axes = element.axes(context);
    let reaction = element.reference("reaction", context);
    element.require_body(in_chart, context);
    element.require("value", "its components", "[mx, my, mz]", context);
    let axes = optional(element.find("axes"), axes)?.unwrap_or(ForceAxes::Body);
    let reaction = optional(element.find("reaction"), reaction)?;
    Some(element.clause(ForceKind::Torque { body: body?, value: value?, axes, reaction }))
}

/// `wrench(…)`; `None` if something is missing or wrong, which is noted. In a chart it always acts on the one body.
pub fn read_wrench(clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &WRENCH, context)?;
    let body = element.body(in_chart, context);
    let at = element.expression("at", "[l, 0, 0]", context);
    let force = element.expression("force", "[fx, fy, fz]", context);
    let torque = element.expression("torque", "[mx, my, mz]", context);
    let axes = element.axes(context);
    element.require_body(in_chart, context);
    element.require_one(
        "force",
        "torque",
        "its components; add `force = [fx, fy, fz]`, `torque = [mx, my, mz]`",
        context,
    );
    if let Some(at) = element.find("at").filter(|_| element.lacks("force")) {
        context.error(
            at.name.span(),
            "a torque has no point: it does the same wherever it acts on its body; add `force = …`, or remove `at`",
        );
    }
    let at = optional(element.find("at"), at)?;
    let force = optional(element.find("force"), force)?;
    let torque = optional(element.find("torque"), torque)?;
    let axes = optional(element.find("axes"), axes)?.unwrap_or(ForceAxes::Body);
    let empty = force.is_none() && torque.is_none();
    let kind = ForceKind::Wrench { body: body?, at, force, torque, axes };
    (!empty).then(|| element.clause(kind))
}

/// `drag(…)`; `None` if something is missing or wrong, which is noted. In a chart it always acts on the one body.
pub fn read_drag(clause: &Clause, in_chart: bool, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &DRAG, context)?;
    let body = element.body(in_chart, context);
    let linear = element.coefficients("linear", context);
    let quadratic = element.coefficients("quadratic", context);
    element.require_body(in_chart, context);
    element.require_one("linear", "quadratic", "its coefficients; add `linear = …`, `quadratic = …`", context);
    let linear = optional(element.find("linear"), linear)?;
    let quadratic = optional(element.find("quadratic"), quadratic)?;
    let empty = linear.is_none() && quadratic.is_none();
    let kind = ForceKind::Drag { body: body?, linear, quadratic };
    (!empty).then(|| element.clause(kind))
}

/// `spring(…)`; `None` if something is missing or wrong, which is noted.
pub fn read_spring(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &SPRING, context)?;
    let extent = element.extent(context);
    let stiffness = element.expression("stiffness", "k", context);
    let length = element.expression("length", "l", context);
    let damping = element.expression("damping", "c", context);
    element.require("stiffness", "its force by elongation", "k", context);
    let length = optional(element.find("length"), length)?;
    let damping = optional(element.find("damping"), damping)?;
    Some(element.clause(ForceKind::Spring { extent: extent?, stiffness: stiffness?, length, damping }))
}

/// `stop(…)`; `None` if something is missing or wrong, which is noted.
pub fn read_stop(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &STOP, context)?;
    let extent = element.extent(context);
    let least = element.expression("least", "a", context);
    let most = element.expression("most", "b", context);
    let stiffness = element.expression("stiffness", "k", context);
    let width = element.expression("width", "e", context);
    let damping = element.expression("damping", "c", context);
    element.require_one("least", "most", "a limit; add `least = …`, `most = …`", context);
    element.require("stiffness", "its force by distance beyond the limit", "k", context);
    element.require("width", "the distance over which it sets in smoothly", "e", context);
    let least = optional(element.find("least"), least)?;
    let most = optional(element.find("most"), most)?;
    let damping = optional(element.find("damping"), damping)?;
    let empty = least.is_none() && most.is_none();
    let kind = ForceKind::Stop { extent: extent?, least, most, stiffness: stiffness?, width: width?, damping };
    (!empty).then(|| element.clause(kind))
}

/// `friction(…)`; `None` if something is missing or wrong, which is noted.
pub fn read_friction(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let element = Element::read(clause, &FRICTION, context)?;
    let extent = element.extent(context);
    let viscous = element.expression("viscous", "d", context);
    let dry = element.expression("dry", "f", context);
    let width = element.expression("width", "w", context);
    element.require_one("viscous", "dry", "a coefficient; add `viscous = …`, `dry = …` with `width = …`", context);
    if element.find("dry").is_some() {
        element.require("width", "the speed over which the dry part sets in smoothly", "w", context);
    } else if let Some(width) = element.find("width") {
        context.error(width.name.span(), "the width is that of dry friction; add `dry = …`, or remove `width`");
        return None;
    }
    let viscous = optional(element.find("viscous"), viscous)?;
    let dry = optional(element.find("dry"), dry)?;
    let width = optional(element.find("width"), width)?;
    let whole = dry.is_some() == width.is_some() && (viscous.is_some() || dry.is_some());
    let extent = extent?;
    whole.then(|| element.clause(ForceKind::Friction { extent, viscous, dry, width }))
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

/// `central_gravity(…)`; `None` if something is missing or wrong, which is noted.
pub fn read_attraction(clause: &Clause, context: &mut Context) -> Option<Attraction> {
    let element = Element::read(clause, &ATTRACTION, context)?;
    let mu = element.expression("mu", "gm", context);
    let center = element.expression("center", "[x, y, z]", context);
    element.require("mu", "its gravitational parameter", "gm", context);
    let center = optional(element.find("center"), center)?;
    Some(Attraction { name: element.name, mu: mu?, center })
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

/// `drive(…)`; `None` if nothing is driven or something is wrong, which is noted.
pub fn read_drive(clause: &Clause, context: &mut Context) -> Option<ForceClause> {
    let group = brackets(clause, "theta = …", context)?;
    let (arguments, complete) = arguments::arguments(group, IN_DRIVE, context);
    let (mut name, mut rates) = (None, Vec::new());
    let mut certain = complete;
    for (index, argument) in arguments.iter().enumerate() {
        match argument.value {
            Content::Absent if index == 0 => name = arguments::name(&argument.name, "drive", context),
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
    let kind = ForceKind::Drive { rates };
    let clause = ForceClause { name, kind, span: clause.name.span() };
    matches!(&clause.kind, ForceKind::Drive { rates } if certain && !rates.is_empty()).then_some(clause)
}
