//! Programs: straight lines of instructions with everything that is needed to run them, print them, or write them in some language.
//!
//! # What a program is
//! A [`Program`] stands alone: it refers to no scene and no expression. It has
//! - [`arguments`](Program::arguments), each a list of numbers with names: time, the components of the configuration, speeds,
//!   momenta, inputs, and the constants of a kernel, which a program of its own computes from the parameters;
//! - [`code`](Program::code): [`Instruction`]s in the order in which they are carried out, each of which is assigned once. What it
//!   works on is an [`Operand`]: an input, an exact fraction, or the result of an earlier instruction, by its index. There are no
//!   loops, branches or memory. Sine and cosine of one angle are one instruction with two results;
//! - [`results`](Program::results): what the outputs of the code are together, numbers, vectors or matrices by rows.
//!
//! ```
//! let top = "#[gauss(motion = fixed_point)] struct Top { #[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64> }";
//! let derivation = gauss_codegen::Derivation::of_source(top, "Top")?;
//! let acceleration = derivation.program("acceleration").expect("every kernel has it");
//! println!("{acceleration}");
//! let constants = derivation.constants().run::<f64>(&[&[1.0, 0.5, 0.4, 0.3]])?;
//! let (t, q, z) = ([0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0]);
//! let rate = acceleration.run(&[&constants, &t, &q, &z, &[]])?;
//! assert!((rate[0] - (0.4 - 0.3) / 0.5 * 2.0 * 3.0).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How to write a pass
//! A pass is a function from [`Code`] to `Code`: it maps instructions with [`Instruction::map`], renumbers what it moved with
//! [`Operand::moved`], and leaves what became idle to [`Code::without_idle`]. Code is generic over what its inputs are called, so
//! that one pass serves while symbols are still symbols and afterwards; `Code::with_signs_led_back` is one of 60 lines.
//! [`Program::with_code`] verifies the shape of what a pass made; whether it still computes the same is seen by running both
//! ([`Program::run`]). Inside this crate every pass ends in `Code::verified`, which checks the shape in debug builds, and every
//! kernel is compared with its expressions where it is made.
//!
//! # How to write a target
//! A target is a function from programs to text. It says how an argument is declared, how each of the ten instructions and five
//! operands is written, and how results are handed back; [`targets::c`](crate::targets::c) is the shortest example.

mod code;
mod cost;
mod instruction;
mod interpret;
mod print;
mod series;
mod signs;
mod verify;

use std::fmt;

pub use crate::algebra::{BinaryFunction, Function, Rational, Scalar};
pub use code::Code;
pub use cost::{Cost, Counts, Smoothness};
pub use instruction::{Instruction, Operand};
pub use verify::Malformed;

/// A function with names for its arguments and results. Its fields can be read; it is made by [`Program::new`], which verifies it.
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
    /// What the outputs of the code are, in their order.
    pub results: Vec<Results>,
}

/// An argument: numbers that are handed over together.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Argument {
    /// What it is.
    pub kind: ArgumentKind,
    /// A short name: `q`, `z`.
    pub name: String,
    /// The names of its numbers, as in the equations.
    pub components: Vec<String>,
}

/// What an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ArgumentKind {
    /// The numbers of the fields of a struct, in their units.
    Parameters,
    /// What a kernel computes once of its parameters.
    Constants,
    /// Time, in seconds: one number.
    Time,
    /// The components of the configuration, in the order of its parts: of rotations those of the unit quaternion, x, y, z, w, of turns in
    /// the plane cosine and sine, of poses these and then the position.
    Configuration,
    /// The speeds z.
    Speeds,
    /// The momenta p = ∂T/∂z.
    Momenta,
    /// The rates ż of the speeds.
    Accelerations,
    /// The twist of a body: velocity of O, angular velocity, both in body axes.
    Twist,
    /// What is left of the constraints.
    Residuals,
    /// Values that arrive at run time.
    Inputs,
}

impl fmt::Display for ArgumentKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ArgumentKind::Parameters => "parameters",
            ArgumentKind::Constants => "constants",
            ArgumentKind::Time => "time",
            ArgumentKind::Configuration => "configuration",
            ArgumentKind::Speeds => "speeds",
            ArgumentKind::Momenta => "momenta",
            ArgumentKind::Accelerations => "accelerations",
            ArgumentKind::Twist => "twist",
            ArgumentKind::Residuals => "residuals",
            ArgumentKind::Inputs => "inputs",
        })
    }
}

/// An input of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Input {
    /// A component of an argument, both by their index.
    Component {
        /// Index among the arguments.
        argument: usize,
        /// Index among the components of that argument.
        component: usize,
    },
    /// A number of the program, by its index.
    Number(usize),
}

/// Outputs that belong together: a number (one row, one column), a vector (one column), or a matrix, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Results {
    /// What they are.
    pub name: String,
    /// Rows of the matrix.
    pub rows: usize,
    /// Columns of the matrix.
    pub columns: usize,
}

/// Arguments of a call that are not those of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongArguments {
    /// How many numbers each argument has.
    pub expected: Vec<usize>,
    /// How many were given.
    pub found: Vec<usize>,
}

impl fmt::Display for WrongArguments {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "arguments of {:?} numbers in place of {:?}", self.found, self.expected)
    }
}

impl std::error::Error for WrongArguments {}

impl Argument {
    /// An argument and the names of its numbers.
    pub fn new(kind: ArgumentKind, name: impl Into<String>, components: Vec<String>) -> Self {
        Self { kind, name: name.into(), components }
    }
}

impl Results {
    /// A matrix; a vector is one of one column.
    pub fn new(name: impl Into<String>, rows: usize, columns: usize) -> Self {
        Self { name: name.into(), rows, columns }
    }

    /// How many outputs it is made of.
    #[expect(clippy::len_without_is_empty, reason = "the size of a matrix; no collection")]
    pub fn len(&self) -> usize {
        self.rows * self.columns
    }

    /// Whether it is one number.
    pub fn is_scalar(&self) -> bool {
        (self.rows, self.columns) == (1, 1)
    }
}

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
        let program = Self { name: name.into(), arguments, numbers, code, results };
        program.verify().map(|()| program)
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
}
