//! The end of a step: closed gaps brought to zero, then their rates and the slips of what sticks.

use gauss_runtime::configuration::{Configuration, VectorSpace};
use gauss_runtime::contact::{ContactSystem, Each, ImpulseResponse};
use gauss_runtime::real::Real;

use crate::dense::value;
use crate::lockstep::{Lockstep, larger};
use crate::mode::{Mode, after_impulses};

use super::bounds::{Bounds, NotClosed, Touched, contact_at, gaps_of, lowest_of, not_closed};
use super::linear::{Place, factorise_symmetric, solve_symmetric, stride};
use super::motion;

/// Parts of the diagonal by which a matrix is made regular where contacts depend on one another: corrections are
/// repeated.
const PULLS: [f64; 3] = [1e-10, 1e-8, 1e-6];
/// Corrections at most. With the matrix of half of the step each leaves a part of the order of the step.
const CORRECTIONS: usize = 12;
/// The most roundings of places by which a gap may be below zero where corrections no longer halve it.
const BELOW: f64 = 64.0;
/// Memory for projections.
pub(crate) struct Projection<'m, K: ContactSystem> {
    pub(super) kernel: &'m K,
    matrix: &'m mut [K::Scalar],
    right: &'m mut [K::Scalar],
    solution: &'m mut [K::Scalar],
    rows: K::EachRow<Place>,
    /// Ends of the rows of factors.
    ends: K::EachRow<Place>,
    count: usize,
    pub(crate) lockstep: Lockstep,
    /// Contacts whose gaps were brought to zero.
    pub(crate) held: K::EachContact<bool>,
}

/// Places with closed gaps.
pub(crate) struct Closed<K: ContactSystem> {
    pub(crate) q: K::Configuration,
    pub(crate) gaps: K::Gaps,
    /// Depth of the lowest gap below zero, before corrections.
    pub(crate) penetration: K::Scalar,
    /// Distance from zero of the gaps that are closed, above it too, before corrections.
    pub(crate) closure: K::Scalar,
    /// Contacts that were to be closed and are open: to close them asks for more than the step has done.
    pub(crate) left: K::EachContact<bool>,
}

impl<T: Real, K: ContactSystem<Scalar = T>> Closed<K> {
    /// Places where no gap was to be closed.
    pub(super) fn still(q: K::Configuration) -> Self {
        let (zero, left) = (T::zero(), Each::from_fn(|_| false));
        Self { q, gaps: K::Gaps::zero(), penetration: zero, closure: zero, left }
    }
}

impl<'m, T: Real, K: ContactSystem<Scalar = T>> Projection<'m, K> {
    /// Number of rows.
    const ROWS: usize = K::ContactRows::DIM;
    /// Number of numbers that it needs.
    pub(crate) const MEMORY: usize = stride(Self::ROWS) * (Self::ROWS + 1) + Self::ROWS;

    pub(crate) fn new(kernel: &'m K, memory: &'m mut [T]) -> Self {
        let (matrix, memory) = memory.split_at_mut(Self::ROWS * stride(Self::ROWS));
        let (solution, memory) = memory.split_at_mut(stride(Self::ROWS));
        let right = &mut memory[..Self::ROWS];
        let (rows, ends) = (Each::from_fn(|_| 0), Each::from_fn(|_| 0));
        Self {
            kernel,
            matrix,
            right,
            solution,
            rows,
            ends,
            count: 0,
            lockstep: Lockstep::default(),
            held: Each::from_fn(|_| false),
        }
    }

    /// Factors of D at some rows; whether there are any.
    pub(super) fn factorise(&mut self, delassus: &K::Delassus, rows: impl Iterator<Item = usize>) -> bool {
        let mut count = 0;
        for row in rows {
            if self.lockstep.less(T::zero(), delassus[(row, row)]) {
                self.rows[count] = row as Place;
                count += 1;
            }
        }
        self.count = count;
        // Rounding may ask for more where masses are far apart.
        PULLS.into_iter().any(|pull| {
            let stride = stride(count);
            for i in 0..count {
                let row = &mut self.matrix[i * stride..(i + 1) * stride];
                for j in i..count {
                    // D is symmetric.
                    row[j] = delassus[(usize::from(self.rows[j]), usize::from(self.rows[i]))];
                }
                row[i] *= T::from_f64(1.0 + pull);
                row[..i].fill(T::zero());
                row[count..].fill(T::zero());
            }
            factorise_symmetric(&self.lockstep, self.matrix, &mut self.ends.as_mut()[..count], self.solution, 0.0)
        })
    }

    /// Impulses in the rows of the factors that take away rates.
    pub(super) fn taking_away(&mut self, rate: impl Fn(usize) -> T) -> K::ContactRows {
        let n = self.count;
        (0..n).for_each(|k| self.right[k] = -rate(usize::from(self.rows[k])));
        solve_symmetric(self.matrix, &self.ends.as_ref()[..n], &self.right[..n], self.solution);
        let mut impulses = K::ContactRows::zero();
        (0..n).for_each(|k| impulses.set_component(usize::from(self.rows[k]), self.solution[k]));
        impulses
    }

