//! Unknowns of a step: which rows, in which states, in memory of the size of the system.

use gauss_runtime::contact::{ContactSystem, Each};

use super::linear::Place;

/// State of a contact in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum State<T = f64> {
    Leaves,
    /// Without friction.
    Closed,
    Sticks,
    /// The direction of `P_T − u_T/d`, against the slip, and by what part of its length friction is smaller.
    Slides([T; 3], T),
}

impl<T: PartialEq> State<T> {
    /// Whether the equations are the same.
    pub(super) fn is_as(&self, other: &Self) -> bool {
        !matches!(self, Self::Slides(..)) && self == other
    }
}

/// Memory for what is unknown in a step of a system.
pub(crate) struct Unknowns<K: ContactSystem> {
    rows: K::EachRow<Place>,
    order: K::EachRow<Place>,
    extents: K::EachRow<[Place; 2]>,
    states: K::EachContact<State<K::Scalar>>,
}

/// The same in slices: of rows, and of contacts.
pub(crate) struct UnknownsIn<'m, T = f64> {
    pub(crate) rows: &'m mut [Place],
    /// Order of pivots; of symmetric factors the ends of their rows.
    pub(crate) order: &'m mut [Place],
    /// Extents of the rows of D: from the first entry that is not zero to behind the last.
    pub(crate) extents: &'m mut [[Place; 2]],
    pub(crate) states: &'m mut [State<T>],
}

impl<K: ContactSystem> Unknowns<K> {
    pub(crate) fn new() -> Self {
        Self {
            rows: Each::from_fn(|_| 0),
            order: Each::from_fn(|_| 0),
            extents: Each::from_fn(|_| [0; 2]),
            states: Each::from_fn(|_| State::Leaves),
        }
    }

    /// As many as a kernel has: lists may have room for more.
    pub(crate) fn slices(&mut self, kernel: &K) -> UnknownsIn<'_, K::Scalar> {
        let contacts = kernel.contacts();
        let (count, used) = (contacts.len(), contacts.last().map_or(0, |last| last.rows().end));
        UnknownsIn {
            rows: &mut self.rows.as_mut()[..used],
            order: &mut self.order.as_mut()[..used],
            extents: &mut self.extents.as_mut()[..used],
            states: &mut self.states.as_mut()[..count],
        }
    }
}
