//! The laws of contact and friction at one instant: forces from Delassus' matrix.
//!
//! With rows of contacts one after the other, of each its normal N, then its tangents T: rates (velocities after an
//! impact, or accelerations) are `u = D λ + b`, and
//!
//! - `0 ≤ λ_N ⊥ u_N ≥ 0` (Signorini),
//! - `|λ_T| ≤ μ λ_N`, and where `u_T ≠ 0`: `λ_T = −μ λ_N u_T/|u_T|` (Coulomb).
//!
//! Of a contact that slides already, the direction ŝ of its friction is known: `λ_T = −μ λ_N ŝ`, whatever u_T is.
//! Friction has up to three rows: two tangents and a spin. Rolling resistance has no normal of its own: its bound is
//! a multiple of the normal force of another contact. Dry friction has none at all, and its bound f in the place of
//! μ λ_N: forces that make `½ λᵀDλ + bᵀλ` least, as Gauss' principle asks, which is the same as `C + Σ f |u_T|`.
//! Friction of several axes is scaled to a circle (`Bounds`).
//!
//! Projected Gauss–Seidel sweeps find which contacts leave, stick and slide; then the equations of these states are
//! solved to rounding, and the laws are checked. States that violate them are corrected by the same rule until they do
//! not change (a semismooth Newton method: P. Alart & A. Curnier 1991). Where that finds nothing, or where friction is
//! so large that solutions need not be unique, all combinations are tried, if they are few.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::real::Real;

use crate::ball::least_in_ball;
use crate::dense::{Matrix, norm, value};
use crate::law::{Law, scales};
use crate::residual::Residual;
use crate::solution::{Failure, Solution, State};

/// The laws of some contacts at an instant.
#[derive(Debug)]
pub(crate) struct Contacts<T = f64> {
    pub(crate) laws: Vec<Law<T>>,
    /// The first row of each.
    first: Vec<usize>,
    pub(crate) matrix: Matrix<T>,
    pub(crate) b: Vec<T>,
    /// To what b is known.
    noise: Vec<f64>,
}

/// Combinations that are tried at most.
const MOST_COMBINATIONS: usize = 4096;
/// Rounds of sweeps, each of twice as many as the one before.
const ROUNDS: u32 = 10;
/// Roundings of each product of a row that its sum may be off by: those of the entries and of the solution.
const ROUNDINGS: f64 = 256.0;

impl<T: Real> Contacts<T> {
    pub(crate) fn new(laws: Vec<Law<T>>, matrix: Matrix<T>, b: Vec<T>) -> Self {
        let scales: Vec<T> = laws.iter().flat_map(scales).collect();
        let b = b.into_iter().zip(&scales).map(|(b, scale)| b * *scale).collect();
        let size = scales.len();
        let matrix = Matrix::from_fn(size, |i, j| matrix.at(i, j) * (scales[i] * scales[j]));
        let rows_before = |i: usize| laws[..i].iter().map(Law::rows).sum();
        let first = (0..laws.len()).map(rows_before).collect();
        Self { laws, first, matrix, b, noise: Vec::new() }
    }

    /// Adds the rounding of b, row by row: laws hold no better than that.
    pub(crate) fn known_to(self, noise: impl Iterator<Item = f64>) -> Self {
        let noise = noise.zip(self.scales()).map(|(noise, scale)| noise * value(scale)).collect();
        Self { noise, ..self }
    }

    /// Factors of all rows by which forces on circles become those of contacts.
    pub(crate) fn scales(&self) -> impl Iterator<Item = T> {
        self.laws.iter().flat_map(scales)
    }

    /// The solution in forces and rates as they are.
    fn unscaled(&self, mut found: Solution<T>) -> Solution<T> {
        for ((force, rate), scale) in found.forces.iter_mut().zip(&mut found.rates).zip(self.scales()) {
            (*force, *rate) = (*force * scale, *rate / scale);
        }
        for (state, law) in found.states.iter_mut().zip(&self.laws) {
            if let State::Slides(along) = state {
                *along = law.bounds.slip_of(*along);
            }
        }
        found
    }

