//! What comes out of the translation: plain data.

use proc_macro2::Span;

use crate::algebra::{Expr, Rational, Substitution};
use crate::mechanics::{QuantityValues, SystemScene};
use crate::model::Model;

use super::drag::DragMatrix;
use super::laws::Law;
use super::parameters::Parameter;
use super::state::Quantity;
use super::symbols::Source;

/// A system in symbols.
pub struct Translated<'a, 'g> {
    pub scene: SystemScene<'g>,
    pub given: Given<'a, 'g>,
}

/// What is known of a scene beside its equations: what is only written down, and where things were written.
pub struct Given<'a, 'g> {
    pub model: &'a Model,
    /// Where the symbols of parameters are read.
    pub sources: Vec<Source<'g>>,
    /// The numbers of fields.
    pub parameters: Vec<Parameter<'g>>,
    /// Literal numbers that symbols stand for.
    pub literals: Vec<(Rational, Expr<'g>)>,
    /// Numbers with which checks may not be sure, where they are written.
    pub extreme: Vec<(Span, Rational)>,
    /// Matrices of drag.
    pub drags: Vec<DragMatrix<'g>>,
    /// Constants of elements.
    pub laws: Vec<Law<'g>>,
    /// Mass data that are written in clauses.
    pub mass_data: MassData<'g>,
    /// Which link each clause of a body or frame became.
    pub links: Vec<usize>,
    /// The links of the frames that are asked for, in their order.
    pub frames: Vec<usize>,
    /// What the speeds are called.
    pub speeds: Vec<SpeedName>,
    /// Coordinates and speeds of a state.
    pub state: [Vec<Quantity>; 2],
    /// Indices of the speeds that stay where constraints are solved for the others.
    pub independent: Option<Vec<usize>>,
}

/// Values of mass data that are written in clauses.
pub struct MassData<'g> {
    /// Of the body without a name, and gravity.
    pub unnamed: Vec<QuantityValues<'g>>,
    /// Clause by clause of the bodies with names.
    pub named: Vec<Vec<QuantityValues<'g>>>,
}

/// The name of a speed, and where it is written.
pub struct SpeedName {
    pub text: String,
    pub span: Span,
}

impl<'g> Given<'_, 'g> {
    /// Puts expressions in the place of symbols, as of speeds that constraints determine.
    pub fn substitute(&mut self, replacement: &Substitution<'g>) {
        let values = self.laws.iter_mut().map(|law| &mut law.values);
        let rows = self.drags.iter_mut().flat_map(|drag| &mut drag.entries);
        values.chain(rows).flatten().for_each(|e| *e = replacement.of(*e));
    }
}
