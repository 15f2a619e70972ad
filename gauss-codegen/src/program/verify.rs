//! The shape of code, checked after every pass in debug builds.

use std::fmt;

use crate::algebra::Function;

use super::code::Code;
use super::input::Input;
use super::instruction::{Instruction, Operand};

/// Faults in the shape of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Malformed {
    /// An instruction, or an output where there is none, reads a result that is not computed before it.
    NotComputed {
        /// The reader; none for an output.
        reader: Option<usize>,
        /// The instruction whose result it reads.
        read: usize,
    },
    /// The result of that instruction is read as a sine or cosine and is none, or the other way round.
    NoPair(usize),
    /// Sine or cosine alone.
    LoneSine(usize),
    /// No output needs that instruction.
    Idle(usize),
    /// A number that is not one.
    NotANumber,
    /// No argument has such a component, or there is no such number.
    NoSuchInput(Input),
    /// The results do not have the sizes that the outputs have together.
    Outputs {
        /// Sizes of the results.
        expected: usize,
        /// Outputs of the code.
        found: usize,
    },
    /// Two arguments or results of that name.
    Named(String),
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Malformed::NotComputed { reader: Some(reader), read } => {
                write!(f, "instruction {reader} reads the result of {read}, which is not computed before")
            }
            Malformed::NotComputed { reader: None, read } => {
                write!(f, "an output is the result of instruction {read}, which does not exist")
            }
            Malformed::NoPair(k) => write!(f, "the result of instruction {k} is read as what it is not"),
            Malformed::LoneSine(k) => write!(f, "instruction {k} is a sine or cosine alone; they come in pairs"),
            Malformed::Idle(k) => write!(f, "no output needs instruction {k}"),
            Malformed::NotANumber => f.write_str("a number is not one"),
            Malformed::NoSuchInput(input) => write!(f, "there is no input {input:?}"),
            Malformed::Outputs { expected, found } => {
                write!(f, "results of {expected} numbers together have {found} outputs")
            }
            Malformed::Named(name) => write!(f, "two arguments or results have the name {name}"),
        }
    }
}

impl std::error::Error for Malformed {}

impl<S: Copy> Code<S> {
    /// Checks its shape: everything is computed before it is read, sines and cosines come in pairs, nothing is idle.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn verify(&self) -> Result<(), Malformed> {
        for (k, instruction) in self.instructions.iter().enumerate() {
            if let Instruction::Call(Function::Sin | Function::Cos, _) = instruction {
                return Err(Malformed::LoneSine(k));
            }
            for operand in instruction.operands() {
                self.verify_operand(operand, Some(k))?;
            }
        }
        self.outputs.iter().try_for_each(|&operand| self.verify_operand(operand, None))?;
        self.needed().iter().position(|needed| !needed).map_or(Ok(()), |k| Err(Malformed::Idle(k)))
    }

    fn verify_operand(&self, operand: Operand<S>, reader: Option<usize>) -> Result<(), Malformed> {
        let read = match operand {
            Operand::Number(n) if n.is_undefined() => return Err(Malformed::NotANumber),
            Operand::Input(_) | Operand::Number(_) => return Ok(()),
            Operand::Value(k) | Operand::Sine(k) | Operand::Cosine(k) => k,
        };
        if read >= reader.unwrap_or(self.instructions.len()) {
            return Err(Malformed::NotComputed { reader, read });
        }
        let pair = matches!(self.instructions[read], Instruction::SineCosine(_));
        if pair == matches!(operand, Operand::Value(_)) { Err(Malformed::NoPair(read)) } else { Ok(()) }
    }

    /// The same code, after its shape is checked in debug builds: what every pass hands on.
    pub(crate) fn verified(self) -> Self {
        if cfg!(debug_assertions)
            && let Err(malformed) = self.verify()
        {
            unreachable!("a pass made a program of wrong shape: {malformed}");
        }
        self
    }
}
