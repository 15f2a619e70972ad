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
struct Lowered<'a, 'g> {
    outputs: &'a [Expr<'g>],
    program: Program<'g>,
}

/// The arrangement that is taken.
pub(super) struct Taken<'a, 'g> {
    pub outputs: &'a [Expr<'g>],
    /// The outputs of the first one where that keeps the digits, too.
    pub first: Option<&'a [Expr<'g>]>,
    pub program: Program<'g>,
    /// The same as it is carried out, and whether sums that are begun by what is added to them keep its digits.
    pub carried_out: Program<'g>,
    pub begun: bool,
    /// Of what is carried out.
    pub loss: Loss,
}

impl<'g> Candidates<'g> {
    /// Arrangements of which values are wanted.
    #[cfg(test)]
    pub fn of_values(arrangements: Vec<Vec<Expr<'g>>>) -> Self {
        Self { arrangements, aim: Aim::Values }
    }

    /// The arrangement that is taken.
    pub(super) fn taken(&self, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Taken<'_, 'g> {
        let mut lowered = self.lowered(hoister);
        trial.define(hoister.constants());
        let programs: Vec<&Program<'g>> = lowered.iter().map(|candidate| &candidate.program).collect();
        let tried = trial.tried(&programs);
        let best = taken(&tried.losses, &self.costs(&lowered, hoister));
        let first = Some(lowered[0].outputs).filter(|_| usable(&tried.losses)[0]);
        let Lowered { outputs, program } = lowered.swap_remove(best);
        let loss = tried.losses[best].clone();
        // A power series has a recurrence for every product, and takes a negation of an addend for an instruction like any other.
        if self.aim == Aim::Series {
            return Taken { outputs, first, carried_out: program.clone(), program, begun: true, loss };
        }
        let program = program.with_signs_led_back();
        let fused = program.clone().with_products_in_sums();
        let Some(sums_begun) = fused.sums_begun() else {
            return Taken { outputs, first, program, carried_out: fused.ordered(), begun: true, loss };
        };
        let other_loss = tried.loss_of(&sums_begun);
        let begun = other_loss.keeps(&loss);
        let (carried_out, loss) = if begun { (sums_begun, other_loss) } else { (fused, loss) };
        Taken { outputs, first, program, carried_out: carried_out.ordered(), begun, loss }
    }

    /// The arrangements as programs, in their order; those that are the same once constants are hoisted, once.
    fn lowered(&self, hoister: &mut Hoister<'_, 'g>) -> Vec<Lowered<'_, 'g>> {
        let (mut seen, mut lowered) = (Vec::new(), Vec::new());
        for outputs in &self.arrangements {
            let hoisted = hoister.hoist(outputs);
            if !seen.contains(&hoisted) {
                lowered.push(Lowered { outputs, program: Program::lower(&hoisted) });
                seen.push(hoisted);
            }
        }
        lowered
    }

    fn costs(&self, candidates: &[Lowered<'_, 'g>], hoister: &Hoister<'_, 'g>) -> Vec<u32> {
        let cost = |candidate: &Lowered<'_, 'g>| match self.aim {
            Aim::Values => candidate.program.cost().total(),
            Aim::Series => candidate.program.series_cost(|symbol| hoister.is_hoisted(symbol)),
        };
        candidates.iter().map(cost).collect()
    }
}
