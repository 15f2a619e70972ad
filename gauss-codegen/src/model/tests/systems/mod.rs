//! Systems: what is accepted and the model that comes out; and their mistakes.

mod accepted;
mod bodies;
mod constraints;
mod contacts;
mod definitions;
mod elements;
mod expressions;
mod forces;
mod frames;
mod groups;
mod locks;
mod names;
mod states;
mod two_bodies;

use super::{Mistake, check};
use crate::model::scene::forces::{ArgumentContent, ArgumentValue};
use crate::model::{Coefficients, Expression, ExpressionKind, ForceAxes, ForceClause, Model, parse};
use syn::DeriveInput;

pub(super) fn system(source: &str) -> Model {
    match parse(&syn::parse_str::<DeriveInput>(source).expect("the snippet is Rust")) {
        Ok(model) if model.in_chart.is_none() => model,
        Ok(_) => panic!("in a chart: {source}"),
        Err(error) => panic!("{source}: {error}"),
    }
}

/// A particle of mass `m` at (x, y, 0), with more `clauses` and `fields`.
fn particle(clauses: &str, fields: &str) -> String {
    format!(
        "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), {clauses})] \
         struct Scene {{ m: f64, {fields} }}"
    )
}

/// The same with `potential`, under fields of several kinds.
fn potential(value: &str) -> String {
    particle(
        &format!("potential = {value}"),
        "k: f64, a: Vector3<f64>, b: Vector3<f64>, n: usize, j: Matrix3<f64>, s: Stiffness",
    )
}

#[track_caller]
fn check_potential(value: &str, expected: &[Mistake<'_>]) {
    check(&potential(value), expected);
}

/// An expression with all its brackets.
pub(super) fn show(expression: &Expression) -> String {
    match &expression.kind {
        ExpressionKind::Horizontal(_, k) => format!("place {k}"),
        ExpressionKind::Own(name, arguments) => {
            let arguments: Vec<String> = arguments.iter().map(show).collect();
            format!("({name} {})", arguments.join(" "))
        }
        ExpressionKind::Number { value, .. } => format!("{value:?}"),
        ExpressionKind::Name(name) | ExpressionKind::Input(name) => name.to_string(),
        ExpressionKind::Component(base, index) => format!("{}[{index}]", show(base)),
        ExpressionKind::Property(base, property) => format!("{}.{property:?}", show(base)),
        ExpressionKind::Negate(inner) => format!("(-{})", show(inner)),
        ExpressionKind::Binary(operator, left, right) => format!("({operator:?} {} {})", show(left), show(right)),
        ExpressionKind::Power(base, exponent) => format!("(powi {} {exponent})", show(base)),
        ExpressionKind::Call(function, arguments) => {
            let arguments: Vec<String> = arguments.iter().map(show).collect();
            format!("({} {})", function.word(), arguments.join(" "))
        }
        ExpressionKind::Vector([a, b, c]) => format!("[{} {} {}]", show(a), show(b), show(c)),
    }
}

/// A clause with its arguments, with all brackets of their expressions.
pub(super) fn shown(clause: &ForceClause) -> String {
    let argument = |given: &ArgumentValue| {
        let word = given.coordinate.as_ref().map_or(given.argument.word.into(), ToString::to_string);
        let value = match &given.value {
            ArgumentContent::Expression(value) => show(value),
            ArgumentContent::Reference(name) | ArgumentContent::Coefficients(Coefficients::Field(name)) => {
                name.to_string()
            }
            ArgumentContent::Axes(ForceAxes::Body) => "body".into(),
            ArgumentContent::Axes(ForceAxes::Observer) => "observer".into(),
            ArgumentContent::Coefficients(Coefficients::Diagonal(entries)) => {
                let entries: Vec<String> = entries.iter().map(|entry| show(entry)).collect();
                format!("[{}]", entries.join(" "))
            }
        };
        format!("{word} {value}")
    };
    let name = clause.name.as_ref().map_or("-".into(), ToString::to_string);
    let arguments: Vec<String> = clause.given.iter().map(argument).collect();
    format!("{} {name}: {}", clause.row.word, arguments.join(", "))
}

/// Whatever stands in the clauses of a system, the answer is a model or a message.
#[test]
fn nothing_panics() {
    let words = [
        "x",
        "=",
        ",",
        "(",
        ")",
        "[",
        "]",
        "()",
        "[x, y, 0]",
        "position",
        "parent = a",
        "rotation_z(x)",
        "-",
        "*",
        "/ 0",
        "1e400",
        "_",
        "if",
        "\"\"",
        "'c'",
        ": Pose",
        ".x",
        ".velocity",
        "rate(x)",
        "twist([x, 0, 0], v)",
        "[9]",
        "powi(x, 99999999999)",
        "x.powi(-2147483648)",
        "::",
        "&",
        "||",
        "é",
        "r#t",
        "{}",
        "#",
        "..",
    ];
    let mut read_snippets = 0;
    let clauses = [
        "coordinates",
        "speeds",
        "kinematics",
        "body",
        "frame",
        "particle",
        "point",
        "constraint",
        "constraint(velocity = ",
        "independent",
        "potential = ",
        "input",
        "force",
        "force(value = x, body = a, at = ",
        "torque",
        "torque(value = ",
        "drive",
        "drive(x = ",
        "spring",
        "spring(from = ",
        "damping = ",
        "limit = ",
        "wrench",
        "wrench(force = ",
        "drag",
        "drag(linear = ",
        "stop",
        "stop(least = x, along = ",
        "define",
        "define(d = ",
        "medium(velocity = ",
        "central_gravity",
        "central_gravity(mu = ",
    ];
    for clause in clauses {
        for first in words {
            for second in words {
                let (open, close) = match clause {
                    clause if clause.contains('(') => ("", ")"),
                    clause if clause.ends_with("= ") => ("", ""),
                    _ => ("(", ")"),
                };
                for source in [
                    format!("{clause}{open}{first} {second}{close}"),
                    format!("coordinates(x), speeds(v: Vector3), body(a), {clause}{open}{first} {second}{close}"),
                ] {
                    let system = format!("#[gauss({source})] struct Scene {{ #[gauss(body)] a: RigidBody<f64> }}");
                    let body = format!("#[gauss({source})] struct Scene {{ #[gauss(mass)] x: f64, a: Matrix6<f64> }}");
                    for source in [system, body] {
                        if let Ok(input) = syn::parse_str(&source) {
                            let _ = parse(&input);
                            read_snippets += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(read_snippets > 5_000, "{read_snippets}");
}
