//! The functions of a kernel, lowered together: shared constants, of each the arrangement that is taken.

use crate::accuracy::{DecidingState, Figure, Forms, Loss, LossFigures, LossSearchInput, Samples, Trial};
use crate::algebra::{Expr, Graph, Map, Rational};
use crate::methods::{DerivativeKind, Method, Methods};

use super::check::{CheckedPrograms, Miscompilation, Sample};
use super::choice::{Candidates, Choice, forms};
use super::constants::{ConstantSet, ConstantSource, Constants};
use super::derivative_programs::{Derivative, DerivativeProgram, DerivativeRequest};
use super::expected_outputs::ExpectedOutputs;
use super::hoist::Hoister;
use super::passes::Passes;
use super::write::Program;

/// The programs of a kernel, which share their constants.
pub struct Kernel<'g> {
    /// Computes the constants from the parameters; its outputs are the constants in order.
    pub constants: Program<'g>,
    /// The symbols of constants among the inputs of programs are listed below.
    pub functions: Methods<LoweredFunction<'g>>,
    /// `evaluate`: the outputs of several functions, one after the other, what they have in common computed once.
    pub joined: Program<'g>,
    pub figure_of_joined: Option<Figure>,
    /// Derivatives that are wanted, in the order of their kinds.
    pub derivatives: Vec<Derivative<'g>>,
    /// The constants as symbols, in the order of the outputs of `constants`.
    pub constant_symbols: Vec<Expr<'g>>,
    /// Constants that literal numbers alone determine, with their values.
    pub known_constants: Vec<(Expr<'g>, f64)>,
    /// The definitions of known constants.
    pub folded: Vec<(Expr<'g>, Expr<'g>)>,
}

/// A function as it is carried out.
pub struct LoweredFunction<'g> {
    pub program: Program<'g>,
    /// Loss at sample states.
    pub loss: Loss,
    /// Loss at the worst state that is found; `None` where it has no value.
    pub figure: Option<Figure>,
}

/// Derivatives that are wanted beside the functions of a kernel.
#[derive(Default)]
pub struct Derivatives<'a, 'g> {
    pub list: &'a [DerivativeRequest<'g>],
    /// Symbols that are the components of one unit vector or quaternion, and so on: equations are solved for the
    /// accelerations with the help of that, so points at which derivatives are checked must have it, too.
    pub units: &'a [Vec<Expr<'g>>],
}

/// The instructions up to which other forms of a derivative are looked for.
const LONG: usize = 4000;

/// Symbols that stand for literal numbers. Where the scalar is not known before run time, there is no value to fold.
pub type Literals<'a, 'g> = Option<&'a [(Rational, Expr<'g>)]>;

impl<'g> Kernel<'g> {
    /// Lowers functions, each of which has an arrangement; those of `evaluate` also together. `definitions` are symbols
    /// that stand for expressions of the arguments. Every program is then run at a pseudo-random point and compared
    /// with its expressions.
    pub fn lower(
        graph: &'g Graph,
        functions: &Methods<Candidates<'g>>,
        definitions: &Map<u32, Expr<'g>>,
        wanted: &Derivatives<'_, 'g>,
        literals: Literals<'_, 'g>,
        trial: &mut Trial,
        passes: Passes,
    ) -> Result<Self, Miscompilation> {
        let mut hoister = Hoister::new(graph, definitions, passes);
        let functions = taken_of_each(functions, &mut hoister, trial);
        let (joined, of_joined) = lower_together(&mut hoister, &functions.evaluated());
        let direct = wanted.list.iter().filter_map(|wanted| wanted.lower(&mut hoister, trial));
        let mut derivatives: Vec<DerivativeProgram<'_, 'g>> = direct.collect();
        let programs = functions.iter().map(|(_, function)| &function.program).chain([&joined]);
        let read: Vec<Expr<'g>> = programs
            .chain(derivatives.iter().flat_map(DerivativeProgram::programs))
            .flat_map(Program::symbols)
            .collect();
        let numbers: Map<u32, f64> =
            literals.into_iter().flatten().map(|(value, symbol)| (symbol.key(), value.to_f64())).collect();
        let source = ConstantSource { read: &read, literals: literals.map(|_| &numbers) };
        // Last, because constants are differentiated.
        let by_parameters = wanted.list.iter().find_map(DerivativeRequest::by_parameters);
        let by_parameters = by_parameters.map(|by| by.lower(graph, &functions, &source, &mut hoister, trial));
        let hoisted = match by_parameters {
            Some((program, expected, hoisted)) => {
                derivatives.push(DerivativeProgram {
                    kind: DerivativeKind::ByParameters,
                    program,
                    columns: None,
                    expected,
                });
                hoisted
            }
            None => source.hoisted(&hoister, &[]),
        };
        derivatives.sort_by_key(|derivative| derivative.kind);
        let ConstantSet { constants: Constants { program: constants, symbols: constant_symbols }, known, folded } =
            hoisted;
        let of_functions = functions.iter().map(|(_, function)| (&function.carried_out, &function.outputs));
        let values = of_functions.chain([(&joined, &of_joined)]);
        let checked = CheckedPrograms {
            constants: &constants,
            constant_symbols: &constant_symbols,
            functions: values.map(|(program, outputs)| (program, ExpectedOutputs::of(outputs))).collect(),
            derivatives: &derivatives,
        };
        let sample = Sample { definitions, units: wanted.units, literals: &numbers, folded: &folded };
        checked.check(graph, &sample)?;
        let derivatives = derivatives.into_iter().map(DerivativeProgram::derivative).collect();
        let functions =
            functions.map(|_, taken| LoweredFunction { program: taken.carried_out, loss: taken.loss, figure: None });
        Ok(Self {
            constants,
            functions,
            joined,
            figure_of_joined: None,
            derivatives,
            constant_symbols,
            known_constants: known,
            folded,
        })
    }

