//! Second derivatives of one number along many directions.

use crate::accuracy::Trial;
use crate::algebra::{Dual, Evaluation, Expr, Map, Number, Rational, Tangents};
use crate::derivatives::{Direction, SecondDerivatives};

use super::adjoint::gradient;
use super::choice::{Aim, Pool, programs_of};
use super::hoist::Hoister;
use super::tangent::{with_outputs, with_tangents};
use super::write::{Operand, Operation, Program};

impl<'g> SecondDerivatives<'g> {
    /// The cheapest way that keeps the digits.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>, trial: &mut Trial) -> Program<'g> {
        let definitions = hoister.program(&self.defined);
        let arrangements: Vec<Vec<Expr<'g>>> = self.arrangements.iter().map(|e| vec![*e]).collect();
        let Pool { lowered, tried, .. } =
            Pool::of(&arrangements, Aim::Values, hoister, Hoister::hoist_undefined, trial);
        let cost = |k: &usize| lowered[*k].program.cost().total();
        let cheapest = |usable: &[bool]| (0..usable.len()).filter(|&k| usable[k]).min_by_key(cost);
        let those: Vec<usize> = if trial.decides_derivatives() {
            (0..lowered.len()).collect()
        } else {
            cheapest(&tried.usable()).into_iter().collect()
        };
        let mut ways: Vec<Program<'g>> =
            self.derived.iter().map(|e| hoister.program(e).signed(hoister.passes)).collect();
        ways.extend(those.into_iter().map(|k| self.of_program(&lowered[k].program, &definitions)));
        trial.define(hoister.constants());
        let tried = trial.tried(&ways.iter().collect::<Vec<_>>());
        let costs: Vec<u32> = ways.iter().map(|program| program.cost().total()).collect();
        ways.swap_remove(tried.taken(&costs)).carried_out(hoister.passes)
    }

    /// Forms that could be taken: programs whose constants are not computed before.
    pub(super) fn forms(&self) -> Vec<Program<'g>> {
        let definitions = Program::lower(&self.defined);
        let arrangements: Vec<Vec<Expr<'g>>> = self.arrangements.iter().map(|e| vec![*e]).collect();
        programs_of(&arrangements).iter().map(|program| self.of_program(program, &definitions)).collect()
    }

    /// The gradient by backward differentiation, and its tangents.
    fn of_program(&self, program: &Program<'g>, definitions: &Program<'g>) -> Program<'g> {
        let count = self.directions.len();
        let gradient = gradient(program, &self.directions);
        let all = with_tangents(&gradient, (&self.defined, definitions), &self.directions);
        // Along j of the derivative along i.
        let entry = |i: usize, j: usize| all.outputs[count * (1 + j) + i];
        // Tangents of what little depends on are short, of what all depends on long: derivatives along the latter are
        // taken last.
        let reach: Vec<usize> = self.directions.iter().map(|direction| reach(program, direction)).collect();
        let mut instructions = all.instructions.clone();
        let outputs = Self::pairs(count).map(|(i, j)| {
            if !self.commute(i, j) {
                return mean(&mut instructions, entry(i, j), entry(j, i));
            }
            if reach[i] <= reach[j] { entry(i, j) } else { entry(j, i) }
        });
        let outputs = outputs.collect();
        with_outputs(&Program { instructions, outputs: Vec::new() }, outputs)
    }

    /// Computes the second derivatives by dual numbers of dual numbers through the expressions.
    pub fn values<N: Number>(&self, evaluation: &mut Evaluation<'_, N>) -> Vec<N> {
        let output = self.arrangements[0];
        let moving: Vec<Map<u32, Dual<N>>> = self
            .directions
            .iter()
            .map(|direction| {
                let mut point: Map<u32, Dual<N>> =
                    evaluation.symbols().iter().map(|(&key, &value)| (key, Dual::constant(value))).collect();
                for (symbol, rate) in direction {
                    let (value, rate) = (evaluation.value(*symbol), evaluation.value(*rate));
                    point.insert(symbol.key(), Dual { value, rate });
                }
                point
            })
            .collect();
        let mut evaluations: Vec<Evaluation<'_, Dual<N>>> = moving.iter().map(Evaluation::new).collect();
        let mut second = |i: usize, j: usize| {
            let rates = self.directions[j].iter();
            let rates = rates.map(|(symbol, rate)| (symbol.key(), evaluations[i].value(*rate))).collect();
            Tangents::new(&mut evaluations[i], &rates).along(output).rate
        };
        let pairs = Self::pairs(self.directions.len());
        pairs
            .map(|(i, j)| match self.commute(i, j) {
                true => second(i, j),
                false => (second(i, j) + second(j, i)) * N::fraction(Rational::new(1, 2)),
            })
            .collect()
    }
}

fn mean<'g>(instructions: &mut Vec<Operation<'g>>, a: Operand<'g>, b: Operand<'g>) -> Operand<'g> {
    if a == b {
        return a;
    }
    let mut push = |operation: Operation<'g>| {
        instructions.push(operation);
        Operand::Value(instructions.len() - 1)
    };
    let sum = push(Operation::Add(a, b));
    push(Operation::Multiply(sum, Operand::Number(Rational::new(1, 2))))
}

/// Number of instructions that give something else along a direction.
fn reach<'g>(program: &Program<'g>, direction: &Direction<'g>) -> usize {
    let mut moves = vec![false; program.instructions.len()];
    for k in 0..moves.len() {
        moves[k] = program.instructions[k].operands().any(|operand| match operand {
            Operand::Input(e) => direction.iter().any(|(symbol, _)| *symbol == e),
            Operand::Number(_) => false,
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => moves[k],
        });
    }
    moves.into_iter().filter(|moves| *moves).count()
}
