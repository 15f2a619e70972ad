//! Derivatives that are wanted, of whatever kind, and what each is lowered to.

use crate::accuracy::{Figure, Trial};
use crate::methods::DerivativeKind;

use super::columns::LoweredColumns;
use super::derivatives::Differentiated;
use super::expected::{Expected, Kept};
use super::hessian::Curved;
use super::hoist::Hoister;
use super::parametric::ByParameters;
use super::write::Program;

/// A derivative that is wanted.
pub struct Wanted<'g> {
    pub kind: DerivativeKind,
    pub differentiation: Differentiation<'g>,
}

/// Functions that are differentiated, and the kind of derivative.
pub enum Differentiation<'g> {
    /// Functions and then their derivatives along the first direction, and so on.
    WithValues(Differentiated<'g>),
    /// The derivatives alone.
    Alone(Differentiated<'g>),
    /// Functions of the kernel by parameters: derivatives by the first one, and so on.
    ByParameters(ByParameters<'g>),
    /// One number twice: along directions i and j up to i.
    Twice(Curved<'g>),
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
pub(super) struct Lowered<'a, 'g> {
    pub kind: DerivativeKind,
    pub program: Program<'g>,
    pub columns: Option<LoweredColumns<'g>>,
    pub expected: Expected<'a, 'g>,
}

impl<'g> Wanted<'g> {
    /// Lowers a derivative that does not wait for the constants of everything else.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Option<Lowered<'_, 'g>> {
        let ((program, columns), expected) = match &self.differentiation {
            Differentiation::WithValues(functions) => functions.lower(hoister, Kept::ValuesToo, trial),
            Differentiation::Alone(functions) => functions.lower(hoister, Kept::DerivativesAlone, trial),
            Differentiation::ByParameters(_) => return None,
            Differentiation::Twice(curved) => ((curved.lower(hoister, trial), None), Expected::of_second(curved)),
        };
        Some(Lowered { kind: self.kind, program, columns, expected })
    }

    /// Forms that could be taken in place of its program; nothing of derivatives by parameters, which follow the
    /// functions.
    pub(super) fn forms(&self) -> Vec<Program<'g>> {
        match &self.differentiation {
            Differentiation::WithValues(functions) => functions.forms(Kept::ValuesToo),
            Differentiation::Alone(functions) => functions.forms(Kept::DerivativesAlone),
            Differentiation::ByParameters(_) => Vec::new(),
            Differentiation::Twice(curved) => curved.forms(),
        }
    }

    pub(super) fn by_parameters(&self) -> Option<&ByParameters<'g>> {
        match &self.differentiation {
            Differentiation::ByParameters(by_parameters) => Some(by_parameters),
            _ => None,
        }
    }
}

impl<'g> Lowered<'_, 'g> {
    pub fn programs(&self) -> impl Iterator<Item = &Program<'g>> {
        std::iter::once(&self.program).chain(self.columns.as_ref().map(|columns| &columns.program))
    }

    /// Without what is only checked.
    pub fn derivative(self) -> Derivative<'g> {
        Derivative { kind: self.kind, program: self.program, columns: self.columns, figure: None }
    }
}
