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
}

/// Largest number of variables of a function of the user's own.
pub const MOST_VARIABLES: usize = 3;

/// A function that the user gives, of one number or several, or a derivative of it: only its name is known when code is
/// written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OwnFunction {
    /// Which of them: an index into a list of names.
    pub index: u16,
    /// Number of its variables, at least one.
    pub variables: u8,
    /// Order of the derivative by each of them.
    pub orders: [u8; MOST_VARIABLES],
    /// Number of continuous derivatives by each variable, of a table; `None`: it is smooth.
    pub continuous: Option<u8>,
}

impl OwnFunction {
    /// The function itself, of one number up to [`MOST_VARIABLES`].
    pub const fn new(index: u16, variables: u8, continuous: Option<u8>) -> Self {
        Self { index, variables, orders: [0; MOST_VARIABLES], continuous }
    }

    /// Its derivative by one of its variables.
    #[must_use]
    pub const fn derivative(mut self, by: usize) -> Self {
        self.orders[by] += 1;
        self
    }

    /// The largest of the orders by its variables.
    pub const fn order(self) -> u8 {
        let [mut most, second, third] = self.orders;
        if second > most {
            most = second;
        }
        if third > most { third } else { most }
    }

    /// Suffix of its name where it is a function of its own: nothing of the function itself, the order of a derivative
    /// by the only variable, the orders by each of several: `_2`, `_1_0`.
    pub(crate) fn suffix(self) -> String {
        let orders = self.of(&self.orders);
        let orders = if self.order() == 0 { &[] } else { orders };
        orders.iter().map(|order| format!("_{order}")).collect()
    }

    /// Arguments that are not mere filling.
    pub(crate) fn of<T>(self, arguments: &[T; MOST_VARIABLES]) -> &[T] {
        &arguments[..usize::from(self.variables)]
    }

    /// A list of arguments, filled up with the last one.
    pub(crate) fn filled<T: Copy>(arguments: &[T]) -> [T; MOST_VARIABLES] {
        std::array::from_fn(|k| arguments[k.min(arguments.len() - 1)])
    }

    /// A number for each, for hashing.
    pub(crate) const fn word(self) -> u64 {
        let [first, second, third] = self.orders;
        (self.index as u64) << 24 | (second as u64) << 16 | (third as u64) << 8 | first as u64
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
    /// Name as users write it.
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
        }
    }
}

impl BinaryFunction {
    /// Name as users write it.
    pub const fn name(self) -> &'static str {
        match self {
            BinaryFunction::Atan2 => "atan2",
            BinaryFunction::Min => "min",
            BinaryFunction::Max => "max",
            BinaryFunction::Powf => "powf",
        }
    }
}
