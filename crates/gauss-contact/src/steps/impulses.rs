//! Impulses of a step that satisfy the laws of Signorini and Coulomb, found in memory that is given.
//!
//! Rates after the step are `u = D P + b`. Of each contact that acts `0 ≤ P_N ⊥ u_N ≥ 0`, `|P_T| ≤ μ P_N`, and where
//! `u_T ≠ 0`: `P_T = −μ P_N u_T/|u_T|`; dry friction has its bound in the place of μ P_N. A semismooth Newton method
//! (P. Alart & A. Curnier 1991) begins with the impulses of the step before: contacts leave, stick or slide as these
//! say, the equations of these states are linear but for directions of slip, and their solution tells the next states.
//! Where that comes to no end, projected Gauss–Seidel sweeps (J. J. Moreau) bring the impulses nearer first.
//!
//! Contacts may depend on one another: a small multiple of the diagonal pulls towards the impulses before (a proximal
//! point), which at the end of the iteration are the solution. Of impulses that are not unique these are near to those
//! of the step before. Coulomb's law may have several solutions with other rates as well; one of them is found.

use core::ops::Range;

use crate::mode::Mode;
use crate::residual::Residual;

use super::cones::Cone;
use super::linear::{Place, dot, dot_and_size, solve, solve_symmetric, stride};
use super::unknowns::{State, UnknownsIn};

/// By what part of the diagonal impulses are pulled towards those before at first, where contacts depend on one
/// another. What cannot stick all at once, as two corners that an impact parts, or cannot all stay closed, drifts to
/// the bound of its friction or to zero by the inverse of that; corrections that gain nothing pull less, those that go
/// too far more.
const PULL: f64 = 1e-5;
const LEAST_PULL: f64 = 1e-9;
const MOST_PULL: f64 = 1e-3;
/// What is looked for at first, as a part of the tolerance.
const STRICT: f64 = 1e-4;
/// Rounds of sweeps and corrections.
const ROUNDS: u32 = 11;
/// Corrections of a round.
const CORRECTIONS: usize = 60;
/// Roundings of each product of a row that its sum may be off by.
const ROUNDINGS: f64 = 64.0;

/// How a solution was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Found {
    /// The worst of all contacts.
    pub(crate) residual: Residual,
    /// Whether it is within the tolerance.
    pub(crate) holds: bool,
    /// How many corrections and sweeps there were.
    pub(crate) corrections: u32,
    pub(crate) sweeps: u32,
}

/// The laws of a step in memory. All but `matrix` and `right` is for all rows of the system.
pub(crate) struct Impulses<'m> {
    /// D, row by row.
    pub(crate) delassus: &'m mut [f64],
    pub(crate) b: &'m mut [f64],
    /// P; what it holds is where the search begins.
    pub(crate) impulses: &'m mut [f64],
    /// u.
    pub(crate) rates: &'m mut [f64],
    /// The sizes of the terms of each rate.
    pub(super) terms: &'m mut [f64],
    pub(super) best: &'m mut [f64],
    pub(super) swept: &'m mut [f64],
    pub(super) solution: &'m mut [f64],
    pub(super) right: &'m mut [f64],
    pub(super) matrix: &'m mut [f64],
    /// Rows of the unknowns.
    pub(super) unknown: &'m mut [Place],
    pub(super) order: &'m mut [Place],
    pub(super) states: &'m mut [State],
    /// Of each row of D, where its first entry is that is not zero, and where the last is behind.
    pub(super) extents: &'m mut [[Place; 2]],
    /// Whether contacts depend on one another, as far as is known.
    pub(crate) dependent: bool,
    /// Whether the law is the convex relaxation of Coulomb's.
    pub(crate) relaxed: bool,
    pub(super) pull: f64,
    /// Whether the factors are those of a symmetric matrix.
    pub(super) symmetric: bool,
}

