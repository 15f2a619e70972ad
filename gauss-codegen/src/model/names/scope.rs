//! Meanings of the names in expressions.

use crate::model::language::functions::FUNCTIONS;
use crate::model::language::synonyms::{FOR_FUNCTIONS, instead};
use crate::model::language::words::{self, PI, TIME};
use crate::model::scene::clauses::{CoordinateKind, SpeedKind};
use crate::model::scene::expression::{Expression, Property};
use crate::terms::InputKind;
use proc_macro2::Ident;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::{HashMap, HashSet};
use syn::ext::IdentExt;

/// Meaning of a name.
#[derive(Clone, PartialEq, Eq)]
pub enum Meaning {
    Time,
    Coordinate(CoordinateKind),
    Speed(SpeedKind),
    /// A state of an element, whose rate is given.
    State,
    /// A value that arrives at run time.
    Input(InputKind),
    /// An expression, by its place among the definitions.
    Definition(usize),
    /// A field that is a number.
    Scalar,
    /// A field that is a vector of three.
    Vector,
    /// A body with mass.
    Body,
    /// A body without mass.
    Frame,
    /// A point of a body.
    Point,
    /// A function that a clause declares.
    Function(DeclaredFunction),
    /// π.
    Pi,
    /// A field that expressions cannot use; the message says why.
    Unusable(String),
}

/// A function that a clause declares.
#[derive(Clone, PartialEq, Eq)]
pub struct DeclaredFunction {
    /// Variables of the function, in words for messages.
    pub variables: Vec<String>,
    /// Its derivative jumps.
    pub kink: bool,
}

/// The names that expressions may use.
pub struct Scope {
    names: Vec<(String, Meaning)>,
    /// Places of the names among these, by the name.
    places: HashMap<String, Vec<usize>>,
    /// Every name could be read; if not, an unknown name may well be one of those that could not.
    complete: bool,
    /// Expressions of the definitions, as far as they are known to be well by themselves.
    definitions: Vec<Option<Expression>>,
    /// Definitions that stand in a circle, which is noted.
    circular: HashSet<usize>,
    /// Mistakes that uses found in definitions: what several uses forbid is said once.
    reported: RefCell<Vec<(usize, String)>>,
}

impl Scope {
    pub fn new(complete: bool) -> Scope {
        let mut scope = Scope {
            names: Vec::new(),
            places: HashMap::new(),
            complete,
            definitions: Vec::new(),
            circular: HashSet::new(),
            reported: RefCell::default(),
        };
        scope.add_word(TIME.into(), Meaning::Time);
        scope.add_word(PI.into(), Meaning::Pi);
        scope
    }

    /// Says what the next definition stands for; `None` if something is wrong with it.
    pub fn define(&mut self, expression: Option<Expression>) {
        self.definitions.push(expression);
    }

    /// Takes note of definitions that stand in a circle: that they name each other is not said once more.
    pub fn note_circular(&mut self, definitions: HashSet<usize>) {
        self.circular = definitions;
    }

    /// Expression of a definition; `None` if something is wrong with it.
    ///
    /// # Errors
    /// It comes after the one that is being read, or is this one.
    pub fn definition(&self, index: usize) -> Result<Option<&Expression>, Ordering> {
        let read = self.definitions.len();
        let around = index > read && self.circular.contains(&index) && self.circular.contains(&read);
        match self.definitions.get(index) {
            Some(definition) => Ok(definition.as_ref()),
            None if around => Ok(None),
            None => Err(index.cmp(&read)),
        }
    }

    /// Whether this is new to be said of the definition.
    pub fn is_new(&self, definition: usize, message: &str) -> bool {
        let mut reported = self.reported.borrow_mut();
        let new = !reported.iter().any(|(other, known)| *other == definition && known == message);
        if new {
            reported.push((definition, message.to_owned()));
        }
        new
    }

