//! Coordinates by which a joint that is let go moves.

use crate::algebra::{Expr, Graph};
use crate::mechanics::{Coordinate, Name};

use super::symbols::SceneSymbols;

/// Coordinates, speeds and rates by which a joint that is let go moves.
#[derive(Clone)]
pub(super) struct FreedJoint<'g> {
    /// The name of the body or frame that it carries.
    pub link: String,
    /// Along the axes, then about them one after the other.
    pub coordinates: [Expr<'g>; 6],
    pub speeds: [Expr<'g>; 6],
    pub rates: [Expr<'g>; 6],
}

impl<'g> FreedJoint<'g> {
    pub fn new(graph: &'g Graph, link: String) -> Self {
        let symbols = |letter: &str| {
            std::array::from_fn(|i| graph.symbol(format!("{letter}{}_{link}", i + 1), letter.to_owned(), false))
        };
        Self { coordinates: symbols("x"), speeds: symbols("s"), rates: symbols("ds"), link }
    }

    pub fn declare(&self, declared: &mut SceneSymbols<'g>) {
        let name = || Name::new("x", "x");
        declared.coordinates.extend(self.coordinates.map(Coordinate::Scalar));
        declared.coordinate_names.extend((0..6).map(|_| name()));
        declared.speeds.extend(self.speeds);
        declared.speed_rates.extend(self.rates);
        declared.momentum_names.extend((0..6).map(|_| name()));
        declared.force_names.extend((0..6).map(|_| name()));
        // Momenta are not asked for.
        declared.momenta.extend(self.speeds);
    }
}
