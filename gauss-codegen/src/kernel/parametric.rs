//! Derivatives by parameters, through the constants that are made of them or in forms of their own.

use crate::accuracy::Trial;
use crate::algebra::{Expr, Graph, Map};
use crate::derivatives::{Direction, ParametricDerivatives};
use crate::methods::Methods;

use super::choice::Choice;
use super::constants::{ConstantSet, ConstantSource, Constants};
use super::expected_outputs::ExpectedOutputs;
use super::hoist::Hoister;
use super::tangent::{Implicit, implicit_tangents, joined, tangents_alone, with_outputs, with_tangents};
use super::write::{Operand, Operation, Program};

/// A program that computes derivatives, and the constants of the kernel with it.
struct ParametricProgram<'g> {
    program: Program<'g>,
    hoisted: ConstantSet<'g>,
}

impl ParametricProgram<'_> {
    fn cost(&self) -> u32 {
        self.program.cost().total() + self.hoisted.constants.program.cost().total()
    }
}

impl<'g> ParametricDerivatives<'g> {
    /// The cheapest way that keeps the digits, with the constants that it needs computed once.
    pub(super) fn lower<'b>(
        &self,
        graph: &'g Graph,
        functions: &Methods<Choice<'g>>,
        source: &ConstantSource<'_, 'g>,
        hoister: &mut Hoister<'_, 'g>,
        trial: &mut Trial,
    ) -> (Program<'g>, ExpectedOutputs<'b, 'g>, ConstantSet<'g>) {
        let along: Vec<Direction<'g>> =
            self.parameters.iter().map(|&parameter| vec![(parameter, graph.one())]).collect();
        let way = self.differentiated(graph, functions, &along, source.hoisted(hoister, &[]));
        let ParametricProgram { program, hoisted } = self.cheaper(way, source, hoister, trial);
        let of_velocity = self.order.iter().map(|&k| functions.configuration_rates().outputs[k]);
        let outputs: Vec<Expr<'g>> = of_velocity.chain(functions.acceleration.outputs.iter().copied()).collect();
        (program.carried_out(hoister.passes), ExpectedOutputs::of_derivatives(outputs, along), hoisted)
    }

    /// Programs read constants, not parameters: the program of the constants is differentiated first, and what their
    /// derivatives are, unless numbers, becomes constants too, computed once. Accelerations are differentiated as they
    /// are computed, or as the solution of their equation, whose constants are simpler; the cheaper program is taken.
    fn differentiated(
        &self,
        graph: &'g Graph,
        functions: &Methods<Choice<'g>>,
        along: &[Direction<'g>],
        hoisted: ConstantSet<'g>,
    ) -> ParametricProgram<'g> {
        let rates = ConstantRates::new(graph, &hoisted.constants, along);
        let velocity = &functions.configuration_rates().program;
        let ordered = self.order.iter().map(|&k| velocity.outputs[k]).collect();
        let velocity = Program { instructions: velocity.instructions.clone(), outputs: ordered };
        let acceleration = &functions.acceleration.program;
        let mut candidates =
            vec![tangents_alone(&joined(&velocity, acceleration), (&[], &Program::nothing()), &rates.directions)];
        candidates.extend(self.equation.as_ref().map(|equation| {
            let implicit = Implicit {
                root: acceleration,
                residual: &functions.gauss_residual.program,
                unknowns: &equation.unknowns,
                solution: &functions.velocity.program,
                loads: &equation.loads,
            };
            implicit_tangents(&velocity, &implicit, &rates.directions)
        }));
        let cost = |program: &Program<'g>| program.cost().total() + rates.constants_for(program).program.cost().total();
        let program = candidates.into_iter().min_by_key(cost).expect("one way at least");
        let constants = rates.constants_for(&program);
        ParametricProgram { program, hoisted: ConstantSet { constants, ..hoisted } }
    }

    /// A way that differentiates programs, or what has a form of its own and costs less. Of roots, whose slope may be
    /// infinite, only programs know what their derivatives are where nothing changes.
    fn cheaper(
        &self,
        way: ParametricProgram<'g>,
        source: &ConstantSource<'_, 'g>,
        hoister: &mut Hoister<'_, 'g>,
        trial: &mut Trial,
    ) -> ParametricProgram<'g> {
        let most = way.cost();
        if self.derived.is_empty() || way.program.counts().roots > 0 {
            return way;
        }
        let programs: Vec<Program<'g>> =
            self.derived.iter().map(|e| hoister.program(e).signed(hoister.passes)).collect();
        let derived = programs.into_iter().map(|program| {
            let hoisted = source.hoisted(hoister, &program.symbols());
            ParametricProgram { program, hoisted }
        });
        let mut ways: Vec<ParametricProgram<'g>> = derived.filter(|way| way.cost() < most).collect();
        if ways.is_empty() {
            return way;
        }
        trial.define(hoister.constants());
        trial.compute(&way.hoisted.constants.symbols, &way.hoisted.constants.program);
        ways.push(way);
        let tried = trial.tried(&ways.iter().map(|way| &way.program).collect::<Vec<_>>());
        let costs: Vec<u32> = ways.iter().map(ParametricProgram::cost).collect();
        ways.swap_remove(tried.taken(&costs))
    }
}

