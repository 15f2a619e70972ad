//! Derivatives that are wanted, of whatever kind, and what each is lowered to.

use crate::accuracy::{Figure, Trial};
use crate::derivatives::{DirectionalDerivatives, ParametricDerivatives, SecondDerivatives};
use crate::methods::DerivativeKind;

use super::columns::LoweredColumns;
use super::expected_outputs::{ExpectedOutputs, OutputSelection};
use super::hoist::Hoister;
use super::write::Program;

/// A derivative that is wanted.
pub struct DerivativeRequest<'g> {
    pub kind: DerivativeKind,
    pub differentiation: Differentiation<'g>,
}

/// Functions that are differentiated, and the kind of derivative.
pub enum Differentiation<'g> {
    /// Functions and then their derivatives along the first direction, and so on.
    WithValues(DirectionalDerivatives<'g>),
    /// The derivatives alone.
    Alone(DirectionalDerivatives<'g>),
    /// Functions of the kernel by parameters: derivatives by the first one, and so on.
    ByParameters(ParametricDerivatives<'g>),
    /// One number twice: along directions i and j up to i.
    Twice(SecondDerivatives<'g>),
}

/// A derivative as it is carried out.
pub struct Derivative<'g> {
    pub kind: DerivativeKind,
    /// Outputs direction by direction, see [`Differentiation`].
    pub program: Program<'g>,
    /// The same where the columns of derivatives are the solutions of one linear system: what is written then.
    pub columns: Option<LoweredColumns<'g>>,
    /// Loss at the states where functions lose most; `None` where it has no value.
    pub figure: Option<Figure>,
}

impl<'g> Derivative<'g> {
    pub fn written(&self) -> &Program<'g> {
        self.columns.as_ref().map_or(&self.program, |columns| &columns.program)
    }
}

/// A derivative with its program and what that should compute.
pub(super) struct DerivativeProgram<'a, 'g> {
    pub kind: DerivativeKind,
    pub program: Program<'g>,
    pub columns: Option<LoweredColumns<'g>>,
    pub expected: ExpectedOutputs<'a, 'g>,
}

impl<'g> DerivativeRequest<'g> {
    /// Lowers a derivative that does not wait for the constants of everything else.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Option<DerivativeProgram<'_, 'g>> {
        let ((program, columns), expected) = match &self.differentiation {
            Differentiation::WithValues(functions) => functions.lower(hoister, OutputSelection::ValuesToo, trial),
            Differentiation::Alone(functions) => functions.lower(hoister, OutputSelection::DerivativesAlone, trial),
            Differentiation::ByParameters(_) => return None,
            Differentiation::Twice(curved) => {
                ((curved.lower(hoister, trial), None), ExpectedOutputs::of_second(curved))
            }
        };
        Some(DerivativeProgram { kind: self.kind, program, columns, expected })
    }

    /// Forms that could be taken in place of its program; nothing of derivatives by parameters, which follow the
    /// functions.
    pub(super) fn forms(&self) -> Vec<Program<'g>> {
        match &self.differentiation {
            Differentiation::WithValues(functions) => functions.forms(OutputSelection::ValuesToo),
            Differentiation::Alone(functions) => functions.forms(OutputSelection::DerivativesAlone),
            Differentiation::ByParameters(_) => Vec::new(),
            Differentiation::Twice(curved) => curved.forms(),
        }
    }

    pub(super) fn by_parameters(&self) -> Option<&ParametricDerivatives<'g>> {
        match &self.differentiation {
            Differentiation::ByParameters(by_parameters) => Some(by_parameters),
            _ => None,
        }
    }
}

impl<'g> DerivativeProgram<'_, 'g> {
    pub fn programs(&self) -> impl Iterator<Item = &Program<'g>> {
        std::iter::once(&self.program).chain(self.columns.as_ref().map(|columns| &columns.program))
    }

    /// Without what is only checked.
    pub fn derivative(self) -> Derivative<'g> {
        Derivative { kind: self.kind, program: self.program, columns: self.columns, figure: None }
    }
}
