//! The clauses of the struct that choose a chart and methods. Clauses of motion and forces are read by `statements`.
//!
//! `chart = left_invariant | right_invariant | hybrid | jet(…) | jet`, by default `left_invariant`;
//! `motion = free | fixed_point | planar`, by default `free`; `crate = path`, by default `::gauss_runtime`; `taylor`,
//! `regressor` and `python` alone; `linearize` alone or as `linearize(word, …)`; `frames(name, …)`;
//! `reactions(name, …)`; `methods(word, …)`.

use super::arguments::UNIT;
use super::attributes::{self, Clause, Content, Owner, Word};
use super::context::Context;
use super::declarations::{self, METHODS};
use super::robots::{self, FILES, RobotClauses};
use super::role_clauses;
use super::role_words::ROLES;
use super::statements::{self, STATEMENTS, Statement, Statements};
use super::synonyms;
use super::words::{self, Table};
use crate::terms::{BodyChart, Chart, KernelOptions, Motion, OptionalMethod, RotationChart};
use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::Parser;
use syn::{Attribute, Path, PathSegment};

/// The contents of the clauses of the struct.
pub struct Clauses {
    /// The chart of the body without a name, unless the scene has coordinates of its own only.
    pub in_chart: Option<BodyChart>,
    pub runtime: Path,
    /// The methods and derivatives to generate besides the equations.
    pub wanted: KernelOptions,
    /// Coordinates, bodies and forces.
    pub statements: Statements,
    /// Some clause declares a moving part besides the body of a chart.
    pub own: bool,
    /// The clause that names a robot's file, and the clauses made from the file.
    pub robot: RobotClauses,
}

/// Clauses of the struct.
pub const CLAUSES: &Table<Topic> = &[
    ("chart", Topic::Chart),
    ("motion", Topic::Motion),
    ("crate", Topic::Runtime),
    ("taylor", Topic::Taylor),
    ("linearize", Topic::Linearize),
    ("regressor", Topic::Regressor),
    ("frames", Topic::Frames),
    ("reactions", Topic::Reactions),
    ("methods", Topic::Methods),
    ("python", Topic::Python),
];

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    Chart,
    Motion,
    Runtime,
    Taylor,
    Linearize,
    Regressor,
    Frames,
    Reactions,
    Methods,
    Python,
}

/// `None` stands for `jet`, which needs to know the motion.
const CHARTS: &Table<Option<Chart>> = &[
    ("left_invariant", Some(Chart::LeftInvariant)),
    ("right_invariant", Some(Chart::RightInvariant)),
    ("hybrid", Some(Chart::Hybrid)),
    ("jet", None),
];

const MOTIONS: &Table<Motion> =
    &[("free", Motion::Free), ("fixed_point", Motion::FixedPoint), ("planar", Motion::Planar)];

const ROTATIONS: &Table<RotationChart> = &[
    ("euler_zyx", RotationChart::Euler([2, 1, 0])),
    ("euler_zxz", RotationChart::Euler([2, 0, 2])),
    ("euler_zyz", RotationChart::Euler([2, 1, 2])),
    ("euler_xyz", RotationChart::Euler([0, 1, 2])),
    ("euler_xzy", RotationChart::Euler([0, 2, 1])),
    ("euler_yxz", RotationChart::Euler([1, 0, 2])),
    ("euler_yzx", RotationChart::Euler([1, 2, 0])),
    ("euler_zxy", RotationChart::Euler([2, 0, 1])),
    ("euler_xyx", RotationChart::Euler([0, 1, 0])),
    ("euler_xzx", RotationChart::Euler([0, 2, 0])),
    ("euler_yxy", RotationChart::Euler([1, 0, 1])),
    ("euler_yzy", RotationChart::Euler([1, 2, 1])),
    ("rodrigues", RotationChart::Rodrigues),
    ("modified_rodrigues", RotationChart::ModifiedRodrigues),
];

/// A chart as written, before the motion is known.
enum ChartSyntax {
    Known(Chart),
    /// `jet`, with the word in its brackets if there are brackets.
    Jet {
        jet: Ident,
        argument: Option<Ident>,
    },
}

