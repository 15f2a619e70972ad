//! Contacts that depend on one another: whether any of their forces are inside the bounds of the laws.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::real::Real;

use crate::dense::size;
use crate::law::Law;
use crate::reserve::{Margin, Reserve, deepest};
use crate::residual::Residual;
use crate::solution::{Solution, State};
use crate::solver::Contacts;

/// Roundings of a row to which the slip of a contact that begins to slide is known. Where directions miss those of
/// slips of rate u by δ, δu is rounding, and friction of contacts whose directions differ by δ is less by a part of
/// δ²/2: u is known to the power 2/3 of a rounding ρ, ρ^(−1/3) roundings of ρ = 10⁻¹² of a row.
const SLOW: f64 = 1e4;
/// Roundings to which forces that are as far inside their bounds as they can be are found.
const INSIDE: f64 = 16.0;

impl<T: Real> Contacts<T> {
    /// The forces that make the rates of all contacts zero but the slips of those that slide already.
    pub(crate) fn stops(&self) -> Vec<T> {
        let forces = self.forces_in(&self.held());
        forces.into_iter().zip(self.scales()).map(|(force, scale)| force * scale).collect()
    }

    /// All stay closed, and those that do not slide already stick.
    fn held(&self) -> Vec<State<T>> {
        let state = |law: &Law<T>| match law.slip {
            None if law.tangents > 0 => State::Sticks,
            _ => State::Closed,
        };
        self.laws.iter().map(state).collect()
    }
}

impl Contacts {
    /// The solution in which all contacts that need not slide stick, where they depend on one another; else forces to
    /// look for another one from, if there are some.
    pub(crate) fn all_hold(&self) -> Result<Solution, Option<Vec<f64>>> {
        let states = self.held();
        if self.equations(&states).factors.is_regular() {
            return Err(None);
        }
        let found = self.in_states(states.clone());
        if found.residuals.iter().all(Residual::holds) {
            return Ok(found);
        }
        self.inside(&states).ok_or_else(|| self.reserve(&states).map(|reserve| reserve.forces))
    }

    /// The solution in the states that sweeps end in, where contacts depend on one another and forces of least norm
    /// break a law: whether others keep it is told by those of the sweeps, which are in their cones.
    pub(crate) fn swept(&self, states: &[State], forces: &[f64]) -> Option<Solution> {
        let equations = self.equations(states);
        if equations.factors.is_regular() {
            return None;
        }
        let mut forces = forces.to_vec();
        for (i, state) in states.iter().enumerate() {
            match state {
                State::Leaves => self.tangents(i).chain(self.normal(i)).for_each(|row| forces[row] = 0.0),
                State::Slides(along) => {
                    let largest = self.largest(i, &forces);
                    self.tangents(i).zip(along).for_each(|(row, part)| forces[row] = -largest * part);
                }
                State::Closed | State::Sticks => {}
            }
        }
        (0..2).for_each(|_| self.correct(&equations, &mut forces));
        let found = self.with_residuals(states.to_vec(), forces);
        let holds = found.residuals.iter().all(Residual::holds);
        holds.then(|| self.inside(states).unwrap_or(found))
    }

    /// The solution in these states by forces inside their cones, where there are several and some are.
    pub(crate) fn inside(&self, states: &[State]) -> Option<Solution> {
        self.deepest(states).filter(|found| found.residuals.iter().all(Residual::holds))
    }

    /// The forces in these states that are as far inside their cones as they can be, where there are several.
    fn deepest(&self, states: &[State]) -> Option<Solution> {
        let Reserve { near: mut forces, .. } = self.reserve(states)?;
        self.correct(&self.equations(states), &mut forces);
        Some(self.with_residuals(states.to_vec(), forces))
    }

    /// The solution in which slips do not begin that would begin no faster than that is known, where bounds are kept to
    /// as much.
    pub(crate) fn unmoved(&self, found: Solution) -> Solution {
        let slow = |row: usize| found.rates[row].abs() <= SLOW * self.rounding(row, &found.forces);
        let mut states = found.states.clone();
        for (i, state) in states.iter_mut().enumerate() {
            if matches!(state, State::Slides(_)) && self.tangents(i).all(slow) {
                *state = State::Sticks;
            }
        }
        if states == found.states {
            return found;
        }
        let known = |mut found: Solution| {
            found.residuals.iter_mut().for_each(|residual| residual.rounding *= INSIDE);
            found.residuals.iter().all(Residual::holds).then_some(found)
        };
        known(self.in_states(states.clone())).or_else(|| known(self.deepest(&states)?)).unwrap_or(found)
    }

    /// The forces in these states that are deepest inside; none where there is one solution alone.
    pub(crate) fn reserve(&self, states: &[State]) -> Option<Reserve> {
        let equations = self.equations(states);
        if equations.factors.is_regular() {
            return None;
        }
        let unknown = equations.factors.free();
        let row = |direction: Vec<f64>| {
            let mut forces = vec![0.0; self.matrix.size()];
            for (x, with) in direction.iter().zip(&equations.with) {
                with.iter().for_each(|(row, part)| forces[*row] += part * x);
            }
            forces
        };
        let free: Vec<Vec<f64>> = unknown.into_iter().map(row).collect();
        let given = self.forces_in(states);
        let scale = |row: usize| Real::sqrt(self.matrix.at(row, row));
        let mut margins = Vec::new();
        for (i, state) in states.iter().enumerate().filter(|(_, state)| **state != State::Leaves) {
            let (normal, tangents) = (self.normal(i), self.tangents(i));
            if let Some(normal) = normal {
                let presses = Some((normal, 1.0));
                margins.push((i, Margin { constant: 0.0, presses, tangents: 0..0, scale: scale(normal) }));
            }
            if *state == State::Sticks {
                let friction = self.laws[i].friction;
                let presses = self.presses(i).map(|normal| (normal, friction));
                let (constant, unit) = match presses {
                    Some((normal, _)) => (0.0, normal),
                    None => (friction, tangents.start),
                };
                margins.push((i, Margin { constant, presses, tangents, scale: scale(unit) }));
            }
        }
        // What nothing can move bears any force.
        margins.retain(|(_, margin)| margin.scale > 0.0);
        let (owners, margins): (Vec<usize>, Vec<Margin>) = margins.into_iter().unzip();
        let scaled: Vec<f64> = given.iter().enumerate().map(|(row, force)| scale(row) * force).collect();
        let size = size(&scaled);
        (size > 0.0).then(|| {
            let found = deepest(&given, &free, &margins, size);
            let of =
                |i: usize| owners.iter().zip(&found.weights).filter(|(owner, _)| **owner == i).map(|(_, w)| w).sum();
            Reserve { weights: (0..self.laws.len()).map(of).collect(), ..found }
        })
    }
}

#[cfg(test)]
#[path = "sticking_tests.rs"]
mod tests;
