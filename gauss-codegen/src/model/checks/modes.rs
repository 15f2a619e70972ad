//! Rules for modes: whose they are, which coordinates they move by, and what numbers alone show.

use crate::model::language::context::Context;
use crate::model::language::statements::{Statement, Statements};
use crate::model::language::words::{self, word};
use crate::model::scene::clauses::{BodyClause, Coefficients, CoordinateKind, RoleClause, RoleValue};
use crate::model::scene::expression::Expression;
use crate::model::scene::modes::{GivenIntegral, Integral, ModesClause};
use crate::terms::Role;
use std::collections::HashSet;

/// Numbers of files have six or seven digits; an eigenvalue of a matrix of unit diagonal moves by less than this for
/// each of its rows when they are rounded so.
const ROUNDED: f64 = 1e-6;

/// Names, and matrices of numbers.
pub fn check(statements: &Statements, context: &mut Context) {
    let mut moved = HashSet::new();
    let mut bodies = HashSet::new();
    for clause in statements.modes.iter().map(|read| &read.clause) {
        check_body(clause, statements, &mut bodies, context);
        check_coordinates(clause, statements, &mut moved, context);
        check_numbers(clause, statements, context);
    }
}

fn check_body(clause: &ModesClause, statements: &Statements, earlier: &mut HashSet<String>, context: &mut Context) {
    let name = &clause.body;
    if !earlier.insert(word(name)) {
        context.error(name.span(), format!("`{name}` has modes already; write all of them in one clause"));
    }
    let found = statements.bodies.iter().find(|body| body.word() == word(name));
    match found {
        Some(body) if body.massless => {
            context.error(
                name.span(),
                format!("`{name}` is a frame, and modes are those of a body; write `body({name}, …)`"),
            );
        }
        Some(_) => {}
        None if statements.missed_any(&[Statement::Body, Statement::Frame]) => {}
        None => {
            let names: Vec<String> = statements.massive().map(BodyClause::word).collect();
            let table: Vec<(&str, ())> = names.iter().map(|name| (name.as_str(), ())).collect();
            let remedy = match words::nearest(&word(name), &table) {
                Some((near, ())) => format!("did you mean `{near}`?"),
                None => format!("add `body({name}, parent = …)`"),
            };
            context.error(name.span(), format!("no body is called `{name}`; {remedy}"));
        }
    }
}

fn check_coordinates(
    clause: &ModesClause,
    statements: &Statements,
    moved: &mut HashSet<String>,
    context: &mut Context,
) {
    let coordinates = || statements.coordinates.iter().flat_map(|names| &names.names);
    for name in &clause.coordinates {
        if !moved.insert(word(name)) {
            context.error(name.span(), format!("`{name}` is the coordinate of a mode already; name another"));
            continue;
        }
        match coordinates().find(|q| word(&q.ident) == word(name)).map(|q| q.kind) {
            Some(CoordinateKind::Scalar) => {}
            Some(_) => context.error(
                name.span(),
                format!(
                    "`{name}` is no scalar, and the coordinate of a mode is one; write it in `coordinates({name})`"
                ),
            ),
            None if statements.missed || statements.coordinates.as_ref().is_some_and(|names| !names.complete) => {}
            None => {
                let names: Vec<String> = coordinates().map(|q| word(&q.ident)).collect();
                let table: Vec<(&str, ())> = names.iter().map(|name| (name.as_str(), ())).collect();
                let remedy = match words::nearest(&word(name), &table) {
                    Some((near, ())) if word(name).chars().count() > 1 => format!("did you mean `{near}`?"),
                    _ => "add it to `coordinates(…)`".to_owned(),
                };
                context.error(name.span(), format!("`{name}` is no coordinate; {remedy}"));
            }
        }
    }
}