/// The derivatives of constants by parameters.
struct ConstantRates<'g> {
    /// Values of the constants, then the derivatives of all by the first parameter, and so on.
    extended: Program<'g>,
    symbols: Vec<Expr<'g>>,
    /// Derivatives that are neither numbers nor constants already.
    added: Vec<(Operand<'g>, Expr<'g>)>,
    /// Constants that depend on each parameter, and their derivatives.
    directions: Vec<Direction<'g>>,
}

impl<'g> ConstantRates<'g> {
    fn new(graph: &'g Graph, constants: &Constants<'g>, along: &[Direction<'g>]) -> Self {
        let nothing = Program::nothing();
        let extended = with_tangents(&constants.program, (&[], &nothing), along);
        let symbols = constants.symbols.clone();
        let count = symbols.len();
        let (values, derivatives) = extended.outputs.split_at(count);
        let mut known: Map<Operand<'g>, Expr<'g>> = values.iter().copied().zip(symbols.iter().copied()).collect();
        let mut added: Vec<(Operand<'g>, Expr<'g>)> = Vec::new();
        let mut rate = |derivative: Operand<'g>| {
            let (negative, operand) = match derivative {
                Operand::Value(k) => match extended.instructions[k] {
                    Operation::Negate(a) => (true, a),
                    _ => (false, derivative),
                },
                _ => (false, derivative),
            };
            let value = match operand {
                Operand::Number(value) => graph.number(value),
                _ => *known.or_insert_with(operand, || {
                    let name = format!("k{}", count + added.len());
                    let symbol = graph.symbol(name.clone(), name, false);
                    added.push((operand, symbol));
                    symbol
                }),
            };
            if negative { -value } else { value }
        };
        let directions = (0..along.len())
            .map(|k| {
                let rates = derivatives[count * k..count * (k + 1)].iter().map(|&derivative| rate(derivative));
                symbols.iter().copied().zip(rates).filter(|(_, rate)| !rate.is_zero()).collect()
            })
            .collect();
        Self { extended, symbols, added, directions }
    }

    /// The constants as they were, and the derivatives that the program reads.
    fn constants_for(&self, program: &Program<'g>) -> Constants<'g> {
        let read = program.symbols();
        let added = || self.added.iter().filter(|(_, symbol)| read.contains(symbol));
        let values = self.extended.outputs[..self.symbols.len()].iter().copied();
        let outputs = values.chain(added().map(|(operand, _)| *operand)).collect();
        let symbols = self.symbols.iter().copied().chain(added().map(|(_, symbol)| *symbol)).collect();
        Constants { program: with_outputs(&self.extended, outputs), symbols }
    }
}