    pub(crate) fn normal(&self, i: usize) -> Option<usize> {
        self.laws[i].has_normal.then(|| self.first[i])
    }

    /// The row of the normal force that bounds friction; none of dry friction.
    pub(crate) fn presses(&self, i: usize) -> Option<usize> {
        self.normal(self.laws[i].on.unwrap_or(i))
    }

    /// Contacts whose friction the normal force of this one bounds, but for its own.
    fn pressed_by(&self, i: usize) -> impl Iterator<Item = usize> {
        (0..self.laws.len()).filter(move |&j| self.laws[j].on == Some(i))
    }

    /// The same problem in other numbers.
    pub(crate) fn in_numbers<U: Real>(&self, number: impl Fn(T) -> U) -> Contacts<U> {
        Contacts {
            laws: self.laws.iter().map(|law| law.in_numbers(&number)).collect(),
            first: self.first.clone(),
            matrix: self.matrix.in_numbers(&number),
            b: self.b.iter().copied().map(&number).collect(),
            noise: self.noise.clone(),
        }
    }

    /// The same problem without derivatives.
    pub(crate) fn values(&self) -> Contacts {
        self.in_numbers(value)
    }

    /// The solution. What contacts do is found by values; forces and directions have the derivatives of the equations
    /// of what they do (implicit functions).
    pub(crate) fn solve(&self) -> Result<Solution<T>, Failure> {
        self.values().on_circles().map(|found| self.followed(found))
    }

    /// The only solution, to rounding, in which a contact sticks.
    pub(crate) fn where_sticks(&self, contact: usize) -> Result<Solution<T>, Failure> {
        let values = self.values();
        let found = values.choices(Some(contact)).map(|choices| values.all(&choices)).unwrap_or_default();
        values.same(contact, found).map(|found| self.followed(found))
    }

    /// A solution in values with its derivatives, in forces and rates as they are.
    fn followed(&self, found: Solution) -> Solution<T> {
        let number = T::from_f64;
        let states = found.states.iter().map(|state| state.in_numbers(number)).collect();
        let (states, forces) = if T::DERIVATIVES {
            self.settled(states)
        } else {
            (states, found.forces.into_iter().map(number).collect())
        };
        self.unscaled(Solution { rates: self.rates(&forces), forces, states, residuals: found.residuals })
    }

    pub(crate) fn tangents(&self, i: usize) -> core::ops::Range<usize> {
        let end = self.first[i] + self.laws[i].rows();
        end - self.laws[i].tangents..end
    }

    fn rates(&self, forces: &[T]) -> Vec<T> {
        (0..self.b.len()).map(|row| self.rate(row, forces)).collect()
    }

    pub(crate) fn rate(&self, row: usize, forces: &[T]) -> T {
        self.matrix.row(row).iter().zip(forces).fold(self.b[row], |sum, (d, force)| d.fma(*force, sum))
    }
}

impl Contacts {
    /// The largest friction of a contact under forces.
    pub(crate) fn largest(&self, i: usize, forces: &[f64]) -> f64 {
        self.laws[i].friction * self.presses(i).map_or(1.0, |normal| Real::max(forces[normal], 0.0))
    }

    /// `|D_TT|` of a contact, the largest of its tangents.
    fn tangent_scale(&self, i: usize) -> f64 {
        self.tangents(i).map(|row| self.matrix.at(row, row)).fold(0.0, f64::max)
    }

