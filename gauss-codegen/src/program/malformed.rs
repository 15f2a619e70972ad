//! What the shape of a program can lack.

use std::fmt;

use super::input::Input;

/// What is wrong with the shape of a program.
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
