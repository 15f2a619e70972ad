//! Snippets and what is said about them: the message, and the source text that it points at.

mod accepted;
mod acting;
mod charts;
mod clauses;
mod items;
mod misleading;
mod modes;
#[cfg(feature = "urdf")]
mod robots;
mod role_clauses;
mod roles;
mod synonyms;
mod systems;
mod units;

use super::Model;
use syn::DeriveInput;

/// A mistake: the text pointed at and the message.
type Mistake<'a> = (&'a str, &'a str);

fn read(source: &str) -> Result<Model, syn::Error> {
    super::parse(&syn::parse_str::<DeriveInput>(source).expect("the snippet is Rust"))
}

fn model(source: &str) -> Model {
    match read(source) {
        Ok(model) => model,
        Err(error) => panic!("{source}: {error}"),
    }
}

/// A struct without mistakes, under `attributes`.
fn body(attributes: &str) -> String {
    format!("{attributes} struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: Vector3<f64> }}")
}

/// A struct of a body with mass and inertia, and more `fields`.
fn with(fields: &str) -> String {
    format!("struct Body {{ #[gauss(mass)] m: f64, #[gauss(inertia)] j: Vector3<f64>, {fields} }}")
}

#[track_caller]
fn check(source: &str, expected: &[Mistake<'_>]) {
    let error = match read(source) {
        Ok(_) => panic!("accepted: {source}"),
        Err(error) => error,
    };
    let found: Vec<(String, String)> =
        error.into_iter().map(|error| (error.span().source_text().unwrap_or_default(), error.to_string())).collect();
    let found: Vec<Mistake<'_>> = found.iter().map(|(token, message)| (token.as_str(), message.as_str())).collect();
    assert_eq!(found, expected, "\nin {source}");
}

#[track_caller]
fn check_body(attributes: &str, expected: &[Mistake<'_>]) {
    check(&body(attributes), expected);
}

const INERTIA: &str = "the inertia about O is one number, three principal moments or a tensor: \
    expected `f64` (spherical), `Vector3<f64>` (principal) or `Matrix3<f64>` (full)";

const ALL_CLAUSES: &str = "motion is declared by `chart`, `motion`, `coordinates`, `speeds`, `kinematics`, `body`, \
    `frame`, `particle`, `constraint`, `independent` or `redundant`, forces and more by `point`, `contact`, `range`, `dry_friction`, `potential`, `input`, `states`, `force`, \
    `torque`, `wrench`, `drive`, `spring`, `stop`, `drag`, `friction`, `coupling`, `torsional_spring`, `bushing`, `damping`, `mass_flow`, `armature`, `lock`, `modes`, `medium`, \
    `central_gravity`, `define`, `function`, `table`, `waive` or `limit`, and generated code is chosen by `crate`, \
    `taylor`, `linearize`, `regressor`, `frames`, `reactions`, `methods` or `python`";
