//! The arrangements of one function, and which of them is taken.

use crate::accuracy::{Loss, Trial, taken, usable};
use crate::algebra::Expr;

use super::hoist::Hoister;
use super::write::Program;

/// A function to be lowered: lists of outputs that are equal, of which one is taken.
pub struct Candidates<'g> {
    pub arrangements: Vec<Vec<Expr<'g>>>,
    pub aim: Aim,
}

/// What a function is to be cheap for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Its values.
    Values,
    /// The power series of its values.
    Series,
}

/// An arrangement with its program.
pub(super) struct Lowered<'a, 'g> {
    pub outputs: &'a [Expr<'g>],
    pub program: Program<'g>,
    pub loss: Loss,
}

impl<'g> Candidates<'g> {
    /// Arrangements of which values are wanted.
    #[cfg(test)]
    pub fn of_values(arrangements: Vec<Vec<Expr<'g>>>) -> Self {
        Self { arrangements, aim: Aim::Values }
    }

    /// The arrangement that is taken, and the outputs of the first one where that keeps the digits, too.
    pub(super) fn chosen(
        &self,
        hoister: &mut Hoister<'_, 'g>,
        trial: &mut Trial,
    ) -> (Lowered<'_, 'g>, Option<&[Expr<'g>]>) {
        let mut lowered = self.lowered(hoister);
        trial.define(hoister.constants());
        let programs: Vec<&Program<'g>> = lowered.iter().map(|candidate| &candidate.program).collect();
        let losses = trial.losses(&programs);
        let best = taken(&losses, &self.costs(&lowered, hoister));
        let first = Some(lowered[0].outputs).filter(|_| usable(&losses)[0]);
        let Lowered { outputs, program, .. } = lowered.swap_remove(best);
        // A power series takes a negation of an addend for an instruction like any other.
        let program = if self.aim == Aim::Values { program.with_signs_led_back() } else { program };
        (Lowered { outputs, program, loss: losses.into_iter().nth(best).unwrap_or_default() }, first)
    }

    /// The arrangements as programs, in their order; those that are the same once constants are hoisted, once.
    fn lowered(&self, hoister: &mut Hoister<'_, 'g>) -> Vec<Lowered<'_, 'g>> {
        let (mut seen, mut lowered) = (Vec::new(), Vec::new());
        for outputs in &self.arrangements {
            let hoisted = hoister.hoist(outputs);
            if !seen.contains(&hoisted) {
                lowered.push(Lowered { outputs, program: Program::lower(&hoisted), loss: Loss::default() });
                seen.push(hoisted);
            }
        }
        lowered
    }

    /// The program that is taken, once nothing is differentiated any more.
    pub(super) fn carried_out(&self, program: Program<'g>) -> Program<'g> {
        // A power series has a recurrence for every product.
        if self.aim == Aim::Values { program.carried_out() } else { program }
    }

    fn costs(&self, candidates: &[Lowered<'_, 'g>], hoister: &Hoister<'_, 'g>) -> Vec<u32> {
        let cost = |candidate: &Lowered<'_, 'g>| match self.aim {
            Aim::Values => candidate.program.cost().total(),
            Aim::Series => candidate.program.series_cost(|symbol| hoister.is_hoisted(symbol)),
        };
        candidates.iter().map(cost).collect()
    }
}
