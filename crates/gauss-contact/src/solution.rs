//! Solutions of the laws of contact.

use alloc::vec::Vec;

use crate::residual::Residual;

/// State of a contact in a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum State<T = f64> {
    Leaves,
    /// Stays closed; friction, if there is any, has a known direction.
    Closed,
    Sticks,
    /// Begins to slide in this direction.
    Slides([T; 3]),
}

impl<T: Copy> State<T> {
    /// The same state in other numbers.
    pub(crate) fn in_numbers<U>(&self, number: impl Fn(T) -> U) -> State<U> {
        match *self {
            Self::Leaves => State::Leaves,
            Self::Closed => State::Closed,
            Self::Sticks => State::Sticks,
            Self::Slides(along) => State::Slides(along.map(number)),
        }
    }
}

#[derive(Debug)]
pub(crate) struct Solution<T = f64> {
    /// λ, all rows.
    pub(crate) forces: Vec<T>,
    /// u, all rows.
    pub(crate) rates: Vec<T>,
    pub(crate) states: Vec<State<T>>,
    pub(crate) residuals: Vec<Residual>,
}

/// Why there is no solution that could be given.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A number is not finite.
    NonFinite,
    /// No state of this contact agrees with the laws.
    Inconsistent(usize),
    /// Several states of this contact do.
    Indeterminate(usize),
    /// None was found; how far the best one was from the laws.
    NotFound(Residual),
}