/// Reads the attributes of the struct. A body without a name moves in a chart where `chart` or `motion` is written, and
/// where neither a clause nor a field (`has_body`) declares a moving part.
pub fn read(attributes: &[Attribute], has_body: bool, context: &mut Context) -> Clauses {
    let clauses = attributes::clauses(attributes, Owner::Struct, context);
    // A clause of its own is no misspelling of another: `frames` is not `frame`.
    let own_word = |word: &str| CLAUSES.iter().any(|(name, _)| *name == word);
    let meant = |clause: &Clause| statements::meant(&clause.word()).filter(|_| !own_word(&clause.word()));
    let beside_file = clauses.iter().any(|clause| FILES.iter().any(|(file, _)| *file == clause.word()));
    let own = beside_file || clauses.iter().any(|clause| meant(clause).is_some_and(Statement::makes_system));
    let chooses_chart =
        |clause: &&Clause| clause.word() == "chart" || (clause.word() == "motion" && !is_driving(clause));
    let of_chart = clauses.iter().find(chooses_chart);
    let of_chart = of_chart.map(|clause| clause.name.clone()).filter(|_| own || has_body);
    let in_chart = of_chart.is_some() || !(own || has_body);
    let has_coordinates = clauses.iter().any(|clause| meant(clause) == Some(Statement::Coordinates));
    let mut statements = Statements::new(in_chart, has_coordinates);
    let mut topics = Topics::default();
    let mut robot = RobotClauses::default();
    for clause in clauses {
        let word = clause.word();
        if is_driving(&clause) {
            statements.read_motion(&clause, context);
        } else if STATEMENTS.iter().any(|(name, _)| *name == word) {
            statements.read(&clause, context);
        } else if let Some(role) = role_clauses::role(&word).filter(|_| !role_clauses::belongs_to_field(&clause)) {
            role_clauses::read(role, &clause, &mut statements.role_clauses, context);
        } else if let Some(topic) = robots::topic(&word, beside_file) {
            robot.read(topic, &clause, context);
        } else if let Some(&(_, topic)) = CLAUSES.iter().find(|(name, _)| *name == word) {
            topics.read(topic, &clause, context);
        } else {
            refuse(&clause, &word, beside_file, context);
            statements.miss(&clause);
        }
    }
    topics.check(context);
    let Topics { charts, motion, runtime, wanted, .. } = topics;
    // A clause left out means its default; a clause that could not be read is known to be unknown.
    let motion = motion.unwrap_or(Some(Motion::Free));
    let mut chart = None;
    for written in charts.into_iter().flatten() {
        let settled = settle(written, motion, context);
        chart = chart.or(settled);
    }
    let chart = chart.unwrap_or(Chart::LeftInvariant);
    let motion = motion.unwrap_or(Motion::Free);
    let in_chart = in_chart.then_some(BodyChart { chart, motion });
    statements.of_chart = of_chart;
    statements.speeds_of_chart = in_chart.map_or_else(Vec::new, BodyChart::speed_words);
    Clauses { in_chart, runtime: runtime.flatten().unwrap_or_else(default_runtime), wanted, statements, own, robot }
}

/// Whether a clause is `motion(x = f)`, of coordinates, and not `motion = free`, of a chart.
fn is_driving(clause: &Clause) -> bool {
    let Content::Brackets(group) = &clause.value else { return false };
    let inner = attributes::written(&attributes::flat(group.stream()));
    clause.word() == "motion" && !MOTIONS.iter().any(|(motion, _)| *motion == inner)
}

/// Contents of the clauses that stand once; `Some(None)` where one could not be read.
#[derive(Default)]
struct Topics {
    charts: Vec<Option<ChartSyntax>>,
    motion: Option<Option<Motion>>,
    runtime: Option<Option<Path>>,
    wanted: KernelOptions,
    /// The topics of clauses so far, each with the clause.
    first: Vec<(Topic, String)>,
    /// The place of `methods(…)`.
    methods: Option<Span>,
}

