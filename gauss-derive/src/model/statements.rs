//! The clauses of a system: coordinates, speeds and their kinematics; bodies, particles and a potential.

use super::arithmetic;
use super::attributes::{self, Clause, Place, Value};
use super::context::Context;
use super::names::{self, Table};
use super::{BodyClause, Expression, ParticleClause};
use proc_macro2::{Group, Ident, TokenTree};

/// What the clauses of a system say, before their names are checked.
#[derive(Default)]
pub(super) struct Statements {
    /// The name of the first clause: where a mistake of the system as a whole is shown.
    pub(super) first: Option<Ident>,
    pub(super) coordinates: Option<Names>,
    pub(super) speeds: Option<Names>,
    pub(super) kinematics: Option<Kinematics>,
    pub(super) bodies: Vec<BodyClause>,
    pub(super) particles: Vec<ParticleClause>,
    pub(super) potential: Option<(Ident, Option<Expression>)>,
    /// Some clause could not be read: what seems to be missing may be what it says.
    pub(super) missed: bool,
    /// The name of some body could not be read.
    pub(super) missed_body: bool,
}

/// Names in brackets.
pub(super) struct Names {
    pub(super) clause: Ident,
    pub(super) names: Vec<Ident>,
    /// Each of them could be read.
    pub(super) complete: bool,
}

/// `kinematics(x = …)`.
pub(super) struct Kinematics {
    pub(super) clause: Ident,
    /// Rates that could not be read are kept, so that they are not missing as well.
    pub(super) rates: Vec<(Ident, Option<Expression>)>,
    pub(super) complete: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Statement {
    Coordinates,
    Speeds,
    Kinematics,
    Body,
    Particle,
    Potential,
}

/// The clauses of systems.
pub(super) const STATEMENTS: &Table<Statement> = &[
    ("coordinates", Statement::Coordinates),
    ("speeds", Statement::Speeds),
    ("kinematics", Statement::Kinematics),
    ("body", Statement::Body),
    ("particle", Statement::Particle),
    ("potential", Statement::Potential),
];

const BODY: &Table<()> = &[("position", ()), ("rotation", ()), ("parent", ())];
const PARTICLE: &Table<()> = &[("mass", ()), ("position", ())];

/// The clause that `word` is, or that it is a misspelling of.
pub(super) fn meant(word: &str) -> Option<Statement> {
    names::nearest(word, STATEMENTS).map(|(_, statement)| statement)
}

impl Statements {
    /// Reads a clause whose name is in [`STATEMENTS`].
    pub(super) fn read(&mut self, clause: &Clause, context: &mut Context) {
        self.first.get_or_insert_with(|| clause.name.clone());
        let Some(statement) = meant(&clause.word()) else { return };
        let given = match statement {
            Statement::Coordinates => self.coordinates.is_some(),
            Statement::Speeds => self.speeds.is_some(),
            Statement::Kinematics => self.kinematics.is_some(),
            Statement::Potential => self.potential.is_some(),
            Statement::Body | Statement::Particle => false,
        };
        if given {
            let name = &clause.name;
            let remedy = match statement {
                Statement::Potential => "write the sum of the two in one",
                _ => "write all of it in one",
            };
            context.error(name.span(), format!("`{name}` is given twice; {remedy}"));
        }
        match statement {
            Statement::Coordinates => {
                let names = read_names(clause, "coordinate", context);
                self.coordinates = self.coordinates.take().or(Some(names));
            }
            Statement::Speeds => {
                let names = read_names(clause, "speed", context);
                self.speeds = self.speeds.take().or(Some(names));
            }
            Statement::Kinematics => {
                let kinematics = read_kinematics(clause, context);
                self.kinematics = self.kinematics.take().or(Some(kinematics));
            }
            Statement::Body => match read_body(clause, context) {
                Some(body) => self.bodies.push(body),
                None => self.missed_body = true,
            },
            Statement::Particle => match read_particle(clause, context) {
                Some(particle) => self.particles.push(particle),
                None => self.missed_body = true,
            },
            Statement::Potential => {
                let value = read_potential(clause, context);
                self.potential = self.potential.take().or(Some((clause.name.clone(), value)));
            }
        }
    }

