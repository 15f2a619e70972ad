//! Numbers of a scene that the type of a source file does not hold.

use std::{error, fmt};

use crate::program::{Functions, Input, Operand, Program};

use super::Real;

/// A number of a scene that would be zero or infinite as a `float`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BeyondRange {
    /// The name of the method.
    pub method: String,
    /// The number.
    pub value: f64,
}

impl BeyondRange {
    /// # Errors
    /// The first number that is beyond the range of the type.
    pub(super) fn check(functions: &Functions, real: Real) -> Result<(), Self> {
        let beyond = |program: &Program| {
            let value = numbers(program).find(|value| !real.holds(*value))?;
            Some(Self { method: program.name.clone(), value })
        };
        functions.programs().find_map(beyond).map_or(Ok(()), Err)
    }
}

fn numbers(program: &Program) -> impl Iterator<Item = f64> {
    let number = |operand: Operand| match operand {
        Operand::Input(Input::Number(number)) => Some(program.numbers[number]),
        Operand::Number(value) => Some(value.to_f64()),
        _ => None,
    };
    program.code.operands().filter_map(number)
}

impl fmt::Display for BeyondRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, value } = self;
        write!(f, "`{method}` has the number {value:e}, which no `float` holds: write it in double precision")
    }
}

impl error::Error for BeyondRange {}
