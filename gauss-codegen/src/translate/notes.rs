//! Notes that translation takes on the way, wherever the expressions stand that they are about.

use std::cell::{Ref, RefCell, RefMut};

use proc_macro2::Span;

use crate::algebra::{Expr, Rational};
use crate::terms::Twin;

use super::drag::DragMatrix;
use super::laws::Law;

/// A list of each kind, to which translation adds and from which it takes nothing away.
pub struct Notes<'g>(RefCell<NoteLists<'g>>);

#[derive(Default)]
pub struct NoteLists<'g> {
    /// Literal numbers that are constants of their own.
    pub literals: Vec<(Rational, Expr<'g>)>,
    /// Symbols among these of limbs that are alike.
    pub twins: Vec<(Expr<'g>, Twin)>,
    /// Numbers with which checks may not be sure, where they are written.
    pub extreme: Vec<(Span, Rational)>,
    /// Expressions without a value.
    pub mistakes: Vec<(Span, String)>,
    /// Matrices of drag, for warnings.
    pub drags: Vec<DragMatrix<'g>>,
    /// Constants of elements, for checks and warnings.
    pub laws: Vec<Law<'g>>,
}

impl<'g> Notes<'g> {
    pub fn new(literals: Vec<(Rational, Expr<'g>)>) -> Self {
        Self(RefCell::new(NoteLists { literals, ..NoteLists::default() }))
    }

    /// Notes with the literal numbers of others: noted more than once they would be other symbols.
    pub fn with_literals_of(other: &Self) -> Self {
        let NoteLists { literals, twins, .. } = &*other.read();
        Self(RefCell::new(NoteLists { literals: literals.clone(), twins: twins.clone(), ..NoteLists::default() }))
    }

    pub fn read(&self) -> Ref<'_, NoteLists<'g>> {
        self.0.borrow()
    }

    pub fn add(&self) -> RefMut<'_, NoteLists<'g>> {
        self.0.borrow_mut()
    }

    pub fn into_inner(self) -> NoteLists<'g> {
        self.0.into_inner()
    }
}
