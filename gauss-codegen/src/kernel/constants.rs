//! The constants of a kernel: what programs read of that which depends on parameters alone.

use crate::algebra::{Evaluation, Expr, Map, Set};

use super::hoist::Hoister;
use super::write::Program;

/// Constants, in order.
pub(super) struct Constants<'g> {
    pub program: Program<'g>,
    pub symbols: Vec<Expr<'g>>,
}

/// The constants that are read.
pub(super) struct ConstantSet<'g> {
    pub constants: Constants<'g>,
    /// Constants that literals alone determine, with their values and with their definitions.
    pub known: Vec<(Expr<'g>, f64)>,
    pub folded: Vec<(Expr<'g>, Expr<'g>)>,
}

/// Symbols and literals that constants are found from, beside those that a hoister has gathered.
pub(super) struct ConstantSource<'a, 'g> {
    /// Symbols that all programs read but those that are asked about.
    pub read: &'a [Expr<'g>],
    /// Symbols that stand for literals, where their values are known.
    pub literals: Option<&'a Map<u32, f64>>,
}

impl<'g> ConstantSource<'_, 'g> {
    /// Constants that are read, here or besides. Those that only a dearer arrangement wanted are dropped.
    pub fn hoisted(&self, hoister: &Hoister<'_, 'g>, besides: &[Expr<'g>]) -> ConstantSet<'g> {
        let read: Set<u32> = self.read.iter().chain(besides).map(|symbol| symbol.key()).collect();
        let (mut symbols, mut values) = (Vec::new(), Vec::new());
        let (mut known, mut folded) = (Vec::new(), Vec::new());
        for &(symbol, definition) in hoister.constants().iter().filter(|(symbol, _)| read.contains(&symbol.key())) {
            match self.known(definition) {
                Some(value) => {
                    known.push((symbol, value));
                    folded.push((symbol, definition));
                }
                None => {
                    symbols.push(symbol);
                    values.push(definition);
                }
            }
        }
        ConstantSet {
            constants: Constants { program: Program::lowered(&values, hoister.passes), symbols },
            known,
            folded,
        }
    }

    /// The value of what literals alone determine. What has none is left to `kernel()`, which refuses it; nearly all
    /// that is made of parameters has none here.
    fn known(&self, definition: Expr<'g>) -> Option<f64> {
        let literals = self.literals?;
        let value = Evaluation::of_known(literals).value(definition);
        let is_made_of_literals =
            || Program::lower(&[definition]).symbols().iter().all(|symbol| literals.contains_key(&symbol.key()));
        Some(value).filter(|value| value.is_finite() && is_made_of_literals())
    }
}