    fn on_circles(&self) -> Result<Solution, Failure> {
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        if !(finite(&self.b) && (0..self.b.len()).all(|row| finite(self.matrix.row(row)))) {
            return Err(Failure::NonFinite);
        }
        if let Some(contact) = (0..self.laws.len()).find(|&i| !self.is_regular(i)) {
            // Of directions that are to be found there are too many to try.
            if self.laws[contact].slip.is_some() || self.choices(None).is_some() {
                return self.only(contact);
            }
        }
        // From no forces first: what is squeezed between its contacts could hold itself against any load.
        let mut best = match self.search(vec![0.0; self.b.len()]) {
            Ok(found) => return Ok(found),
            Err(best) => *best,
        };
        let near = match self.all_hold() {
            Ok(found) => return Ok(found),
            Err(near) => near,
        };
        match near.map(|forces| self.search(forces)) {
            Some(Ok(found)) => return Ok(found),
            Some(Err(found)) if found.0.worst() < best.0.worst() => best = *found,
            _ => {}
        }
        match self.choices(None).map(|choices| self.all(&choices)) {
            Some(mut found) if !found.is_empty() => Ok(found.swap_remove(0)),
            _ => self.to_noise(best.1).ok_or(Failure::NotFound(best.0)),
        }
    }

    /// Sweeps from forces and corrections of states; else the best that there was, with its worst residual.
    fn search(&self, mut forces: Vec<f64>) -> Result<Solution, Box<(Residual, Option<Solution>)>> {
        let mut best = (Residual { signorini: f64::INFINITY, ..Residual::default() }, None);
        let rows = self.laws.iter().map(|law| law.tangents).max().unwrap_or(0);
        // Spins and tangents are in units of their own: one step for all rows would be small for some.
        let steps = (0..ROUNDS).map(|round| (round, rows > 2)).chain((0..ROUNDS).map(|round| (round, true)));
        for (round, exactly) in steps.take(if rows == 2 { 2 } else { 1 } * ROUNDS as usize) {
            (0..8 << round).for_each(|_| self.sweep(&mut forces, exactly));
            let mut states = self.states(&forces, &self.rates(&forces));
            for correction in 0..20 {
                let found = self.in_states(states.clone());
                let worst = found.residuals.iter().max_by(|a, b| a.worst().total_cmp(&b.worst()));
                let worst = worst.copied().unwrap_or_default();
                if found.residuals.iter().all(Residual::holds) {
                    return Ok(self.shared(self.unmoved(found)));
                }
                if let Some(found) = (correction == 0).then(|| self.swept(&states, &forces)).flatten() {
                    return Ok(self.shared(self.unmoved(found)));
                }
                let next = self.states(&found.forces, &found.rates);
                if worst.worst() < best.0.worst() {
                    best = (worst, Some(found));
                }
                if core::mem::replace(&mut states, next) == states {
                    break;
                }
            }
        }
        Err(Box::new(best))
    }

    /// A solution that is right to what b is known to.
    fn to_noise(&self, found: Option<Solution>) -> Option<Solution> {
        let mut found = found?;
        for (i, residual) in found.residuals.iter_mut().enumerate() {
            let rows = self.tangents(i).chain(self.normal(i));
            residual.rounding = rows.filter_map(|row| self.noise.get(row)).fold(residual.rounding, |a, b| a.max(*b));
        }
        found.residuals.iter().all(Residual::holds).then_some(found)
    }