    /// The name of a definition.
    pub fn name_of_definition(&self, index: usize) -> &str {
        let named = self.names.iter().find(|(_, meaning)| *meaning == Meaning::Definition(index));
        named.map_or("", |(name, _)| name)
    }

    /// Adds a name; one with two meanings keeps both.
    pub fn add(&mut self, name: &Ident, meaning: Meaning) {
        self.add_word(name.unraw().to_string(), meaning);
    }

    fn add_word(&mut self, word: String, meaning: Meaning) {
        if !self.meanings(&word).any(|known| *known == meaning) {
            self.places.entry(word.clone()).or_default().push(self.names.len());
            self.names.push((word, meaning));
        }
    }

    /// All meanings of a name.
    fn meanings(&self, word: &str) -> impl Iterator<Item = &Meaning> {
        self.places.get(word).into_iter().flatten().map(|&place| &self.names[place].1)
    }

    /// The meaning of `name` where names with an `expected` meaning may stand.
    ///
    /// # Errors
    /// What to say of an unknown name; `None` where that is said elsewhere.
    pub fn find(&self, name: &Ident, expected: impl Fn(&Meaning) -> bool) -> Result<&Meaning, Option<String>> {
        let word = name.unraw().to_string();
        let mut meanings = self.meanings(&word);
        if let Some(meaning) = meanings.next() {
            // What a name with two meanings was meant to be cannot be told; that it has two is noted elsewhere.
            return if meanings.next().is_some() { Err(None) } else { Ok(meaning) };
        }
        if let Some((_, function)) = FUNCTIONS.iter().find(|(function, _)| *function == word) {
            return Err(Some(format!("`{word}` is a function; write `{}`", function.example())));
        }
        if !self.complete {
            return Err(None);
        }
        let remedy = match self.nearest(&word) {
            Some((near, meaning)) => format!("did you mean {}`{near}`?", meaning.noun()),
            None if expected(&Meaning::Input(InputKind::Scalar)) => {
                format!("declare it by `input({word})` if it arrives at run time, or write {}", self.list(expected))
            }
            None => format!("expected {}", self.list(expected)),
        };
        Err(Some(format!("unknown name `{word}`; {remedy}")))
    }

    /// The function that is called so, and whether its derivative jumps.
    ///
    /// # Errors
    /// What to say of one that is not declared; `None` where that is said elsewhere.
    pub fn find_function(&self, name: &Ident) -> Result<&DeclaredFunction, Option<String>> {
        let word = name.unraw().to_string();
        let declared = self.meanings(&word).find_map(|meaning| match meaning {
            Meaning::Function(declared) => Some(declared),
            _ => None,
        });
        if let Some(declared) = declared {
            return Ok(declared);
        }
        if !self.complete {
            return Err(None);
        }
        let own = self.names.iter().filter_map(|(known, meaning)| match meaning {
            Meaning::Function(_) => Some((known.as_str(), ())),
            _ => None,
        });
        let table: Vec<(&str, ())> = own.chain(FUNCTIONS.iter().map(|(word, _)| (*word, ()))).collect();
        if let Some(told) = instead(&word, FOR_FUNCTIONS) {
            return Err(Some(format!("unknown function `{word}`; {told}")));
        }
        Err(Some(match words::nearest(&word, &table) {
            Some((near, ())) => format!("unknown function `{word}`; did you mean `{near}`?"),
            None => format!(
                "unknown function `{word}`; expected {}; a function of your own is declared by `function({word}, \
                 derivative = …)`",
                words::list(&table)
            ),
        }))
    }

    /// Whether an expression may name it: the definition that is being read is none of those that it is made of.
    fn is_usable(&self, meaning: &Meaning) -> bool {
        match meaning {
            Meaning::Unusable(_) => false,
            Meaning::Definition(index) => *index != self.definitions.len(),
            _ => true,
        }
    }

