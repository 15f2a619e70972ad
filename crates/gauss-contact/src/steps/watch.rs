//! Decisions of a step, for whoever makes it again in numbers with derivatives.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;

use crate::mode::Mode;

use super::motion::Rule;

/// Outcome of an attempt at a part of a step.
pub(super) struct Attempted<'a, K: ContactSystem> {
    pub(super) impulses: &'a K::ContactRows,
    /// Modes of the contacts, where the laws were solved.
    pub(super) modes: Option<&'a [Mode]>,
    /// Contacts that are closed after the step, and those that were to be and are open.
    pub(super) rests: &'a [bool],
    pub(super) left: &'a [bool],
    /// Contacts that were open before it and may bounce.
    pub(super) opened: &'a [bool],
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

/// Who watches the parts of a step.
pub(super) trait Watch<K: ContactSystem> {
    /// A part of a step begins; whether its first attempt goes to the place at half of it with foreseen mean speeds.
    fn begins(&mut self, by_mean: bool);
    /// An attempt that is not the last, and how the next one follows from it.
    fn again(&mut self, attempted: Attempted<K>, how: Rule);
    /// Attempts have led to one that the next would not change.
    fn settles(&mut self);
    /// The number of parts.
    fn parts(&self) -> usize;
    /// Only the first so many parts stay.
    fn keep(&mut self, parts: usize);
    /// The attempt with which a part from a time on, of some length, ends.
    fn part(&mut self, of: (f64, f64), attempted: Attempted<K>);
}

/// Nobody.
impl<K: ContactSystem> Watch<K> for () {
    fn begins(&mut self, _: bool) {}
    fn again(&mut self, _: Attempted<K>, _: Rule) {}
    fn settles(&mut self) {}
    fn parts(&self) -> usize {
        0
    }
    fn keep(&mut self, _: usize) {}
    fn part(&mut self, _: (f64, f64), _: Attempted<K>) {}
}

/// Decisions of an attempt.
pub(super) struct Taken {
    /// Modes of the contacts, where the laws were solved.
    pub(super) modes: Option<Vec<Mode>>,
    /// Impulses, row by row.
    pub(super) impulses: Vec<f64>,
    /// Contacts that are closed after the step.
    pub(super) rests: Vec<bool>,
    /// Contacts that were to be closed.
    pub(super) closed: Vec<bool>,
    /// Contacts that were open before the step and may bounce.
    pub(super) opened: Vec<bool>,
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

/// A part of a step.
pub(super) struct Part {
    pub(super) t: f64,
    pub(super) h: f64,
    /// Whether the first attempt goes to the place at half of the part with foreseen mean speeds.
    pub(super) by_mean: bool,
    /// The attempts that told the speeds at half of the part, and how.
    pub(super) before: Vec<(Taken, Rule)>,
    /// Whether the last one would not be changed by another.
    pub(super) settled: bool,
    pub(super) taken: Taken,
}

/// All parts of a step.
#[derive(Default)]
pub(super) struct Seen {
    by_mean: bool,
    settled: bool,
    before: Vec<(Taken, Rule)>,
    pub(super) parts: Vec<Part>,
}

impl Taken {
    fn of<K: ContactSystem<Scalar = f64>>(attempted: &Attempted<K>) -> Self {
        Self {
            modes: attempted.modes.map(Into::into),
            impulses: (0..K::ContactRows::DIM).map(|row| attempted.impulses.component(row)).collect(),
            rests: attempted.rests.into(),
            closed: attempted.rests.iter().zip(attempted.left).map(|(rests, left)| *rests || *left).collect(),
            opened: attempted.opened.into(),
            dependent: attempted.dependent,
            struck: attempted.struck,
        }
    }
}

impl<K: ContactSystem<Scalar = f64>> Watch<K> for Seen {
    fn begins(&mut self, by_mean: bool) {
        (self.by_mean, self.settled) = (by_mean, false);
        self.before.clear();
    }

    fn again(&mut self, attempted: Attempted<K>, how: Rule) {
        self.before.push((Taken::of::<K>(&attempted), how));
    }

    fn settles(&mut self) {
        self.settled = true;
    }

    fn parts(&self) -> usize {
        self.parts.len()
    }

    fn keep(&mut self, parts: usize) {
        self.parts.truncate(parts);
    }

    fn part(&mut self, (t, h): (f64, f64), attempted: Attempted<K>) {
        let before = core::mem::take(&mut self.before);
        let Self { by_mean, settled, .. } = *self;
        self.parts.push(Part { t, h, by_mean, before, settled, taken: Taken::of::<K>(&attempted) });
    }
}