    /// The same motion with all contacts that can carry it: where contacts depend on one another, one may leave at
    /// a rate of zero, or its friction may be at its bound, for nothing.
    fn shared(&self, found: Solution) -> Solution {
        let still = |row: usize| found.rates[row].abs() <= self.rounding(row, &found.forces);
        let mut states = found.states.clone();
        for (i, state) in states.iter_mut().enumerate() {
            let free = self.laws[i].tangents > 0 && self.laws[i].slip.is_none();
            match state {
                State::Leaves if self.laws[i].on.is_some() => {}
                State::Leaves if still(self.first[i]) && !free => *state = State::Closed,
                State::Leaves if still(self.first[i]) && self.tangents(i).all(still) => *state = State::Sticks,
                State::Slides(_) if self.tangents(i).all(still) => *state = State::Sticks,
                _ => {}
            }
        }
        // What rolls on one that carries now.
        for (i, law) in self.laws.iter().enumerate() {
            let carried = law.on.is_some_and(|on| states[on] != State::Leaves);
            match law.slip {
                _ if !carried || states[i] != State::Leaves => {}
                Some(_) => states[i] = State::Closed,
                None if self.tangents(i).all(still) => states[i] = State::Sticks,
                None => {}
            }
        }
        if states == found.states {
            return found;
        }
        let shared = self.in_states(states.clone());
        let carries = |i: usize| {
            let normal = self.first[i];
            let pressed = self.matrix.at(normal, normal) * shared.forces[normal];
            self.laws[i].on.is_some()
                || found.states[i] != State::Leaves
                || pressed > self.rounding(normal, &shared.forces)
                || shared.states[i] == State::Leaves
        };
        let all = shared.residuals.iter().all(Residual::holds) && (0..self.laws.len()).all(carries);
        if all { shared } else { self.inside(&states).unwrap_or(found) }
    }

    /// Whether friction of a contact cannot turn the sign of what its normal force does: `D_NN > μ |D_NT|`, or along
    /// a known direction `p = D_NN − μ D_NT ŝ > 0` (P. Painlevé 1895).
    fn is_regular(&self, i: usize) -> bool {
        let Some(normal) = self.normal(i) else { return true };
        let diagonal = self.matrix.at(normal, normal);
        let (mut left, mut terms) = (diagonal, diagonal);
        for j in core::iter::once(i).chain(self.pressed_by(i)) {
            let Law { friction, slip, .. } = self.laws[j];
            let coupling: Vec<f64> = self.tangents(j).map(|row| self.matrix.at(normal, row)).collect();
            let against = match slip {
                Some(slip) => coupling.iter().zip(slip).map(|(d, s)| d * s).sum(),
                None => norm(&coupling),
            };
            left -= friction * against;
            terms += friction * norm(&coupling);
        }
        left > ROUNDINGS * f64::EPSILON * terms || terms == 0.0
    }

    /// Looks for all solutions where they need not be unique: returns the only one, else an error.
    fn only(&self, contact: usize) -> Result<Solution, Failure> {
        let normal = self.first[contact];
        let Some(found) = self.choices(None).map(|choices| self.all(&choices)) else {
            return Err(if self.b[normal] < 0.0 {
                Failure::Inconsistent(contact)
            } else {
                Failure::Indeterminate(contact)
            });
        };
        self.same(contact, found)
    }

    /// One of several solutions with the same rates.
    fn same(&self, contact: usize, mut found: Vec<Solution>) -> Result<Solution, Failure> {
        let Some(first) = found.first() else { return Err(Failure::Inconsistent(contact)) };
        let same = |other: &Solution| {
            let pairs = other.rates.iter().zip(&first.rates).enumerate();
            pairs.into_iter().all(|(row, (a, b))| (a - b).abs() <= 1e3 * self.rounding(row, &first.forces))
        };
        if found.iter().all(same) { Ok(found.swap_remove(0)) } else { Err(Failure::Indeterminate(contact)) }
    }

    /// The states that each contact may have; none where the combinations are too many, or directions are not of finite
    /// number. One of them may be known to stick.
    fn choices(&self, sticks: Option<usize>) -> Option<Vec<Vec<State>>> {
        let of = |(i, law): (usize, &Law)| {
            if sticks == Some(i) {
                return Some(vec![State::Sticks]);
            }
            let mut states = match (law.slip, law.tangents) {
                (Some(_), _) | (None, 0) => vec![State::Closed],
                (None, 1) => vec![State::Sticks, State::Slides([1.0, 0.0, 0.0]), State::Slides([-1.0, 0.0, 0.0])],
                _ => return None,
            };
            if law.has_normal {
                states.insert(0, State::Leaves);
            }
            Some(states)
        };
        let choices: Vec<Vec<State>> = self.laws.iter().enumerate().map(of).collect::<Option<_>>()?;
        let count = choices.iter().try_fold(1_usize, |count, of| count.checked_mul(of.len()));
        count.filter(|count| *count <= MOST_COMBINATIONS).map(|_| choices)
    }

