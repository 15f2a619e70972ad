//! Clauses that declare names: coordinates, speeds and inputs with their kinds, speeds that stay independent,
//! kinematics, and definitions.

use super::arguments::{self, brackets, value};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::placements;
use super::words::{self, Table};
use crate::model::scene::clauses::{CoordinateClause, CoordinateKind, Speed, SpeedKind, SpeedPart};
use crate::model::scene::expression::Expression;
use crate::terms::{InputKind, InputName, OptionalMethod, ReactionJoint};
use proc_macro2::{Ident, Span, TokenTree};

/// Names that a clause declares, in brackets.
pub struct Names<N> {
    pub clause: Ident,
    pub names: Vec<N>,
    /// Each of them could be read.
    pub complete: bool,
}

/// Puts names before those of a clause, which is called `word` where there is none.
#[cfg_attr(not(any(feature = "urdf", feature = "mjcf")), allow(dead_code, reason = "files of robots are not read"))]
pub fn before<N>(clause: &mut Option<Names<N>>, names: Vec<N>, word: &str, span: Span) {
    let empty = || Names { clause: Ident::new(word, span), names: Vec::new(), complete: true };
    clause.get_or_insert_with(empty).names.splice(0..0, names);
}

/// `kinematics(x = …)`.
pub struct KinematicsClause {
    pub clause: Ident,
    /// Rates that could not be read are kept, so that they are not missing as well.
    pub rates: Vec<(Ident, Option<Expression>)>,
    pub complete: bool,
}

/// `states(x = …)`: one of its equations.
pub struct StateClause {
    pub name: Ident,
    /// One that could not be read is kept, so that its name is known.
    pub rate: Option<Expression>,
}

/// `define(name = …)`: one of its equations.
pub struct Definition {
    pub name: Ident,
    /// One that could not be read is kept, so that its name is known.
    pub expression: Option<Expression>,
    pub origin: Origin,
}

/// Clauses that definitions come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// `define(…)`.
    Define,
    /// `lock(…)`: the name is that of a coordinate that is held at the value, or of its speed.
    Lock,
    /// `motion(…)`: the name is that of a coordinate that is the value at every time.
    Motion,
    /// The name is that of the speed of such a coordinate.
    Rate,
}

impl Origin {
    /// Whether the name was that of a coordinate or a speed.
    pub fn is_moved(self) -> bool {
        self != Origin::Define
    }
}

const COORDINATES: &Table<CoordinateKind> = &[("Pose", CoordinateKind::Pose), ("Rotation", CoordinateKind::Rotation)];
const SPEEDS: &Table<SpeedKind> = &[("Vector3", SpeedKind::Vector)];
const INPUTS: &Table<InputKind> = &[("Vector3", InputKind::Vector), ("Wrench", InputKind::Wrench)];

/// Words about the declarations of a clause, for messages.
struct Language<K: 'static> {
    noun: &'static str,
    example: &'static str,
    kinds: &'static Table<K>,
    scalar: K,
    /// Units may follow, `thrust = "N"`.
    units: bool,
    /// Components may follow, `w.x`: the kind that each is.
    component: Option<fn(usize) -> K>,
}

/// `coordinates(x, pose: Pose)`.
pub fn read_coordinates(clause: &Clause, context: &mut Context) -> Names<CoordinateClause> {
    let language = Language {
        noun: "coordinate",
        example: "x, y, theta",
        kinds: COORDINATES,
        scalar: CoordinateKind::Scalar,
        units: false,
        component: None,
    };
    read_names(clause, &language, |ident, kind, _| CoordinateClause { ident, kind }, context)
}

/// `speeds(v, w: Vector3)`.
pub fn read_speeds(clause: &Clause, context: &mut Context) -> Names<Speed> {
    let language = Language {
        noun: "speed",
        example: "v, omega",
        kinds: SPEEDS,
        scalar: SpeedKind::Scalar,
        units: false,
        component: None,
    };
    read_names(clause, &language, |ident, kind, _| Speed { ident, kind }, context)
}

/// `independent(v, w.x)`.
pub fn read_independent(clause: &Clause, context: &mut Context) -> Names<SpeedPart> {
    let language =
        Language { noun: "speed", example: "v, omega", kinds: &[], scalar: None, units: false, component: Some(Some) };
    read_names(clause, &language, |ident, component, _| SpeedPart { ident, component }, context)
}

