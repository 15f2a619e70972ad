//! Files of modes: a body as finite elements or a formula give it, in JSON, whose numbers become those of the clause.

use std::path::{Path, PathBuf};

use proc_macro2::Span;
use serde_json::{Map, Value};

use crate::model::language::context::Context;
use crate::model::language::modes::{ModesFile, NestedList, shaped};
use crate::model::language::role_clauses;
use crate::model::language::statements::Statements;
use crate::model::language::words::{self, word};
use crate::model::scene::clauses::{Coefficients, RoleClause, RoleValue};
use crate::model::scene::expression::{Expression, ExpressionKind};
use crate::model::scene::modes::{GivenIntegral, Integral};
use crate::terms::number::shortest;
use crate::terms::{Role, Shape};

/// The keys of a file beside `modes`: mass data of the body as it is undeformed, and words for readers.
const MASS_DATA: [(&str, Role); 4] = [
    ("mass", Role::Mass),
    ("center_of_mass", Role::CenterOfMass),
    ("inertia", Role::Inertia),
    ("inertia_about_center_of_mass", Role::CentralInertia),
];
const MODES: &str = "modes";
const COMMENT: &str = "comment";

/// Contents of a file, at the token that names it.
struct Contents {
    role_clauses: Vec<RoleClause>,
    integrals: Vec<GivenIntegral>,
}

/// Reads the files of all clauses: mass data go to their bodies, integrals to the clauses. Gives back the paths, which
/// generated code names so that an edit compiles the struct anew.
pub fn compose(statements: &mut Statements, context: &mut Context) -> Vec<String> {
    let mut paths = Vec::new();
    for read in &mut statements.modes {
        let Some(file) = read.file.take() else { continue };
        let path = absolute(&file);
        match contents(&file, &path, read.clause.coordinates.len()) {
            Ok(Contents { role_clauses, integrals }) => {
                paths.push(path.to_string_lossy().into_owned());
                read.clause.integrals = integrals;
                read.clause.file = Some(file.path);
                let own = word(&read.clause.body);
                let body = statements.bodies.iter_mut().find(|body| body.name.is_some() && body.word() == own);
                let list = body.map_or(&mut statements.role_clauses, |body| &mut body.role_clauses);
                role_clauses.into_iter().for_each(|clause| role_clauses::add(clause, list, context));
            }
            Err(messages) => {
                // Whatever else seems to be missing is what the file was to say.
                statements.missed = true;
                messages.iter().for_each(|message| context.error(file.span, format!("{}{message}", file.path)));
            }
        }
    }
    paths
}

/// The path from the folder of the package that is compiled; of a tool without one from where it runs.
fn absolute(file: &ModesFile) -> PathBuf {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    let path = folder.join(&file.path);
    std::path::absolute(&path).unwrap_or(path)
}

/// # Errors
/// Everything that is wrong in the file, each with what follows its path.
fn contents(file: &ModesFile, path: &Path, modes: usize) -> Result<Contents, Vec<String>> {
    let text = std::fs::read_to_string(path).map_err(|error| vec![format!(": {error}")])?;
    let value: Value = serde_json::from_str(&text).map_err(|error| {
        let place = format!(":{}:{}", error.line(), error.column());
        let message = error.to_string();
        let told = message.split(" at line ").next().unwrap_or_default();
        vec![format!("{place}: {told}")]
    })?;
    let mut reader = ModesReader { span: file.span, modes, mistakes: Vec::new() };
    let contents = reader.whole(&value);
    if reader.mistakes.is_empty() { Ok(contents) } else { Err(reader.mistakes) }
}

struct ModesReader {
    span: Span,
    modes: usize,
    mistakes: Vec<String>,
}

impl ModesReader {
    fn mistake(&mut self, message: impl std::fmt::Display) {
        self.mistakes.push(format!(": {message}"));
    }

    fn whole(&mut self, value: &Value) -> Contents {
        let mut contents = Contents { role_clauses: Vec::new(), integrals: Vec::new() };
        let Some(object) = value.as_object() else {
            self.mistake("expected an object with `modes`, and the mass data of the body");
            return contents;
        };
        let words: Vec<&'static str> = MASS_DATA.iter().map(|(word, _)| *word).chain([MODES, COMMENT]).collect();
        self.refuse_unknown(object, "", &words);
        for (word, role) in MASS_DATA {
            if let Some(value) = object.get(word) {
                contents.role_clauses.extend(self.role(word, role, value));
            }
        }
        match object.get(MODES) {
            Some(Value::Object(modes)) => contents.integrals = self.integrals(modes),
            Some(_) => self.mistake("`modes` is an object with `stiffness` and what else is known of the modes"),
            None => self.mistake("`modes` is missing; add `\"modes\": {\"stiffness\": […], …}`"),
        }
        contents
    }

