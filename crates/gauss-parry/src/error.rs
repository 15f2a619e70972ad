//! Why shapes give no contacts.

use std::fmt;

use gauss_contact::{ContactError, SlotError};

use crate::id::ShapeId;

/// Shapes that give no contacts, or a step that cannot be made: which, and why.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ParryError {
    /// The shapes, in the order in which they were added; none where it is not about a pair.
    pub shapes: Option<(ShapeId, ShapeId)>,
    /// The cause.
    pub kind: ParryErrorKind,
}

/// The cause.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ParryErrorKind {
    /// The library has no manifolds of two shapes of these kinds.
    Unsupported,
    /// A shape that was not added here.
    Unknown,
    /// The pair has more points than [`Shapes::most`](crate::Shapes::most) allows.
    PairPoints {
        /// Number of its points.
        points: usize,
        /// Number of points that it may have.
        most: usize,
    },
    /// All pairs together have more points than there are slots.
    Points {
        /// Number of their points.
        points: usize,
        /// Number of slots.
        slots: usize,
    },
    /// A gap is below zero by more than [`Shapes::deepest`](crate::Shapes::deepest): shapes passed into one another
    /// unseen. Make steps shorter, or the reach longer.
    TooDeep {
        /// The gap.
        gap: f64,
        /// Depth that is allowed.
        deepest: f64,
    },
    /// A number that is not what it must be.
    Number {
        /// Name of the setting.
        field: &'static str,
        /// The number.
        value: f64,
        /// Condition that the number must meet.
        rule: &'static str,
    },
    /// The data of a contact are refused.
    Slot(SlotError),
    /// The step.
    Contact(ContactError),
}

impl ParryError {
    pub(crate) fn of(kind: ParryErrorKind) -> Self {
        Self { shapes: None, kind }
    }
}

impl fmt::Display for ParryErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsupported => f.write_str("the library finds no contacts of shapes of these kinds"),
            Self::Unknown => f.write_str("the shape is none of these; it comes from `add`"),
            Self::PairPoints { points, most } => {
                write!(
                    f,
                    "they touch at {points} points and may at {most}; allow more by `most`, or find fewer by a shorter \
                     `reach` or by `reduce`"
                )
            }
            Self::Points { points, slots } => {
                write!(
                    f,
                    "all shapes touch at {points} points, and there are {slots} slots; make more of them, or find fewer \
                     points by a shorter `reach` or by `reduce`"
                )
            }
            Self::TooDeep { gap, deepest } => write!(
                f,
                "the gap is {gap:e}, and may be {:e}: they passed into one another unseen; make steps shorter, or \
                 `reach` longer",
                -deepest
            ),
            Self::Number { field, value, rule } => write!(f, "`{field}` is {value}; it must be {rule}"),
            Self::Slot(error) => error.fmt(f),
            Self::Contact(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for ParryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.shapes {
            Some((first, second)) => write!(f, "shapes {first} and {second}: {}", self.kind),
            None => self.kind.fmt(f),
        }
    }
}

impl std::error::Error for ParryErrorKind {}

impl std::error::Error for ParryError {}

impl From<SlotError> for ParryError {
    fn from(error: SlotError) -> Self {
        Self::of(ParryErrorKind::Slot(error))
    }
}

impl From<ContactError> for ParryError {
    fn from(error: ContactError) -> Self {
        Self::of(ParryErrorKind::Contact(error))
    }
}
