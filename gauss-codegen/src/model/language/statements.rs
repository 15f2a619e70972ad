//! The clauses of a system, each read on its own: what `declarations`, `placements` and `actions` read, constraints,
//! the potential, the dissipation function, and the limit on the size of the code.

use super::arguments::{self, brackets, equals, value};
use super::attributes::{self, Clause, Content, Owner};
use super::context::Context;
use super::declarations::{self, Definition, KinematicsClause, Names, StateClause};
use super::modes::{self, ModesInput};
use super::words::{self, Table, same};
use super::{actions, contacts, own_functions, placements, role_clauses};
use crate::model::scene::clauses::{
    BodyClause, ConstraintClause, ConstraintLevel, CoordinateClause, ParticleClause, PointClause, RoleClause, Speed,
    SpeedPart,
};
use crate::model::scene::contacts::ContactClause;
use crate::model::scene::elements::{ATTRACTION, ClauseForm, ELEMENTS, Row};
use crate::model::scene::expression::{Expression, ExpressionKind};
use crate::model::scene::forces::ForceClause;
use crate::terms::{InputName, UserFunction};
use proc_macro2::{Group, Ident, TokenTree};
use syn::LitInt;

/// The contents of the clauses of a system, before their names are checked.
#[derive(Default)]
pub struct Statements {
    /// A body without a name moves in a chart: clauses without a body are about this one.
    pub in_chart: bool,
    /// `chart` or `motion`, where other clauses declare moving parts as well.
    pub of_chart: Option<Ident>,
    /// Names of the speeds of the chart, one by one.
    pub speeds_of_chart: Vec<String>,
    /// Some clause declares coordinates.
    has_coordinates: bool,
    /// The name of the first clause: where a mistake of the scene as a whole is shown.
    pub first: Option<Ident>,
    pub coordinates: Option<Names<CoordinateClause>>,
    pub speeds: Option<Names<Speed>>,
    pub kinematics: Option<KinematicsClause>,
    /// States of elements.
    pub states: Vec<StateClause>,
    pub bodies: Vec<BodyClause>,
    pub particles: Vec<ParticleClause>,
    pub points: Vec<PointClause>,
    pub constraints: Vec<ConstraintClause>,
    pub contacts: Vec<ContactClause>,
    pub independent: Option<Names<SpeedPart>>,
    /// `redundant` is written.
    pub redundant: Option<Ident>,
    pub limit: Option<(Ident, Option<usize>)>,
    pub potential: Option<(Ident, Option<Expression>)>,
    pub inputs: Option<Names<InputName>>,
    pub forces: Vec<ForceClause>,
    /// Numbers of these, and of constraints, that come from a robot's file: the first ones.
    pub forces_of_file: usize,
    pub constraints_of_file: usize,
    /// Names of joints of a robot's file, by which their reactions are asked for, too.
    pub joints_of_file: Vec<String>,
    /// Links that are not called as in the file, by both names.
    pub links_of_file: Vec<(String, String)>,
    /// Bodies that deform.
    pub modes: Vec<ModesInput>,
    /// Coordinates with the inertia of their rates.
    pub armatures: Vec<(Ident, Expression)>,
    pub definitions: Vec<Definition>,
    /// Coordinates that are held or driven, each with its value.
    pub locks: Vec<Definition>,
    /// Coordinates that joints of a file would have, which are held where it is read.
    pub locked_in_file: Vec<Ident>,
    /// Coordinates that were driven, in the order of the clauses.
    pub driven: Vec<Ident>,
    pub attractions: Vec<ForceClause>,
    pub medium: Option<(Ident, Option<Expression>)>,
    /// Mass data of the body without a name, and gravity.
    pub role_clauses: Vec<RoleClause>,
    pub functions: Vec<UserFunction>,
    /// Bodies whose moments need not obey the triangle inequality; `None`: all.
    pub formal: Vec<Option<Ident>>,
    /// `damping = …` is written.
    damped: bool,
    /// Some clause could not be read. Then nothing is refused as missing, because the unread clause may declare it.
    pub missed: bool,
    /// The kinds of the clauses that could not be read.
    unread: Vec<Statement>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Statement {
    Coordinates,
    Speeds,
    Kinematics,
    Body,
    Frame,
    Particle,
    Point,
    Constraint,
    Contact,
    Range,
    DryFriction,
    Independent,
    Redundant,
    Potential,
    Input,
    States,
    /// A force element.
    Element(&'static Row),
    Limit,
    Armature,
    Lock,
    Modes,
    Define,
    Medium,
    CentralGravity,
    Waive,
    Function,
    Table,
}

/// The clauses of systems, but for those of force elements: these stand between the two.
const DECLARED: [(&str, Statement); 16] = [
    ("coordinates", Statement::Coordinates),
    ("speeds", Statement::Speeds),
    ("kinematics", Statement::Kinematics),
    ("body", Statement::Body),
    ("frame", Statement::Frame),
    ("particle", Statement::Particle),
    ("point", Statement::Point),
    ("constraint", Statement::Constraint),
    ("contact", Statement::Contact),
    ("range", Statement::Range),
    ("dry_friction", Statement::DryFriction),
    ("independent", Statement::Independent),
    ("redundant", Statement::Redundant),
    ("potential", Statement::Potential),
    ("input", Statement::Input),
    ("states", Statement::States),
];
const OTHERS: [(&str, Statement); 10] = [
    ("armature", Statement::Armature),
    ("lock", Statement::Lock),
    ("modes", Statement::Modes),
    ("medium", Statement::Medium),
    (ATTRACTION.word, Statement::CentralGravity),
    ("define", Statement::Define),
    ("function", Statement::Function),
    ("table", Statement::Table),
    ("waive", Statement::Waive),
    ("limit", Statement::Limit),
];
const COUNT: usize = DECLARED.len() + ELEMENTS.len() + OTHERS.len();

/// The clauses of systems.
pub static STATEMENTS: &Table<Statement> = &statements();

const fn statements() -> [(&'static str, Statement); COUNT] {
    let mut all = [("", Statement::Limit); COUNT];
    let mut k = 0;
    while k < COUNT {
        let of_element = k.wrapping_sub(DECLARED.len());
        all[k] = if k < DECLARED.len() {
            DECLARED[k]
        } else if of_element < ELEMENTS.len() {
            (ELEMENTS[of_element].word, Statement::Element(ELEMENTS[of_element]))
        } else {
            OTHERS[of_element - ELEMENTS.len()]
        };
        k += 1;
    }
    all
}

const CONSTRAINT: &Table<ConstraintLevel> =
    &[("position", ConstraintLevel::Position), ("velocity", ConstraintLevel::Velocity)];

/// The clause that `word` is, or that it is a misspelling of.
pub fn meant(word: &str) -> Option<Statement> {
    words::nearest(word, STATEMENTS).map(|(_, statement)| statement)
}

/// Form in which the clause `word` is written, if it is one of these.
pub fn form(word: &str) -> Option<String> {
    STATEMENTS.iter().find(|(name, _)| *name == word).map(|(_, statement)| match statement {
        Statement::Potential | Statement::Limit => format!("{word} = …"),
        Statement::Element(row) if row.form == ClauseForm::Value => format!("{word} = …"),
        Statement::Redundant => word.to_owned(),
        _ => format!("{word}(…)"),
    })
}

impl Statement {
    /// Whether the clause declares a moving part: a struct with such a clause is a system. The other clauses add to a
    /// system or to the one body of a chart, so they decide nothing.
    pub fn makes_system(self) -> bool {
        matches!(
            self,
            Statement::Coordinates
                | Statement::Speeds
                | Statement::Kinematics
                | Statement::Body
                | Statement::Frame
                | Statement::Particle
                | Statement::Constraint
                | Statement::Independent
                | Statement::Redundant
        )
    }
}

impl Statements {
    /// Mass data in clauses: of the struct, then of the bodies.
    pub fn all_role_clauses(&self) -> impl Iterator<Item = &RoleClause> {
        self.role_clauses.iter().chain(self.bodies.iter().flat_map(|body| &body.role_clauses))
    }

    /// None so far.
    pub fn new(in_chart: bool, has_coordinates: bool) -> Statements {
        Statements { in_chart, has_coordinates, ..Statements::default() }
    }

    /// Reads a clause whose name is in [`STATEMENTS`].
    pub fn read(&mut self, clause: &Clause, context: &mut Context) {
        self.first.get_or_insert_with(|| clause.name.clone());
        let Some(statement) = meant(&clause.word()) else { return };
        self.refuse_twice(statement, clause, context);
        match statement {
            Statement::Coordinates
            | Statement::Speeds
            | Statement::Kinematics
            | Statement::Independent
            | Statement::Input
            | Statement::States
            | Statement::Define
            | Statement::Lock
            | Statement::Function
            | Statement::Table
            | Statement::Waive
            | Statement::Limit => self.read_declaration(statement, clause, context),
            Statement::Body
            | Statement::Frame
            | Statement::Particle
            | Statement::Point
            | Statement::Constraint
            | Statement::Contact
            | Statement::Range
            | Statement::DryFriction => self.read_placement(statement, clause, context),
            Statement::Element(row) => self.read_element(row, clause, context),
            Statement::Redundant => self.read_redundant(clause, context),
            Statement::Armature => self.read_armature(clause, context),
            Statement::Modes => self.read_modes(clause, context),
            Statement::Potential => {
                let value = value(clause, "k * x * x / 2", context);
                self.potential = self.potential.take().or(Some((clause.name.clone(), value)));
            }
            Statement::Medium => {
                let velocity = actions::read_medium(clause, context);
                self.medium = self.medium.take().or(Some((clause.name.clone(), velocity)));
            }
            Statement::CentralGravity => {
                self.attractions.extend(actions::read(&ATTRACTION, clause, self.in_chart, context));
            }
        }
    }

    /// Refuses a second clause of a kind that can be written once.
    fn refuse_twice(&self, statement: Statement, clause: &Clause, context: &mut Context) {
        let written = match statement {
            Statement::Coordinates => self.coordinates.is_some(),
            Statement::Speeds => self.speeds.is_some(),
            Statement::Kinematics => self.kinematics.is_some(),
            Statement::Independent => self.independent.is_some(),
            Statement::Redundant => self.redundant.is_some(),
            Statement::Potential => self.potential.is_some(),
            Statement::Limit => self.limit.is_some(),
            Statement::Input => self.inputs.is_some(),
            Statement::Element(row) => row.form == ClauseForm::Value && self.damped,
            Statement::Medium => self.medium.is_some(),
            _ => false,
        };
        if written {
            let name = &clause.name;
            let remedy = match statement {
                Statement::Potential | Statement::Element(_) => "write the sum of the two in one",
                Statement::Limit | Statement::Medium | Statement::Redundant => "keep one of the two",
                _ => "write all of it in one",
            };
            context.error(name.span(), format!("`{name}` is given twice; {remedy}"));
        }
    }

    /// Reads names with their meanings; where a name is given twice, the first counts.
    fn read_declaration(&mut self, statement: Statement, clause: &Clause, context: &mut Context) {
        match statement {
            Statement::Coordinates => {
                let names = declarations::read_coordinates(clause, context);
                self.coordinates = self.coordinates.take().or(Some(names));
            }
            Statement::Speeds => {
                let names = declarations::read_speeds(clause, context);
                self.speeds = self.speeds.take().or(Some(names));
            }
            Statement::Kinematics => {
                let kinematics = declarations::read_kinematics(clause, context);
                self.kinematics = self.kinematics.take().or(Some(kinematics));
            }
            Statement::Independent => {
                let names = declarations::read_independent(clause, context);
                self.independent = self.independent.take().or(Some(names));
            }
            Statement::Input => {
                let names = declarations::read_inputs(clause, context);
                self.inputs = self.inputs.take().or(Some(names));
            }
            Statement::States => {
                let (states, complete) = declarations::read_states(clause, context);
                self.note_read(complete, statement);
                self.states.extend(states);
            }
            Statement::Define => {
                let definitions = declarations::read_definitions(clause, context);
                self.note_read(!definitions.is_empty(), statement);
                self.definitions.extend(definitions);
            }
            Statement::Lock => {
                let locks = declarations::read_locks(clause, context);
                self.note_read(!locks.is_empty(), statement);
                self.locks.extend(locks);
            }
            Statement::Waive => self.formal.extend(declarations::read_waived(clause, context)),
            Statement::Limit => {
                let limit = read_limit(clause, context);
                self.limit = self.limit.take().or(Some((clause.name.clone(), limit)));
            }
            _ => {
                let function = match statement {
                    Statement::Function => own_functions::read_function(clause, context),
                    _ => own_functions::read_table(clause, context),
                };
                self.note_read(function.is_some(), statement);
                self.functions.extend(function);
            }
        }
    }

    /// `motion(x = f)`: the word stands for the motion of a chart as well, `motion = free`.
    pub fn read_motion(&mut self, clause: &Clause, context: &mut Context) {
        self.first.get_or_insert_with(|| clause.name.clone());
        let motions = declarations::read_motions(clause, context);
        self.note_read(!motions.is_empty(), Statement::Define);
        self.locks.extend(motions);
    }

    /// Bodies, particles, points, what constrains them and what they touch.
    fn read_placement(&mut self, statement: Statement, clause: &Clause, context: &mut Context) {
        let read = match statement {
            Statement::Body => match placements::read_body(clause, false, context) {
                Some(body) => {
                    self.add_body(body, context);
                    true
                }
                None => false,
            },
            Statement::Frame => add(&mut self.bodies, placements::read_body(clause, true, context)),
            Statement::Particle => add(&mut self.particles, placements::read_particle(clause, context)),
            Statement::Point => add(&mut self.points, placements::read_point(clause, self.in_chart, context)),
            Statement::Contact => add(&mut self.contacts, contacts::read_contact(clause, context)),
            Statement::Range => add(&mut self.contacts, contacts::read_range(clause, context)),
            Statement::DryFriction => add(&mut self.contacts, contacts::read_dry_friction(clause, context)),
            _ => add(&mut self.constraints, read_constraint(clause, context)),
        };
        self.note_read(read, statement);
    }

    fn add_body(&mut self, mut body: BodyClause, context: &mut Context) {
        if self.in_chart && body.name.is_none() {
            context.error(
                body.span,
                "the body without a name moves in the chart, which gives its place; give another body a name, \
                 `body(name, …)`, write mass data as clauses of the struct, or remove `chart` and `motion`",
            );
            return;
        }
        // Of the only body there is one set of mass data, wherever they are written.
        if body.name.is_none() {
            for clause in body.role_clauses.drain(..) {
                role_clauses::add(clause, &mut self.role_clauses, context);
            }
        }
        self.bodies.push(body);
    }

    /// A force element.
    fn read_element(&mut self, row: &'static Row, clause: &Clause, context: &mut Context) {
        if row.form == ClauseForm::Rates && self.has_no_names() {
            context.error(
                clause.name.span(),
                "`drive` acts on rates of named coordinates, and those of a chart have no names; write `force(…)` or \
                 `torque(…)`, or `coordinates(…)` of what else moves",
            );
            return;
        }
        self.damped |= row.form == ClauseForm::Value;
        self.forces.extend(actions::read(row, clause, self.in_chart, context));
    }

    fn read_armature(&mut self, clause: &Clause, context: &mut Context) {
        if self.has_no_names() {
            context.error(
                clause.name.span(),
                "an armature turns with a named coordinate, and those of a chart have no names; write \
                 `coordinates(…)` of what else moves",
            );
            return;
        }
        self.armatures.extend(actions::read_armature(clause, context));
    }

    fn read_modes(&mut self, clause: &Clause, context: &mut Context) {
        let read = modes::read(clause, context);
        self.note_read(read.is_some(), Statement::Modes);
        self.modes.extend(read);
    }

    /// The coordinates of modes.
    pub fn modal_coordinates(&self) -> impl Iterator<Item = &Ident> {
        self.modes.iter().flat_map(|read| &read.clause.coordinates)
    }

    /// `redundant`, a word alone.
    fn read_redundant(&mut self, clause: &Clause, context: &mut Context) {
        if !matches!(clause.value, Content::Absent) {
            context.error(
                clause.name.span(),
                "`redundant` is a word alone, and of all constraints; write `redundant` without a value",
            );
        }
        self.redundant.get_or_insert_with(|| clause.name.clone());
    }

    /// All coordinates are those of a chart.
    fn has_no_names(&self) -> bool {
        self.in_chart && !self.has_coordinates
    }

    /// Takes note of a clause that could not be read.
    fn note_read(&mut self, read: bool, statement: Statement) {
        if !read {
            self.unread.push(statement);
        }
    }

    /// Takes note of a clause that is refused.
    pub fn miss(&mut self, clause: &Clause) {
        self.missed = true;
        self.first.get_or_insert_with(|| clause.name.clone());
    }

    /// Whether some clause of one of these kinds could not be read: what is unknown may be what it names.
    pub fn missed_any(&self, statements: &[Statement]) -> bool {
        self.missed || self.unread.iter().any(|unread| statements.contains(unread))
    }

    /// Whether nothing is declared besides the chart: no moving part, no force and no mass data.
    pub fn is_empty(&self) -> bool {
        self.first.is_none() && self.role_clauses.is_empty()
    }

    /// The bodies that have mass.
    pub fn massive(&self) -> impl Iterator<Item = &BodyClause> {
        self.bodies.iter().filter(|body| !body.massless)
    }

    /// The bodies without mass.
    pub fn frames(&self) -> impl Iterator<Item = &Ident> {
        self.bodies.iter().filter(|body| body.massless).filter_map(|body| body.name.as_ref())
    }

    /// The point that `at` names, if it is one of `body` itself: its place in the body is known.
    pub fn own_point(&self, body: &Ident, at: &Expression) -> Option<&PointClause> {
        let ExpressionKind::Name(name) = &at.kind else { return None };
        self.points.iter().find(|point| same(&point.name, name) && same(&point.body, body))
    }

    /// Some body has no name.
    pub fn has_unnamed_body(&self) -> bool {
        self.bodies.iter().any(|body| body.name.is_none())
    }
}

/// Whether there is something to add.
fn add<T>(list: &mut Vec<T>, read: Option<T>) -> bool {
    let earlier = list.len();
    list.extend(read);
    list.len() > earlier
}

/// `None` if something is missing or wrong, which is noted. Whether the expression is a vector is not known yet.
fn read_constraint(clause: &Clause, context: &mut Context) -> Option<ConstraintClause> {
    let group = brackets(clause, "velocity = …", context)?;
    if let Some(expression) = bare_expression(group) {
        let written = attributes::written(&expression);
        context.error(
            expression.first().map_or(clause.name.span(), attributes::start),
            format!(
                "a constraint is one of positions or of velocities; write `constraint(position = {written})` or \
                 `constraint(velocity = {written})`"
            ),
        );
        return None;
    }
    let (arguments, _) = arguments::arguments(group, Owner::Constraint, context);
    let (mut read, mut several) = (None, false);
    for argument in &arguments {
        let name = &argument.name;
        if matches!(argument.value, Content::Absent) && words::nearest(&argument.word(), CONSTRAINT).is_none() {
            context.error(
                name.span(),
                format!(
                    "a constraint has no name: nothing refers to it; write `constraint(position = …)` or \
                     `constraint(velocity = …)` without `{name}`"
                ),
            );
            continue;
        }
        let Ok(kind) = words::resolve("argument of `constraint`:", name, CONSTRAINT, context) else { continue };
        if several {
            context.error(
                name.span(),
                format!("a clause has one constraint; write `constraint({name} = …)` in a clause of its own"),
            );
        }
        several = true;
        let example = match kind {
            ConstraintLevel::Position => "x - l",
            ConstraintLevel::Velocity => "v - r * w",
        };
        let Some(expression) = value(argument, example, context) else { continue };
        read =
            read.or(Some(ConstraintClause { kind, expression, vector: false, place: None, span: clause.name.span() }));
    }
    read
}

/// Tokens in the brackets of a constraint, if they are an expression without a word for what is constrained.
fn bare_expression(group: &Group) -> Option<Vec<TokenTree>> {
    let pieces = attributes::pieces(group.stream(), "", &mut Context::default());
    let [piece] = pieces.as_slice() else { return None };
    let argument = match piece.as_slice() {
        [TokenTree::Ident(_), TokenTree::Punct(equals), ..] if equals.as_char() == '=' => true,
        [TokenTree::Ident(word), ..] => words::nearest(&word.to_string(), CONSTRAINT).is_some(),
        _ => false,
    };
    (!argument).then(|| piece.clone())
}

/// A positive integer.
fn read_limit(clause: &Clause, context: &mut Context) -> Option<usize> {
    let tokens = attributes::flat(equals(clause, "50000", context)?.iter().cloned().collect());
    let number = match tokens.as_slice() {
        [TokenTree::Literal(literal)] => syn::parse_str::<LitInt>(&literal.to_string())
            .ok()
            .filter(|number| matches!(number.suffix(), "" | "usize"))
            .and_then(|number| number.base10_parse::<usize>().ok())
            .filter(|&number| number > 0),
        _ => None,
    };
    if number.is_none() {
        context.error(
            tokens.first().map_or(clause.name.span(), attributes::start),
            format!(
                "`limit` is the most operations that the generated code may have, a positive integer, found `{}`; \
                 write `limit = 50000`",
                attributes::written(&tokens)
            ),
        );
    }
    number
}
