//! Scenes that are written in Rust rather than in attributes: for tools that read a file or ask a user.
//!
//! A [`Scene`] holds the clauses of `#[gauss(…)]` and the fields of a struct, with the same words; it becomes that
//! struct ([`Scene::source`]), which is read as any other. So a `Scene` can have every clause of the language, and is
//! refused for the same mistakes; a mistake has the name of its clause where an attribute would be underlined.
//!
//! ```
//! use gauss_codegen::{Clause, Derivation, Field, Notation, Scene};
//!
//! let pendulum = Scene::new("Pendulum")
//!     .coordinates(["angle"])
//!     .clause(
//!         Clause::new("body")
//!             .name("rod")
//!             .with("position", ["l * sin(angle)", "0", "-l * cos(angle)"])
//!             .with("rotation", "rotation_y(angle)"),
//!     )
//!     .clause(Clause::new("spring").with("along", "angle").with("stiffness", 2.5).with("length", "pi / 6"))
//!     .field(Field::new("rod", "RigidBody<f64>").role("body"))
//!     .field(Field::new("g", "f64").role("gravity"))
//!     .field(Field::new("l", "f64"));
//! let derived = Derivation::of_scene(&pendulum).expect("a scene without mistakes");
//! assert!(derived.equations(Notation::Text).contains("angle"));
//!
//! let mistakes = Derivation::of_scene(&pendulum.potential("k * angle")).expect_err("k is nowhere");
//! assert_eq!(mistakes[0].clause, "potential");
//! ```

use std::fmt;
use std::str::FromStr;

use proc_macro2::{TokenStream, TokenTree};

/// A scene in the words of the language: clauses and fields, in the order in which they are added.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    name: String,
    generics: String,
    clauses: Vec<Clause>,
    fields: Vec<Field>,
}

/// A clause of the struct: `name`, `name = value`, or `name(…)` with arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    word: String,
    content: Content,
}

#[derive(Clone, Debug, PartialEq)]
enum Content {
    Nothing,
    Value(Value),
    Arguments(Vec<(Option<String>, Value)>),
}

/// An expression: as text, as a number, or as a list of expressions in square brackets.
#[derive(Clone, Debug, PartialEq)]
pub struct Value(String);

/// A field of the struct, a parameter: its type, what it is to the body, and its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    name: String,
    ty: String,
    roles: Vec<String>,
    documentation: String,
}

/// A mistake in a scene, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The clause as it begins, `body(rod, …)`; the name of a field; the name of the scene where it is of the whole.
    pub clause: String,
    /// The mistake, with the remedy.
    pub message: String,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.clause, self.message)
    }
}

impl std::error::Error for Mistake {}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<f64> for Value {
    /// All of its digits. What is not finite is refused with the scene.
    fn from(number: f64) -> Self {
        Self(format!("{number:?}"))
    }
}

impl From<i64> for Value {
    fn from(number: i64) -> Self {
        Self(number.to_string())
    }
}

impl<V: Into<Value>, const N: usize> From<[V; N]> for Value {
    fn from(components: [V; N]) -> Self {
        let components: Vec<String> = components.into_iter().map(|component| component.into().0).collect();
        Self(format!("[{}]", components.join(", ")))
    }
}

impl Clause {
    /// A clause by its word: `body`, `force`, `linearize`.
    pub fn new(word: impl Into<String>) -> Self {
        Self { word: word.into(), content: Content::Nothing }
    }

    /// `word = value`.
    pub fn equals(word: impl Into<String>, value: impl Into<Value>) -> Self {
        Self { word: word.into(), content: Content::Value(value.into()) }
    }

    /// A further argument without a word before it: the name of a body, a coordinate.
    #[must_use]
    pub fn name(self, name: impl Into<Value>) -> Self {
        self.argument(None, name.into())
    }

    /// A further argument `word = value`.
    #[must_use]
    pub fn with(self, word: impl Into<String>, value: impl Into<Value>) -> Self {
        self.argument(Some(word.into()), value.into())
    }

    fn argument(mut self, word: Option<String>, value: Value) -> Self {
        match &mut self.content {
            Content::Arguments(arguments) => arguments.push((word, value)),
            Content::Nothing | Content::Value(_) => self.content = Content::Arguments(vec![(word, value)]),
        }
        self
    }

    /// The word, and what tells it from others of its kind.
    fn label(&self) -> String {
        match &self.content {
            Content::Arguments(arguments) => match arguments.as_slice() {
                [(None, Value(name)), ..] if arguments.len() > 1 => format!("{}({name}, …)", self.word),
                [(None, Value(name))] => format!("{}({name})", self.word),
                _ => format!("{}(…)", self.word),
            },
            Content::Nothing | Content::Value(_) => self.word.clone(),
        }
    }

