//! Which symbols of limbs that are alike correspond to one another.

use crate::algebra::Expr;
use crate::mechanics::Coordinate;
use crate::model::Model;
use crate::terms::{InputKind, Twin};
use crate::words::Unraw;

use super::symbols::SceneSymbols;

/// Coordinates, their speeds with rates and momenta, and inputs that are called as they are. Slots are those of the
/// model, each once for every kind.
pub fn twins<'g>(model: &Model, declared: &SceneSymbols<'g>) -> Vec<(Expr<'g>, Twin)> {
    let mut twins = Vec::new();
    let inputs = inputs(model);
    for (name, twin) in &model.limbs.coordinates {
        let Some(place) = model.coordinates.iter().position(|q| q.ident == *name) else { continue };
        let place = declared.before + place;
        if let Some(Coordinate::Scalar(symbol)) = declared.coordinates.get(place) {
            twins.push((*symbol, slot(*twin, 1)));
        }
        // Speeds of their own may be anything.
        if model.speeds.is_none() {
            let first: usize = declared.coordinates[..place].iter().map(|q| q.size()).sum();
            let all = [&declared.speeds, &declared.speed_rates, &declared.momenta];
            let of_speeds = all.iter().zip(2..).filter_map(|(all, kind)| Some((*all.get(first)?, slot(*twin, kind))));
            twins.extend(of_speeds);
        }
        let word = name.unraw().to_string();
        let input =
            inputs.iter().find(|(called, _)| *called == word).and_then(|(_, place)| declared.inputs.get(*place));
        twins.extend(input.map(|&symbol| (symbol, slot(*twin, 5))));
    }
    twins
}

/// A slot of a kind of its own: numbers are the first, coordinates and what belongs to them the others.
pub fn slot(twin: Twin, kind: usize) -> Twin {
    const KINDS: usize = 6;
    Twin { slot: twin.slot * KINDS + kind, ..twin }
}

/// Name of each input, and its first component.
fn inputs(model: &Model) -> Vec<(String, usize)> {
    let mut place = 0;
    let mut all = Vec::new();
    for input in &model.item.inputs {
        all.push((input.called.unraw().to_string(), place));
        place += match input.kind {
            InputKind::Scalar => 1,
            InputKind::Vector => 3,
            InputKind::Wrench => 6,
        };
    }
    all
}