impl<'m> Impulses<'m> {
    /// How many numbers it needs for so many rows.
    pub(crate) const fn memory(rows: usize) -> usize {
        rows * rows + stride(rows) * (rows + 1) + 7 * rows
    }

    pub(crate) fn new(
        memory: &'m mut [f64],
        UnknownsIn { rows: unknown, order, extents, states }: UnknownsIn<'m>,
    ) -> Self {
        let rows = unknown.len();
        let (delassus, memory) = memory.split_at_mut(rows * rows);
        let (matrix, memory) = memory.split_at_mut(rows * stride(rows));
        let (solution, memory) = memory.split_at_mut(stride(rows));
        let (b, memory) = memory.split_at_mut(rows);
        let (impulses, memory) = memory.split_at_mut(rows);
        let (rates, memory) = memory.split_at_mut(rows);
        let (terms, memory) = memory.split_at_mut(rows);
        let (best, memory) = memory.split_at_mut(rows);
        let (swept, memory) = memory.split_at_mut(rows);
        let right = &mut memory[..rows];
        Self {
            delassus,
            b,
            impulses,
            rates,
            terms,
            best,
            swept,
            solution,
            right,
            matrix,
            unknown,
            order,
            states,
            extents,
            dependent: false,
            relaxed: false,
            pull: 0.0,
            symmetric: false,
        }
    }

    /// A problem of so many rows: D, and for each row its rate without impulses and the impulse to begin with. Rows of
    /// friction are scaled to circles.
    pub(crate) fn set_up(
        &mut self,
        scales: &[f64],
        delassus: impl Fn(usize, usize) -> f64,
        row: impl Fn(usize) -> [f64; 2],
    ) {
        let n = self.b.len();
        for i in 0..n {
            let [rate, impulse] = row(i);
            (self.b[i], self.impulses[i]) = (scales[i] * rate, impulse / scales[i]);
            let row = &mut self.delassus[i * n..(i + 1) * n];
            // D is symmetric, column after column.
            row.iter_mut()
                .zip(scales)
                .enumerate()
                .for_each(|(j, (entry, scale))| *entry = scales[i] * delassus(j, i) * scale);
            let is_zero = |x: &f64| *x == 0.0;
            let from = row.iter().position(|x| !is_zero(x)).unwrap_or(0);
            self.extents[i] =
                [from, row.iter().rposition(|x| !is_zero(x)).map_or(from, |last| last + 1)].map(|k| k as Place);
        }
    }

    /// The rows that act on a row.
    fn extent(&self, row: usize) -> Range<usize> {
        let [from, to] = self.extents[row];
        usize::from(from)..usize::from(to)
    }

