//! Decisions about several states that are worked on in lockstep.

use core::cell::Cell;

use gauss_runtime::real::Real;

/// Decisions that all lanes of a number take together, and whether one of them was not the same in all: what comes
/// after it holds for the first lane alone, and is to be thrown away. A number of one lane always agrees.
#[derive(Debug, Default)]
pub(crate) struct Lockstep {
    parted: Cell<bool>,
}

impl Lockstep {
    /// The answer to a question about each lane.
    #[inline(always)]
    pub(crate) fn agree<T: Real>(&self, question: impl Fn(usize) -> bool) -> bool {
        let first = question(0);
        if T::LANES > 1 && (1..T::LANES).any(|lane| question(lane) != first) {
            self.parted.set(true);
        }
        first
    }

    /// Whether `a < b`.
    #[inline(always)]
    pub(crate) fn less<T: Real>(&self, a: T, b: T) -> bool {
        (T::LANES > 1 && T::all_lt(a, b)) || self.agree::<T>(|lane| a.lane(lane) < b.lane(lane))
    }

    /// Whether `a ≤ b`.
    #[inline(always)]
    pub(crate) fn at_most<T: Real>(&self, a: T, b: T) -> bool {
        (T::LANES > 1 && T::all_lt(a, b)) || self.agree::<T>(|lane| a.lane(lane) <= b.lane(lane))
    }

    /// Whether a number is zero.
    #[inline(always)]
    pub(crate) fn is_zero<T: Real>(&self, x: T) -> bool {
        self.agree::<T>(|lane| x.lane(lane) == 0.0)
    }

    /// Whether lanes did not agree.
    pub(crate) fn has_parted(&self) -> bool {
        self.parted.get()
    }
}

/// The last of some numbers that is not zero, by place: of those of a pack the last that is not zero in some lane, in
/// all of which it must be.
#[inline]
pub(crate) fn last<T: Real>(
    lockstep: &Lockstep,
    mut places: impl DoubleEndedIterator<Item = usize>,
    x: &[T],
) -> Option<usize> {
    let some = |x: T| (0..T::LANES).any(|lane| x.lane(lane) != 0.0);
    let last = places.rfind(|place| some(x[*place]))?;
    lockstep.is_zero(x[last]);
    Some(last)
}

/// The larger of two numbers, lane by lane; the first where one is NaN.
#[inline(always)]
pub(crate) fn larger<T: Real>(a: T, b: T) -> T {
    T::select_lt(a, b, b, a)
}
