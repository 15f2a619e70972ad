//! Expected results of programs, from the expressions that they were made from.

use std::borrow::Cow;

use crate::algebra::{Evaluation, Expr, Number, Tangents};
use crate::derivatives::{Direction, SecondDerivatives};

/// Whether the outputs themselves are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutputSelection {
    ValuesToo,
    DerivativesAlone,
}

/// Expected results of a program of derivatives.
pub(super) struct ExpectedOutputs<'a, 'g> {
    outputs: Cow<'a, [Expr<'g>]>,
    directions: Cow<'a, [Direction<'g>]>,
    kept: OutputSelection,
    /// In place of all that, second derivatives.
    second: Option<&'a SecondDerivatives<'g>>,
}

impl<'a, 'g> ExpectedOutputs<'a, 'g> {
    /// The outputs and their derivatives along each direction.
    pub fn along(outputs: Vec<Expr<'g>>, directions: &'a [Direction<'g>], kept: OutputSelection) -> Self {
        Self { outputs: Cow::Owned(outputs), directions: Cow::Borrowed(directions), kept, second: None }
    }

    /// Derivatives of functions alone.
    pub fn of_derivatives(outputs: Vec<Expr<'g>>, directions: Vec<Direction<'g>>) -> Self {
        let (outputs, directions) = (Cow::Owned(outputs), Cow::Owned(directions));
        Self { outputs, directions, kept: OutputSelection::DerivativesAlone, second: None }
    }

    /// The values of expressions.
    pub fn of(outputs: &'a [Expr<'g>]) -> Self {
        Self {
            outputs: Cow::Borrowed(outputs),
            directions: Cow::Borrowed(&[]),
            kept: OutputSelection::ValuesToo,
            second: None,
        }
    }

    /// The second derivatives of a number.
    pub fn of_second(second: &'a SecondDerivatives<'g>) -> Self {
        Self { second: Some(second), ..Self::of(&second.arrangements[..1]) }
    }

    pub fn outputs(&self) -> &[Expr<'g>] {
        &self.outputs
    }

    /// Computes the expected results by dual numbers through the expressions.
    pub fn values<N: Number>(&self, evaluation: &mut Evaluation<'_, N>) -> Vec<N> {
        if let Some(second) = self.second {
            return second.values(evaluation);
        }
        let mut expected = Vec::new();
        if self.kept == OutputSelection::ValuesToo {
            expected.extend(self.outputs.iter().map(|e| evaluation.value(*e)));
        }
        for direction in self.directions.iter() {
            let rates = direction.iter().map(|(symbol, rate)| (symbol.key(), evaluation.value(*rate))).collect();
            let mut tangents = Tangents::new(evaluation, &rates);
            expected.extend(self.outputs.iter().map(|e| tangents.along(*e)));
        }
        expected
    }
}
