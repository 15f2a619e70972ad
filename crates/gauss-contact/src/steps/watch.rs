//! What a step decided, for whoever makes it again in numbers with derivatives.

use alloc::vec::Vec;

use gauss_runtime::configuration::VectorSpace;
use gauss_runtime::contact::ContactSystem;

use crate::mode::Mode;

/// What an attempt at a part of a step came to.
pub(super) struct Attempted<'a, K: ContactSystem> {
    pub(super) impulses: &'a K::ContactRows,
    /// What contacts did, where the laws were solved.
    pub(super) modes: Option<&'a [Mode]>,
    /// Contacts that are closed after the step.
    pub(super) rests: &'a [bool],
    /// Whether rates were those of contacts that depend on one another.
    pub(super) dependent: bool,
    /// Whether a gap has closed.
    pub(super) struck: bool,
}

/// Who watches the parts of a step.
pub(super) trait Watch<K: ContactSystem> {
    /// A part of a step begins.
    fn begins(&mut self);
    /// Its first attempt, of two.
    fn first(&mut self, attempted: Attempted<K>);
    /// The attempt with which a part from a time on, of some length, ends.
    fn part(&mut self, of: (f64, f64), attempted: Attempted<K>);
}

/// Nobody.
impl<K: ContactSystem> Watch<K> for () {
    fn begins(&mut self) {}
    fn first(&mut self, _: Attempted<K>) {}
    fn part(&mut self, _: (f64, f64), _: Attempted<K>) {}
}

/// What an attempt decided.
pub(super) struct Taken {
    /// What contacts did, where the laws were solved.
    pub(super) modes: Option<Vec<Mode>>,
    /// Impulses, row by row.
    pub(super) impulses: Vec<f64>,
    /// Contacts that are closed after the step.
    pub(super) rests: Vec<bool>,
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
    fn of<K: ContactSystem<Scalar = f64>>(attempted: &Attempted<K>) -> Self {
        Self {
            modes: attempted.modes.map(Into::into),
            impulses: (0..K::ContactRows::DIM).map(|row| attempted.impulses.component(row)).collect(),
            rests: attempted.rests.into(),
            dependent: attempted.dependent,
            struck: attempted.struck,
        }
    }
}

impl<K: ContactSystem<Scalar = f64>> Watch<K> for Seen {
    fn begins(&mut self) {
        self.first = None;
    }

    fn first(&mut self, attempted: Attempted<K>) {
        self.first = Some(Taken::of::<K>(&attempted));
    }

    fn part(&mut self, (t, h): (f64, f64), attempted: Attempted<K>) {
        self.parts.push(Part { t, h, first: self.first.take(), taken: Taken::of::<K>(&attempted) });
    }
}
