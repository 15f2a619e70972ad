//! Arguments and results of programs, with their components.

use std::fmt;

use crate::algebra::{Key, joined};

/// An argument: numbers that are handed over together.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Argument {
    /// Meaning of the argument.
    pub kind: ArgumentKind,
    /// A short name: `q`, `z`.
    pub name: String,
    /// The names of its numbers, as in the equations.
    pub components: Vec<String>,
}

/// The meaning of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ArgumentKind {
    /// The numbers of the fields of a struct, in their units.
    Parameters,
    /// The constants of a kernel, which it computes once from its parameters.
    Constants,
    /// Time, in seconds: one number.
    Time,
    /// The components of the configuration, in the order of its parts: of rotations those of the unit quaternion, x, y,
    /// z, w, of turns in the plane cosine and sine, of poses these and then the position.
    Configuration,
    /// The speeds z.
    Speeds,
    /// The momenta p = ∂T/∂z.
    Momenta,
    /// The rates ż of the speeds.
    Accelerations,
    /// The twist of a body: velocity of O, angular velocity, both in body axes.
    Twist,
    /// The residuals of the constraints.
    Residuals,
    /// Factors of the velocities of contact impulses: numbers of A and W, as `impulse_dynamics` gives them.
    Factors,
    /// Contact impulses, row by row.
    Impulses,
    /// Values that arrive at run time.
    Inputs,
    /// The weights of the sum of the rates (V, ż) whose second derivatives are taken.
    Weights,
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
            ArgumentKind::Factors => "factors",
            ArgumentKind::Impulses => "impulses",
            ArgumentKind::Inputs => "inputs",
            ArgumentKind::Weights => "weights",
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

impl Key for Input {
    fn word(&self) -> u64 {
        match self {
            Input::Component { argument, component } => joined(1 + *argument as u64, *component as u64),
            Input::Number(k) => joined(0, *k as u64),
        }
    }
}

/// Outputs that belong together: a number (one row, one column), a vector (one column), or a matrix, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Results {
    /// Name of the results.
    pub name: String,
    /// Rows of the matrix.
    pub rows: usize,
    /// Columns of the matrix.
    pub columns: usize,
}

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

    /// Number of outputs that it is made of.
    #[expect(clippy::len_without_is_empty, reason = "the size of a matrix; no collection")]
    pub fn len(&self) -> usize {
        self.rows * self.columns
    }

    /// Whether it is one number.
    pub fn is_scalar(&self) -> bool {
        (self.rows, self.columns) == (1, 1)
    }
}
