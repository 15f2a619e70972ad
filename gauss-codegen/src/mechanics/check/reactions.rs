//! Reactions against the definition: C of (3.1) of the system with joints let go, differentiated by their speeds.

use crate::algebra::{Evaluation, Expr, Map, Number, Precise};

use crate::mechanics::formula::Method;
use crate::mechanics::reactions::Reactions;

use super::agreement::{Disagreement, SizedSum, agree};
use super::witness::{Witness, sample_state};

/// Evaluates the rows at a few states, with speeds and rates of any size. As everywhere, what double precision finds
/// wrong counts if many digits confirm it.
pub fn check_reactions(reactions: &Reactions<'_>) -> Result<(), Disagreement> {
    match check_in::<f64>(reactions) {
        Err(_) if !reactions.system.scene.graph.is_exhausted() => check_in::<Precise>(reactions),
        result => result,
    }
}

/// The states that are tried, and how many of them may disagree: near singular ones roundings are large.
const STATES: u32 = 16;
const FEW: usize = 3;

fn check_in<N: Number>(reactions: &Reactions<'_>) -> Result<(), Disagreement> {
    let mut found = Vec::new();
    for shift in 0..STATES {
        match compare::<N>(reactions, shift) {
            Ok(true) => return Ok(()),
            Ok(false) => {}
            Err(error) => found.push(error),
        }
        if found.len() == FEW {
            break;
        }
    }
    found.pop().map_or(Ok(()), Err)
}

/// Whether there are values at the state, which then agree.
fn compare<N: Number>(reactions: &Reactions<'_>, shift: u32) -> Result<bool, Disagreement> {
    let Reactions { system, home, rows, .. } = reactions;
    let still = N::number(0.0);
    let mut state: Map<u32, N> = sample_state(system, shift);
    state.extend(home.keys().map(|&key| (key, still)));
    let of_these = home.len() / 3;
    let (all, rates) = (system.scene.speeds.len(), &system.scene.speed_rates);
    let own = all - of_these;
    let motion: Vec<N> =
        (0..all).map(|k| if k < own { N::number(0.7 - 0.3 * (k % 4) as f64) } else { still }).collect();
    let witness = Witness::new(system, state);
    let expected: Vec<SizedSum<N>> =
        witness.stationarity(&motion)[own..].iter().map(|row| SizedSum::of(*row, Vec::new())).collect();
    if !expected.iter().all(SizedSum::is_in_range) {
        return Ok(false);
    }
    let mut state = witness.state;
    state.extend(rates.iter().zip(&motion).map(|(rate, value)| (rate.key(), *value)));
    let mut evaluation = Evaluation::new(&state);
    let mut values = |rows: &[Expr<'_>]| -> Vec<N> { rows.iter().map(|e| evaluation.value(*e)).collect() };
    rows.iter().try_for_each(|rows| agree(Method::Reactions, &values(rows), &expected))?;
    Ok(true)
}
