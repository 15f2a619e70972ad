//! Symbols become components of arguments: where the inputs of programs are found.

use std::fmt;

use crate::algebra::{Expr, Map, Notation, Rational, print};
use crate::emit::Derived;
use crate::kernel::{self, Kernel};
use crate::program::{Argument, ArgumentKind, Input, Malformed, Operand, Program, Results};
use crate::words::Unraw;

/// All arguments that methods of a kernel have, and the symbols of their components.
pub struct Signature<'g> {
    arguments: Vec<(Argument, Vec<Expr<'g>>)>,
    /// Symbols of literals, and of constants that literals determine.
    literals: Map<u32, Rational>,
    known: Map<u32, f64>,
    /// Names of functions of the user's own.
    functions: Vec<String>,
}

/// An error of this crate.
pub enum SignatureError {
    /// A symbol that is no component of the arguments.
    Symbol(String),
    Malformed(Malformed),
}

impl fmt::Display for SignatureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SignatureError::Symbol(name) => write!(f, "the symbol `{name}` is no component of the arguments"),
            SignatureError::Malformed(malformed) => malformed.fmt(f),
        }
    }
}

impl<'g> Signature<'g> {
    pub fn new(derived: &Derived<'_, 'g>) -> Self {
        let formal = derived.formal();
        let configuration: Vec<Expr<'g>> = derived
            .subject
            .configuration_arguments(&derived.private())
            .into_iter()
            .flat_map(|argument| argument.symbols)
            .collect();
        let parameters = derived.subject.provenance.parameters.iter();
        let (names, symbols) = parameters.map(|parameter| (parameter.name.clone(), parameter.symbol)).unzip();
        let constants = &derived.kernel.constant_symbols;
        let arguments = vec![
            (Argument::new(ArgumentKind::Parameters, "parameters", names), symbols),
            argument(ArgumentKind::Constants, "k", constants),
            (Argument::new(ArgumentKind::Time, "t", vec!["t".to_owned()]), vec![derived.time()]),
            argument(ArgumentKind::Configuration, "q", &configuration),
            argument(ArgumentKind::Speeds, "z", formal.speeds),
            argument(ArgumentKind::Momenta, "p", formal.momenta),
            argument(ArgumentKind::Accelerations, "acceleration", formal.speed_rates),
            argument(ArgumentKind::Twist, "twist", formal.twist),
            argument(ArgumentKind::Residuals, "residual", formal.residuals),
            argument(ArgumentKind::Factors, "factors", formal.factors),
            argument(ArgumentKind::Impulses, "impulses", formal.impulses),
            argument(ArgumentKind::Inputs, "input", formal.inputs),
            argument(ArgumentKind::Weights, "weights", formal.weights),
        ];
        let known = derived.kernel.known_constants.iter().map(|(symbol, value)| (symbol.key(), *value));
        let literals = derived.literals().iter().map(|(value, symbol)| (symbol.key(), *value));
        let functions = derived.item().functions.iter().map(|function| function.name.unraw().to_string());
        Self { arguments, literals: literals.collect(), known: known.collect(), functions: functions.collect() }
    }

    /// A program with arguments of these kinds.
    pub fn program(
        &self,
        name: &str,
        kinds: &[ArgumentKind],
        code: &kernel::Program<'g>,
        results: Vec<Results>,
    ) -> Result<Program, SignatureError> {
        let taken: Vec<_> = kinds
            .iter()
            .filter_map(|kind| self.arguments.iter().find(|(argument, _)| argument.kind == *kind))
            .collect();
        let mut inputs: Map<u32, Operand> =
            self.literals.iter().map(|(&symbol, &value)| (symbol, Operand::Number(value))).collect();
        for (argument, (_, symbols)) in taken.iter().enumerate() {
            let component = |(component, symbol): (usize, &Expr<'g>)| {
                (symbol.key(), Operand::Input(Input::Component { argument, component }))
            };
            inputs.extend(symbols.iter().enumerate().map(component));
        }
        let mut numbers = Vec::new();
        for symbol in code.symbols() {
            if let Some(&value) = self.known.get(&symbol.key()) {
                inputs.insert(symbol.key(), Operand::Input(Input::Number(numbers.len())));
                numbers.push(value);
            }
        }
        let bound = |symbol: Expr<'g>| {
            inputs.get(&symbol.key()).copied().ok_or_else(|| SignatureError::Symbol(print(symbol, Notation::Text)))
        };
        let arguments = taken.into_iter().map(|(argument, _)| argument.clone()).collect();
        let program = Program::new(name, arguments, numbers, code.with_inputs(bound)?, results);
        program.map(|program| program.with_functions(self.functions.clone())).map_err(SignatureError::Malformed)
    }

    /// Program that computes the constants from the parameters.
    pub fn constants(&self, kernel: &Kernel<'_>) -> Result<Program, SignatureError> {
        let code = &kernel.constants;
        self.program("kernel", &[ArgumentKind::Parameters], code, vec![Results::new("k", code.outputs.len(), 1)])
    }
}

fn argument<'g>(kind: ArgumentKind, name: &str, symbols: &[Expr<'g>]) -> (Argument, Vec<Expr<'g>>) {
    let components = symbols.iter().map(|symbol| print(*symbol, Notation::Text)).collect();
    (Argument::new(kind, name, components), symbols.to_vec())
}