    /// The nearest usable name. A single letter is near to nothing but its other case: any two letters are one edit
    /// apart.
    fn nearest(&self, word: &str) -> Option<(&str, &Meaning)> {
        let usable = self.names.iter().filter(|(_, meaning)| self.is_usable(meaning));
        let single = word.chars().count() == 1;
        let table: Vec<(&str, &Meaning)> = usable
            .filter(|(name, _)| !single || name.eq_ignore_ascii_case(word))
            .map(|(name, meaning)| (name.as_str(), meaning))
            .collect();
        words::nearest(word, &table)
    }

    /// All expected names, by what they are.
    fn list(&self, expected: impl Fn(&Meaning) -> bool) -> String {
        let mut parts = Vec::new();
        for noun in [
            "the coordinate ",
            "the speed ",
            "the state ",
            "the input ",
            "the definition ",
            "the field ",
            "the body ",
            "the frame ",
            "the point ",
        ] {
            let table: Vec<(&str, ())> = self
                .names
                .iter()
                .filter(|(_, meaning)| meaning.noun() == noun && self.is_usable(meaning) && expected(meaning))
                .map(|(name, _)| (name.as_str(), ()))
                .collect();
            if !table.is_empty() {
                parts.push(format!("{}({})", words::a(&noun[4..]), words::list(&table)));
            }
        }
        if expected(&Meaning::Time) {
            parts.push(format!("`{TIME}`"));
        }
        match parts.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            Some((last, _)) => last.clone(),
            None => "a number or the name of a field".into(),
        }
    }
}

impl Meaning {
    fn noun(&self) -> &'static str {
        match self {
            Meaning::Time | Meaning::Pi | Meaning::Unusable(_) => "",
            Meaning::Coordinate(_) => "the coordinate ",
            Meaning::Speed(_) => "the speed ",
            Meaning::State => "the state ",
            Meaning::Input(_) => "the input ",
            Meaning::Definition(_) => "the definition ",
            Meaning::Scalar | Meaning::Vector => "the field ",
            Meaning::Body => "the body ",
            Meaning::Frame => "the frame ",
            Meaning::Point => "the point ",
            Meaning::Function(_) => "the function ",
        }
    }

    /// It has this velocity: of bodies all of them, of poses those of the twist, of rotations the angular ones, of
    /// points their own.
    pub fn has_velocity(&self, property: Property) -> bool {
        let angular = matches!(property, Property::AngularVelocity | Property::BodyAngularVelocity);
        match self {
            Meaning::Body | Meaning::Frame => property.is_velocity(),
            Meaning::Coordinate(CoordinateKind::Pose) => {
                angular || matches!(property, Property::Velocity | Property::BodyVelocity)
            }
            Meaning::Coordinate(CoordinateKind::Rotation) => angular,
            Meaning::Point => property == Property::Velocity,
            _ => false,
        }
    }

    /// A body or a frame.
    pub fn is_body(&self) -> bool {
        matches!(self, Meaning::Body | Meaning::Frame)
    }

    /// Noun of the meaning, for messages.
    pub fn described(&self) -> &'static str {
        match self {
            Meaning::Function(_) => "a function",
            Meaning::Time | Meaning::Pi | Meaning::Scalar | Meaning::Coordinate(CoordinateKind::Scalar) => "a scalar",
            Meaning::Speed(SpeedKind::Scalar) | Meaning::State | Meaning::Input(InputKind::Scalar) => "a scalar",
            Meaning::Vector | Meaning::Speed(SpeedKind::Vector) | Meaning::Input(InputKind::Vector) => "a vector",
            Meaning::Input(InputKind::Wrench) => "a wrench",
            Meaning::Definition(_) => "a definition",
            Meaning::Coordinate(CoordinateKind::Pose) => "a pose",
            Meaning::Coordinate(CoordinateKind::Rotation) => "a rotation",
            Meaning::Body => "a body",
            Meaning::Frame => "a frame",
            Meaning::Point => "a point",
            Meaning::Unusable(_) => "a field",
        }
    }
}
