//! The linear equations of a step in given states of its contacts.

use gauss_runtime::real::Real;

use super::cones::Cone;
use super::impulses::Impulses;
use super::linear::{Place, factorise, factorise_symmetric, stride};
use super::unknowns::State;

/// Contacts depend on one another where this is left of a column.
const DEPENDENT: f64 = 1e-11;

impl<T: Real> Impulses<'_, T> {
    /// Factors of the equations in given states; how many unknowns there are. `None` where they have no solution. Where
    /// nothing slides the equations are those of D.
    pub(super) fn factors(&mut self, cones: &[Cone<T>], states: &[State<T>]) -> Option<usize> {
        let mut count = 0;
        for (cone, state) in cones.iter().zip(states) {
            let rows = match state {
                State::Leaves => continue,
                State::Closed => cone.first..cone.first,
                State::Sticks | State::Slides(..) => cone.tangents(),
            };
            // What no impulse moves has no equation: of what sticks its slip is none at all.
            let sticks = *state == State::Sticks;
            for row in cone.normal.into_iter().chain(rows) {
                if cone.normal == Some(row) || !sticks || self.moves(row) {
                    self.unknown[count] = row as Place;
                    count += 1;
                }
            }
        }
        self.symmetric = !states.iter().any(|state| matches!(state, State::Slides(..)));
        if self.symmetric {
            return self.symmetric_factors(count);
        }
        let mut k = 0;
        for (cone, state) in cones.iter().zip(states) {
            if *state == State::Leaves {
                continue;
            }
            if let Some(normal) = cone.normal {
                self.equal((k, count), count, normal);
                if self.relaxed {
                    for c in 0..count {
                        self.matrix[k * count + c] +=
                            self.lift_entry(cones, states, normal, usize::from(self.unknown[c]));
                    }
                }
                k += 1;
            }
            match state {
                State::Sticks => {
                    for row in cone.tangents() {
                        if self.moves(row) {
                            self.equal((k, count), count, row);
                            k += 1;
                        }
                    }
                }
                State::Slides(along, part) => {
                    let scale = self.scale(cone);
                    for a in 0..cone.count {
                        for c in 0..count {
                            let entry =
                                self.sliding_entry(cone, (along, *part, scale), a, usize::from(self.unknown[c]));
                            self.matrix[k * count + c] = entry;
                        }
                        k += 1;
                    }
                }
                State::Leaves | State::Closed => {}
            }
        }
        let part = if self.dependent { 0.0 } else { DEPENDENT };
        factorise(&self.lockstep, &mut self.matrix[..count * count], &mut self.order[..count], part).then_some(count)
    }

    /// The factors where nothing slides.
    fn symmetric_factors(&mut self, count: usize) -> Option<usize> {
        let rows = stride(count);
        for k in 0..count {
            self.equal((k, rows), count, usize::from(self.unknown[k]));
            self.matrix[k * rows + count..(k + 1) * rows].fill(T::zero());
        }
        let part = if self.dependent { 0.0 } else { DEPENDENT };
        let ends = &mut self.order[..count];
        factorise_symmetric(&self.lockstep, self.matrix, ends, self.solution, part).then_some(count)
    }

    pub(super) fn pull(&self) -> f64 {
        if self.dependent { self.pull.part() } else { 0.0 }
    }

    /// The equation of a rate that is zero, in rows of some length.
    fn equal(&mut self, (k, rows): (usize, usize), count: usize, row: usize) {
        let n = self.b.len();
        let (own, more) = (&self.delassus[row * n..(row + 1) * n], T::from_f64(1.0 + self.pull()));
        let entries = self.matrix[k * rows..k * rows + count].iter_mut().zip(&*self.unknown);
        for (entry, &of) in entries {
            let of = usize::from(of);
            *entry = if of == row { own[of] * more } else { own[of] };
        }
    }

    /// Entry of the equation `d P_a − d μ P_N t_a − part Σ_b (δ_ab − t_a t_b) (d P_b − u_b) = 0`, which is Coulomb's
    /// law to first order in the direction t: the factor of an impulse.
    fn sliding_entry(&self, cone: &Cone<T>, (along, part, scale): (&[T; 3], T, T), a: usize, column: usize) -> T {
        let is_own = column == cone.first + a;
        let mut entry = if is_own { scale * T::from_f64(1.0 + self.pull()) } else { T::zero() };
        if cone.pressed == Some(column) {
            entry -= scale * cone.friction * along[a];
        }
        for (b, row) in cone.tangents().enumerate() {
            let across = same::<T>(a, b) - along[a] * along[b];
            let own = if column == row { scale } else { T::zero() };
            entry -= part * across * (own - self.at(row, column));
        }
        entry
    }

    pub(super) fn right_sides(&mut self, cones: &[Cone<T>], states: &[State<T>], count: usize) {
        let mut k = 0;
        for (cone, state) in cones.iter().zip(states) {
            if *state == State::Leaves {
                continue;
            }
            let pulled = |this: &Self, row: usize| {
                T::from_f64(this.pull()) * this.at(row, row) * this.impulses[row] - this.b[row]
            };
            if let Some(normal) = cone.normal {
                let lifted = if self.relaxed { self.lift_free(cones, states, normal) } else { T::zero() };
                self.right[k] = pulled(self, normal) - lifted;
                k += 1;
            }
            match state {
                State::Sticks => {
                    for row in cone.tangents() {
                        if self.moves(row) {
                            self.right[k] = pulled(self, row);
                            k += 1;
                        }
                    }
                }
                State::Slides(along, part) => {
                    let scale = self.scale(cone);
                    for a in 0..cone.count {
                        let fixed = if cone.pressed.is_none() { scale * cone.friction * along[a] } else { T::zero() };
                        let each = cone.tangents().enumerate();
                        let turned = each
                            .map(|(b, row)| (same::<T>(a, b) - along[a] * along[b]) * self.b[row])
                            .fold(T::zero(), |sum, term| sum + term);
                        let pulled = T::from_f64(self.pull()) * scale * self.impulses[cone.first + a];
                        self.right[k] = fixed - *part * turned + pulled;
                        k += 1;
                    }
                }
                State::Leaves | State::Closed => {}
            }
        }
        debug_assert_eq!(k, count);
    }
}

/// δ.
fn same<T: Real>(a: usize, b: usize) -> T {
    if a == b { T::one() } else { T::zero() }
}
