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

use gauss_runtime::real::Real;

use crate::lockstep::{Lockstep, larger, last};
use crate::mode::Mode;
use crate::residual::Residual;

use super::cones::Cone;
use super::linear::{Place, dot, dot_and_size, solve, solve_symmetric, stride};
use super::pull::{Drift, Pull};
use super::unknowns::{State, UnknownsIn};

/// Residual that is looked for at first, as a part of the tolerance.
pub(super) const STRICT: f64 = 1e-4;
/// Corrections of a round.
const CORRECTIONS: usize = 60;
/// Roundings of each product of a row that its sum may be off by.
const ROUNDINGS: f64 = 64.0;

/// Account of how a solution was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Found<T = f64> {
    /// The worst of all contacts.
    pub(crate) residual: Residual<T>,
    /// Whether it is within the tolerance.
    pub(crate) holds: bool,
    /// Number of corrections and sweeps.
    pub(crate) corrections: u32,
    pub(crate) sweeps: u32,
}

impl<T: Real> Found<T> {
    /// The account of one lane.
    pub(super) fn lane(&self, lane: usize) -> Found {
        let Self { residual, holds, corrections, sweeps } = *self;
        Found { residual: residual.lane(lane), holds, corrections, sweeps }
    }

    fn none() -> Self {
        Self { residual: Residual::zero(), holds: false, corrections: 0, sweeps: 0 }
    }
}

/// The laws of a step in memory. All but `matrix` and `right` is for all rows of the system.
pub(crate) struct Impulses<'m, T = f64> {
    /// D, row by row.
    pub(crate) delassus: &'m mut [T],
    pub(crate) b: &'m mut [T],
    /// P; what it holds is where the search begins.
    pub(crate) impulses: &'m mut [T],
    /// u.
    pub(crate) rates: &'m mut [T],
    /// The sizes of the terms of each rate.
    pub(super) terms: &'m mut [T],
    pub(super) best: &'m mut [T],
    pub(super) swept: &'m mut [T],
    pub(super) solution: &'m mut [T],
    pub(super) right: &'m mut [T],
    pub(super) matrix: &'m mut [T],
    /// Rows of the unknowns.
    pub(super) unknown: &'m mut [Place],
    pub(super) order: &'m mut [Place],
    pub(super) states: &'m mut [State<T>],
    /// Places, in each row of D, of the first entry that is not zero, and behind the last.
    pub(super) extents: &'m mut [[Place; 2]],
    /// Whether contacts depend on one another, as far as is known.
    pub(crate) dependent: bool,
    /// Whether the law is the convex relaxation of Coulomb's.
    pub(crate) relaxed: bool,
    pub(super) pull: Pull,
    /// Whether the factors are those of a symmetric matrix.
    pub(super) symmetric: bool,
    pub(crate) lockstep: Lockstep,
}

/// Number of numbers that [`Impulses`] need for so many rows.
pub(crate) const fn memory(rows: usize) -> usize {
    rows * rows + stride(rows) * (rows + 1) + 7 * rows
}

