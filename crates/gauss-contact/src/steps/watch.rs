//! What a step decided, for whoever makes it again in numbers with derivatives.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;

use crate::mode::Mode;

use super::cones::MOST;
use super::stepper::End;

/// Who watches the parts of a step.
pub(super) trait Watch<K: ContactSystem> {
    /// A part of a step begins.
    fn begins(&mut self);
    /// Its first attempt, of two.
    fn first(&mut self, end: &End<K>, modes: &[Mode]);
    /// The attempt with which a part from a time on, of some length, ends.
    fn part(&mut self, of: (f64, f64), end: &End<K>, modes: &[Mode]);
}

/// Nobody.
impl<K: ContactSystem> Watch<K> for () {
    fn begins(&mut self) {}
    fn first(&mut self, _: &End<K>, _: &[Mode]) {}
    fn part(&mut self, _: (f64, f64), _: &End<K>, _: &[Mode]) {}
}

/// What an attempt decided.
pub(super) struct Taken {
    /// What contacts did, where the laws were solved.
    pub(super) modes: Option<Vec<Mode>>,
    /// Impulses, row by row.
    pub(super) impulses: Vec<f64>,
    /// Contacts that are closed after the step.
    pub(super) rests: [bool; MOST],
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

/// A part of a step.
pub(super) struct Part {
    pub(super) t: f64,
    pub(super) h: f64,
    /// The attempt that told the speeds at half of the part.
    pub(super) first: Option<Taken>,
    pub(super) taken: Taken,
}

/// All parts of a step.
#[derive(Default)]
pub(super) struct Seen {
    first: Option<Taken>,
    pub(super) parts: Vec<Part>,
}

impl Taken {
    fn of<K: ContactSystem<Scalar = f64>>(end: &End<K>, modes: &[Mode]) -> Self {
        Self {
            modes: end.touches.then(|| modes[..K::CONTACTS.len()].into()),
            impulses: (0..K::ContactRows::DIM).map(|row| end.impulses.component(row)).collect(),
            rests: end.rests,
            dependent: end.dependent,
            struck: end.struck,
        }
    }
}

impl<K: ContactSystem<Scalar = f64>> Watch<K> for Seen {
    fn begins(&mut self) {
        self.first = None;
    }

    fn first(&mut self, end: &End<K>, modes: &[Mode]) {
        self.first = Some(Taken::of(end, modes));
    }

    fn part(&mut self, (t, h): (f64, f64), end: &End<K>, modes: &[Mode]) {
        self.parts.push(Part { t, h, first: self.first.take(), taken: Taken::of(end, modes) });
    }
}