    /// The texts that must each be one piece between commas.
    fn pieces(&self) -> Vec<&str> {
        match &self.content {
            Content::Nothing => vec![&self.word],
            Content::Value(value) => vec![&self.word, &value.0],
            Content::Arguments(arguments) => {
                let words = arguments.iter().flat_map(|(word, value)| word.iter().chain([&value.0]));
                std::iter::once(&self.word).chain(words).map(String::as_str).collect()
            }
        }
    }
}

impl fmt::Display for Clause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.content {
            Content::Nothing => f.write_str(&self.word),
            Content::Value(Value(value)) => write!(f, "{} = {value}", self.word),
            Content::Arguments(arguments) => {
                let written = arguments.iter().map(|(word, Value(value))| match word {
                    Some(word) => format!("{word} = {value}"),
                    None => value.clone(),
                });
                write!(f, "{}({})", self.word, written.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

impl Field {
    /// A field with its type, as in Rust: `f64`, `Vector3<f64>`, `RigidBody<f64>`.
    pub fn new(name: impl Into<String>, ty: impl Into<String>) -> Self {
        Self { name: name.into(), ty: ty.into(), roles: Vec::new(), documentation: String::new() }
    }

    /// Adds a role: `mass`, `body`, `inertia = principal`.
    #[must_use]
    pub fn role(mut self, role: impl Into<String>) -> Self {
        self.roles.push(role.into());
        self
    }

    /// Its unit, `N` or `kg m^2`: dimensions are then checked.
    #[must_use]
    pub fn unit(self, unit: &str) -> Self {
        self.role(format!("unit = {unit:?}"))
    }

    /// Sets the words of the equations about it.
    #[must_use]
    pub fn documentation(mut self, text: impl Into<String>) -> Self {
        self.documentation = text.into();
        self
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.documentation.is_empty() {
            write!(f, "#[doc = {:?}] ", self.documentation)?;
        }
        self.roles.iter().try_for_each(|role| write!(f, "#[gauss({role})] "))?;
        write!(f, "{}: {}", self.name, self.ty)
    }
}

impl Scene {
    /// A scene without anything in it yet; its kernel is called `NameKernel`.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), generics: String::new(), clauses: Vec::new(), fields: Vec::new() }
    }

    /// Its fields have the type parameter of this name for their scalar.
    #[must_use]
    pub fn generic(mut self, parameter: &str) -> Self {
        self.generics = format!("<{parameter}>");
        self
    }

    /// One more clause.
    #[must_use]
    pub fn clause(mut self, clause: Clause) -> Self {
        self.clauses.push(clause);
        self
    }

    /// One more field.
    #[must_use]
    pub fn field(mut self, field: Field) -> Self {
        self.fields.push(field);
        self
    }

    fn list(self, word: &str, names: impl IntoIterator<Item = impl Into<Value>>) -> Self {
        self.clause(names.into_iter().fold(Clause::new(word), Clause::name))
    }

    /// `coordinates(x, turn: Rotation)`.
    #[must_use]
    pub fn coordinates(self, names: impl IntoIterator<Item = impl Into<Value>>) -> Self {
        self.list("coordinates", names)
    }

    /// `speeds(v, w: Vector3)`.
    #[must_use]
    pub fn speeds(self, names: impl IntoIterator<Item = impl Into<Value>>) -> Self {
        self.list("speeds", names)
    }

    /// `kinematics(x = v * cos(a), …)`: the rate of each coordinate.
    #[must_use]
    pub fn kinematics<W: Into<String>, V: Into<Value>>(self, rates: impl IntoIterator<Item = (W, V)>) -> Self {
        let clause = rates.into_iter().fold(Clause::new("kinematics"), |clause, (name, rate)| clause.with(name, rate));
        self.clause(clause)
    }

    /// `states(amps = (volts - r * amps) / l, …)`: states of elements, each with its rate.
    #[must_use]
    pub fn states<W: Into<String>, V: Into<Value>>(self, rates: impl IntoIterator<Item = (W, V)>) -> Self {
        let clause = rates.into_iter().fold(Clause::new("states"), |clause, (name, rate)| clause.with(name, rate));
        self.clause(clause)
    }

    /// `input(thrust, rudder)`: values that arrive at run time.
    #[must_use]
    pub fn inputs(self, names: impl IntoIterator<Item = impl Into<Value>>) -> Self {
        self.list("input", names)
    }

    /// `chart = hybrid`: the body without a name moves in a chart.
    #[must_use]
    pub fn chart(self, chart: impl Into<Value>) -> Self {
        self.clause(Clause::equals("chart", chart))
    }

    /// `motion = planar`.
    #[must_use]
    pub fn motion(self, motion: impl Into<Value>) -> Self {
        self.clause(Clause::equals("motion", motion))
    }

    /// `particle(mass = …, position = […])`.
    #[must_use]
    pub fn particle(self, mass: impl Into<Value>, position: impl Into<Value>) -> Self {
        self.clause(Clause::new("particle").with("mass", mass).with("position", position))
    }

    /// `potential = …`, besides that of gravity.
    #[must_use]
    pub fn potential(self, potential: impl Into<Value>) -> Self {
        self.clause(Clause::equals("potential", potential))
    }

    /// The derivatives of the equations by state, time and input.
    #[must_use]
    pub fn linearize(self) -> Self {
        self.clause(Clause::new("linearize"))
    }

    /// The struct with the same clauses and fields in Rust, each on a line.
    pub fn source(&self) -> String {
        self.lines().into_iter().map(|(_, line)| line + "\n").collect()
    }

    /// The lines of the struct, each with what it is called in messages.
    fn lines(&self) -> Vec<(String, String)> {
        let whole = |line: String| (self.name.clone(), line);
        let mut lines = Vec::new();
        if !self.clauses.is_empty() {
            lines.push(whole("#[gauss(".to_owned()));
            lines.extend(self.clauses.iter().map(|clause| (clause.label(), format!("    {},", one_line(clause)))));
            lines.push(whole(")]".to_owned()));
        }
        lines.push(whole(format!("struct {}{} {{", self.name, self.generics)));
        lines.extend(self.fields.iter().map(|field| (field.name.clone(), format!("    {},", one_line(field)))));
        lines.push(whole("}".to_owned()));
        lines
    }

    /// The struct, read: every piece of text must stand for itself.
    pub(crate) fn item(&self) -> Result<syn::DeriveInput, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        let wrong =
            |clause: &str, text: &str| wrong_text(text).map(|message| Mistake { clause: clause.to_owned(), message });
        mistakes.extend(wrong(&self.name, &self.name));
        for clause in &self.clauses {
            mistakes.extend(clause.pieces().into_iter().filter_map(|text| wrong(&clause.label(), text)));
        }
        for field in &self.fields {
            let texts = std::iter::once(&field.name).chain(&field.roles);
            mistakes.extend(texts.filter_map(|text| wrong(&field.name, text)));
            if syn::parse_str::<syn::Type>(&field.ty).is_err() {
                let message = format!("`{}` is no type; write `f64` or `Vector3<f64>`", field.ty);
                mistakes.push(Mistake { clause: field.name.clone(), message });
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        TokenStream::from_str(&self.source())
            .map_err(syn::Error::from)
            .and_then(crate::model::item)
            .map_err(|error| self.located(&error))
    }

    /// The mistakes of the struct, each with the clause whose line it is on.
    pub(crate) fn located(&self, mistakes: &syn::Error) -> Vec<Mistake> {
        let lines = self.lines();
        let line = |error: &syn::Error| error.span().start().line.saturating_sub(1);
        let mistake = |error: syn::Error| {
            let line = line(&error);
            let clause = lines.get(line).map_or_else(|| self.name.clone(), |(label, _)| label.clone());
            Mistake { clause, message: error.to_string() }
        };
        let mut mistakes: Vec<syn::Error> = mistakes.clone().into_iter().collect();
        mistakes.sort_by_key(line);
        mistakes.into_iter().map(mistake).collect()
    }
}

/// Text of the user's may have line breaks.
fn one_line(text: &impl fmt::Display) -> String {
    text.to_string().replace(['\n', '\r'], " ")
}

/// Mistake of a text that is more or less than one piece between commas.
fn wrong_text(text: &str) -> Option<String> {
    let Ok(tokens) = TokenStream::from_str(text) else {
        return Some(format!(
            "`{text}` is no Rust: a bracket or a quote is missing, or a character is none of its own"
        ));
    };
    if text.contains("//") || text.contains("/*") {
        return Some(format!("`{text}` has a comment; remove it"));
    }
    let comma = |token: TokenTree| matches!(token, TokenTree::Punct(comma) if comma.as_char() == ',');
    if tokens.is_empty() {
        return Some("a text is empty; write a name or an expression".to_owned());
    }
    tokens.into_iter().any(comma).then(|| format!("`{text}` has a comma; write one expression, or `[…]` of several"))
}
