//! Owners of expressions, as messages call them.

use crate::model::language::words;
use crate::model::scene::elements::Row;

/// Owners of ends, an extent, constants or coefficients.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    Element(&'static Row),
    Armature,
    Lock,
    Modes,
    AddedMass,
    Inertia,
    Contact,
}

impl Holder {
    /// Noun in messages, with its article.
    pub fn noun(self) -> String {
        match self {
            Holder::Element(row) => words::a(row.noun),
            Holder::Armature => "an armature".into(),
            Holder::Lock => "a lock".into(),
            Holder::Modes => "modes".into(),
            Holder::AddedMass => "an added mass".into(),
            Holder::Inertia => "an inertia".into(),
            Holder::Contact => "a contact".into(),
        }
    }

    /// Words for its constants.
    pub fn constant(self) -> String {
        match self {
            Holder::Element(_) | Holder::Contact => format!("a constant of {}", self.noun()),
            Holder::Armature | Holder::Lock | Holder::Modes | Holder::AddedMass | Holder::Inertia => self.noun(),
        }
    }
}
