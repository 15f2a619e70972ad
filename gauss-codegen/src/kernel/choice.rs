//! The arrangements of one function, and which of them is taken.

use crate::accuracy::{Loss, Trial, TrialResult};
use crate::algebra::{Expr, without_differences};

use super::hoist::Hoister;
use super::write::Program;

/// A function to be lowered: lists of outputs that are equal, of which one is taken.
pub struct Candidates<'g> {
    pub arrangements: Vec<Vec<Expr<'g>>>,
    pub aim: Aim,
}

/// Aims of a choice: the results that a function is to be cheap for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Its values.
    Values,
    /// The power series of its values.
    Series,
}

/// An arrangement with its program.
pub(super) struct LoweredForm<'g> {
    pub outputs: Vec<Expr<'g>>,
    hoisted: Vec<Expr<'g>>,
    pub program: Program<'g>,
}

/// Arrangements as programs, with what they lose and which is the best of them.
pub(super) struct Pool<'g> {
    pub lowered: Vec<LoweredForm<'g>>,
    pub tried: TrialResult,
    pub best: usize,
}

/// The loss from which on differences of like functions are looked for, and the instructions up to which: in long
/// programs they are hardly ever alone in a sum, and a second form of each arrangement takes its time.
const SUSPECT: f64 = 30.0;
const LONG: usize = 1000;

/// The arrangement that is taken.
pub(super) struct Choice<'g> {
    pub outputs: Vec<Expr<'g>>,
    /// The outputs of the first one where that keeps the digits, too.
    pub first: Option<Vec<Expr<'g>>>,
    pub program: Program<'g>,
    /// The same as it is carried out, and whether sums that are begun by what is added to them keep its digits.
    pub carried_out: Program<'g>,
    pub begun: bool,
    /// Rounding loss of `carried_out`.
    pub loss: Loss,
}

impl<'g> Candidates<'g> {
    /// Arrangements of which values are wanted.
    #[cfg(test)]
    pub fn of_values(arrangements: Vec<Vec<Expr<'g>>>) -> Self {
        Self { arrangements, aim: Aim::Values }
    }

    /// The arrangement that is taken.
    pub(super) fn taken(&self, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Choice<'g> {
        let Pool { mut lowered, tried, best } = Pool::of(&self.arrangements, self.aim, hoister, Hoister::hoist, trial);
        let first = Some(lowered[0].outputs.clone()).filter(|_| tried.usable()[0]);
        let LoweredForm { outputs, program, .. } = lowered.swap_remove(best);
        let loss = tried.losses[best].clone();
        // A power series has a recurrence for every product, and takes a negation of an addend for an instruction like
        // any other.
        if self.aim == Aim::Series {
            return Choice { outputs, first, carried_out: program.clone(), program, begun: true, loss };
        }
        let program = program.signed(hoister.passes);
        let fused = program.clone().fused(hoister.passes);
        let Some(sums_begun) = fused.begun(hoister.passes) else {
            return Choice { outputs, first, program, carried_out: fused.ordered(), begun: true, loss };
        };
        let other_loss = trial.loss_of(&tried, &sums_begun);
        let begun = other_loss.keeps(&loss);
        let (carried_out, loss) = if begun { (sums_begun, other_loss) } else { (fused, loss) };
        Choice { outputs, first, program, carried_out: carried_out.ordered(), begun, loss }
    }
}

/// Everything that could be taken in place of a program of so many instructions.
pub(super) fn forms<'g>(arrangements: &[Vec<Expr<'g>>], instructions: usize) -> Vec<Vec<Expr<'g>>> {
    let mut forms = arrangements.to_vec();
    if instructions <= LONG {
        forms.extend(arrangements.iter().flat_map(|outputs| without_differences(outputs)));
    }
    forms
}

/// The same as programs of constants that are not computed before.
pub(super) fn programs_of<'g>(arrangements: &[Vec<Expr<'g>>]) -> Vec<Program<'g>> {
    let Some(first) = arrangements.first() else { return Vec::new() };
    let length = Program::lower(first).instructions.len();
    forms(arrangements, length).iter().map(|outputs| Program::lower(outputs)).collect()
}

impl<'g> Pool<'g> {
    /// Programs of equal outputs, hoisted in one way or the other. Where the best loses much, or derivatives do
    /// somewhere, each is tried without its differences of like functions as well.
    pub fn of<'a>(
        arrangements: &[Vec<Expr<'g>>],
        aim: Aim,
        hoister: &mut Hoister<'a, 'g>,
        hoist: fn(&mut Hoister<'a, 'g>, &[Expr<'g>]) -> Vec<Expr<'g>>,
        trial: &mut Trial,
    ) -> Self {
        let of_derivatives = trial.decides_derivatives();
        let mut lowered = Vec::new();
        let mut add = |arrangements: &[Vec<Expr<'g>>], lowered: &mut Vec<LoweredForm<'g>>| {
            for outputs in arrangements {
                let hoisted = hoist(hoister, outputs);
                // Those that are the same once constants are hoisted, once.
                if lowered.iter().all(|other| other.hoisted != hoisted) {
                    let program = Program::lowered(&hoisted, hoister.passes);
                    lowered.push(LoweredForm { outputs: outputs.clone(), hoisted, program });
                }
            }
            trial.define(hoister.constants());
            let programs: Vec<&Program<'g>> = lowered.iter().map(|other| &other.program).collect();
            let costs: Vec<u32> = programs.iter().map(|program| aim.cost(program, hoister)).collect();
            let tried = trial.tried(&programs);
            let best = tried.taken(&costs);
            (tried, best)
        };
        let (mut tried, mut best) = add(arrangements, &mut lowered);
        let is_suspect = of_derivatives || tried.losses[best].worst() > SUSPECT;
        if is_suspect && lowered[best].program.instructions.len() <= LONG {
            let others: Vec<Vec<Expr<'g>>> =
                lowered.iter().flat_map(|candidate| without_differences(&candidate.outputs)).collect();
            if !others.is_empty() {
                (tried, best) = add(&others, &mut lowered);
            }
        }
        Self { lowered, tried, best }
    }
}

impl Aim {
    fn cost<'g>(self, program: &Program<'g>, hoister: &Hoister<'_, 'g>) -> u32 {
        match self {
            Aim::Values => program.cost().total(),
            Aim::Series => program.series_cost(|symbol| hoister.is_hoisted(symbol)),
        }
    }
}
