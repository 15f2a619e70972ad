//! Errors: mistakes of a scene with their places, parameters that no body has, calls with numbers of another method.

use std::fmt;

use gauss_runtime::error::ParameterError;
use gauss_runtime::table::TableFault;

/// Place of a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// In the text of a scene, both counted from one; columns are characters.
    Text {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// A clause as it begins, the name of a field, or of the scene where it is of the whole.
    Clause(String),
}

/// One mistake of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mistake {
    /// Its place.
    pub place: Place,
    /// The mistake with its remedy, as the compiler says it of a struct.
    pub message: String,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Text { line, column } => write!(f, "{line}:{column}: {}", self.message),
            Place::Clause(clause) => write!(f, "{clause}: {}", self.message),
        }
    }
}

/// Every mistake of a scene, in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistakes {
    pub(crate) list: Vec<Mistake>,
    pub(crate) source: String,
}

impl Mistakes {
    /// The mistakes: at least one.
    pub fn as_slice(&self) -> &[Mistake] {
        &self.list
    }

    /// The text that places are in: of a robot's file the struct that was made of its clauses, one on each line.
    pub fn source(&self) -> &str {
        &self.source
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        lines(f, &self.list, "\n")
    }
}

impl std::error::Error for Mistakes {}

/// Why a kernel cannot be made from numbers.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum KernelError {
    /// Parameters that no body has: as `kernel()` of a compiled struct refuses them, all at once.
    Parameters(ParameterError),
    /// Names and counts of numbers that are not those of the model, all at once.
    Given(Vec<Misgiven>),
    /// A check needs a matrix with more rows than are supported at run time.
    TooLarge {
        /// Number of rows of the matrix.
        rows: usize,
        /// Number of rows that are supported.
        most: usize,
    },
}

/// A parameter that is not given as the model has it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Misgiven {
    /// No parameter has that name.
    Unknown(String),
    /// A parameter that is not given.
    Missing(String),
    /// A parameter that is given more than once.
    Repeated(String),
    /// The constant of a table whose numbers were not given before, by `Model::with_tables`.
    Table(String),
    /// A parameter with another count of numbers.
    Count {
        /// Its name.
        name: String,
        /// Count of its numbers.
        expected: usize,
        /// Count of the numbers given.
        found: usize,
    },
}

impl fmt::Display for Misgiven {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "the model has no parameter `{name}`"),
            Self::Missing(name) => write!(f, "`{name}` is not given"),
            Self::Repeated(name) => write!(f, "`{name}` is given more than once"),
            Self::Table(name) => {
                write!(f, "the numbers of the table in `{name}` are not given; add them by `with_tables`")
            }
            Self::Count { name, expected, found } => {
                write!(f, "`{name}` has {expected} numbers, and {found} are given")
            }
        }
    }
}

impl fmt::Display for KernelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameters(error) => error.fmt(f),
            Self::Given(list) => lines(f, list, "; "),
            Self::TooLarge { rows, most } => {
                write!(f, "a check of the parameters needs a matrix of {rows} rows; at run time {most} are supported")
            }
        }
    }
}

impl std::error::Error for KernelError {}

impl From<ParameterError> for KernelError {
    fn from(error: ParameterError) -> Self {
        Self::Parameters(error)
    }
}

/// An array of a table that is not as the model has it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum TableMistake {
    /// No table has its numbers in a constant of that name.
    Unknown {
        /// The name.
        name: String,
        /// The names of all constants of tables.
        known: Vec<String>,
    },
    /// A constant whose array is not given.
    Missing(String),
    /// A constant whose array is given more than once.
    Repeated(String),
    /// An array of another shape.
    Shape {
        /// The name of its constant.
        name: String,
        /// Its axes; none where any length is right.
        expected: Vec<Option<usize>>,
        /// The axes of the array given.
        found: Vec<usize>,
    },
    /// Numbers that make no table.
    Fault {
        /// The name of their constant.
        name: String,
        /// The fault.
        fault: TableFault,
    },
}

impl TableMistake {
    /// The name of the constant.
    pub fn name(&self) -> &str {
        match self {
            Self::Missing(name) | Self::Repeated(name) => name,
            Self::Unknown { name, .. } | Self::Shape { name, .. } | Self::Fault { name, .. } => name,
        }
    }
}

/// Axes as Python writes them.
fn written(axes: impl Iterator<Item = String>) -> String {
    let axes: Vec<String> = axes.collect();
    let comma = if axes.len() == 1 { "," } else { "" };
    format!("({}{comma})", axes.join(", "))
}

impl fmt::Display for TableMistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name, known } if known.is_empty() => {
                write!(f, "`{name}` is no constant of a table: the model has no tables")
            }
            Self::Unknown { name, known } => {
                write!(f, "`{name}` is no constant of a table; there are {}", known.join(", "))
            }
            Self::Missing(name) => write!(f, "`{name}`, the constant of a table, is not given"),
            Self::Repeated(name) => write!(f, "`{name}` is given more than once"),
            Self::Shape { name, expected, found } => {
                let expected = expected.iter().map(|own| own.map_or_else(|| "n".to_owned(), |own| own.to_string()));
                let found = found.iter().map(usize::to_string);
                write!(f, "`{name}` has shape {}; expected {}", written(found), written(expected))
            }
            Self::Fault { name, fault } => write!(f, "`{name}`: {fault}"),
        }
    }
}

/// Every array that is not as the model has it.
#[derive(Clone, Debug, PartialEq)]
pub struct TableMistakes {
    pub(crate) list: Vec<TableMistake>,
}

impl TableMistakes {
    /// The mistakes: at least one.
    pub fn as_slice(&self) -> &[TableMistake] {
        &self.list
    }
}

impl fmt::Display for TableMistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        lines(f, &self.list, "\n")
    }
}

impl std::error::Error for TableMistakes {}

fn lines<T: fmt::Display>(f: &mut fmt::Formatter<'_>, list: &[T], between: &str) -> fmt::Result {
    list.iter().enumerate().try_for_each(|(k, own)| {
        let separator = if k > 0 { between } else { "" };
        write!(f, "{separator}{own}")
    })
}

/// Why a method is not called.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CallError {
    /// The model has no such method; those of clauses are there where the clause is.
    NoMethod {
        /// The method that was asked for.
        name: String,
        /// The methods that there are.
        known: Vec<String>,
    },
    /// The lists of numbers are more or fewer than the method takes.
    Lists {
        /// The method.
        method: String,
        /// The names of its arguments.
        expected: Vec<String>,
        /// Number of lists given.
        found: usize,
    },
    /// The configuration has more rotations and poses than the method moves: 31.
    Groups {
        /// The method.
        method: String,
    },
    /// An argument, or the results, have another count of numbers.
    Count {
        /// The method.
        method: String,
        /// The argument: `q`; or `results`.
        name: String,
        /// Count of its numbers.
        expected: usize,
        /// Count of the numbers that there are.
        found: usize,
    },
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMethod { name, known } => {
                write!(f, "the model has no method `{name}`; it has {}", known.join(", "))
            }
            Self::Lists { method, expected, found } => {
                write!(f, "`{method}` takes {}, and {found} lists of numbers are given", expected.join(", "))
            }
            Self::Groups { method } => write!(f, "`{method}` is for at most 31 rotations and poses"),
            Self::Count { method, name, expected, found } => {
                write!(f, "`{name}` of `{method}` has {expected} numbers, and {found} are given")
            }
        }
    }
}

impl std::error::Error for CallError {}