    fn refuse_unknown(&mut self, object: &Map<String, Value>, within: &str, known: &[&'static str]) {
        let table: Vec<(&str, ())> = known.iter().map(|word| (*word, ())).collect();
        for key in object.keys().filter(|key| !known.contains(&key.as_str())) {
            let remedy = match words::nearest(key, &table) {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None => format!("expected {}", words::list(&table)),
            };
            self.mistake(format_args!("unknown key `{within}{key}`; {remedy}"));
        }
    }

    fn integrals(&mut self, object: &Map<String, Value>) -> Vec<GivenIntegral> {
        let words: Vec<&'static str> = Integral::ALL.iter().map(|(word, _)| *word).chain([COMMENT]).collect();
        self.refuse_unknown(object, "modes.", &words);
        let mut integrals = Vec::new();
        for (word, integral) in Integral::ALL {
            let Some(value) = object.get(word) else { continue };
            let Some(nested) = self.nested(value, &format!("modes.{word}")) else { continue };
            match shaped(nested, integral, self.modes) {
                Ok(entries) => integrals.push(GivenIntegral { integral, entries, span: self.span }),
                Err((_, message)) => self.mistake(message.replacen('`', "`modes.", 1)),
            }
        }
        integrals
    }

    fn nested(&mut self, value: &Value, path: &str) -> Option<NestedList> {
        match value {
            Value::Array(rows) => {
                let mut entries = Vec::new();
                for (k, row) in rows.iter().enumerate() {
                    entries.push(self.nested(row, &format!("{path}[{k}]"))?);
                }
                Some(NestedList::List(entries, self.span))
            }
            _ => Some(NestedList::Scalar(self.number(value, path)?)),
        }
    }

    /// As it would be written: the shortest decimal fraction that is read as it.
    fn number(&mut self, value: &Value, path: &str) -> Option<Expression> {
        let Some(number) = value.as_f64().filter(|number| number.is_finite()) else {
            self.mistake(format_args!("`{path}` is a number or a list of numbers"));
            return None;
        };
        let own =
            Expression { kind: ExpressionKind::Number { value: shortest(number.abs()), twin: None }, span: self.span };
        let negative = |own| Expression { kind: ExpressionKind::Negate(Box::new(own)), span: self.span };
        Some(if number < 0.0 { negative(own) } else { own })
    }

    fn role(&mut self, word: &str, role: Role, value: &Value) -> Option<RoleClause> {
        let value = match (role, value) {
            (Role::Mass, _) => RoleValue::Expression(self.number(value, word)?),
            (Role::Inertia | Role::CentralInertia, Value::Array(rows)) if rows.iter().any(Value::is_array) => {
                RoleValue::Coefficients(Coefficients::Diagonal(self.tensor(word, value)?))
            }
            _ => {
                let components = value.as_array().filter(|components| components.len() == 3);
                let Some(components) = components else {
                    let tensor = if role == Role::CenterOfMass { "" } else { ", or three of them" };
                    self.mistake(format_args!("`{word}` is a list of three numbers{tensor}"));
                    return None;
                };
                let mut read = Vec::new();
                for (k, component) in components.iter().enumerate() {
                    read.push(Box::new(self.number(component, &format!("{word}[{k}]"))?));
                }
                let vector = <[Box<Expression>; 3]>::try_from(read).ok()?;
                RoleValue::Expression(Expression { kind: ExpressionKind::Vector(vector), span: self.span })
            }
        };
        Some(RoleClause { role, shape: Shape::Other, value, span: self.span })
    }

    /// xx, xy, xz, yy, yz, zz of a symmetric tensor.
    fn tensor(&mut self, word: &str, value: &Value) -> Option<[Box<Expression>; 6]> {
        let entry = |i: usize, j: usize| value.get(i).and_then(|row| row.get(j)).and_then(Value::as_f64);
        let square = value.as_array().is_some_and(|rows| rows.len() == 3)
            && (0..3).all(|i| value[i].as_array().is_some_and(|row| row.len() == 3));
        if !square || (0..9).any(|at| entry(at / 3, at % 3).is_none()) {
            self.mistake(format_args!("`{word}` has three rows of three numbers"));
            return None;
        }
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if entry(i, j) != entry(j, i) {
                self.mistake(format_args!("`{word}` is symmetric, and its entries ({i}, {j}) and ({j}, {i}) differ"));
            }
        }
        let entries = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
        let read: Option<Vec<_>> =
            entries.into_iter().map(|(i, j)| self.number(&value[i][j], word).map(Box::new)).collect();
        read?.try_into().ok()
    }
}