    /// Takes note of a clause that is refused.
    pub(super) fn miss(&mut self, clause: &Clause) {
        self.missed = true;
        self.first.get_or_insert_with(|| clause.name.clone());
    }
}

/// The brackets of a clause that needs them.
fn brackets<'a>(clause: &'a Clause, example: &str, context: &mut Context) -> Option<&'a Group> {
    let name = &clause.name;
    match &clause.value {
        Value::Malformed => None,
        Value::Brackets(group) if !group.stream().is_empty() => Some(group),
        Value::Brackets(group) => {
            context
                .error(group.span_open(), format!("`{name}()` says nothing; write `{name}({example})` or remove it"));
            None
        }
        Value::Absent => {
            context.error(name.span(), format!("`{name}` says nothing; write `{name}({example})`"));
            None
        }
        Value::Equals(tokens) => {
            let span = tokens.first().map_or(name.span(), attributes::start);
            context.error(span, format!("`{name}` takes brackets, not `=`; write `{name}({example})`"));
            None
        }
    }
}

/// A name that expressions can use: no keyword.
fn name(ident: &Ident, noun: &str, context: &mut Context) -> Option<Ident> {
    // The tokens of macros have keywords and `_` as identifiers; syn's have not.
    match syn::parse2::<Ident>(TokenTree::Ident(ident.clone()).into()) {
        Ok(ident) => Some(ident),
        Err(_) => {
            context.error(ident.span(), format!("`{ident}` is a keyword and cannot name a {noun}"));
            None
        }
    }
}

/// `coordinates(x, y)`.
fn read_names(clause: &Clause, noun: &str, context: &mut Context) -> Names {
    let mut names = Names { clause: clause.name.clone(), names: Vec::new(), complete: false };
    let example = if noun == "speed" { "v, omega" } else { "x, y, theta" };
    let Some(group) = brackets(clause, example, context) else { return names };
    names.complete = true;
    for piece in attributes::pieces(group.stream(), &format!("the name of a {noun}"), context) {
        let (ident, rest) = match piece.split_first() {
            Some((TokenTree::Ident(ident), rest)) => (ident, rest),
            Some((other, _)) => {
                context.error(
                    attributes::start(other),
                    format!("expected the name of a {noun}, found {}", attributes::found(other)),
                );
                names.complete = false;
                continue;
            }
            None => continue,
        };
        let Some(ident) = name(ident, noun, context) else {
            names.complete = false;
            continue;
        };
        match rest {
            [] => names.names.push(ident),
            [TokenTree::Punct(colon), .., TokenTree::Ident(ty)]
                if colon.as_char() == ':' && (ty == "Pose" || ty == "Rotation") =>
            {
                context.error(
                    ty.span(),
                    format!("`{ident}: {ty}` is not supported by this version; write scalar coordinates"),
                );
                names.complete = false;
            }
            [TokenTree::Punct(colon), ..] if colon.as_char() == ':' => {
                context.error(colon.span(), format!("a {noun} is a scalar and has no type; write `{ident}`"));
                names.names.push(ident);
            }
            [other, ..] => {
                context.error(
                    attributes::start(other),
                    format!(
                        "expected `,` after `{ident}`, found {}; separate names by commas",
                        attributes::found(other)
                    ),
                );
                names.names.push(ident);
                names.complete = false;
            }
        }
    }
    names
}

/// The arguments in the brackets of a clause.
fn arguments(group: &Group, place: Place, context: &mut Context) -> Vec<Clause> {
    let mut arguments = Vec::new();
    attributes::split(group.stream(), place, &mut arguments, context);
    arguments
}

/// The expression that an argument is said to be.
fn value(argument: &Clause, example: &str, context: &mut Context) -> Option<Expression> {
    let name = &argument.name;
    match &argument.value {
        Value::Malformed => None,
        Value::Equals(tokens) => arithmetic::read(&argument.word(), tokens, context),
        Value::Absent => {
            context.error(name.span(), format!("`{name}` needs a value; write `{name} = {example}`"));
            None
        }
        Value::Brackets(group) => {
            context.error(
                group.span_open(),
                format!("the value of `{name}` follows `=`, without brackets; write `{name} = {example}`"),
            );
            None
        }
    }
}

fn read_kinematics(clause: &Clause, context: &mut Context) -> Kinematics {
    let mut kinematics = Kinematics { clause: clause.name.clone(), rates: Vec::new(), complete: false };
    let Some(group) = brackets(clause, "x = v, …", context) else { return kinematics };
    let equations = arguments(group, Place::Kinematics, context);
    let written = attributes::pieces(group.stream(), "", &mut Context::default()).len();
    kinematics.complete = written == equations.len();
    for equation in &equations {
        kinematics.rates.push((equation.name.clone(), value(equation, "v", context)));
    }
    kinematics
}

