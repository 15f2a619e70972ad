//! Derivatives of functions: along what moves, and by parameters through the constants that are made of them.

use std::borrow::Cow;

use crate::accuracy::{Loss, Trial, taken, usable};
use crate::algebra::{Evaluation, Expr, Graph, Map, Number, Tangents};

use super::columns::{Columns, LoweredColumns};
use super::hessian::Curved;
use super::hoist::Hoister;
use super::tangent::{Direction, Implicit, implicit_tangents, joined, tangents_alone, with_outputs, with_tangents};
use super::write::{Operand, Operation, Program};

/// Functions and the directions along which their derivatives are wanted.
pub struct Differentiated<'g> {
    /// The outputs, in equivalent arrangements.
    pub arrangements: Vec<Vec<Expr<'g>>>,
    /// Symbols that stand for expressions of the arguments, in the order of their definitions, and move by rates of their own.
    pub defined: Vec<Expr<'g>>,
    pub directions: Vec<Direction<'g>>,
    /// Forms of their own.
    pub derived: Vec<Derived<'g>>,
}

/// Outputs and their derivatives in a form of their own.
pub struct Derived<'g> {
    /// The outputs and then their derivatives, direction by direction.
    pub outputs: Vec<Expr<'g>>,
    /// The same, where the last step is a linear system with a right-hand side for each direction.
    pub columns: Option<Columns<'g>>,
}

/// What is differentiated beside the functions of a kernel.
#[derive(Default)]
pub struct Derivatives<'a, 'g> {
    /// Outputs that are wanted together with their derivatives.
    pub by_state: Option<&'a Differentiated<'g>>,
    /// Symbols that are the components of one unit vector or quaternion, and so on: equations are solved for the accelerations with
    /// the help of that, so points at which derivatives are checked must have it, too.
    pub units: &'a [Vec<Expr<'g>>],
    /// Velocities and accelerations by the parameters.
    pub by_parameters: Option<ByParameters<'a, 'g>>,
    /// Inverse dynamics together with its derivatives.
    pub inverse: Option<&'a Differentiated<'g>>,
    /// Outputs that are affine in the symbols of their directions: their coefficients.
    pub regressor: Option<&'a Differentiated<'g>>,
    /// A number whose second derivatives are wanted.
    pub hessian: Option<&'a Curved<'g>>,
}

/// Two functions of a kernel, one after the other, whose derivatives by parameters are wanted. All functions by their numbers.
#[derive(Clone, Copy)]
pub struct ByParameters<'a, 'g> {
    pub parameters: &'a [Expr<'g>],
    pub velocity: usize,
    /// The outputs of the velocity in another order.
    pub order: &'a [usize],
    pub acceleration: usize,
    /// What the acceleration solves, where nothing else restricts it.
    pub equation: Option<Equation<'a, 'g>>,
}

/// `residual = 0`, solved for the accelerations.
#[derive(Clone, Copy)]
pub struct Equation<'a, 'g> {
    pub residual: usize,
    /// The accelerations in it.
    pub unknowns: &'a [Expr<'g>],
    /// Affine in `loads`, with the inverse of the matrix of the residual.
    pub solution: usize,
    pub loads: &'a [Expr<'g>],
}

/// Whether the outputs themselves are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    ValuesToo,
    DerivativesAlone,
}

/// A program of derivatives, and what it should compute.
pub(super) type Lowered<'a, 'g> = (Program<'g>, Expected<'a, 'g>);

/// The same, with the way in which many right-hand sides are solved for together.
pub(super) type LoweredByState<'a, 'g> = (Lowered<'a, 'g>, Option<LoweredColumns<'g>>);

/// What a program of derivatives should compute.
pub(super) struct Expected<'a, 'g> {
    outputs: Cow<'a, [Expr<'g>]>,
    directions: Cow<'a, [Direction<'g>]>,
    kept: Kept,
    /// In place of all that, second derivatives.
    second: Option<&'a Curved<'g>>,
}

/// The constants of a kernel, in order.
pub(super) struct Constants<'g> {
    pub program: Program<'g>,
    pub symbols: Vec<Expr<'g>>,
}

impl<'g> Differentiated<'g> {
    /// The cheapest arrangement with its derivatives. What is defined enters as it is, because its rates are simple where
    /// those of its definition are not: R σ̂ beside what a quaternion makes of it.
    pub(super) fn lower(&self, hoister: &mut Hoister<'_, 'g>, kept: Kept, trial: &mut Trial) -> LoweredByState<'_, 'g> {
        let definitions = Program::lower(&hoister.hoist(&self.defined));
        let differentiate = if kept == Kept::ValuesToo { with_tangents } else { tangents_alone };
        let lower = |outputs: &'_ Vec<Expr<'g>>| Program::lower(&hoister.hoist_undefined(outputs));
        let programs: Vec<Program<'g>> = self.arrangements.iter().map(lower).collect();
        trial.define(hoister.constants());
        // What loses digits loses them in its derivatives, too.
        let losses = trial.losses(&programs.iter().collect::<Vec<_>>());
        let usable = usable(&losses);
        let of_usable = (0..programs.len()).filter(|&k| usable[k]).map(|k| {
            let program = differentiate(&programs[k], (&self.defined, &definitions), &self.directions);
            (program, losses[k].clone(), &self.arrangements[k])
        });
        let mut of_usable: Vec<_> = of_usable.collect();
        let losses: Vec<Loss> = of_usable.iter().map(|(_, loss, _)| loss.clone()).collect();
        let costs: Vec<u32> = of_usable.iter().map(|(program, ..)| program.cost().total()).collect();
        let (program, _, outputs) = of_usable.swap_remove(taken(&losses, &costs));
        let (program, columns) = self.cheaper(program, hoister, trial);
        let program = program.ordered();
        let expected = Expected {
            outputs: Cow::Borrowed(outputs),
            directions: Cow::Borrowed(&self.directions),
            kept,
            second: None,
        };
        ((program, expected), columns)
    }
}

