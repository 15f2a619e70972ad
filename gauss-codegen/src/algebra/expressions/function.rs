//! The functions that expressions call, and those that users give.

/// A function of one argument that the language knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Function {
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// −1, 0 or 1.
    Signum,
    /// Hyperbolic tangent.
    Tanh,
    /// A function of the user's own, or one of its derivatives: only its name is known when code is written.
    Own(OwnFunction),
}

/// A function that the user gives, or a derivative of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OwnFunction {
    /// Which of them: an index into a list of names.
    pub index: u16,
    /// How often it is differentiated.
    pub order: u8,
    /// How many of its derivatives are continuous, of a table; `None`: it is smooth.
    pub continuous: Option<u8>,
}

impl OwnFunction {
    /// The function itself.
    pub const fn new(index: u16, continuous: Option<u8>) -> Self {
        Self { index, order: 0, continuous }
    }

    /// Its derivative.
    #[must_use]
    pub const fn derivative(self) -> Self {
        Self { order: self.order + 1, ..self }
    }

    /// Another smooth function in its place, for checks of identities that hold for every function: the angle by which
    /// the sine of its argument is shifted, and the number of times that sine is differentiated.
    pub(crate) fn stand_in(self) -> (f64, u8) {
        (0.3 + 0.7 * f64::from(self.index), self.order % 4)
    }
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BinaryFunction {
    /// Angle of the point (x, y), given as y and x.
    Atan2,
    /// The smaller one.
    Min,
    /// The larger one.
    Max,
    /// The power with a real exponent, which is a constant.
    Powf,
}

impl Function {
    /// What users write.
    pub const fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Signum => "signum",
            Function::Tanh => "tanh",
            Function::Own(_) => "own",
        }
    }
}

impl Function {
    /// A number for each, for hashing.
    pub(crate) const fn word(self) -> u64 {
        match self {
            Function::Sin => 0,
            Function::Cos => 1,
            Function::Exp => 2,
            Function::Ln => 3,
            Function::Sqrt => 4,
            Function::Abs => 5,
            Function::Signum => 6,
            Function::Tanh => 7,
            Function::Own(own) => 8 + ((own.index as u64) << 8 | own.order as u64),
        }
    }
}

impl BinaryFunction {
    /// What users write.
    pub const fn name(self) -> &'static str {
        match self {
            BinaryFunction::Atan2 => "atan2",
            BinaryFunction::Min => "min",
            BinaryFunction::Max => "max",
            BinaryFunction::Powf => "powf",
        }
    }
}
