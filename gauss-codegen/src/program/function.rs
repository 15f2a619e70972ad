//! Programs: code with names for what it reads and gives.

use std::fmt;

use crate::algebra::Scalar;

use super::code::Code;
use super::input::{Argument, Input, Results};
use super::instruction::Operand;
use super::verify::Malformed;

/// A function with names for its arguments and results. Its fields can be read; it is made by [`Program::new`], which
/// verifies it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Program {
    /// The name of the method.
    pub name: String,
    /// In order; no component is missing because the code does not read it.
    pub arguments: Vec<Argument>,
    /// Numbers that are no short fractions: what literals of the scene determine in double precision.
    pub numbers: Vec<f64>,
    /// The instructions.
    pub code: Code,
    /// Meaning of the outputs of the code, in their order.
    pub results: Vec<Results>,
    /// Names of functions of the user's own, by their index. [`run`](Self::run) does not know them: they give NaN.
    #[cfg_attr(feature = "serde", serde(default))]
    pub functions: Vec<String>,
}

/// Arguments of a call that are not those of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongArguments {
    /// Lengths of the arguments of the program.
    pub expected: Vec<usize>,
    /// Lengths of the arguments that were given.
    pub found: Vec<usize>,
}

impl fmt::Display for WrongArguments {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "arguments of {:?} numbers in place of {:?}", self.found, self.expected)
    }
}

impl std::error::Error for WrongArguments {}

impl Program {
    /// A program of verified shape.
    ///
    /// # Errors
    /// What is wrong with its shape.
    pub fn new(
        name: impl Into<String>,
        arguments: Vec<Argument>,
        numbers: Vec<f64>,
        code: Code,
        results: Vec<Results>,
    ) -> Result<Self, Malformed> {
        let program = Self { name: name.into(), arguments, numbers, code, results, functions: Vec::new() };
        program.verify().map(|()| program)
    }

    /// The same with names of functions of the user's own.
    #[must_use]
    pub fn with_functions(self, functions: Vec<String>) -> Self {
        Self { functions, ..self }
    }

    /// The same function with other code, as a pass makes it.
    ///
    /// # Errors
    /// What is wrong with its shape.
    pub fn with_code(self, pass: impl FnOnce(Code) -> Code) -> Result<Self, Malformed> {
        let program = Self { code: pass(self.code), ..self };
        program.verify().map(|()| program)
    }

    /// Carries it out: one list of numbers for each argument; the outputs, result by result.
    ///
    /// # Errors
    /// Arguments that are not those of the program.
    pub fn run<T: Scalar>(&self, arguments: &[&[T]]) -> Result<Vec<T>, WrongArguments> {
        let expected: Vec<usize> = self.arguments.iter().map(|argument| argument.components.len()).collect();
        let found: Vec<usize> = arguments.iter().map(|argument| argument.len()).collect();
        if expected != found {
            return Err(WrongArguments { expected, found });
        }
        Ok(self.code.evaluate(|input| match input {
            Input::Component { argument, component } => arguments[argument][component].clone(),
            Input::Number(number) => T::number(self.numbers[number]),
        }))
    }

    /// Checks its shape: that of its code, and that its inputs and results are there.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn verify(&self) -> Result<(), Malformed> {
        self.code.verify()?;
        for operand in self.code.operands() {
            if let Operand::Input(input) = operand {
                let exists = match input {
                    Input::Component { argument, component } => {
                        self.arguments.get(argument).is_some_and(|argument| component < argument.components.len())
                    }
                    Input::Number(number) => number < self.numbers.len(),
                };
                if !exists {
                    return Err(Malformed::NoSuchInput(input));
                }
            }
        }
        let (expected, found) = (self.results.iter().map(|r| r.len()).sum(), self.code.outputs.len());
        if expected != found {
            return Err(Malformed::Outputs { expected, found });
        }
        let names = || self.arguments.iter().map(|a| &a.name).chain(self.results.iter().map(|r| &r.name));
        match names().enumerate().find(|(k, name)| names().skip(k + 1).any(|other| other == *name)) {
            Some((_, name)) => Err(Malformed::Named(name.clone())),
            None => Ok(()),
        }
    }
}