impl<'g> Differentiated<'g> {
    /// A program of derivatives, or what has a form of its own and costs less. Of roots, whose slope may be infinite, only programs know what
    /// their derivatives are where nothing changes.
    fn cheaper(
        &self,
        program: Program<'g>,
        hoister: &mut Hoister<'_, 'g>,
        trial: &mut Trial,
    ) -> (Program<'g>, Option<LoweredColumns<'g>>) {
        let most = program.cost().total();
        if program.counts().roots > 0 {
            return (program, None);
        }
        let derived = self.derived.iter().map(|derived| {
            let program = Program::lower(&hoister.hoist(&derived.outputs)).with_signs_led_back();
            (program, derived.columns.as_ref())
        });
        let mut ways: Vec<_> = derived.filter(|(program, _)| program.cost().total() < most).collect();
        if ways.is_empty() {
            return (program, None);
        }
        ways.push((program, None));
        trial.define(hoister.constants());
        let losses = trial.losses(&ways.iter().map(|(program, _)| program).collect::<Vec<_>>());
        let costs: Vec<u32> = ways.iter().map(|(program, _)| program.cost().total()).collect();
        let (program, columns) = ways.swap_remove(taken(&losses, &costs));
        (program, columns.and_then(|columns| columns.lower(hoister)))
    }
}

impl<'g> ByParameters<'_, 'g> {
    /// Programs read constants, not parameters: the program of the constants is differentiated first, and what their
    /// derivatives are, unless numbers, becomes constants too, computed once. Accelerations are differentiated as they are
    /// computed, or as the solution of their equation, whose constants are simpler; the cheaper program is taken.
    pub(super) fn lower<'b>(
        &self,
        graph: &'g Graph,
        (programs, outputs): (&[Program<'g>], &[&[Expr<'g>]]),
        constants: &mut Constants<'g>,
    ) -> Lowered<'b, 'g> {
        let along: Vec<Direction<'g>> =
            self.parameters.iter().map(|&parameter| vec![(parameter, graph.one())]).collect();
        let rates = ConstantRates::new(graph, constants, &along);
        let velocity = &programs[self.velocity];
        let ordered = self.order.iter().map(|&k| velocity.outputs[k]).collect();
        let velocity = Program { instructions: velocity.instructions.clone(), outputs: ordered };
        let acceleration = &programs[self.acceleration];
        let mut candidates =
            vec![tangents_alone(&joined(&velocity, acceleration), (&[], &Program::nothing()), &rates.directions)];
        candidates.extend(self.equation.map(|equation| {
            let implicit = Implicit {
                root: acceleration,
                residual: &programs[equation.residual],
                unknowns: equation.unknowns,
                solution: &programs[equation.solution],
                loads: equation.loads,
            };
            implicit_tangents(&velocity, &implicit, &rates.directions)
        }));
        let cost = |program: &Program<'g>| program.cost().total() + rates.constants_for(program).program.cost().total();
        let program = candidates.into_iter().min_by_key(cost).expect("one way at least");
        *constants = rates.constants_for(&program);
        let of_velocity = self.order.iter().map(|&k| outputs[self.velocity][k]);
        let outputs: Vec<Expr<'g>> = of_velocity.chain(outputs[self.acceleration].iter().copied()).collect();
        let expected = Expected {
            outputs: Cow::Owned(outputs),
            directions: Cow::Owned(along),
            kept: Kept::DerivativesAlone,
            second: None,
        };
        (program, expected)
    }
}

/// The derivatives of constants by parameters.
struct ConstantRates<'g> {
    /// Values of the constants, then the derivatives of all by the first parameter, and so on.
    extended: Program<'g>,
    symbols: Vec<Expr<'g>>,
    /// Derivatives that are neither numbers nor constants already.
    added: Vec<(Operand<'g>, Expr<'g>)>,
    /// For each parameter the constants that depend on it, and how.
    directions: Vec<Direction<'g>>,
}

impl<'g> ConstantRates<'g> {
    #[expect(
        clippy::mutable_key_type,
        reason = "expressions are compared by their place in the graph, which never changes"
    )]
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
                _ => *known.entry(operand).or_insert_with(|| {
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

impl<'a, 'g> Expected<'a, 'g> {
    /// The values of expressions.
    pub fn of(outputs: &'a [Expr<'g>]) -> Self {
        Self { outputs: Cow::Borrowed(outputs), directions: Cow::Borrowed(&[]), kept: Kept::ValuesToo, second: None }
    }

    /// The second derivatives of a number.
    pub fn of_second(second: &'a Curved<'g>) -> Self {
        Self { second: Some(second), ..Self::of(&second.arrangements[..1]) }
    }

    pub fn outputs(&self) -> &[Expr<'g>] {
        &self.outputs
    }

    /// By dual numbers through the expressions.
    pub fn values<N: Number>(&self, evaluation: &mut Evaluation<'_, N>) -> Vec<N> {
        if let Some(second) = self.second {
            return second.values(evaluation);
        }
        let mut expected = Vec::new();
        if self.kept == Kept::ValuesToo {
            expected.extend(self.outputs.iter().map(|e| evaluation.value(*e)));
        }
        for direction in self.directions.iter() {
            let rates = direction.iter().map(|(symbol, rate)| (symbol.key(), evaluation.value(*rate))).collect();
            let mut tangents = Tangents::new(evaluation, &rates);
            expected.extend(self.outputs.iter().map(|e| tangents.along(*e)));
        }
        expected
    }
}