    /// Gaps of contacts that are closed brought to zero, and no gap below it, from places at a time.
    ///
    /// Places move by the least in the metric of the kinetic energy, `Δ = A⁻¹Wᵀπ`. To push a contact open takes what
    /// it takes. To pull one shut, `π < 0`, there is a bound: its impulse P acted at half of the step in place of its
    /// time there, and by that places are off by no more than `½h P` does; and where the gap opened before the step its
    /// first half has opened it farther, by `½h` times that rate. What asks for more, and moves points farther than a
    /// gap does alone, has not closed and is left open.
    pub(crate) fn close(
        &mut self,
        (t, mut q): (T, K::Configuration),
        response: &ImpulseResponse<K>,
        touched: &Touched<'_, K>,
    ) -> Result<Closed<K>, NotClosed> {
        let (kernel, zero, infinite) = (self.kernel, T::zero(), T::from_f64(f64::INFINITY));
        let (mut gaps, magnitude) = (kernel.gaps(t, &q), motion::magnitude(&q));
        let lowest = |gaps: &K::Gaps| lowest_of(kernel, gaps);
        let (lowest_before, bounds) = (lowest(&gaps), Bounds::new(self.kernel, touched, &response.delassus, magnitude));
        self.held = Each::from_fn(|_| false);
        let (mut left, mut size, mut closure, mut goes_on) = (infinite, zero, zero, T::one());
        let (mut entries, mut done) = (K::Gaps::zero(), K::ContactRows::zero());
        let (below, mut parted) = (T::from_f64(BELOW * f64::EPSILON) * magnitude, false);
        for n in 0..CORRECTIONS {
            let grown = self.join((&gaps, &mut entries), |i| n == 0 && touched.closed[i]) || n == 0;
            size = gaps_of(self.kernel).map(|(i, _)| self.held_gap(&gaps, i).abs()).fold(zero, larger);
            if n == 0 {
                closure = size;
            }
            // Below rounding, or where a correction no longer halves what is left, there is nothing to gain.
            goes_on = T::select_lt(T::from_f64(2.0 * f64::EPSILON) * magnitude, size, goes_on, zero);
            // Gaps that cannot all be zero: some are above it then, none below.
            let is_stuck = value(size) >= 0.5 * value(left) && value(lowest(&gaps) + below) < 0.0;
            let parts = T::LANES == 1 && !grown && !parted && is_stuck;
            if !grown && !parts {
                goes_on = T::select_lt(size, T::from_f64(0.5) * left, goes_on, zero);
            }
            if !goes_on_somewhere(goes_on) {
                break;
            }
            left = size;
            let held = self.held;
            let normals = gaps_of(self.kernel).filter(|(i, _)| held[*i]).map(|(_, contact)| contact.normal);
            if grown && !self.factorise(&response.delassus, normals) {
                break;
            }
            let corrected = self.correction(&response.delassus, (&gaps, &bounds, &done), parts);
            let (moves, is_least) = corrected.ok_or_else(|| not_closed(None, value(size)))?;
            if is_least {
                // Of what is held now no correction was before this one.
                (parted, left) = (true, infinite);
            }
            done = done.add_scaled(T::one(), &moves);
            let next = self.moved(kernel, (t, &q), response, &moves);
            q = if T::LANES == 1 { next } else { chosen_place(goes_on, &next, &q) };
            gaps = kernel.gaps(t, &q);
        }
        self.settled((&gaps, &entries), (larger(size, -lowest(&gaps)), magnitude))?;
        bounds.moves_enough(&self.lockstep, &response.delassus, (&done, &entries))?;
        let left = self.left_open(touched.closed, &gaps, bounds.near);
        let is_alike = self.lockstep.at_most(-lowest(&gaps), below) && !left.as_ref().contains(&true);
        if T::LANES > 1 && !is_alike {
            return Err(not_closed(None, value(size)));
        }
        Ok(Closed { q, gaps, penetration: -lowest_before, closure, left })
    }

