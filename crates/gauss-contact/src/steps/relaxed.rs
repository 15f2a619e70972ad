//! The convex relaxation of Coulomb's law: what closes is not the gap, but the gap less the way of slip.
//!
//! Impulses minimise `½ PᵀDP + bᵀP` over the cones of friction (M. Anitescu 2006). At the minimum rates `u = D P + b`
//! are in the dual cones and `P·u = 0`: with `ũ_N = u_N − μ |u_T|` in the place of u_N that is Signorini's law
//! `0 ≤ P_N ⊥ ũ_N ≥ 0` and Coulomb's friction. So what slides separates at μ times its slip. Where rolling resistance
//! of a bound ρ P_N acts at the same gap, `ũ_N = u_N − μ |u_T| − ρ |ω|`.
//!
//! The minimum always exists where rates in the dual cones do, and its rates are unique. Sweeps go down to it, cone by
//! cone; Newton's method of the other law ends at it.

use gauss_runtime::contact::Contact;
use gauss_runtime::real::Real;

use crate::law::carrier;
use crate::mode::Mode;

use super::cones::Cone;
use super::impulses::{Impulses, norm};
use super::unknowns::State;

/// Which law of friction the impulses of a step satisfy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StepLaw {
    /// Signorini's law and Coulomb's: closed gaps stay closed while they slide.
    #[default]
    Coulomb,
    /// The convex problem that engines solve in its place (M. Anitescu 2006; MuJoCo, SAP): rates are unique, and there
    /// is no paradox of Painlevé's, but what slides separates at μ times its slip, whatever the length of the step.
    /// Where nothing slides both laws agree. [`StepReport::from_coulomb`](super::StepReport) says how far they do not.
    ConvexRelaxation,
}

/// Whether slips separate a closed gap: such a gap is open after the step.
pub(super) fn lifts(contacts: &[Contact], law: StepLaw, modes: &[Mode], i: usize) -> bool {
    let carries = carrier(contacts, i);
    let slides = |n: usize| carrier(contacts, n) == carries && matches!(modes[n], Mode::Slides(_));
    let relaxed = law == StepLaw::ConvexRelaxation && contacts[carries].has_gap();
    relaxed && (0..contacts.len()).any(slides)
}

impl<T: Real> Impulses<'_, T> {
    /// The cones whose friction this normal bounds.
    fn pressed_by(cones: &[Cone<T>], normal: usize) -> impl Iterator<Item = (usize, &Cone<T>)> {
        let own = move |(_, cone): &(usize, &Cone<T>)| cone.acts && cone.pressed == Some(normal);
        cones.iter().enumerate().filter(own)
    }

    /// Rate that the slips at a normal take from its own: `μ |u_T|`, with ρ |ω| of rolling resistance.
    pub(super) fn lift(&self, cones: &[Cone<T>], normal: usize) -> T {
        let slip = |cone: &Cone<T>| {
            let mut slip = [T::zero(); 3];
            slip.iter_mut().zip(cone.tangents()).for_each(|(x, row)| *x = self.rates[row]);
            cone.friction * norm(&slip)
        };
        Self::pressed_by(cones, normal).map(|(_, cone)| slip(cone)).fold(T::zero(), |sum, slip| sum + slip)
    }

    /// Entry that is added to the equation of a normal, in an unknown: to second order |u_T| is `−t·u_T` with the
    /// direction t of friction.
    pub(super) fn lift_entry(&self, cones: &[Cone<T>], states: &[State<T>], normal: usize, column: usize) -> T {
        self.lift_along(cones, states, normal, |this, row| this.at(row, column))
    }

    /// The same of the rates without impulses.
    pub(super) fn lift_free(&self, cones: &[Cone<T>], states: &[State<T>], normal: usize) -> T {
        self.lift_along(cones, states, normal, |this, row| this.b[row])
    }

    fn lift_along(
        &self,
        cones: &[Cone<T>],
        states: &[State<T>],
        normal: usize,
        of_row: impl Fn(&Self, usize) -> T,
    ) -> T {
        let along = |(i, cone): (usize, &Cone<T>)| match states[i] {
            State::Slides(along, _) => {
                let each = cone.tangents().zip(along);
                cone.friction
                    * each.map(|(row, along)| along * of_row(self, row)).fold(T::zero(), |sum, term| sum + term)
            }
            _ => T::zero(),
        };
        Self::pressed_by(cones, normal).map(along).fold(T::zero(), |sum, term| sum + term)
    }
}