    /// All combinations of states that agree with the laws.
    fn all(&self, choices: &[Vec<State>]) -> Vec<Solution> {
        let count = choices.iter().map(Vec::len).product::<usize>();
        let combination = |mut n: usize| {
            let state = |of: &Vec<State>| {
                let state = of[n % of.len()];
                n /= of.len();
                state
            };
            choices.iter().map(state).collect::<Vec<_>>()
        };
        let solutions = (0..count).map(|n| self.in_states(combination(n)));
        solutions.filter(|found| found.residuals.iter().all(Residual::holds)).collect()
    }

    /// One sweep over the contacts: each force is brought to its cone as if the others stayed; friction by a step that
    /// is short enough for all of its rows, or exactly.
    fn sweep(&self, forces: &mut [f64], exactly: bool) {
        for i in 0..self.laws.len() {
            let Law { friction, slip, .. } = self.laws[i];
            if let Some(normal) = self.normal(i) {
                let diagonal = self.matrix.at(normal, normal);
                let rate = self.rate(normal, forces);
                let effective = match slip {
                    Some(slip) => {
                        let coupled = self.tangents(i).zip(slip).map(|(row, s)| s * self.matrix.at(normal, row));
                        diagonal - friction * coupled.sum::<f64>()
                    }
                    None => diagonal,
                };
                if effective > 0.0 {
                    forces[normal] = Real::max(forces[normal] - rate / effective, 0.0);
                }
            }
            let largest = self.largest(i, forces);
            if let Some(slip) = slip {
                self.tangents(i).zip(slip).for_each(|(row, s)| forces[row] = -largest * s);
                continue;
            }
            let scale = self.matrix_norm(i);
            if exactly && self.laws[i].tangents > 1 {
                let friction = self.friction(i, forces, largest);
                self.tangents(i).zip(friction).for_each(|(row, force)| forces[row] = force);
            } else if scale > 0.0 {
                let rates: Vec<f64> = self.tangents(i).map(|row| self.rate(row, forces)).collect();
                let wanted: Vec<f64> =
                    self.tangents(i).zip(&rates).map(|(row, rate)| forces[row] - rate / scale).collect();
                let size = norm(&wanted);
                let part = if size > largest { largest / size } else { 1.0 };
                self.tangents(i).zip(&wanted).for_each(|(row, force)| forces[row] = part * force);
            }
        }
    }

    /// The friction of a contact that would be right if other forces stayed.
    fn friction(&self, i: usize, forces: &[f64], largest: f64) -> Vec<f64> {
        let rows = self.tangents(i);
        let block = Matrix::from_fn(rows.len(), |a, b| self.matrix.at(rows.start + a, rows.start + b));
        let others = |row: usize| {
            rows.clone().fold(self.rate(row, forces), |rate, j| self.matrix.at(row, j).fma(-forces[j], rate))
        };
        let rates: Vec<f64> = rows.clone().map(others).collect();
        least_in_ball(&block, &rates, largest)
    }

    /// A bound of the tangential block of a contact.
    fn matrix_norm(&self, i: usize) -> f64 {
        self.tangents(i).map(|row| self.matrix.at(row, row)).sum()
    }

