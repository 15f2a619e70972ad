//! Names of `define` in printed equations, and angles of files that are meant to be quarter turns.

use crate::algebra::{Expr, Rational};
use crate::mechanics::{Readings, Tree};

use super::notes::Notes;
use super::symbols::name_of;
use super::translator::Translator;
use super::value::Value;

/// Decimal places from which on a number of a file that is a multiple of π/2 to its last place is taken for it in
/// print: of four, one angle in ten thousand is there by chance.
const PLACES: u32 = 4;

impl<'g> Translator<'_, 'g> {
    /// As far as they occur in the scene as it was translated: what is only printed makes nothing.
    pub(super) fn readings(&self, tree: &Tree<'g>) -> Readings<'g> {
        let mut names = Vec::new();
        for (ident, expression) in &self.model.definitions {
            // What is noted has been noted where the name stands.
            let notes = Notes::with_literals_of(self.notes);
            let quiet = Translator { notes: &notes, ..self.clone() };
            let name = name_of(ident);
            let found = self.graph.existing(|| match quiet.value(expression, tree).map(Value::observed) {
                Ok(Value::Scalar(value)) => vec![value],
                Ok(Value::Vector(components)) => components.to_vec(),
                _ => Vec::new(),
            });
            let several = found.len() > 1;
            let named = found.into_iter().enumerate().filter_map(|(k, value)| {
                let name = if several { name.index(k) } else { name.clone() };
                value.filter(|value| !value.is_leaf()).map(|value| (name, value))
            });
            names.extend(named);
        }
        let literals = self.notes.read().literals.clone();
        let in_file = self.model.item.described.is_some();
        let angles = literals.into_iter().filter(|_| in_file).filter_map(|(value, symbol)| angle(value, symbol));
        Readings { names, angles: angles.collect() }
    }
}

/// A number with so many decimal places that is as near to quarters of a turn as these can say.
fn angle(value: Rational, symbol: Expr<'_>) -> Option<(Expr<'_>, i64)> {
    let (numerator, denominator) = value.parts()?;
    let places = (0..18).find(|&places| 10_i64.checked_pow(places).is_some_and(|power| power % denominator == 0))?;
    let quarters = (value.to_f64() / std::f64::consts::FRAC_PI_2).round();
    // The last place, and what doubles round.
    let half = 0.5 * 0.1_f64.powi(i32::try_from(places).ok()?) + 4.0 * f64::EPSILON * value.to_f64().abs();
    let near = (value.to_f64() - quarters * std::f64::consts::FRAC_PI_2).abs() <= half;
    (numerator != 0 && places >= PLACES && near && quarters.abs() < 1e6).then_some((symbol, quarters as i64))
}
