//! The expressions that each method of a kernel is made from.

use crate::algebra::Expr;

use crate::methods::Methods;
pub use crate::methods::{FrameQuantity, Method};

/// Equal outputs of one method, formed in different ways: the kernel takes the one that costs least of those that keep
/// the digits.
pub type Arrangements<'g> = Vec<Vec<Expr<'g>>>;

/// The arrangements of every method.
pub type Formulas<'g> = Methods<Arrangements<'g>>;

/// The arrangements of one method that not every kernel has.
#[derive(Clone)]
pub struct Formula<'g> {
    pub method: Method,
    pub arrangements: Arrangements<'g>,
}

impl<'g> Formulas<'g> {
    /// Adds methods behind those that are there.
    pub fn extend(&mut self, formulas: impl IntoIterator<Item = Formula<'g>>) {
        self.others.extend(formulas.into_iter().map(|Formula { method, arrangements }| (method, arrangements)));
    }
}