/// Words of `methods(…)`.
pub const METHODS: &Table<OptionalMethod> = &[
    ("centroidal", OptionalMethod::Centroidal),
    ("nonlinear_effects", OptionalMethod::NonlinearEffects),
    ("gravity_torques", OptionalMethod::GravityTorques),
    ("jacobian_rates", OptionalMethod::JacobianRates),
];

/// `methods(centroidal, gravity_torques)`: words, each once.
pub fn read_methods(clause: &Clause, context: &mut Context) -> Vec<OptionalMethod> {
    read_words(clause, ["method", "centroidal"], METHODS, context)
}

/// Words in brackets, each once; what they are called, and one of them.
pub fn read_words<T: Copy + PartialEq>(
    clause: &Clause,
    [noun, example]: [&'static str; 2],
    table: &Table<T>,
    context: &mut Context,
) -> Vec<T> {
    let language = Language { noun, example, kinds: &[], scalar: (), units: false, component: None };
    let names = read_names(clause, &language, |ident, (), _| ident, context);
    let mut words = Vec::new();
    for name in names.names {
        let Ok(word) = words::resolve(noun, &name, table, context) else { continue };
        if words.contains(&word) {
            context.error(name.span(), format!("`{name}` is named twice; keep one of the two"));
        } else {
            words.push(word);
        }
    }
    words
}

/// `frames(tool, left_foot)`: names of bodies and frames, each once.
pub fn read_frames(clause: &Clause, context: &mut Context) -> Vec<Ident> {
    read_once(clause, ["frame", "tool"], context)
}

/// `reactions(upper_arm, wrist)`: names of joints, each once. Of scenes that are written the bodies and frames that
/// joints carry.
pub fn read_reactions(clause: &Clause, context: &mut Context) -> Vec<ReactionJoint> {
    let names = read_once(clause, ["joint", "upper_arm"], context).into_iter();
    names.map(|name| ReactionJoint { link: name.clone(), name }).collect()
}

fn read_once(clause: &Clause, [noun, example]: [&'static str; 2], context: &mut Context) -> Vec<Ident> {
    let language = Language { noun, example, kinds: &[], scalar: (), units: false, component: None };
    let names = read_names(clause, &language, |ident, (), _| ident, context);
    let mut frames: Vec<Ident> = Vec::new();
    for name in names.names {
        if frames.iter().any(|earlier| words::same(earlier, &name)) {
            context.error(name.span(), format!("`{name}` is named twice; keep one of the two"));
        } else {
            frames.push(name);
        }
    }
    frames
}

/// `input(thrust = "N", wind: Vector3 = "m/s", gust: Wrench)`.
pub fn read_inputs(clause: &Clause, context: &mut Context) -> Names<InputName> {
    let language = Language {
        noun: "input",
        example: "thrust, rudder",
        kinds: INPUTS,
        scalar: InputKind::Scalar,
        units: true,
        component: None,
    };
    let mut of_wrenches = Vec::new();
    let make = |ident: Ident, kind, unit: Option<(String, Span)>| {
        if let (InputKind::Wrench, Some((_, span))) = (kind, &unit) {
            of_wrenches.push((ident.clone(), *span));
        }
        let unit = unit.map(|(text, _)| text).filter(|_| kind != InputKind::Wrench);
        InputName { called: ident.clone(), ident, kind, unit }
    };
    let names = read_names(clause, &language, make, context);
    for (ident, span) in of_wrenches {
        context.error(
            span,
            format!(
                "a wrench has two units, N of its force and N m of its torque, without being told; write `{ident}: Wrench`"
            ),
        );
    }
    names
}

fn read_names<N, K: Copy>(
    clause: &Clause,
    language: &Language<K>,
    mut make: impl FnMut(Ident, K, Option<(String, Span)>) -> N,
    context: &mut Context,
) -> Names<N> {
    let noun = language.noun;
    let mut names = Names { clause: clause.name.clone(), names: Vec::new(), complete: false };
    let Some(group) = brackets(clause, language.example, context) else { return names };
    names.complete = true;
    for piece in attributes::pieces(group.stream(), &format!("the name of {}", words::a(noun)), context) {
        let Some((ident, rest)) = named(&piece, noun, context) else {
            names.complete = false;
            continue;
        };
        let equals = |token: &TokenTree| matches!(token, TokenTree::Punct(equals) if equals.as_char() == '=');
        let (rest, unit) = match rest.iter().position(equals).filter(|_| language.units) {
            Some(index) => {
                (&rest[..index], arguments::read_unit(&ident, &rest[index + 1..], rest[index].span(), context))
            }
            None => (rest, None),
        };
        match (rest, language.component) {
            ([TokenTree::Punct(point), TokenTree::Ident(axis)], Some(kind)) if point.as_char() == '.' => {
                match read_component(&ident, axis, context) {
                    Some(component) => names.names.push(make(ident, kind(component), unit)),
                    None => names.complete = false,
                }
            }
            ([], _) => names.names.push(make(ident, language.scalar, unit)),
            ([TokenTree::Punct(colon), ty @ ..], _) if colon.as_char() == ':' => {
                match read_kind(&ident, colon.span(), ty, language, context) {
                    Some(kind) => names.names.push(make(ident, kind, unit)),
                    None => names.complete = false,
                }
            }
            ([other, ..], _) => {
                context.error(
                    attributes::start(other),
                    format!(
                        "expected `,` after `{ident}`, found {}; separate names by commas",
                        attributes::found(other)
                    ),
                );
                names.names.push(make(ident, language.scalar, unit));
                names.complete = false;
            }
        }
    }
    names
}

/// The name that a piece begins with, and what follows it.
fn named<'a>(piece: &'a [TokenTree], noun: &str, context: &mut Context) -> Option<(Ident, &'a [TokenTree])> {
    match piece.split_first()? {
        (TokenTree::Ident(ident), rest) => Some((arguments::name(ident, noun, context)?, rest)),
        (other, _) => {
            context.error(
                attributes::start(other),
                format!("expected the name of {}, found {}", words::a(noun), attributes::found(other)),
            );
            None
        }
    }
}

/// x, y or z.
fn read_component(ident: &Ident, axis: &Ident, context: &mut Context) -> Option<usize> {
    let component = ["x", "y", "z"].iter().position(|name| axis == name);
    if component.is_none() {
        context.error(axis.span(), format!("the components of a speed are `{ident}.x`, `{ident}.y` and `{ident}.z`"));
    }
    component
}

/// Reads the kind after the colon; `None` if it is unknown what was meant, which is noted.
fn read_kind<K: Copy>(
    ident: &Ident,
    colon: Span,
    ty: &[TokenTree],
    language: &Language<K>,
    context: &mut Context,
) -> Option<K> {
    let Language { noun, kinds, scalar, .. } = language;
    if kinds.is_empty() {
        context.error(colon, format!("the kind of {} is given where it is declared; write `{ident}`", words::a(noun)));
        return Some(*scalar);
    }
    let ty = attributes::flat(ty.iter().cloned().collect());
    if let [TokenTree::Ident(word)] = ty.as_slice()
        && let Some(&(_, kind)) = kinds.iter().find(|(name, _)| word == name)
    {
        return Some(kind);
    }
    let written = attributes::written(&ty);
    if let ([TokenTree::Literal(_)], true, true) = (ty.as_slice(), language.units, written.starts_with('"')) {
        context.error(colon, format!("a unit follows `=`; write `{ident} = {written}`"));
        return Some(*scalar);
    }
    // The last word before any `<…>`: `f64`, `Rotation` of `gauss::Rotation`, `Vector3` of `Vector3<f64>`.
    let head = written.split('<').next().unwrap_or_default();
    let word = head.rsplit("::").next().unwrap_or_default().trim();
    let span = ty.first().map_or(colon, attributes::start);
    if word.is_empty() {
        let list = words::list(kinds);
        context.error(colon, format!("nothing follows `{ident}:`; expected {list}, or `{ident}` alone for a scalar"));
        return Some(*scalar);
    }
    if matches!(word, "f64" | "f32" | "T" | "Scalar") {
        context.error(colon, format!("a scalar {noun} has no type; write `{ident}`"));
        return Some(*scalar);
    }
    let is_quaternion = ["Quaternion", "UnitQuaternion", "Rotation3", "Matrix3"].contains(&word);
    if let Some((rotation, kind)) = kinds.iter().find(|(name, _)| is_quaternion && *name == "Rotation") {
        context.error(span, format!("unknown kind of {noun} `{word}`; a rotation is `{ident}: {rotation}`"));
        return Some(*kind);
    }
    if let Some((near, kind)) = words::nearest(word, kinds) {
        let message = if near == word {
            format!("`{written}` is written as one word; write `{ident}: {near}`")
        } else {
            format!("unknown kind of {noun} `{word}`; did you mean `{near}`?")
        };
        context.error(span, message);
        return Some(kind);
    }
    let list = words::list(kinds);
    context
        .error(span, format!("unknown kind of {noun} `{written}`; expected {list}, or `{ident}` alone for a scalar"));
    None
}

pub fn read_kinematics(clause: &Clause, context: &mut Context) -> KinematicsClause {
    let mut kinematics = KinematicsClause { clause: clause.name.clone(), rates: Vec::new(), complete: false };
    let Some(group) = brackets(clause, "x = v, …", context) else { return kinematics };
    let (equations, complete) = arguments::arguments(group, Owner::Kinematics, context);
    kinematics.complete = complete;
    for equation in &equations {
        kinematics.rates.push((equation.name.clone(), value(equation, "v", context)));
    }
    kinematics
}

/// `states(current = (voltage - r * current) / l, …)`, and whether every name could be read.
pub fn read_states(clause: &Clause, context: &mut Context) -> (Vec<StateClause>, bool) {
    const EXAMPLE: &str = "x = (u - x) / tau";
    let Some(group) = brackets(clause, EXAMPLE, context) else { return (Vec::new(), false) };
    let (equations, mut complete) = arguments::arguments(group, Owner::States, context);
    let mut states = Vec::new();
    for equation in &equations {
        let Some(name) = arguments::name(&equation.name, "state", context) else {
            complete = false;
            continue;
        };
        let rate = if matches!(equation.value, Content::Absent) {
            context.error(
                name.span(),
                format!(
                    "the state `{name}` has no rate, so nothing determines it; write `{name} = …` with its rate, or \
                     `coordinates({name})` of what moves a body"
                ),
            );
            None
        } else {
            value(equation, "…", context)
        };
        states.push(StateClause { name, rate });
    }
    (states, complete)
}

/// `define(u = body.relative_velocity, …)`.
pub fn read_definitions(clause: &Clause, context: &mut Context) -> Vec<Definition> {
    let Some(group) = brackets(clause, "name = …", context) else { return Vec::new() };
    let (equations, _) = arguments::arguments(group, Owner::Define, context);
    let read = |equation: &Clause, context: &mut Context| {
        let name = arguments::name(&equation.name, "definition", context)?;
        Some(Definition { name, expression: value(equation, "…", context), origin: Origin::Define })
    };
    equations.iter().filter_map(|equation| read(equation, context)).collect()
}

/// `lock(elbow = 0.5, finger = opening)`: coordinates, or joints of a file, each with the value that it is held at.
pub fn read_locks(clause: &Clause, context: &mut Context) -> Vec<Definition> {
    const PLACE: Owner = Owner::Action { word: "lock", example: "a coordinate with its value such as `elbow = 0.5`" };
    held(clause, (Origin::Lock, PLACE), ["elbow = 0.5", "0.5"], context)
}

/// `motion(crank = w * t)`: coordinates, or joints of a file, each with the function of time that it is.
pub fn read_motions(clause: &Clause, context: &mut Context) -> Vec<Definition> {
    const PLACE: Owner =
        Owner::Action { word: "motion", example: "a coordinate with a function of time such as `crank = w * t`" };
    held(clause, (Origin::Motion, PLACE), ["crank = w * t", "w * t"], context)
}

fn held(
    clause: &Clause,
    (origin, place): (Origin, Owner),
    [example, of_value]: [&str; 2],
    context: &mut Context,
) -> Vec<Definition> {
    let Some(group) = brackets(clause, example, context) else { return Vec::new() };
    let (arguments, _) = arguments::arguments(group, place, context);
    let read = |argument: &Clause, context: &mut Context| {
        let expression = value(argument, of_value, context);
        Definition { name: argument.name.clone(), expression, origin }
    };
    arguments.iter().map(|argument| read(argument, context)).collect()
}

/// `waive(triangle_inequality)`, of all bodies, or `waive(triangle_inequality = arm)`.
pub fn read_waived(clause: &Clause, context: &mut Context) -> Vec<Option<Ident>> {
    const RULES: &Table<()> = &[("triangle_inequality", ())];
    let Some(group) = brackets(clause, "triangle_inequality", context) else { return Vec::new() };
    let place = Owner::Action { word: "waive", example: "a rule such as `triangle_inequality`" };
    let (rules, _) = arguments::arguments(group, place, context);
    let read = |rule: &Clause, context: &mut Context| {
        words::resolve("rule", &rule.name, RULES, context).ok()?;
        match rule.value {
            Content::Absent => Some(None),
            _ => placements::read_reference(rule, "a body", context).map(Some),
        }
    };
    rules.iter().filter_map(|rule| read(rule, context)).collect()
}
