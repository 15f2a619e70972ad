//! Systems: what is accepted and the model that comes out; and their mistakes.

mod accepted;
mod bodies;
mod constraints;
mod expressions;
mod forces;
mod frames;
mod groups;
mod names;

use super::{Mistake, check};
use crate::model::{Expression, ExpressionKind, Scene, SystemModel, parse_scene};
use syn::DeriveInput;

fn system(source: &str) -> SystemModel {
    match parse_scene(&syn::parse_str::<DeriveInput>(source).expect("the snippet is Rust")) {
        Ok(Scene::System(model)) => *model,
        Ok(Scene::Body(_)) => panic!("one body: {source}"),
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
fn show(expression: &Expression) -> String {
    match &expression.kind {
        ExpressionKind::Number { numerator, denominator: 1 } => numerator.to_string(),
        ExpressionKind::Number { numerator, denominator } => format!("{numerator}/{denominator}"),
        ExpressionKind::Name(name) => name.to_string(),
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
                    let source = format!("#[gauss({source})] struct Scene {{ #[gauss(body)] a: RigidBody<f64> }}");
                    if let Ok(input) = syn::parse_str(&source) {
                        let _ = parse_scene(&input);
                        read_snippets += 1;
                    }
                }
            }
        }
    }
    assert!(read_snippets > 5_000, "{read_snippets}");
}