/// `None` if not even its name is certain.
fn read_body(clause: &Clause, context: &mut Context) -> Option<BodyClause> {
    let group = brackets(clause, "position = […], rotation = …", context)?;
    let mut body = BodyClause {
        name: None,
        massless: false,
        parent: None,
        position: None,
        rotation: None,
        span: clause.name.span(),
    };
    let mut given: Vec<String> = Vec::new();
    let mut certain = true;
    for (index, argument) in arguments(group, Place::Body, context).iter().enumerate() {
        let word = argument.word();
        if !known(argument, &word, "body", BODY, index == 0, &mut given, context) {
            // A word alone at the beginning is the name; what else is unknown is noted.
            if index == 0 && matches!(argument.value, Value::Absent) {
                body.name = name(&argument.name, "body", context);
                certain &= body.name.is_some();
            }
            continue;
        }
        match word.as_str() {
            "position" => body.position = value(argument, "[x, y, 0]", context).or(body.position),
            "rotation" => body.rotation = value(argument, "rotation_z(theta)", context).or(body.rotation),
            _ => body.parent = read_parent(argument, context).or(body.parent),
        }
    }
    certain.then_some(body)
}

/// Whether an argument is in the table and new; if not, that is noted. A word alone may be a name where names stand.
fn known(
    argument: &Clause,
    word: &str,
    owner: &str,
    table: &Table<()>,
    may_be_name: bool,
    given: &mut Vec<String>,
    context: &mut Context,
) -> bool {
    if !table.iter().any(|(name, ())| *name == word) {
        if !(may_be_name && matches!(argument.value, Value::Absent)) {
            let noun = format!("argument of `{owner}`:");
            // The message reads "unknown argument of `body`: `positon`; …".
            let _ = names::resolve(&noun, &argument.name, table, context);
        }
        return false;
    }
    if given.iter().any(|earlier| earlier == word) {
        context.error(argument.name.span(), format!("`{word}` is given twice; keep one of the two"));
    }
    given.push(word.into());
    true
}

fn read_parent(argument: &Clause, context: &mut Context) -> Option<Ident> {
    let tokens = match &argument.value {
        Value::Malformed => return None,
        Value::Equals(tokens) => attributes::flat(tokens.iter().cloned().collect()),
        Value::Absent | Value::Brackets(_) => {
            context.error(
                argument.name.span(),
                "`parent` needs the name of another body; write `parent = other`, or leave it out",
            );
            return None;
        }
    };
    match tokens.as_slice() {
        [TokenTree::Ident(parent)] => Some(parent.clone()),
        [TokenTree::Ident(_), extra, ..] | [extra, ..] => {
            context.error(
                attributes::start(extra),
                format!("`parent` is the name of another body, found {}", attributes::found(extra)),
            );
            None
        }
        [] => None,
    }
}

/// `None` if something is missing or wrong, which is noted.
fn read_particle(clause: &Clause, context: &mut Context) -> Option<ParticleClause> {
    let group = brackets(clause, "mass = m, position = [x, y, z]", context)?;
    let (mut mass, mut position) = (None, None);
    let mut given: Vec<String> = Vec::new();
    let arguments = arguments(group, Place::Particle, context);
    let mut misspelt = Vec::new();
    for argument in &arguments {
        let word = argument.word();
        if !known(argument, &word, "particle", PARTICLE, false, &mut given, context) {
            misspelt.extend(names::nearest(&word, PARTICLE).map(|(name, ())| name));
            continue;
        }
        match word.as_str() {
            "mass" => mass = value(argument, "m", context).or(mass),
            _ => position = value(argument, "[x, y, 0]", context).or(position),
        }
    }
    for (word, example) in [("mass", "mass = m"), ("position", "position = [x, y, z]")] {
        if !given.iter().any(|name| name == word) && !misspelt.contains(&word) {
            context.error(clause.name.span(), format!("a particle needs its {word}; add `{example}`"));
        }
    }
    Some(ParticleClause { mass: mass?, position: position?, parent: None, span: clause.name.span() })
}

fn read_potential(clause: &Clause, context: &mut Context) -> Option<Expression> {
    value(clause, "k * x * x / 2", context)
}