    /// States of the contacts, judged by forces and rates.
    fn states(&self, forces: &[f64], rates: &[f64]) -> Vec<State> {
        let state = |i: usize| {
            let law = self.laws[i];
            let (diagonal, pressed) = self.presses(i).map_or((1.0, 1.0), |normal| {
                let diagonal = self.matrix.at(normal, normal);
                (diagonal, diagonal * forces[normal] - rates[normal])
            });
            if pressed <= 0.0 {
                return State::Leaves;
            }
            if law.tangents == 0 || law.slip.is_some() {
                return State::Closed;
            }
            let scale = self.tangent_scale(i);
            let wanted: Vec<f64> = self.tangents(i).map(|row| scale * forces[row] - rates[row]).collect();
            let size = norm(&wanted);
            if size * diagonal <= law.friction * pressed * scale || size == 0.0 {
                return State::Sticks;
            }
            State::Slides(core::array::from_fn(|k| wanted.get(k).map_or(0.0, |w| -w / size)))
        };
        (0..self.laws.len()).map(state).collect()
    }

    /// The solution in given states, with its residuals.
    pub(crate) fn in_states(&self, states: Vec<State>) -> Solution {
        let (states, forces) = self.settled(states);
        self.with_residuals(states, forces)
    }

    pub(crate) fn with_residuals(&self, states: Vec<State>, forces: Vec<f64>) -> Solution {
        let rates = self.rates(&forces);
        let shared = self.shared_rounding(&forces);
        let residuals = (0..self.laws.len()).map(|i| self.residual(i, &forces, &rates, shared)).collect();
        Solution { forces, rates, states, residuals }
    }

    /// Rounding of the rate of a row.
    pub(crate) fn rounding(&self, row: usize, forces: &[f64]) -> f64 {
        let terms = self.matrix.row(row).iter().zip(forces).map(|(d, force)| (d * force).abs());
        ROUNDINGS * (1 + self.b.len()) as f64 * f64::EPSILON * terms.fold(self.b[row].abs(), |sum, term| sum + term)
    }

    /// The rounding of the worst row, over `√D_ii`: in the norm of energy the motion is known no better than that, and
    /// the rate of a row is its product with a row of length `√D_ii`.
    fn shared_rounding(&self, forces: &[f64]) -> f64 {
        let over = |row: usize| (self.length(row) > 0.0).then(|| self.rounding(row, forces) / self.length(row));
        (0..self.b.len()).filter_map(over).fold(0.0, f64::max)
    }

    fn length(&self, row: usize) -> f64 {
        Real::sqrt(self.matrix.at(row, row))
    }

    fn residual(&self, i: usize, forces: &[f64], rates: &[f64], shared: f64) -> Residual {
        let law = self.laws[i];
        let signorini = self
            .normal(i)
            .map_or(0.0, |normal| Real::min(rates[normal], self.matrix.at(normal, normal) * forces[normal]).abs());
        let rows = self.first[i]..self.tangents(i).end;
        let of_row = |row: usize| self.rounding(row, forces).max(shared * self.length(row));
        let rounding = rows.map(of_row).fold(0.0, f64::max);
        let scale = self.tangent_scale(i);
        let friction: Vec<f64> = self.tangents(i).map(|row| scale * forces[row]).collect();
        let largest = scale * self.largest(i, forces);
        let coulomb = Real::max(norm(&friction) - largest, 0.0);
        let wanted: Vec<f64> = match law.slip {
            Some(slip) => slip.iter().take(law.tangents).map(|s| -largest * s).collect(),
            None => {
                let pushed: Vec<f64> = self.tangents(i).zip(&friction).map(|(row, f)| f - rates[row]).collect();
                let size = norm(&pushed);
                let part = if size > largest { largest / size } else { 1.0 };
                pushed.iter().map(|f| part * f).collect()
            }
        };
        let off: Vec<f64> = friction.iter().zip(&wanted).map(|(f, w)| f - w).collect();
        Residual { signorini, coulomb, dissipation: norm(&off), rounding }
    }
}

#[cfg(test)]
#[path = "solver_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "enumeration_tests.rs"]
mod enumeration_tests;

#[cfg(test)]
#[path = "convex_tests.rs"]
mod convex_tests;