/// Symmetry and definiteness of matrices that are numbers, and whether the modes fit the mass of the body.
fn check_numbers(clause: &ModesClause, statements: &Statements, context: &mut Context) {
    let (n, place, earlier) = (clause.coordinates.len(), clause.place(), context.count());
    if clause.find(Integral::Stiffness).is_none() && !statements.missed {
        let remedy = "give K, or ω² of modes of unit modal mass";
        context.error(clause.span, format!("{place}modes without `stiffness` are not held by anything; {remedy}"));
    }
    for given in clause.integrals.iter().filter(|given| given.integral.is_symmetric()) {
        check_symmetry(given, n, &place, context);
    }
    for (integral, strict) in [(Integral::Mass, true), (Integral::Damping, false), (Integral::Stiffness, false)] {
        let Some((given, matrix)) = clause.find(integral).and_then(|given| Some((given, matrix(given, n)?))) else {
            continue;
        };
        if !is_definite(&matrix, strict) {
            let (word, wrong) =
                (integral.word(), if strict { "is not positive definite" } else { "has a negative eigenvalue" });
            context
                .error(given.span, format!("{place}the matrix `{word}` of modes {wrong}; check its signs and units"));
        }
    }
    if context.count() == earlier
        && let Some(whole) = whole(clause, statements, n)
        && !is_definite(&whole, false)
    {
        context.error(
            clause.span,
            format!(
                "{place}the modes of `{}` take more of the mass than the body has: with `translation` δ₀, `rotation` δ₁ \
                 and `mass` M the matrix [[m, −m c×, δ₀], [m c×, I_O, δ₁], [δ₀ᵀ, δ₁ᵀ, M]] has a negative eigenvalue; check \
                 units and the pole O, and that modal masses and participations are of the same normalisation",
                clause.body
            ),
        );
    }
}

fn check_symmetry(given: &GivenIntegral, n: usize, place: &str, context: &mut Context) {
    let Some(entries) = numbers(&given.entries) else { return };
    let size = entries.len() / (n * n).max(1);
    let block = |k: usize, l: usize| &entries[(k * n + l) * size..(k * n + l + 1) * size];
    let largest = entries.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
    for (k, l) in (0..n).flat_map(|l| (0..l).map(move |k| (k, l))) {
        let differs = block(k, l).iter().zip(block(l, k)).any(|(a, b)| (a - b).abs() > ROUNDED * largest);
        if differs {
            let word = given.integral.word();
            context.error(
                given.span,
                format!("{place}`{word}` is symmetric in its modes, and its entries [{k}][{l}] and [{l}][{k}] differ"),
            );
            return;
        }
    }
}

fn numbers(entries: &[Expression]) -> Option<Vec<f64>> {
    entries.iter().map(Expression::literal).collect()
}

fn matrix(given: &GivenIntegral, n: usize) -> Option<Vec<Vec<f64>>> {
    Some(numbers(&given.entries)?.chunks(n).map(<[f64]>::to_vec).collect())
}

/// `∫ ∂v_P/∂ν_i·∂v_P/∂ν_j dm` of the undeformed body with its modes, where all of it is numbers.
fn whole(clause: &ModesClause, statements: &Statements, n: usize) -> Option<Vec<Vec<f64>>> {
    let body = statements.bodies.iter().find(|body| body.word() == word(&clause.body))?;
    let own = if body.name.is_some() { &body.role_clauses } else { &statements.role_clauses };
    let (mass, center, inertia) = mass_data(own)?;
    let rows = |integral: Integral| match clause.find(integral) {
        Some(given) => numbers(&given.entries),
        None => Some(vec![0.0; 3 * n]),
    };
    let (translation, rotation) = (rows(Integral::Translation)?, rows(Integral::Rotation)?);
    let modal = match clause.find(Integral::Mass) {
        Some(given) => matrix(given, n)?,
        None => (0..n).map(|k| (0..n).map(|l| f64::from(u8::from(k == l))).collect()).collect(),
    };
    let [x, y, z] = center.map(|c| mass * c);
    let lever = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
    let mut whole = vec![vec![0.0; 6 + n]; 6 + n];
    for i in 0..3 {
        whole[i][i] = mass;
        for j in 0..3 {
            (whole[i][3 + j], whole[3 + j][i]) = (lever[i][j], lever[i][j]);
            whole[3 + i][3 + j] = inertia[i][j];
        }
        for k in 0..n {
            (whole[i][6 + k], whole[6 + k][i]) = (translation[3 * k + i], translation[3 * k + i]);
            (whole[3 + i][6 + k], whole[6 + k][3 + i]) = (rotation[3 * k + i], rotation[3 * k + i]);
        }
    }
    modal.iter().enumerate().for_each(|(k, row)| whole[6 + k][6..].copy_from_slice(row));
    Some(whole)
}

