//! Constraints that follow from those before them, or contradict them.

use crate::algebra::{Expr, Map, Number, Precise, Rational};

use crate::mechanics::scene::constraint::ConstraintKind;
use crate::mechanics::system::System;

use super::witness::{Witness, largest, sample_state, sum};

/// Positions that are sums of multiples of those before them, with the same factors wherever the system is: they say
/// nothing, as the components of a loop's position across the plane in which it moves. Symbols that stand for
/// `literals` have those values.
pub fn needless_constraints<'g>(system: &System<'g>, literals: &[(Rational, Expr<'g>)]) -> Vec<usize> {
    // Roundings of numbers, not of what is computed with them: planes of which each link has its own.
    const NEGLIGIBLE: f64 = 1e-12;
    // Roundings can look like a dependence, as for all that is checked.
    let alike = needless::<f64>(system, literals, 100.0 * f64::NEGLIGIBLE);
    if alike.is_empty() { alike } else { needless::<Precise>(system, literals, NEGLIGIBLE) }
}

fn needless<'g, N: Number>(system: &System<'g>, literals: &[(Rational, Expr<'g>)], negligible: f64) -> Vec<usize> {
    // The system elsewhere, its parameters as they were.
    let mut at: Map<u32, N> = sample_state(system, 0);
    at.extend(literals.iter().map(|(value, symbol)| (symbol.key(), N::fraction(*value))));
    let states = (0..16).map(|shift| {
        let mut state = at.clone();
        let other: Map<u32, N> = sample_state(system, shift);
        state.extend(system.scene.rates.keys().filter_map(|key| Some((*key, *other.get(key)?))));
        Witness::new(system, state)
    });
    let all = dependencies(system, states, negligible);
    all.into_iter().filter(|found| found.constant && !found.contradicts).map(|found| found.number).collect()
}

/// A constraint whose velocity is a combination of those before it.
pub struct Dependency {
    pub number: usize,
    /// Whether it is a combination of positions, with the same coefficients everywhere.
    constant: bool,
    /// It does not hold together with them.
    pub contradicts: bool,
}

/// Constraints that say nothing new, or nothing that can hold with those before them.
pub fn dependencies<'a, 'g, N: Number + 'a>(
    system: &'a System<'g>,
    states: impl Iterator<Item = Witness<'a, 'g, N>>,
    negligible: f64,
) -> Vec<Dependency> {
    let constraints = &system.constraints;
    let positions = constraints.on_positions();
    let usable = |witness: &Witness<'_, 'g, N>| {
        let finite = |values: Vec<N>| values.iter().all(|x| x.is_finite());
        finite(witness.values(constraints.on_velocities.iter().chain(&positions)))
            && witness.partials(&constraints.on_velocities).into_iter().all(finite)
    };
    let mut usable = states.filter(usable);
    // What no coordinate and no speed changes needs no state to be seen, and may have a value at none.
    let Some(witness) = usable.next() else {
        let still = constraints.on_velocities.iter().enumerate().filter(|(_, rate)| rate.is_zero());
        return still.map(|(number, _)| Dependency { number, constant: false, contradicts: false }).collect();
    };
    let mut dependent = dependent_rows(&witness, negligible);
    if dependent.is_empty() {
        return Vec::new();
    }
    // What depends on others does so everywhere; a row of powers such as k¹⁰⁰⁰ is small beside others at some states
    // alone.
    let elsewhere: Vec<_> = usable.take(3).map(|other| (dependent_rows(&other, negligible), other)).collect();
    dependent.retain(|(k, _)| elsewhere.iter().all(|(rows, _)| rows.iter().any(|(row, _)| row == k)));
    // What constraints say of velocities, of a system at rest.
    let mut at_rest = Witness::new(system, witness.state.clone());
    let zero = N::number(0.0);
    at_rest.state.extend(system.scene.speeds.iter().map(|z| (z.key(), zero)));
    let moving = at_rest.values(&constraints.on_velocities);
    let elsewhere = elsewhere.into_iter().next().map(|(rows, other)| (rows, other.values(&positions)));
    let combined =
        |coefficients: &[N], values: &[N]| sum(coefficients.iter().zip(values).map(|(c, value)| *c * *value));
    dependent
        .into_iter()
        .map(|(k, coefficients)| {
            // Positions can be compared where a combination with the same coefficients everywhere is constant.
            let of_positions = (0..=k)
                .all(|j| coefficients[j] == zero || system.scene.constraints[j].kind == ConstraintKind::Position);
            let constant = elsewhere.as_ref().and_then(|(rows, values)| {
                let (_, other) = rows.iter().find(|(row, _)| *row == k)?;
                let close = |a: N, b: N| (a - b).to_f64().abs() <= 1e-8 * (1.0 + a.to_f64().abs());
                let same = coefficients.iter().zip(other).all(|(a, b)| close(*a, *b));
                (of_positions && same).then(|| combined(other, values))
            });
            let values = [Some(combined(&coefficients, &moving)), constant].into_iter().flatten();
            let contradicts = values.into_iter().any(|value| value.to_f64().abs() > 1e-8);
            Dependency { number: k, constant: constant.is_some(), contradicts }
        })
        .collect()
}

/// Rows of J that are combinations of those before them, with the coefficients of the combination that vanishes.
/// What is smaller than the `negligible` part of a row is what elimination leaves of it.
fn dependent_rows<N: Number>(witness: &Witness<'_, '_, N>, negligible: f64) -> Vec<(usize, Vec<N>)> {
    let constraints = &witness.system.constraints;
    let columns = witness.partials(&constraints.on_velocities);
    let count = constraints.count();
    let mut rows: Vec<Vec<N>> = (0..count).map(|k| columns.iter().map(|c| c[k]).collect()).collect();
    let unit = |k: usize| (0..count).map(|j| N::number(f64::from(u8::from(j == k)))).collect::<Vec<N>>();
    let mut combinations: Vec<Vec<N>> = (0..count).map(unit).collect();
    let sizes: Vec<f64> = rows.iter().map(|row| largest(row.iter().copied())).collect();
    let mut dependent = Vec::new();
    for k in 0..count {
        let (pivot, size) = rows[k]
            .iter()
            .enumerate()
            .map(|(column, x)| (column, x.to_f64().abs()))
            .fold((0, 0.0_f64), |best, other| if other.1 > best.1 { other } else { best });
        if size <= negligible * sizes[k].max(1e-3) {
            dependent.push((k, combinations[k].clone()));
            continue;
        }
        for later in k + 1..count {
            let factor = rows[later][pivot] / rows[k][pivot];
            for column in 0..rows[k].len() {
                rows[later][column] = rows[later][column] - factor * rows[k][column];
            }
            for column in 0..count {
                combinations[later][column] = combinations[later][column] - factor * combinations[k][column];
            }
        }
    }
    dependent
}
