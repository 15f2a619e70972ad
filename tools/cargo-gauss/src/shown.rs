//! What is shown of a struct.

use gauss_codegen::Derivation;

/// A struct in a chart, and what is derived from it.
pub struct Shown {
    /// The name of the struct, and the chart if the user chose one.
    pub title: String,
    pub derivation: Derivation,
}

/// Digits that a method loses to rounding: at the worst state found, and in the middle; as words.
pub fn loss(derivation: &Derivation, method: &str) -> Option<[f64; 2]> {
    derivation.accuracy().iter().find(|(name, _)| name == method).map(|(_, loss)| *loss)
}
