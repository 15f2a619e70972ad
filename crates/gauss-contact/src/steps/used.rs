//! The speeds at which a step took its forces, beside those of its ends.

use gauss_runtime::configuration::VectorSpace;

/// Part of a speed by which that at which forces are taken may differ from the mean one without further notice.
const NEAR: f64 = 1e-5;
/// Part of the sizes of speeds before and after a step by which these may change before one looks whether that is so
/// because forces do: a quarter of a swing.
const ROUGH: f64 = 0.5;
/// The same of what speeds at half of a step were foreseen to be: where a motion turns back, speeds at both ends agree.
const FAR: f64 = 0.2;
/// Part of a speed before a step by which forces may change it by changing along half of the step.
const STEEP: f64 = 0.25;
/// The part of the largest speed below which one counts as zero. Units of speeds may differ.
pub(super) const SMALL: f64 = 1e-3;
/// The same where a speed that is zero for a moment is no measure of what others do to it.
pub(super) const PART: f64 = 0.1;
/// A speed as small as that has no digits to compare.
const LEAST: f64 = 1e-150;
/// Rounding of mean speeds, as a part of speeds.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The speeds of a step: before it, those at which forces were taken, with their acceleration, and after it.
pub(super) struct Used<V> {
    pub(super) h: f64,
    /// A speed as small as that is rounding of places.
    pub(super) least: f64,
    pub(super) before: V,
    pub(super) used: V,
    pub(super) acceleration: V,
    pub(super) after: V,
}

impl<V: VectorSpace<f64>> Used<V> {
    pub(super) fn mean(&self, i: usize) -> f64 {
        0.5 * (self.before.component(i) + self.after.component(i))
    }

    /// The size of each speed, by which differences are judged, with a part of the largest.
    pub(super) fn sizes(&self, part: f64) -> V {
        let mut sizes = V::zero();
        (0..V::DIM)
            .for_each(|i| sizes.set_component(i, self.before.component(i).abs() + self.after.component(i).abs()));
        let gained = |i: usize| self.h * self.acceleration.component(i).abs();
        // From rest, with speeds that turn back within the step, those at half of it are all that there is.
        let size = |i: usize| sizes.component(i).max(gained(i)).max(self.used.component(i).abs());
        let largest = (0..V::DIM).map(size).fold(0.0, f64::max);
        let least = part * largest + self.least + LEAST;
        (0..V::DIM).for_each(|i| sizes.set_component(i, sizes.component(i) + least));
        sizes
    }

    /// The size of each speed before the step, by which its changes along half of the step are judged: with a part of
    /// the largest, since from rest nothing moves along half of a step, and what differs is rounding.
    pub(super) fn magnitudes(&self) -> V {
        let (mut sizes, near) = (V::zero(), self.sizes(SMALL));
        let before = |i: usize| self.before.component(i).abs();
        let least = PART * (0..V::DIM).map(before).fold(0.0, f64::max);
        (0..V::DIM).for_each(|i| sizes.set_component(i, before(i) + least + NEAR * near.component(i)));
        sizes
    }

    /// The size of each speed by itself: those at both ends, with what forces add to it in the step.
    pub(super) fn own_sizes(&self) -> V {
        let mut sizes = V::zero();
        for i in 0..V::DIM {
            let ends = self.before.component(i).abs() + self.after.component(i).abs();
            sizes.set_component(i, ends + self.h * self.acceleration.component(i).abs() + LEAST);
        }
        sizes
    }

    /// Whether forces were taken at the mean speeds: in flight to rounding, else as nearly as need be.
    pub(super) fn is_plain(&self, flies: bool) -> bool {
        let allowed = match flies {
            true => self.own_sizes().scale(ROUNDING),
            false => self.sizes(SMALL).scale(NEAR),
        };
        let off = |i: usize| (self.mean(i) - self.used.component(i)).abs();
        (0..V::DIM).all(|i| off(i) <= allowed.component(i))
    }

    /// Whether a speed changes so much that forces may do so within the step more than it can follow.
    pub(super) fn is_rough(&self) -> bool {
        let sizes = self.sizes(SMALL);
        (0..V::DIM).any(|i| self.is_rough_at(i, sizes.component(i)))
    }

    fn is_rough_at(&self, i: usize, size: f64) -> bool {
        let changes = (self.after.component(i) - self.before.component(i)).abs() > ROUGH * size;
        changes || (self.mean(i) - self.used.component(i)).abs() > FAR * size
    }

    /// The speed that forces change too fast along half of the step, given the acceleration at the places before it: by
    /// (ωh)²/4 of itself where they swing.
    pub(super) fn steep(&self, at_start: &V) -> Option<usize> {
        let (sizes, magnitudes) = (self.sizes(SMALL), self.magnitudes());
        let by = |i: usize| 0.5 * self.h * (self.acceleration.component(i) - at_start.component(i)).abs();
        (0..V::DIM).find(|i| self.is_rough_at(*i, sizes.component(*i)) && by(*i) > STEEP * magnitudes.component(*i))
    }

    /// The first speed that an acceleration changes by more than a part of it, beside another one.
    pub(super) fn changes_beyond(&self, part: f64, [acceleration, other]: [&V; 2]) -> Option<usize> {
        let sizes = self.sizes(SMALL);
        let by = |i: usize| self.h * (acceleration.component(i) - other.component(i)).abs();
        (0..V::DIM).find(|i| by(*i) > part * sizes.component(*i))
    }

    /// The first speed that forces turn back within the step: those at the mean speeds of its motion without contacts
    /// differ from those that were taken by more than the speeds do, against that and more than twice as much.
    pub(super) fn turns_back(&self, free: &V, at_free: &V) -> Option<usize> {
        let sizes = self.sizes(SMALL);
        (0..V::DIM).find(|i| {
            let by = self.h * (at_free.component(*i) - self.acceleration.component(*i));
            let off = free.component(*i) - self.used.component(*i);
            by * off < 0.0 && by.abs() > 2.0 * off.abs() && by.abs() > ROUGH * sizes.component(*i)
        })
    }

    /// Whether an acceleration changes all speeds by less than a part of them, beside another one.
    pub(super) fn is_within(&self, part: f64, accelerations: [&V; 2]) -> bool {
        self.changes_beyond(part, accelerations).is_none()
    }
}
