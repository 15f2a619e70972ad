//! Places moved by the least that leaves no gap below zero.

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::{ContactSystem, Each};
use gauss_runtime::real::Real;

use crate::dense::value;

use super::bounds::{Bounds, contact_at, gap_after, gaps_of};
use super::projection::Projection;

impl<T: Real, K: ContactSystem<Scalar = T>> Projection<'_, K> {
    /// The impulses with which no gap is below zero and none is pulled by more than its bound, of the least motion:
    /// those of `min ½ πᵀDπ + gᵀπ` over `π ≥` these bounds (C. L. Lawson & R. J. Hanson 1974). Held are then contacts
    /// that are not at their bounds. `None` where it is not found.
    pub(super) fn least(
        &mut self,
        delassus: &K::Delassus,
        (gaps, bounds): (&K::Gaps, &Bounds<'_, K>),
        done: &K::ContactRows,
    ) -> Option<K::ContactRows> {
        let zero = T::zero();
        let mut moves = K::ContactRows::zero();
        let lowest = |row: usize| contact_at(self.kernel, row).map_or(zero, |i| bounds.lowest(i, row, done));
        let movable = |row: usize| value(delassus[(row, row)]) > 0.0;
        for (_, contact) in gaps_of(self.kernel).filter(|(_, contact)| movable(contact.normal)) {
            moves.set_component(contact.normal, lowest(contact.normal));
        }
        self.held = Each::from_fn(|_| false);
        let deepest = gaps_of(self.kernel).map(|(i, _)| -value(gaps.component(i))).fold(0.0, f64::max);
        let enough = (4.0 * bounds.rounding).max(1e-8 * deepest);
        for _ in 0..4 * self.kernel.contacts().len() {
            let after = |i: usize, row: usize| value(gap_after(self.kernel, delassus, gaps.component(i), row, &moves));
            let waiting = gaps_of(self.kernel).filter(|(i, contact)| !self.held[*i] && movable(contact.normal));
            let gaps_after = waiting.map(|(i, contact)| (i, after(i, contact.normal)));
            let lowest_gap = gaps_after.reduce(|a, b| if b.1 < a.1 { b } else { a });
            let Some((i, _)) = lowest_gap.filter(|(_, gap)| *gap < -enough) else { return Some(moves) };
            self.held[i] = true;
            self.within(delassus, gaps, (&mut moves, &lowest))?;
        }
        None
    }

    /// Goes towards the impulses that close all held gaps, and lets go of those that come to their bounds on the way.
    fn within(
        &mut self,
        delassus: &K::Delassus,
        gaps: &K::Gaps,
        (moves, lowest): (&mut K::ContactRows, &impl Fn(usize) -> T),
    ) -> Option<()> {
        for _ in 0..=self.kernel.contacts().len() {
            let held = self.held;
            let normals = gaps_of(self.kernel).filter(|(i, _)| held[*i]).map(|(_, contact)| contact.normal);
            if !self.factorise(delassus, normals) {
                return None;
            }
            let whole = self.taking_away(|row| {
                contact_at(self.kernel, row)
                    .map_or(T::zero(), |i| gap_after(self.kernel, delassus, gaps.component(i), row, moves))
            });
            // The part of the way on which none passes its bound.
            let (mut part, mut at) = (T::one(), None);
            for (i, contact) in gaps_of(self.kernel).filter(|(i, _)| held[*i]) {
                let (row, step) = (contact.normal, whole.component(contact.normal));
                let room = moves.component(row) - lowest(row);
                if value(room + step) < 0.0 && value(room) < -value(step * part) {
                    (part, at) = (room / -step, Some(i));
                }
            }
            *moves = moves.add_scaled(part, &whole);
            let Some(i) = at else { return Some(()) };
            self.held[i] = false;
            let row = self.kernel.contacts()[i].normal;
            moves.set_component(row, lowest(row));
        }
        None
    }
}