impl<'m, T: Real> Impulses<'m, T> {
    pub(crate) fn new(
        memory: &'m mut [T],
        UnknownsIn { rows: unknown, order, extents, states }: UnknownsIn<'m, T>,
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
            pull: Pull::new(Drift::Short),
            symmetric: false,
            lockstep: Lockstep::default(),
        }
    }

    /// A problem of so many rows: D, and for each row its rate without impulses and the impulse to begin with. Rows of
    /// friction are scaled to circles.
    pub(crate) fn set_up(&mut self, scales: &[T], delassus: impl Fn(usize, usize) -> T, row: impl Fn(usize) -> [T; 2]) {
        let n = self.b.len();
        for i in 0..n {
            let [rate, impulse] = row(i);
            (self.b[i], self.impulses[i]) = (scales[i] * rate, impulse / scales[i]);
            let row = &mut self.delassus[i * n..(i + 1) * n];
            // D is symmetric, column after column.
            row.iter_mut()
                .zip(scales)
                .enumerate()
                .for_each(|(j, (entry, scale))| *entry = scales[i] * delassus(j, i) * *scale);
            let from = last(&self.lockstep, (0..n).rev(), row).unwrap_or(0);
            self.extents[i] = [from, last(&self.lockstep, 0..n, row).map_or(from, |last| last + 1)].map(|k| k as Place);
        }
    }

    /// The rows that act on a row.
    fn extent(&self, row: usize) -> Range<usize> {
        let [from, to] = self.extents[row];
        usize::from(from)..usize::from(to)
    }

    /// Factors of impulses in a row, from the first that acts on it to the last; with these impulses.
    fn row(&self, row: usize) -> [&[T]; 2] {
        let (n, extent) = (self.b.len(), self.extent(row));
        [&self.delassus[row * n..(row + 1) * n][extent.clone()], &self.impulses[extent]]
    }

    pub(super) fn at(&self, i: usize, j: usize) -> T {
        self.delassus[i * self.b.len() + j]
    }

    pub(super) fn rate(&self, row: usize) -> T {
        let [row_of, impulses] = self.row(row);
        self.b[row] + dot(row_of, impulses)
    }

    /// The rates of the rows that act, with their terms.
    pub(super) fn update(&mut self, cones: &[Cone<T>]) {
        for row in cones.iter().flat_map(Cone::rows) {
            let [row_of, impulses] = self.row(row);
            let (sum, size) = dot_and_size(row_of, impulses);
            (self.rates[row], self.terms[row]) = (self.b[row] + sum, self.b[row].abs() + size);
        }
    }

    /// The largest diagonal entry of friction.
    pub(super) fn scale(&self, cone: &Cone<T>) -> T {
        cone.tangents().map(|row| self.at(row, row)).fold(T::zero(), larger)
    }

    /// Whether impulses change the rate of a row: not where a constraint drives it, nor where its slip is none at all.
    pub(super) fn moves(&self, row: usize) -> bool {
        self.lockstep.less(T::zero(), self.at(row, row))
    }

    /// Whether no impulse changes a slip.
    pub(super) fn is_driven(&self, cone: &Cone<T>) -> bool {
        cone.count > 0 && !cone.tangents().any(|row| self.moves(row))
    }

    /// The state of a slip that no impulse changes, by its friction, where there is some.
    pub(super) fn slides_driven(&self, cone: &Cone<T>) -> Option<State<T>> {
        if !cone.acts || !self.is_driven(cone) {
            return None;
        }
        let mut friction = [T::zero(); 3];
        friction.iter_mut().zip(cone.tangents()).for_each(|(x, row)| *x = self.impulses[row]);
        let size = norm(&friction);
        (!self.lockstep.is_zero(size)).then(|| State::Slides(friction.map(|x| x / size), T::one()))
    }

    /// `d P_T − u_T`, at most three, and its length.
    fn wanted(&self, cone: &Cone<T>, scale: T) -> ([T; 3], T) {
        let mut wanted = [T::zero(); 3];
        for (wanted, row) in wanted.iter_mut().zip(cone.tangents()) {
            *wanted = scale * self.impulses[row] - self.rates[row];
        }
        (wanted, norm(&wanted))
    }

    /// The rate that is zero where a gap is closed: that of the gap, or of the relaxed law less what slips take.
    fn closing(&self, cones: &[Cone<T>], row: usize) -> T {
        if self.relaxed { self.rates[row] - self.lift(cones, row) } else { self.rates[row] }
    }

    /// State of a contact, judged by impulses and rates.
    pub(super) fn state(&self, cones: &[Cone<T>], cone: &Cone<T>) -> State<T> {
        if !cone.acts {
            return State::Leaves;
        }
        let pressing = |row: usize| self.impulses[row] - self.closing(cones, row) / self.at(row, row);
        let pressed = cone.pressed.map_or(T::one(), pressing);
        let lockstep = &self.lockstep;
        if lockstep.at_most(pressed, T::zero()) {
            return State::Leaves;
        }
        let scale = self.scale(cone);
        if cone.count == 0 || lockstep.is_zero(cone.friction) || lockstep.is_zero(scale) {
            return State::Closed;
        }
        let (wanted, size) = self.wanted(cone, scale);
        let largest = cone.friction * pressed * scale;
        // A slip along one axis that no impulse changes is one, whatever friction is along the others.
        let slips = |row: usize| !self.moves(row) && !lockstep.is_zero(self.rates[row]);
        match lockstep.at_most(size, largest) {
            true if !cone.tangents().any(slips) || lockstep.is_zero(size) => State::Sticks,
            true => State::Slides(wanted.map(|x| x / size), T::one()),
            false => State::Slides(wanted.map(|x| x / size), largest / size),
        }
    }

    /// Mode of a contact in a lane, by its state, in forces and slips as they are: rows were scaled. Slips within the
    /// tolerance are none.
    pub(crate) fn mode(&self, (cone, state): (&Cone<T>, &State<T>), scales: &[T], tolerance: f64, lane: usize) -> Mode {
        let largest = |of: &dyn Fn(usize) -> T| cone.tangents().map(|row| of(row).lane(lane)).fold(0.0, f64::max);
        let slips = || largest(&|row| self.rates[row].abs()) > tolerance * largest(&|row| self.terms[row]);
        match state {
            State::Slides(..) if !slips() => Mode::Sticks,
            State::Leaves => Mode::Open,
            State::Closed => Mode::Closed,
            State::Sticks => Mode::Sticks,
            State::Slides(against, _) => {
                let mut along = [0.0; 3];
                let each = along.iter_mut().zip(cone.tangents()).zip(against);
                each.for_each(|((x, row), y)| *x = (-*y / scales[row]).lane(lane));
                let size = norm(&along);
                Mode::Slides(along.map(|x| x / size))
            }
        }
    }

    /// The work of the impulses: half of the rates before and after them, times these. Rates before are given without
    /// what impacts pass on.
    pub(crate) fn work(&self, before: impl Fn(usize) -> T) -> T {
        let change = |row: usize| T::from_f64(0.5) * (self.rates[row] - self.b[row]);
        let work = |row: usize| self.impulses[row] * (before(row) + change(row));
        (0..self.b.len()).map(work).fold(T::zero(), |sum, work| sum + work)
    }

    /// The rates with which the search begins; whether there is anything to look for.
    pub(super) fn begin(&mut self, cones: &[Cone<T>]) -> bool {
        for row in cones.iter().filter(|cone| !cone.acts).flat_map(|cone| cone.rows()) {
            self.impulses[row] = T::zero();
        }
        self.update(cones);
        self.best.copy_from_slice(self.impulses);
        cones.iter().any(|cone| cone.acts)
    }

    /// Finds the impulses of all lanes by corrections alone; nothing where lanes part, or where that is not enough for
    /// one of them.
    pub(crate) fn solve_in_lockstep(&mut self, cones: &[Cone<T>], tolerance: f64) -> Option<Found<T>> {
        let mut found = Found::none();
        found.holds = !self.begin(cones);
        self.pull = Pull::new(Drift::Short);
        let solved = found.holds || self.correct(cones, STRICT * tolerance, &mut found);
        (solved && !self.lockstep.has_parted()).then_some(found)
    }

    /// Newton's method; whether it ends with a solution.
    pub(super) fn correct(&mut self, cones: &[Cone<T>], tolerance: f64, found: &mut Found<T>) -> bool {
        let states = core::mem::take(&mut self.states);
        let solved = self.correct_in(states, cones, (tolerance, found));
        self.states = states;
        solved
    }

    fn correct_in(
        &mut self,
        states: &mut [State<T>],
        cones: &[Cone<T>],
        (tolerance, found): (f64, &mut Found<T>),
    ) -> bool {
        states.fill(State::Leaves);
        let mut known = 0;
        let (mut before, mut changed) = (T::from_f64(f64::INFINITY), false);
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
            self.impulses.fill(T::zero());
            (0..known).for_each(|k| self.impulses[usize::from(self.unknown[k])] = self.solution[k]);
            self.update(cones);
            found.corrections += 1;
            let (residual, holds) = self.worst(cones, tolerance);
            let size = residual.worst();
            if n == 0 || holds || self.lockstep.less(size, found.residual.worst()) {
                (found.residual, found.holds) = (residual, holds);
                self.best.copy_from_slice(self.impulses);
            }
            if holds {
                return true;
            }
            let is_finite = self.lockstep.agree::<T>(|lane| size.lane(lane).is_finite());
            if !is_finite || (n > 12 && !self.dependent) || self.lockstep.has_parted() {
                return false;
            }
            let [grows, stalls] = [3.0, 0.3].map(|part| self.lockstep.less(T::from_f64(part) * before, size));
            changed = self.pull.follow(grows, stalls) && self.dependent;
            before = size;
        }
        false
    }

    /// The worst residuals, and whether they are within the tolerance, a part of the largest rate, or rounding.
    pub(super) fn worst(&self, cones: &[Cone<T>], tolerance: f64) -> (Residual<T>, bool) {
        self.worst_by(cones, tolerance, |row| self.closing(cones, row))
    }

    /// The worst residuals of Coulomb's law, whatever law the impulses satisfy.
    pub(crate) fn residual_of_coulomb(&self, cones: &[Cone<T>]) -> Residual<T> {
        self.worst_by(cones, 0.0, |row| self.rates[row]).0
    }

    /// The same by given rates of the gaps.
    fn worst_by(&self, cones: &[Cone<T>], tolerance: f64, closing: impl Fn(usize) -> T) -> (Residual<T>, bool) {
        let acting = || cones.iter().filter(|cone| cone.acts);
        let rows = || acting().flat_map(|cone| cone.rows());
        let largest = rows().map(|row| self.terms[row]).fold(T::zero(), larger);
        let rounding = ROUNDINGS * (1 + self.b.len()) as f64 * f64::EPSILON;
        let mut worst = Residual::zero();
        let mut holds = true;
        for cone in acting() {
            let residual = self.residual(cone, rounding, &closing);
            // Written so that what is not a number does not hold.
            let allowed = larger(residual.rounding, T::from_f64(tolerance) * largest);
            holds &= self.lockstep.at_most(residual.worst(), allowed);
            worst = worst.worse(residual);
        }
        (worst, holds)
    }

    fn residual(&self, cone: &Cone<T>, rounding: f64, closing: impl Fn(usize) -> T) -> Residual<T> {
        let pressed = cone.normal.map_or(T::zero(), |row| self.at(row, row) * self.impulses[row]);
        let signorini = cone.normal.map_or(T::zero(), |row| closing(row).min(pressed).abs());
        let scale = self.scale(cone);
        let terms = cone.rows().map(|row| self.terms[row]).fold(T::zero(), larger);
        let mut residual = Residual { signorini, rounding: T::from_f64(rounding) * terms, ..Residual::zero() };
        if cone.count > 0 {
            let largest = scale * cone.radius(self.impulses);
            let mut friction = [T::zero(); 3];
            friction.iter_mut().zip(cone.tangents()).for_each(|(x, row)| *x = scale * self.impulses[row]);
            residual.coulomb = (norm(&friction) - largest).max(T::zero());
            let (wanted, size) = self.wanted(cone, scale);
            let part = T::select_lt(largest, size, largest / size, T::one());
            let off: [T; 3] = core::array::from_fn(|k| friction[k] - part * wanted[k]);
            residual.dissipation = norm(&off);
        }
        residual
    }
}

pub(super) fn norm<T: Real>(x: &[T; 3]) -> T {
    (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()
}

#[cfg(test)]
#[path = "impulses_tests.rs"]
pub(super) mod tests;