    /// What impulses are multiplied with in a row, from the first that acts on it to the last; with these.
    fn row(&self, row: usize) -> [&[f64]; 2] {
        let (n, extent) = (self.b.len(), self.extent(row));
        [&self.delassus[row * n..(row + 1) * n][extent.clone()], &self.impulses[extent]]
    }

    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.delassus[i * self.b.len() + j]
    }

    pub(super) fn rate(&self, row: usize) -> f64 {
        let [row_of, impulses] = self.row(row);
        self.b[row] + dot(row_of, impulses)
    }

    /// The rates of the rows that act, with their terms.
    fn update(&mut self, cones: &[Cone]) {
        for row in cones.iter().flat_map(Cone::rows) {
            let [row_of, impulses] = self.row(row);
            let (sum, size) = dot_and_size(row_of, impulses);
            (self.rates[row], self.terms[row]) = (self.b[row] + sum, self.b[row].abs() + size);
        }
    }

    /// The largest diagonal entry of friction.
    pub(super) fn scale(&self, cone: &Cone) -> f64 {
        cone.tangents().map(|row| self.at(row, row)).fold(0.0, f64::max)
    }

    /// `d P_T − u_T`, at most three, and its length.
    fn wanted(&self, cone: &Cone, scale: f64) -> ([f64; 3], f64) {
        let mut wanted = [0.0; 3];
        for (wanted, row) in wanted.iter_mut().zip(cone.tangents()) {
            *wanted = scale * self.impulses[row] - self.rates[row];
        }
        (wanted, norm(&wanted))
    }

    /// The rate that is zero where a gap is closed: that of the gap, or of the relaxed law less what slips take.
    fn closing(&self, cones: &[Cone], row: usize) -> f64 {
        if self.relaxed { self.rates[row] - self.lift(cones, row) } else { self.rates[row] }
    }

    /// What a contact does, judged by impulses and rates.
    fn state(&self, cones: &[Cone], cone: &Cone) -> State {
        if !cone.acts {
            return State::Leaves;
        }
        let pressing = |row: usize| self.impulses[row] - self.closing(cones, row) / self.at(row, row);
        let pressed = cone.pressed.map_or(1.0, pressing);
        if pressed <= 0.0 {
            return State::Leaves;
        }
        let scale = self.scale(cone);
        if cone.count == 0 || cone.friction == 0.0 || scale == 0.0 {
            return State::Closed;
        }
        let (wanted, size) = self.wanted(cone, scale);
        let largest = cone.friction * pressed * scale;
        if size <= largest {
            return State::Sticks;
        }
        State::Slides(wanted.map(|x| x / size), largest / size)
    }

    /// What a contact does, in forces and slips as they are: rows were scaled. Slips within the tolerance are none.
    pub(crate) fn mode(&self, cones: &[Cone], cone: &Cone, scales: &[f64], tolerance: f64) -> Mode {
        let terms = cone.tangents().map(|row| self.terms[row]).fold(0.0, f64::max);
        let slip = cone.tangents().map(|row| self.rates[row].abs()).fold(0.0, f64::max);
        match self.state(cones, cone) {
            State::Slides(..) if slip <= tolerance * terms => Mode::Sticks,
            State::Leaves => Mode::Open,
            State::Closed => Mode::Closed,
            State::Sticks => Mode::Sticks,
            State::Slides(against, _) => {
                let mut along = [0.0; 3];
                along.iter_mut().zip(cone.tangents()).zip(against).for_each(|((x, row), y)| *x = -y / scales[row]);
                let size = norm(&along);
                Mode::Slides(along.map(|x| x / size))
            }
        }
    }

    /// Finds the impulses; contacts that others press closed, judged by their number and rate, take part as well.
    pub(crate) fn solve_with_more(
        &mut self,
        cones: &mut [Cone],
        tolerance: f64,
        closes: impl Fn(usize, f64) -> bool,
    ) -> Found {
        let mut found = Found::default();
        loop {
            let next = self.solve(cones, tolerance);
            let (corrections, sweeps) = (found.corrections + next.corrections, found.sweeps + next.sweeps);
            found = Found { corrections, sweeps, ..next };
            let mut more = false;
            for i in 0..cones.len() {
                let Cone { normal, pressed, acts, .. } = cones[i];
                let joins = match normal {
                    Some(normal) => closes(i, self.rates[normal]),
                    None => cones.iter().any(|cone| cone.acts && pressed.is_some() && cone.normal == pressed),
                };
                if !acts && joins {
                    cones[i].acts = true;
                    more = true;
                }
            }
            if !more {
                return found;
            }
        }
    }

    /// The work of the impulses: half of the rates before and after them, times these. Rates before are given without
    /// what impacts pass on.
    pub(crate) fn work(&self, before: impl Fn(usize) -> f64) -> f64 {
        let work = |row: usize| self.impulses[row] * (before(row) + 0.5 * (self.rates[row] - self.b[row]));
        (0..self.b.len()).map(work).sum()
    }

    /// Finds the impulses from those that are there.
    pub(crate) fn solve(&mut self, cones: &[Cone], tolerance: f64) -> Found {
        let mut found = Found::default();
        for row in cones.iter().filter(|cone| !cone.acts).flat_map(|cone| cone.rows()) {
            self.impulses[row] = 0.0;
        }
        self.update(cones);
        self.best.copy_from_slice(self.impulses);
        if !cones.iter().any(|cone| cone.acts) {
            found.holds = true;
            return found;
        }
        // Also where those of the step before satisfy the laws within the tolerance: what rests is to rest exactly.
        for round in 0..ROUNDS {
            // From the impulses of the step before; from none, since dependent contacts may press against one another
            // up to the bounds of their friction; then from sweeps that go on from where they were.
            if round == 1 {
                self.swept.fill(0.0);
            }
            if round > 0 {
                self.impulses.copy_from_slice(self.swept);
                let sweeps = if round == 1 { 0 } else { 4 << round };
                (0..sweeps).for_each(|_| if self.relaxed { self.sweep_convex(cones) } else { self.sweep(cones) });
                found.sweeps += sweeps;
                self.swept.copy_from_slice(self.impulses);
                self.update(cones);
            }
            self.pull = PULL;
            if self.correct(cones, STRICT * tolerance, &mut found) {
                return found;
            }
            if found.corrections == 0 {
                (found.residual, found.holds) = self.worst(cones, tolerance);
            }
            // Where contacts depend on one another rates of places that moved agree only to the order of the step.
            if round > 0 {
                self.impulses.copy_from_slice(self.best);
                self.update(cones);
                (found.residual, found.holds) = self.worst(cones, tolerance);
                if found.holds {
                    return found;
                }
            }
        }
        found
    }

    /// Newton's method; whether it ends with a solution.
    fn correct(&mut self, cones: &[Cone], tolerance: f64, found: &mut Found) -> bool {
        let states = core::mem::take(&mut self.states);
        let solved = self.correct_in(states, cones, (tolerance, found));
        self.states = states;
        solved
    }

    fn correct_in(&mut self, states: &mut [State], cones: &[Cone], (tolerance, found): (f64, &mut Found)) -> bool {
        states.fill(State::Leaves);
        let mut known = 0;
        let (mut last, mut changed) = (f64::INFINITY, false);
        for n in 0..CORRECTIONS {
            let mut same = n > 0 && !changed;
            for (state, cone) in states.iter_mut().zip(cones) {
                let next = self.state(cones, cone);
                same &= state.is_as(&next);
                *state = next;
            }
            if !same {
                let found = self.factors(cones, states).or_else(|| {
                    let again = !core::mem::replace(&mut self.dependent, true);
                    again.then(|| self.factors(cones, states)).flatten()
                });
                match found {
                    Some(count) => known = count,
                    None => return false,
                }
            }
            self.right_sides(cones, states, known);
            let (factors, order, right) = (&*self.matrix, &self.order[..known], &self.right[..known]);
            match self.symmetric {
                true => solve_symmetric(factors, order, right, self.solution),
                false => solve(factors, order, right, &mut self.solution[..known]),
            }
            self.impulses.fill(0.0);
            (0..known).for_each(|k| self.impulses[usize::from(self.unknown[k])] = self.solution[k]);
            self.update(cones);
            found.corrections += 1;
            let (residual, holds) = self.worst(cones, tolerance);
            let size = residual.worst();
            if n == 0 || size < found.residual.worst() || holds {
                (found.residual, found.holds) = (residual, holds);
                self.best.copy_from_slice(self.impulses);
            }
            if holds {
                return true;
            }
            if !size.is_finite() || (n > 12 && !self.dependent) {
                return false;
            }
            let pull = self.pull;
            if size > 3.0 * last {
                self.pull = (10.0 * pull).min(MOST_PULL);
            } else if size > 0.3 * last {
                self.pull = (0.1 * pull).max(LEAST_PULL);
            }
            changed = self.dependent && self.pull != pull;
            last = size;
        }
        false
    }

    /// One sweep over the contacts: each impulse is brought to its cone as if the others stayed.
    fn sweep(&mut self, cones: &[Cone]) {
        for cone in cones.iter().filter(|cone| cone.acts) {
            if let Some(normal) = cone.normal {
                let diagonal = self.at(normal, normal);
                if diagonal > 0.0 {
                    self.impulses[normal] = (self.impulses[normal] - self.rate(normal) / diagonal).max(0.0);
                }
            }
            let scale: f64 = cone.tangents().map(|row| self.at(row, row)).sum();
            if scale > 0.0 {
                let largest = cone.radius(self.impulses);
                let mut wanted = [0.0; 3];
                for (wanted, row) in wanted.iter_mut().zip(cone.tangents()) {
                    *wanted = self.impulses[row] - self.rate(row) / scale;
                }
                let size = norm(&wanted);
                let part = if size > largest { largest / size } else { 1.0 };
                cone.tangents().zip(wanted).for_each(|(row, impulse)| self.impulses[row] = part * impulse);
            }
        }
    }

    /// The worst residuals, and whether they are within the tolerance, a part of the largest rate, or rounding.
    fn worst(&self, cones: &[Cone], tolerance: f64) -> (Residual, bool) {
        self.worst_by(cones, tolerance, |row| self.closing(cones, row))
    }

    /// The worst residuals of Coulomb's law, whatever law the impulses satisfy.
    pub(crate) fn residual_of_coulomb(&self, cones: &[Cone]) -> Residual {
        self.worst_by(cones, 0.0, |row| self.rates[row]).0
    }

    /// The same by given rates of the gaps.
    fn worst_by(&self, cones: &[Cone], tolerance: f64, closing: impl Fn(usize) -> f64) -> (Residual, bool) {
        let acting = || cones.iter().filter(|cone| cone.acts);
        let rows = || acting().flat_map(|cone| cone.rows());
        let largest = rows().map(|row| self.terms[row]).fold(0.0, f64::max);
        let rounding = ROUNDINGS * (1 + self.b.len()) as f64 * f64::EPSILON;
        let mut worst = Residual::default();
        let mut holds = true;
        for cone in acting() {
            let residual = self.residual(cone, rounding, &closing);
            // Written so that what is not a number does not hold.
            holds &= residual.worst() <= residual.rounding.max(tolerance * largest);
            worst = worst.worse(residual);
        }
        (worst, holds)
    }

    fn residual(&self, cone: &Cone, rounding: f64, closing: impl Fn(usize) -> f64) -> Residual {
        let pressed = cone.normal.map_or(0.0, |row| self.at(row, row) * self.impulses[row]);
        let signorini = cone.normal.map_or(0.0, |row| nan_or(closing(row), f64::min, pressed).abs());
        let scale = self.scale(cone);
        let terms = cone.rows().map(|row| self.terms[row]).fold(0.0, f64::max);
        let mut residual = Residual { signorini, rounding: rounding * terms, ..Residual::default() };
        if cone.count > 0 {
            let largest = scale * cone.radius(self.impulses);
            let mut friction = [0.0; 3];
            friction.iter_mut().zip(cone.tangents()).for_each(|(x, row)| *x = scale * self.impulses[row]);
            residual.coulomb = nan_or(norm(&friction) - largest, f64::max, 0.0);
            let (wanted, size) = self.wanted(cone, scale);
            let part = if size > largest { largest / size } else { 1.0 };
            let off: [f64; 3] = core::array::from_fn(|k| friction[k] - part * wanted[k]);
            residual.dissipation = norm(&off);
        }
        residual
    }
}

/// The smaller or larger of two; NaN where there is one.
fn nan_or(a: f64, choose: fn(f64, f64) -> f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { choose(a, b) }
}

pub(super) fn norm(x: &[f64; 3]) -> f64 {
    gauss_runtime::real::Real::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])
}

#[cfg(test)]
#[path = "impulses_tests.rs"]
pub(super) mod tests;
