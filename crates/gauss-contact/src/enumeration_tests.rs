//! The solver against an enumeration of all modes in exact arithmetic, which shares nothing with it.
//!
//! Entries of W have few bits and units are powers of two from 2⁻²⁰ to 2²⁰, so that D and b are exact as `f64`: the
//! solver and the enumeration have the same problem, however near to singular it is.

use num_bigint::BigInt;
use num_rational::BigRational;

use gauss_runtime::contact::Contact;

use super::*;
use crate::friction::Bounds;
use crate::solver::convex_tests::witness::{eliminated, independent};
use crate::solver::tests::Numbers;

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("is finite")
}

fn zero() -> BigRational {
    BigRational::from_integer(BigInt::from(0))
}

/// Modes of a contact: it leaves, sticks, or slides along its tangent; a contact without one slides at μ = 0.
const MODES: [Option<i32>; 4] = [None, Some(0), Some(1), Some(-1)];

/// Solves by elimination; nothing where the matrix is singular.
fn solved(mut rows: Vec<Vec<BigRational>>) -> Option<Vec<BigRational>> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).find(|&i| rows[i][k] != zero())?;
        rows.swap(k, pivot);
        let first = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, row)| *i != k && row[k] != zero()) {
            debug_assert!(i != k);
            let factor = &row[k] / &first[k];
            (k..=n).for_each(|j| row[j] = &row[j] - &factor * &first[j]);
        }
    }
    Some((0..n).map(|k| &rows[k][n] / &rows[k][k]).collect())
}

/// The rows whose rates modes keep at zero, and what the unknown of each adds to forces.
fn unknowns(contacts: &Contacts, modes: &[Option<i32>]) -> (Vec<usize>, Vec<Vec<(usize, f64)>>) {
    let (mut rows, mut columns) = (Vec::new(), Vec::new());
    for (i, mode) in modes.iter().enumerate() {
        let (normal, mu) = (contacts.first[i], contacts.laws[i].friction);
        let Some(side) = mode else { continue };
        let mut column = vec![(normal, 1.0)];
        if contacts.laws[i].tangents == 1 && *side != 0 {
            column.push((normal + 1, -mu * f64::from(*side)));
        }
        rows.push(normal);
        columns.push(column);
        if *side == 0 {
            rows.push(normal + 1);
            columns.push(vec![(normal + 1, 1.0)]);
        }
    }
    (rows, columns)
}

/// Whether modes violate a law by far more than rounding: most do, and exact numbers take their time. In units in which
/// the diagonal of D is 1 pivots above 10⁻⁵ leave at least six digits of twelve unknowns.
fn surely_disagrees(contacts: &Contacts, modes: &[Option<i32>], rows: &[usize], columns: &[Vec<(usize, f64)>]) -> bool {
    let size = |row: usize| contacts.matrix.at(row, row).sqrt();
    let entry = |i: usize, j: usize| {
        let sum: f64 = columns[j].iter().map(|(row, x)| contacts.matrix.at(rows[i], *row) * x).sum();
        sum / (size(rows[i]) * size(rows[j]))
    };
    let n = rows.len();
    let matrix = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    let right = rows.iter().map(|&row| -contacts.b[row] / size(row)).collect();
    let Some((unknowns, pivot)) = eliminated(matrix, right) else { return false };
    if pivot < 1e-5 {
        return false;
    }
    let mut forces = vec![0.0; contacts.b.len()];
    for ((column, unknown), &own) in columns.iter().zip(&unknowns).zip(rows) {
        column.iter().for_each(|(row, x)| forces[*row] += x * unknown / size(own));
    }
    let largest = (0..forces.len()).map(|row| (size(row) * forces[row]).abs().max(contacts.b[row].abs() / size(row)));
    let margin = 1e-5 * largest.fold(0.0, f64::max);
    modes.iter().enumerate().any(|(i, mode)| {
        let (normal, mu) = (contacts.first[i], contacts.laws[i].friction);
        let rate = |row: usize| contacts.rate(row, &forces) / size(row);
        match mode {
            None => rate(normal) < -margin,
            Some(0) => (forces[normal + 1].abs() - mu * forces[normal]) * size(normal + 1) > margin,
            Some(side) => {
                let pulls = forces[normal] * size(normal) < -margin;
                pulls || (contacts.laws[i].tangents == 1 && rate(normal + 1) * f64::from(*side) < -margin)
            }
        }
    })
}