impl Impulses<'_> {
    /// One sweep: impulses at each gap are brought down to the least value along its gradient and back into the cone,
    /// while others stay. Diagonal entries times the number of rows bound the second derivative, so that no sweep goes
    /// up.
    pub(super) fn sweep_convex(&mut self, cones: &[Cone]) {
        for cone in cones.iter().filter(|cone| cone.acts) {
            match (cone.normal, cone.pressed) {
                (Some(normal), _) => self.sweep_gap(cones, normal),
                // Dry friction: a ball.
                (None, None) => {
                    let weight = self.weight(cone, cone.count);
                    self.descend(cone, weight);
                    self.shorten(cone, cone.friction);
                }
                // Rolling resistance comes with its gap.
                (None, Some(_)) => {}
            }
        }
    }

    fn sweep_gap(&mut self, cones: &[Cone], normal: usize) {
        let rows = 1 + Self::pressed_by(cones, normal).map(|(_, cone)| cone.count).sum::<usize>();
        let weight = rows as f64 * self.at(normal, normal);
        if weight <= 0.0 {
            return;
        }
        let pressed = self.impulses[normal] - self.rate(normal) / weight;
        // All rates are those before the sweep of this gap.
        let mut wanted = [[0.0; 3]; 8];
        for ((_, cone), wanted) in Self::pressed_by(cones, normal).zip(&mut wanted) {
            let weight = self.weight(cone, rows);
            for (x, row) in wanted.iter_mut().zip(cone.tangents()) {
                *x = if weight > 0.0 { self.impulses[row] - self.rate(row) / weight } else { 0.0 };
            }
        }
        let mut each = [[0.0; 3]; 8];
        let mut count = 0;
        for (((_, cone), wanted), each) in Self::pressed_by(cones, normal).zip(&wanted).zip(&mut each) {
            *each = [self.weight(cone, rows), cone.friction, norm(wanted)];
            count += 1;
        }
        let impulse = nearest((weight, pressed), &each[..count]);
        self.impulses[normal] = impulse;
        for ((_, cone), wanted) in Self::pressed_by(cones, normal).zip(wanted) {
            cone.tangents().zip(wanted).for_each(|(row, wanted)| self.impulses[row] = wanted);
            self.shorten(cone, cone.friction * impulse);
        }
    }

    /// A bound of the second derivative along the rows of friction of a cone, as one of so many rows.
    fn weight(&self, cone: &Cone, rows: usize) -> f64 {
        rows as f64 * self.scale(cone)
    }

    fn descend(&mut self, cone: &Cone, weight: f64) {
        let mut next = [0.0; 3];
        if weight > 0.0 {
            for (next, row) in next.iter_mut().zip(cone.tangents()) {
                *next = self.impulses[row] - self.rate(row) / weight;
            }
        }
        cone.tangents().zip(next).for_each(|(row, next)| self.impulses[row] = next);
    }

    /// Friction no larger than a bound.
    fn shorten(&mut self, cone: &Cone, largest: f64) {
        let mut friction = [0.0; 3];
        friction.iter_mut().zip(cone.tangents()).for_each(|(x, row)| *x = self.impulses[row]);
        let size = norm(&friction);
        if size > largest {
            cone.tangents().for_each(|row| self.impulses[row] *= largest / size);
        }
    }
}

/// The normal of the point of a cone `|T_k| ≤ μ_k n` that is nearest to a point, in a metric with weights; of each k
/// `[weight, μ, |T|]`. What is to be zero there, `w (n − x) − Σ w_k μ_k (|T_k| − μ_k n)₊`, has pieces that are straight
/// and bends down: Newton's method from x, or from 0, ends after as many steps as there are pieces.
fn nearest((weight, x): (f64, f64), each: &[[f64; 3]]) -> f64 {
    let mut n = x.max(0.0);
    for _ in 0..=each.len() {
        let (mut above, mut below) = (weight * x, weight);
        for [weight, friction, size] in each {
            if *size > friction * n {
                above += weight * friction * size;
                below += weight * friction * friction;
            }
        }
        n = (above / below).max(0.0);
    }
    n
}

#[cfg(test)]
#[path = "relaxed_tests.rs"]
mod tests;
