//! Derivatives of code, forward and backward, whatever its inputs are called; of programs as programs.
//!
//! Equal instructions are written once, what no output needs is left out, and outputs that cannot change are the
//! number 0. At a kink (`abs`, `min`, `max`) the derivative is the mean of those on both sides.

mod backward;
mod forward;
mod writer;

pub(crate) use backward::{Sweep, signed};
pub(crate) use forward::TangentPass;
pub(crate) use writer::{InstructionWriter, Rate, Tangent};

use crate::algebra::{Map, Rational};

use super::{Argument, ArgumentKind, Code, Input, Malformed, Operand, Program, Results};

/// A program of derivatives that are not 0 everywhere, and where each stands in its matrix.
pub struct SparseJacobian {
    /// A result of one column for each result of the program and each of its arguments, all arguments of the first
    /// result first: the entries by columns, in each from the top.
    pub program: Program,
    /// Rows and columns of the entries of each result: a row is an output among those of its result, a column a
    /// component of the argument.
    pub places: Vec<Vec<(usize, usize)>>,
}

impl Program {
    /// The same function of the parameters: a constant of the kernel is the output of that place of `constants`.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn of_parameters(&self, constants: &Self) -> Result<Self, Malformed> {
        let Some(place) = self.arguments.iter().position(|argument| argument.kind == ArgumentKind::Constants) else {
            return Ok(self.clone());
        };
        let mut arguments = self.arguments.clone();
        arguments.splice(place..=place, constants.arguments.iter().cloned());
        let mut symbols: Map<Input, Operand> = Map::default();
        for input in constants.code.inputs() {
            if let Input::Component { argument, component } = input {
                symbols.insert(input, Operand::Input(Input::Component { argument: place + argument, component }));
            }
        }
        let mut writer = InstructionWriter::default();
        let (_, values) = writer.copy(&constants.code, &symbols);
        let mut symbols: Map<Input, Operand> = Map::default();
        for input in self.code.inputs() {
            let moved = match input {
                Input::Component { argument, component } if argument == place => values[component],
                Input::Component { argument, component } => {
                    let more = if argument > place { constants.arguments.len() - 1 } else { 0 };
                    Operand::Input(Input::Component { argument: argument + more, component })
                }
                Input::Number(k) => Operand::Input(Input::Number(constants.numbers.len() + k)),
            };
            symbols.insert(input, moved);
        }
        let (_, outputs) = writer.copy(&self.code, &symbols);
        let numbers = [constants.numbers.clone(), self.numbers.clone()].concat();
        let program = Self::new(&self.name, arguments, numbers, writer.finish(outputs), self.results.clone())?;
        Ok(program.with_functions(self.functions.clone()))
    }

    /// The program of ∂f/∂x·dx along changes of the arguments of these kinds, which follow the arguments under their
    /// names with a `d` in front. Its result is `change`.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn tangent(&self, name: &str, kinds: &[ArgumentKind]) -> Result<Self, Malformed> {
        let mut arguments = self.arguments.clone();
        let mut rates: Map<Input, Rate<Input>> = Map::default();
        for (place, argument) in self.arguments.iter().enumerate().filter(|(_, own)| kinds.contains(&own.kind)) {
            for component in 0..argument.components.len() {
                let rate = Operand::Input(Input::Component { argument: arguments.len(), component });
                rates.insert(Input::Component { argument: place, component }, Some(Tangent::plain(rate)));
            }
            arguments.push(argument.renamed(argument.kind, "d"));
        }
        let (mut writer, places) = InstructionWriter::copied(&self.code);
        let none = Map::default();
        let mut pass = TangentPass::new(&mut writer, &self.code, &none, &places);
        pass.rates = rates;
        let outputs = pass.outputs();
        let results = vec![Results::new("change", outputs.len(), 1)];
        self.derived(name, arguments, writer.finish(outputs), results)
    }

    /// The program of the derivatives of Σ wᵢ fᵢ by all arguments. The weights of each result follow the arguments, and
    /// are called as it is with `adj_` in front; so are the results, one for each argument.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn adjoint(&self, name: &str) -> Result<Self, Malformed> {
        let mut arguments = self.arguments.clone();
        let mut weights = Vec::with_capacity(self.code.outputs.len());
        for result in &self.results {
            let weight = |component| Operand::Input(Input::Component { argument: arguments.len(), component });
            weights.extend((0..result.len()).map(|k| Some(Tangent::plain(weight(k)))));
            let components = (0..result.len()).map(|k| format!("adj_{}_{k}", result.name)).collect();
            arguments.push(Argument::new(ArgumentKind::Weights, format!("adj_{}", result.name), components));
        }
        let (mut writer, places) = InstructionWriter::copied(&self.code);
        let none = Map::default();
        let mut sweep = Sweep::new(TangentPass::new(&mut writer, &self.code, &none, &places));
        sweep.run(&weights);
        let mut outputs = Vec::new();
        for (argument, own) in self.arguments.iter().enumerate() {
            for component in 0..own.components.len() {
                let slope = sweep.of_symbols.get(&Input::Component { argument, component }).copied().flatten();
                outputs.push(slope.map_or(ZERO, |slope| sweep.pass.writer.written(slope)));
            }
        }
        let results =
            self.arguments.iter().map(|own| Results::new(format!("adj_{}", own.name), own.components.len(), 1));
        let results = results.collect();
        self.derived(name, arguments, writer.finish(outputs), results)
    }

    /// The derivatives of all outputs by all components of the arguments.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn jacobian(&self, name: &str) -> Result<SparseJacobian, Malformed> {
        let (mut writer, places) = InstructionWriter::copied(&self.code);
        let none = Map::default();
        let mut entries: Vec<Vec<(usize, usize, Operand)>> =
            vec![Vec::new(); self.results.len() * self.arguments.len()];
        for (argument, own) in self.arguments.iter().enumerate() {
            for component in 0..own.components.len() {
                let mut pass = TangentPass::new(&mut writer, &self.code, &none, &places);
                let one = Some(Tangent::plain(Operand::Number(Rational::one())));
                pass.rates.insert(Input::Component { argument, component }, one);
                let mut column = pass.outputs().into_iter();
                for (k, result) in self.results.iter().enumerate() {
                    let rows = column.by_ref().take(result.len()).enumerate().filter(|(_, entry)| *entry != ZERO);
                    entries[k * self.arguments.len() + argument]
                        .extend(rows.map(|(row, entry)| (row, component, entry)));
                }
            }
        }
        let pairs = self.results.iter().flat_map(|result| self.arguments.iter().map(move |own| (result, own)));
        let results = pairs.zip(&entries);
        let results = results
            .map(|((result, own), block)| Results::new(format!("jac_{}_{}", result.name, own.name), block.len(), 1));
        let results = results.collect();
        let outputs = entries.iter().flatten().map(|(.., entry)| *entry).collect();
        let program = self.derived(name, self.arguments.clone(), writer.finish(outputs), results)?;
        let places = entries.into_iter().map(|block| block.into_iter().map(|(row, column, _)| (row, column)).collect());
        Ok(SparseJacobian { program, places: places.collect() })
    }

    /// A program of other arguments and code with the numbers and functions of this one.
    fn derived(
        &self,
        name: &str,
        arguments: Vec<Argument>,
        code: Code,
        results: Vec<Results>,
    ) -> Result<Self, Malformed> {
        let program = Self::new(name, arguments, self.numbers.clone(), code, results)?;
        Ok(program.with_functions(self.functions.clone()))
    }
}

const ZERO: Operand = Operand::Number(Rational::zero());

impl Argument {
    /// An argument of the same size whose names have a beginning.
    fn renamed(&self, kind: ArgumentKind, beginning: &str) -> Self {
        let components = self.components.iter().map(|component| format!("{beginning}{component}")).collect();
        Self::new(kind, format!("{beginning}{}", self.name), components)
    }
}