    /// Impulses that close what is held, or where these pull too much those of the least motion, and whether they are
    /// these. Lanes are to find them one by one.
    fn correction(
        &mut self,
        delassus: &K::Delassus,
        (gaps, bounds, done): (&K::Gaps, &Bounds<'_, K>, &K::ContactRows),
        parts: bool,
    ) -> Option<(K::ContactRows, bool)> {
        let moves = self.taking_away(|row| contact_at(self.kernel, row).map_or(T::zero(), |i| gaps.component(i)));
        let gap = |i: usize| self.held_gap(gaps, i);
        if !(parts || bounds.pulls_too_much(&self.lockstep, delassus, (done, &moves), gap)) {
            return Some((moves, false));
        }
        let least = if T::LANES == 1 { self.least(delassus, (gaps, bounds), done) } else { None };
        least.map(|least| (least, true))
    }

    /// Holds contacts that are to be closed, and those that are below zero; whether there are more now.
    fn join(&mut self, (gaps, entries): (&K::Gaps, &mut K::Gaps), closes: impl Fn(usize) -> bool) -> bool {
        let mut grown = false;
        for (i, _) in gaps_of(self.kernel) {
            let gap = gaps.component(i);
            let joins = !self.held[i] && (closes(i) || self.lockstep.less(gap, T::zero()));
            if joins {
                self.held[i] = true;
                entries.set_component(i, larger(entries.component(i), gap.abs()));
            }
            grown |= joins;
        }
        grown
    }

    /// A gap that is held.
    fn held_gap(&self, gaps: &K::Gaps, i: usize) -> T {
        if self.held[i] { gaps.component(i) } else { T::zero() }
    }

    /// Configuration to which impulses move one.
    fn moved(
        &self,
        kernel: &K,
        (t, q): (T, &K::Configuration),
        response: &ImpulseResponse<K>,
        moves: &K::ContactRows,
    ) -> K::Configuration {
        let still = K::Speeds::zero();
        let moved = after_impulses(&self.lockstep, kernel, &still, (&response.factors, moves));
        // ψ is affine in z: what an impulse adds to it is an increment of the configuration.
        let still = kernel.kinematics(t, q, &still);
        q.advance(&kernel.kinematics(t, q, &moved).add_scaled(-T::one(), &still))
    }

    /// Refuses gaps that did not come to zero, and says which was the farthest.
    fn settled(&self, (gaps, entries): (&K::Gaps, &K::Gaps), (size, magnitude): (T, T)) -> Result<(), NotClosed> {
        // Half of the digits: what is farther off was not on its way to zero.
        let allowed = T::from_f64(Real::sqrt(f64::EPSILON)) * larger(T::from_f64(1e-3), magnitude);
        if self.lockstep.at_most(size, allowed) {
            return Ok(());
        }
        let off = |i: usize| value(gaps.component(i)).abs();
        let held = gaps_of(self.kernel).map(|(i, _)| i).filter(|i| self.held[*i]);
        let worst = held.reduce(|a, b| if off(b) > off(a) { b } else { a });
        Err(not_closed(worst, worst.map_or(value(size), |i| value(entries.component(i)))))
    }

    /// Contacts that were to be closed and are not.
    fn left_open(&self, closed: &[bool], gaps: &K::Gaps, near: T) -> K::EachContact<bool> {
        let open = |i: usize| (0..T::LANES).any(|lane| gaps.component(i).lane(lane) > near.lane(lane));
        // A kernel may have fewer contacts than its lists have room for; what is there is closed at times.
        let is_left = |i: usize| closed[i] && self.kernel.contacts()[i].has_gap() && !self.held[i] && open(i);
        Each::from_fn(is_left)
    }

    /// Rates of closed gaps, and slips of what sticks, brought to zero where they are more than rounding; with all
    /// rates there.
    pub(crate) fn stop(
        &mut self,
        (t, q, mut z, mut rates): (T, &K::Configuration, K::Speeds, K::ContactRows),
        response: &ImpulseResponse<K>,
        (mode, rounding): (impl Fn(usize) -> Mode, T),
    ) -> (K::Speeds, K::ContactRows) {
        let kernel = self.kernel;
        let rows = || {
            kernel.contacts().iter().enumerate().flat_map(|(i, contact)| match mode(i) {
                Mode::Open => 0..0,
                Mode::Sticks => contact.rows(),
                Mode::Closed | Mode::Slides(_) => contact.normal..contact.tangent_rows().start,
            })
        };
        let (mut left, mut goes_on) = (T::from_f64(f64::INFINITY), T::one());
        for n in 0..CORRECTIONS {
            let size = rows().map(|row| rates.component(row).abs()).fold(T::zero(), larger);
            goes_on = T::select_lt(rounding, size, goes_on, T::zero());
            goes_on = T::select_lt(size, T::from_f64(0.5) * left, goes_on, T::zero());
            if !goes_on_somewhere(goes_on) {
                break;
            }
            left = size;
            if n == 0 && !self.factorise(&response.delassus, rows()) {
                break;
            }
            let impulses = self.taking_away(|row| rates.component(row));
            let next = after_impulses(&self.lockstep, kernel, &z, (&response.factors, &impulses));
            z = if T::LANES == 1 { next } else { chosen(goes_on, &next, &z) };
            rates = kernel.contact_rates(t, q, &z);
        }
        (z, rates)
    }
}

/// Whether there is a lane that is not done.
fn goes_on_somewhere<T: Real>(goes_on: T) -> bool {
    (0..T::LANES).any(|lane| goes_on.lane(lane) > 0.0)
}

/// The next place in the lanes that go on, in the others that before.
fn chosen_place<T: Real, Q: Configuration<Scalar = T>>(goes_on: T, next: &Q, before: &Q) -> Q {
    Q::from_components(&chosen(goes_on, &next.components(), &before.components()))
}

/// The next value in the lanes that go on, in the others that before.
fn chosen<T: Real, V: VectorSpace<T>>(goes_on: T, next: &V, before: &V) -> V {
    let mut chosen = *before;
    for i in 0..V::DIM {
        chosen.set_component(i, T::select_lt(T::zero(), goes_on, next.component(i), before.component(i)));
    }
    chosen
}