impl Topics {
    /// Reads a clause: of those given twice the first counts, but mistakes in the second are found all the same.
    fn read(&mut self, topic: Topic, clause: &Clause, context: &mut Context) {
        if let Some((_, earlier)) = self.first.iter().find(|(other, _)| *other == topic) {
            let message =
                format!("`{}` is given twice; it was given first as `{earlier}`: keep one of the two", clause.word());
            context.error(clause.name.span(), message);
        } else {
            self.first.push((topic, clause.written()));
        }
        match topic {
            Topic::Chart => self.charts.push(read_chart(clause, context)),
            Topic::Motion => {
                let motion = read_motion(clause, context);
                self.motion = self.motion.or(Some(motion));
            }
            Topic::Runtime => {
                let runtime = read_runtime(clause, context);
                self.runtime = self.runtime.take().or(Some(runtime));
            }
            Topic::Taylor => {
                self.wanted.taylor.get_or_insert(clause.name.clone());
                check_alone(clause, context);
            }
            Topic::Linearize => {
                self.wanted.linearize.get_or_insert(clause.name.clone());
                for further in read_linearize(clause, context) {
                    match further {
                        LinearizeOption::Parameters => self.wanted.by_parameters = true,
                        LinearizeOption::Inverse => self.wanted.inverse = true,
                        LinearizeOption::Hessian => self.wanted.hessian = true,
                        LinearizeOption::WithoutContacts => self.wanted.without_contacts = true,
                    }
                }
            }
            Topic::Regressor => {
                self.wanted.regressor.get_or_insert(clause.name.clone());
                check_alone(clause, context);
            }
            Topic::Python => {
                self.wanted.python.get_or_insert(clause.name.clone());
                check_alone(clause, context);
            }
            Topic::Frames => self.wanted.frames.extend(declarations::read_frames(clause, context)),
            Topic::Reactions => self.wanted.reactions.extend(declarations::read_reactions(clause, context)),
            Topic::Methods => {
                self.methods = Some(clause.name.span());
                self.wanted.methods.extend(declarations::read_methods(clause, context));
            }
        }
    }

    /// Refuses rates of Jacobians without `frames(…)`.
    fn check(&self, context: &mut Context) {
        let framed = self.first.iter().any(|(topic, _)| *topic == Topic::Frames);
        if let Some(span) =
            self.methods.filter(|_| !framed && self.wanted.methods.contains(&OptionalMethod::JacobianRates))
        {
            context.error(span, "`jacobian_rates` are those of the frames in `frames(…)`; add it with their names");
        }
    }
}

/// Notes why a clause is none of the struct's.
fn refuse(clause: &Clause, word: &str, beside_file: bool, context: &mut Context) {
    let span = clause.name.span();
    let message = if word == UNIT {
        "units are those of fields and inputs; write `#[gauss(unit = \"N\")]` on a field, or `input(thrust = \"N\")`"
            .into()
    } else if ROLES.iter().any(|(name, _)| *name == word) {
        format!(
            "`{word}` is the role of a field; write `#[gauss({word})]` on that field, or give it here: `{word} = …`"
        )
    } else if CHARTS.iter().any(|(name, _)| *name == word) {
        let chart = match &clause.value {
            Content::Brackets(_) => clause.written(),
            Content::Equals(tokens) if word == "jet" => {
                format!("jet({})", attributes::written(tokens))
            }
            _ => word.into(),
        };
        format!("`{word}` is a chart; write `chart = {chart}`")
    } else if MOTIONS.iter().any(|(name, _)| *name == word) {
        format!("`{word}` is a motion; write `motion = {word}`")
    } else if ROTATIONS.iter().any(|(name, _)| *name == word) {
        format!("`{word}` is a rotation chart; write `chart = jet({word})`")
    } else if METHODS.iter().any(|(name, _)| *name == word) {
        format!("`{word}` is a method of the kernel; write `methods({word})`")
    } else if let Some(remedy) = [synonyms::FOR_CLAUSES, synonyms::LAWS].iter().find_map(|t| synonyms::instead(word, t))
    {
        format!("unknown clause `{word}`; {remedy}")
    } else if let Some(name) = words::nearest(word, CLAUSES).map(|(name, _)| name).or(robots::near(word, beside_file)) {
        format!("unknown clause `{word}`; did you mean `{name}`?")
    } else if let Some((name, _)) = words::nearest(word, STATEMENTS) {
        format!("unknown clause `{word}`; did you mean `{name}`?")
    } else {
        format!("unknown clause `{word}`; {}", all_clauses())
    };
    context.error(span, message);
}