    /// `None` of a derivative that is not wanted.
    pub fn derivative(&self, kind: DerivativeKind) -> Option<&Derivative<'g>> {
        self.derivatives.iter().find(|derivative| derivative.kind == kind)
    }

    /// Every program, as it is written.
    pub fn written(&self) -> impl Iterator<Item = &Program<'g>> {
        let functions = self.functions.iter().map(|(_, function)| &function.program);
        functions.chain(self.derivatives.iter().map(Derivative::written)).chain([&self.constants])
    }

    /// Looks for the states where functions and derivatives lose most, and tries `joined` there. Gives those states
    /// where another form of one of them, if others are given, loses much less.
    pub fn seek_losses(
        &mut self,
        samples: &Samples<'_, '_, 'g>,
        others: Option<(&Methods<Candidates<'g>>, &Derivatives<'_, 'g>)>,
    ) -> Vec<DecidingState> {
        let of_function = |k: usize| {
            let (_, function) = self.functions.iter().nth(k)?;
            Some(forms(&others?.0.iter().nth(k)?.1.arrangements, function.program.instructions.len()))
        };
        let of_derivative = |k: usize| {
            let Derivative { kind, .. } =
                self.derivatives.get(k).filter(|own| own.program.instructions.len() <= LONG)?;
            Some(others?.1.list.iter().find(|wanted| wanted.kind == *kind)?.forms())
        };
        let forms = Forms {
            of_function: &|k| of_function(k).unwrap_or_default(),
            of_derivative: &|k| of_derivative(k).unwrap_or_default(),
        };
        let (LossFigures { functions, besides }, deciding) = samples.seek(&self.sought(), &forms);
        for ((_, function), figure) in self.functions.each_mut().into_iter().zip(functions) {
            function.figure = figure;
        }
        let derivatives = self.derivatives.iter_mut().map(|derivative| &mut derivative.figure);
        for (place, figure) in std::iter::once(&mut self.figure_of_joined).chain(derivatives).zip(besides) {
            *place = figure;
        }
        deciding
    }

    /// Programs of the kernel whose losses are sought.
    pub fn sought(&self) -> LossSearchInput<'_, 'g> {
        let functions = || self.functions.iter().map(|(_, function)| function);
        let derivatives = self.derivatives.iter().map(|derivative| &derivative.program);
        LossSearchInput {
            constants: &self.constants,
            symbols: &self.constant_symbols,
            folded: &self.folded,
            functions: functions().map(|function| &function.program).collect(),
            measured: functions().map(|function| &function.loss).collect(),
            momentum: self.functions.iter().position(|(method, _)| method == Method::Momentum),
            besides: std::iter::once(&self.joined).chain(derivatives).collect(),
        }
    }
}

/// Chooses the arrangement of each function.
fn taken_of_each<'g>(
    functions: &Methods<Candidates<'g>>,
    hoister: &mut Hoister<'_, 'g>,
    trial: &mut Trial,
) -> Methods<Choice<'g>> {
    let mut number = 0..;
    let taken = functions.each_ref().map(|_, candidates| {
        trial.begin(number.next());
        candidates.taken(hoister, trial)
    });
    trial.begin(None);
    taken
}

/// Several functions in one program, of each what was taken and what comes first where that keeps the digits. What wins
/// alone may have less in common with the rest than what comes first: it is replaced where that costs less.
fn lower_together<'g>(hoister: &mut Hoister<'_, 'g>, functions: &[&Choice<'g>]) -> (Program<'g>, Vec<Expr<'g>>) {
    let mut lower = |parts: &[&[Expr<'g>]]| {
        let outputs = parts.concat();
        (hoister.program(&outputs), outputs)
    };
    let mut parts: Vec<&[Expr<'g>]> = functions.iter().map(|function| function.outputs.as_slice()).collect();
    let mut best = lower(&parts);
    for (place, function) in functions.iter().enumerate() {
        let Some(first) = function.first.as_deref().filter(|first| *first != parts[place]) else { continue };
        let won = std::mem::replace(&mut parts[place], first);
        let other = lower(&parts);
        if other.0.cost().total() < best.0.cost().total() {
            best = other;
        } else {
            parts[place] = won;
        }
    }
    let signed = best.0.signed(hoister.passes);
    let keep_their_digits = functions.iter().all(|function| function.begun);
    let carried_out =
        if keep_their_digits { signed.carried_out(hoister.passes) } else { signed.fused(hoister.passes).ordered() };
    (carried_out, best.1)
}
