//! Coordinates by which a joint that is let go moves, or a driven coordinate that is.

use crate::algebra::{Expr, Graph};
use crate::mechanics::{Coordinate, Name};

use super::symbols::SceneSymbols;

/// Parts that are let go.
#[derive(Clone, PartialEq)]
pub(super) enum FreedPart {
    /// The joint that carries the body or frame of that name.
    Joint(String),
    /// The driven coordinate of that name.
    Motion(String),
}

/// Coordinates, speeds and rates by which a part that is let go moves.
#[derive(Clone)]
pub(super) struct FreedJoint<'g> {
    pub part: FreedPart,
    /// Along the axes of a joint, then about them one after the other; of a motion one.
    pub coordinates: Vec<Expr<'g>>,
    pub speeds: Vec<Expr<'g>>,
    pub rates: Vec<Expr<'g>>,
}

impl<'g> FreedJoint<'g> {
    pub fn new(graph: &'g Graph, part: FreedPart) -> Self {
        let (name, mark, count) = match &part {
            FreedPart::Joint(link) => (link.clone(), "", 6),
            FreedPart::Motion(coordinate) => (coordinate.clone(), "m", 1),
        };
        let symbols = |letter: &str| {
            let symbol = |i| graph.symbol(format!("{letter}{mark}{i}_{name}"), letter.to_owned(), false);
            (1..=count).map(symbol).collect()
        };
        Self { coordinates: symbols("x"), speeds: symbols("s"), rates: symbols("ds"), part }
    }

    pub fn declare(&self, declared: &mut SceneSymbols<'g>) {
        let name = || Name::new("x", "x");
        let names = || self.speeds.iter().map(|_| name());
        declared.coordinates.extend(self.coordinates.iter().copied().map(Coordinate::Scalar));
        declared.coordinate_names.extend(names());
        declared.speeds.extend(&self.speeds);
        declared.speed_rates.extend(&self.rates);
        declared.momentum_names.extend(names());
        declared.force_names.extend(names());
        // Momenta are not asked for.
        declared.momenta.extend(&self.speeds);
    }
}