/// List of the clauses of a struct, by their topics.
fn all_clauses() -> String {
    let names = |chosen: &dyn Fn(Statement) -> bool| {
        STATEMENTS.iter().filter(|(_, statement)| chosen(*statement)).map(|&(name, _)| (name, ())).collect::<Vec<_>>()
    };
    let topics = |chosen: &dyn Fn(Topic) -> bool| {
        CLAUSES.iter().filter(|(_, topic)| chosen(*topic)).map(|&(name, _)| (name, ())).collect::<Vec<_>>()
    };
    let of_motion = |topic| matches!(topic, Topic::Chart | Topic::Motion);
    let moves = [topics(&of_motion), names(&Statement::makes_system)].concat();
    let (acts, wanted) = (names(&|statement| !statement.makes_system()), topics(&|topic| !of_motion(topic)));
    let [moves, acts, wanted] = [moves, acts, wanted].map(|table| words::list(&table));
    format!("motion is declared by {moves}, forces and more by {acts}, and generated code is chosen by {wanted}")
}

fn read_chart(clause: &Clause, context: &mut Context) -> Option<ChartSyntax> {
    let Word { ident, arguments } = clause.bare_word(CHARTS, context)?;
    let chart = words::resolve("chart", &ident, CHARTS, context).ok()?;
    match (chart, arguments) {
        (Some(chart), None) => Some(ChartSyntax::Known(chart)),
        (Some(_), Some(arguments)) => {
            let name = &clause.name;
            context.error(
                arguments.span_open(),
                format!("the chart `{ident}` takes nothing in brackets; write `{name} = {ident}`"),
            );
            None
        }
        (None, None) => Some(ChartSyntax::Jet { jet: ident, argument: None }),
        (None, Some(arguments)) => {
            let argument = read_argument(&ident, &arguments, context)?;
            Some(ChartSyntax::Jet { jet: ident, argument: Some(argument) })
        }
    }
}

/// The one word in the brackets of `jet(…)`.
fn read_argument(jet: &Ident, arguments: &Group, context: &mut Context) -> Option<Ident> {
    let tokens = attributes::flat(arguments.stream());
    let (word, rest) = match tokens.split_first() {
        Some((TokenTree::Ident(word), rest)) => (word, rest),
        Some((other, _)) => {
            attributes::not_a_word(jet, None, other, ROTATIONS, context);
            return None;
        }
        None => {
            context.error(
                arguments.span_open(),
                "`jet()` has nothing in its brackets; write a rotation chart such as `jet(euler_zyx)`, or `jet` alone in planar motion",
            );
            return None;
        }
    };
    match rest.first() {
        None => Some(word.clone()),
        Some(TokenTree::Punct(comma)) if comma.as_char() == ',' && rest.len() == 1 => Some(word.clone()),
        Some(extra) => {
            context.error(
                attributes::start(extra),
                format!(
                    "`jet` takes one rotation chart, found {} after `{word}`; write one word, such as `jet(euler_zyx)`",
                    attributes::found(extra)
                ),
            );
            None
        }
    }
}

/// The chart in this motion; `motion` is `None` where it could not be read.
fn settle(written: ChartSyntax, motion: Option<Motion>, context: &mut Context) -> Option<Chart> {
    match (written, motion) {
        (ChartSyntax::Known(chart), _) => Some(chart),
        (ChartSyntax::Jet { argument: None, .. }, Some(Motion::Planar)) => Some(Chart::Jet(RotationChart::Angle)),
        (ChartSyntax::Jet { argument: None, .. }, None) => None,
        (ChartSyntax::Jet { jet, argument: None }, Some(_)) => {
            context.error(
                jet.span(),
                format!(
                    "`jet` needs a rotation chart unless the motion is planar; write `jet(…)` with {}",
                    words::list(ROTATIONS)
                ),
            );
            None
        }
        (ChartSyntax::Jet { argument: Some(argument), .. }, Some(Motion::Planar)) => {
            context.error(
                argument.span(),
                format!(
                    "`jet({argument})` contradicts `motion = planar`, where the body turns through one angle only; \
                     write `chart = jet`"
                ),
            );
            None
        }
        (ChartSyntax::Jet { argument: Some(argument), .. }, _) => read_rotation(&argument, context).map(Chart::Jet),
    }
}