/// All rates that agree with the laws in one combination of modes or another.
fn enumerated(contacts: &Contacts) -> Vec<Vec<BigRational>> {
    let (d, b): (Vec<Vec<BigRational>>, Vec<BigRational>) = (
        (0..contacts.b.len()).map(|i| contacts.matrix.row(i).iter().map(|x| exact(*x)).collect()).collect(),
        contacts.b.iter().map(|x| exact(*x)).collect(),
    );
    let count = contacts.laws.len();
    let all_rows: Vec<Vec<f64>> = (0..contacts.b.len()).map(|row| contacts.matrix.row(row).to_vec()).collect();
    let rank = independent(&all_rows, &(0..contacts.b.len()).collect::<Vec<_>>()).len();
    let mut found: Vec<Vec<BigRational>> = Vec::new();
    for n in 0..4_usize.pow(count as u32) {
        let modes: Vec<_> = (0..count).map(|i| MODES[n / 4_usize.pow(i as u32) % 4]).collect();
        if modes.iter().zip(&contacts.laws).any(|(mode, law)| law.tangents == 0 && !matches!(mode, None | Some(1))) {
            continue;
        }
        let (rows, columns) = unknowns(contacts, &modes);
        // Of more rows than D has rank the equations are singular.
        if rows.len() > rank || surely_disagrees(contacts, &modes, &rows, &columns) {
            continue;
        }
        let columns: Vec<Vec<_>> =
            columns.iter().map(|column| column.iter().map(|(row, x)| (*row, exact(*x))).collect()).collect();
        let entry = |i: usize, j: usize| columns[j].iter().fold(zero(), |sum, (row, x)| sum + &d[rows[i]][*row] * x);
        let system = (0..rows.len())
            .map(|i| (0..rows.len()).map(|j| entry(i, j)).chain([-b[rows[i]].clone()]).collect())
            .collect();
        let Some(unknowns) = solved(system) else { continue };
        let mut forces = vec![zero(); b.len()];
        for (column, unknown) in columns.iter().zip(&unknowns) {
            column.iter().for_each(|(row, x)| forces[*row] = &forces[*row] + x * unknown);
        }
        let rate = |i: usize| d[i].iter().zip(&forces).fold(b[i].clone(), |sum, (d, f)| sum + d * f);
        let rates: Vec<_> = (0..b.len()).map(rate).collect();
        let agrees = |(i, mode): (usize, &Option<i32>)| {
            let (normal, mu) = (contacts.first[i], exact(contacts.laws[i].friction));
            match mode {
                None => rates[normal] >= zero(),
                Some(0) => {
                    let (friction, bound) = (forces[normal + 1].clone(), mu * &forces[normal]);
                    forces[normal] >= zero() && friction <= bound && -friction <= bound
                }
                Some(side) => {
                    let slips =
                        contacts.laws[i].tangents == 0 || &rates[normal + 1] * exact(f64::from(*side)) >= zero();
                    forces[normal] >= zero() && slips
                }
            }
        };
        if modes.iter().enumerate().all(agrees) && !found.contains(&rates) {
            found.push(rates);
        }
    }
    found
}