/// Mass, centre of mass and I_O, where they are numbers.
fn mass_data(clauses: &[RoleClause]) -> Option<(f64, [f64; 3], [[f64; 3]; 3])> {
    let find = |role: Role| clauses.iter().find(|clause| clause.role == role).map(|clause| &clause.value);
    let RoleValue::Expression(mass) = find(Role::Mass)? else { return None };
    let mass = mass.literal()?;
    let center = match find(Role::CenterOfMass) {
        None => [0.0; 3],
        Some(RoleValue::Expression(center)) => center.literal_components()?,
        Some(RoleValue::Coefficients(_)) => return None,
    };
    let (given, central) = match (find(Role::Inertia), find(Role::CentralInertia)) {
        (Some(about_o), _) => (about_o, false),
        (None, Some(central)) => (central, true),
        (None, None) => return None,
    };
    let mut inertia = [[0.0; 3]; 3];
    match given {
        RoleValue::Expression(e) => {
            let principal = e.literal().map(|moment| [moment; 3]).or_else(|| e.literal_components())?;
            (0..3).for_each(|i| inertia[i][i] = principal[i]);
        }
        RoleValue::Coefficients(Coefficients::Diagonal(entries)) => {
            for (entry, (i, j)) in entries.iter().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]) {
                let value = entry.literal()?;
                (inertia[i][j], inertia[j][i]) = (value, value);
            }
        }
        RoleValue::Coefficients(Coefficients::Field(_)) => return None,
    }
    if central {
        let square: f64 = center.iter().map(|c| c * c).sum();
        for i in 0..3 {
            inertia[i][i] += mass * square;
            (0..3).for_each(|j| inertia[i][j] -= mass * center[i] * center[j]);
        }
    }
    Some((mass, center, inertia))
}

/// Whether a symmetric matrix has positive eigenvalues, or none below zero, up to the rounding of its entries: by the
/// pivots of elimination after scaling to a unit diagonal.
fn is_definite(matrix: &[Vec<f64>], strict: bool) -> bool {
    let n = matrix.len();
    let limit = n as f64 * ROUNDED;
    if (0..n).any(|i| matrix[i][i] < 0.0 || (strict && matrix[i][i] == 0.0)) {
        return false;
    }
    let scale = |i: usize| if matrix[i][i] > 0.0 { matrix[i][i].sqrt().recip() } else { 1.0 };
    let mean = |i: usize, j: usize| 0.5 * (matrix[i][j] + matrix[j][i]) * scale(i) * scale(j);
    let mut rest: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| mean(i, j)).collect()).collect();
    let mut left: Vec<usize> = (0..n).collect();
    while let Some(at) = (0..left.len()).max_by(|&a, &b| rest[left[a]][left[a]].total_cmp(&rest[left[b]][left[b]])) {
        let k = left[at];
        let pivot = rest[k][k];
        if pivot <= limit {
            // What is left is zero up to rounding: its diagonal, and so all of it.
            let small = |&i: &usize| rest[i][i] >= -limit && left.iter().all(|&j| rest[i][j].abs() <= 2.0 * limit);
            return !strict && left.iter().all(small);
        }
        left.swap_remove(at);
        for &i in &left {
            let factor = rest[i][k] / pivot;
            for &j in &left {
                rest[i][j] -= factor * rest[k][j];
            }
        }
    }
    true
}