fn read_rotation(ident: &Ident, context: &mut Context) -> Option<RotationChart> {
    let word = ident.unraw().to_string();
    // Two mistakes that edit distance cannot see: axes without `euler_`, and a sequence that repeats an axis.
    let axes = word.strip_prefix("euler_").unwrap_or(&word);
    if axes.len() == 3 && axes.chars().all(|axis| matches!(axis, 'x' | 'y' | 'z')) {
        let full = format!("euler_{axes}");
        let letters: Vec<char> = axes.chars().collect();
        if let Some(pair) = letters.windows(2).find(|pair| pair[0] == pair[1]) {
            context.error(
                ident.span(),
                format!(
                    "`{word}` turns about {} twice in a row, which is one turn; \
                     expected three axes with no two neighbours equal, such as `euler_zyx` or `euler_zxz`",
                    pair[0]
                ),
            );
            return None;
        }
        if full != word {
            context.error(ident.span(), format!("unknown rotation chart `{word}`; did you mean `{full}`?"));
            return None;
        }
    }
    words::resolve("rotation chart", ident, ROTATIONS, context).ok()
}

fn read_motion(clause: &Clause, context: &mut Context) -> Option<Motion> {
    let Word { ident, arguments } = clause.bare_word(MOTIONS, context)?;
    let motion = words::resolve("motion", &ident, MOTIONS, context).ok()?;
    if let Some(arguments) = arguments {
        let name = &clause.name;
        context.error(
            arguments.span_open(),
            format!("the motion `{ident}` takes nothing in brackets; write `{name} = {ident}`"),
        );
        return None;
    }
    Some(motion)
}

/// Refuses a value of a clause that is written as its name alone.
fn check_alone(clause: &Clause, context: &mut Context) {
    let name = &clause.name;
    let span = match &clause.value {
        Content::Absent | Content::Malformed => return,
        Content::Equals(tokens) => tokens.first().map_or(name.span(), attributes::start),
        Content::Brackets(group) => group.span_open(),
    };
    context.error(span, format!("`{name}` takes no value; write `{name}` alone, or leave it out"));
}

/// Options of `linearize` besides the derivatives by state, time and input, and of which equations.
#[derive(Clone, Copy, PartialEq)]
enum LinearizeOption {
    Parameters,
    Inverse,
    Hessian,
    WithoutContacts,
}

const FURTHER: &Table<LinearizeOption> = &[
    ("parameters", LinearizeOption::Parameters),
    ("inverse", LinearizeOption::Inverse),
    ("hessian", LinearizeOption::Hessian),
    ("without_contacts", LinearizeOption::WithoutContacts),
];

/// `linearize`, `linearize(parameters, inverse)`.
fn read_linearize(clause: &Clause, context: &mut Context) -> Vec<LinearizeOption> {
    match &clause.value {
        Content::Absent | Content::Malformed => Vec::new(),
        Content::Equals(tokens) => {
            context.error(
                tokens.first().map_or(clause.name.span(), attributes::start),
                "`linearize` takes no value after `=`; write `linearize` alone for the derivatives by state, time and \
                 input, and in brackets what else is wanted: `parameters` for those by the parameters, `inverse` for \
                 those of inverse dynamics, `hessian` for second ones along given weights",
            );
            Vec::new()
        }
        Content::Brackets(_) => declarations::read_words(clause, ["kind of derivative", "inverse"], FURTHER, context),
    }
}

fn read_runtime(clause: &Clause, context: &mut Context) -> Option<Path> {
    let tokens = match &clause.value {
        Content::Equals(tokens) => attributes::flat(tokens.iter().cloned().collect()),
        Content::Malformed => return None,
        Content::Absent | Content::Brackets(_) => {
            context.error(clause.name.span(), "`crate` needs the path to the runtime; write `crate = ::gauss_runtime`");
            return None;
        }
    };
    match Path::parse_mod_style.parse2(tokens.iter().cloned().collect::<TokenStream>()) {
        Ok(path) => Some(path),
        Err(_) => {
            let first = tokens.first()?;
            let remedy = match first {
                TokenTree::Literal(literal) => match syn::parse_str::<syn::LitStr>(&literal.to_string()) {
                    Ok(text) => format!("write `crate = {}` without quotes", text.value()),
                    Err(_) => "write `crate = ::gauss_runtime`".into(),
                },
                _ => "write `crate = ::gauss_runtime`".into(),
            };
            context.error(
                attributes::start(first),
                format!("`crate` takes the path to the runtime, found `{}`; {remedy}", attributes::written(&tokens)),
            );
            None
        }
    }
}

/// `::gauss_runtime`.
fn default_runtime() -> Path {
    let segment = PathSegment::from(Ident::new("gauss_runtime", Span::mixed_site()));
    Path { leading_colon: Some(syn::Token![::](Span::mixed_site())), segments: [segment].into_iter().collect() }
}