/// Contacts of units from 2⁻²⁰ to 2²⁰ in a space of some dimensions, with entries of six bits.
fn drawn(numbers: &mut Numbers, tangents: usize, frictions: &[f64], dimensions: usize) -> Contacts {
    let rows = frictions.len() * (1 + tangents);
    let units: Vec<f64> = frictions.iter().map(|_| 2.0_f64.powi((20.0 * numbers.signed()).round() as i32)).collect();
    let mut short = || (32.0 * numbers.signed()).round() / 32.0;
    let mut w: Vec<Vec<f64>> =
        (0..rows).map(|row| (0..dimensions).map(|_| units[row / (1 + tangents)] * short()).collect()).collect();
    // Of large friction tangents that lean on their normals: where Painlevé's states are.
    for i in (0..frictions.len()).filter(|&i| tangents == 1 && frictions[i] > 1.0) {
        (0..dimensions).for_each(|j| w[2 * i + 1][j] = 0.25 * w[2 * i + 1][j] + w[2 * i][j]);
    }
    let free: Vec<f64> = (0..dimensions).map(|_| short()).collect();
    let b = w.iter().map(|row| crate::dense::dot(row, &free)).collect();
    let bounds = |&largest: &f64| Bounds { largest, weights: [1.0; 3] };
    let law = |friction| Law::new(&Contact::new("", 0, tangents), bounds(friction), None);
    let laws = frictions.iter().map(law).collect();
    Contacts::new(laws, Matrix::from_fn(rows, |i, j| crate::dense::dot(&w[i], &w[j])), b)
}

/// Whether rates are those: to 10⁻⁹ of the terms they are sums of. The solver's own bound is 256 (1 + R) ε of them, R ≤
/// 8 rows; the forces in these terms are off by the condition of D with diagonal 1, below 10⁴ in these draws.
fn are(contacts: &Contacts, found: &Solution, wanted: &[BigRational]) -> bool {
    (0..contacts.b.len()).all(|row| {
        let terms = contacts.matrix.row(row).iter().zip(&found.forces).map(|(d, f)| (d * f).abs());
        let size = terms.fold(contacts.b[row].abs(), |sum, term| sum + term);
        let off = exact(found.rates[row]) - &wanted[row];
        off <= exact(1e-9 * size) && -off <= exact(1e-9 * size)
    })
}

#[test]
fn frictionless_contacts_have_the_one_motion_that_an_exact_enumeration_finds() {
    let mut numbers = Numbers(11);
    for n in 0..60 {
        // As many contacts as dimensions, fewer, and more: then D is singular, exactly.
        let contacts = drawn(&mut numbers, 0, &vec![0.0; 1 + n % 6], 2 + n % 5);
        let all = enumerated(&contacts);
        let found = contacts.solve().expect("is convex");
        assert_eq!(all.len(), 1, "{n}");
        assert!(are(&contacts, &found, &all[0]), "{n} {found:?}");
    }
}

#[test]
fn coulombs_law_has_a_motion_that_an_exact_enumeration_finds_or_the_reason_why_not() {
    let mut numbers = Numbers(5);
    let (mut unique, mut several, mut none) = (0, 0, 0);
    for n in 0..72 {
        let count = 1 + n % 3;
        let most = if n % 2 == 0 { 0.5 } else { 4.0 };
        let frictions: Vec<f64> = (0..count).map(|_| (64.0 * most * numbers.next()).round() / 64.0).collect();
        let contacts = drawn(&mut numbers, 1, &frictions, 2 * count + n % 2);
        let all = enumerated(&contacts);
        match contacts.solve() {
            Ok(found) => {
                assert!(all.iter().any(|wanted| are(&contacts, &found, wanted)), "{n} {found:?}");
                if all.len() == 1 { unique += 1 } else { several += 1 }
            }
            Err(Failure::Indeterminate(_)) => {
                assert!(all.len() > 1, "{n}");
                several += 1;
            }
            Err(Failure::Inconsistent(_)) => {
                assert!(all.is_empty(), "{n}");
                none += 1;
            }
            Err(other) => panic!("{n} {other:?}"),
        }
    }
    assert!(unique > 40 && several > 2, "{unique} {several} {none}");
}

#[test]
fn six_contacts_with_friction_have_a_motion_that_an_exact_enumeration_finds() {
    let mut numbers = Numbers(13);
    for n in 0..3 {
        let frictions: Vec<f64> = (0..6).map(|_| (32.0 * numbers.next()).round() / 64.0).collect();
        // Of two to four planar bodies: of fewer than four forces depend on one another.
        let contacts = drawn(&mut numbers, 1, &frictions, [9, 12, 6][n]);
        let all = enumerated(&contacts);
        let found = contacts.solve().unwrap_or_else(|failure| panic!("{n} {failure:?}"));
        assert!(all.iter().any(|wanted| are(&contacts, &found, wanted)), "{n} {found:?}");
    }
}
