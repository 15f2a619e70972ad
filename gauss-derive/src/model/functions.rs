//! The functions that expressions may call, what they take and what they give.

use super::FunctionName;
use super::kinds::Kind;
use super::names::Table;

/// A function as it is called: integer powers are kept apart, since their exponent is no expression.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    Named(FunctionName),
    Power,
}

/// Every function by its word.
pub(super) const FUNCTIONS: &Table<Function> = &[
    ("sin", Function::Named(FunctionName::Sin)),
    ("cos", Function::Named(FunctionName::Cos)),
    ("tan", Function::Named(FunctionName::Tan)),
    ("exp", Function::Named(FunctionName::Exp)),
    ("ln", Function::Named(FunctionName::Ln)),
    ("sqrt", Function::Named(FunctionName::Sqrt)),
    ("powi", Function::Power),
    ("dot", Function::Named(FunctionName::Dot)),
    ("cross", Function::Named(FunctionName::Cross)),
    ("rotation_x", Function::Named(FunctionName::RotationX)),
    ("rotation_y", Function::Named(FunctionName::RotationY)),
    ("rotation_z", Function::Named(FunctionName::RotationZ)),
];

impl Function {
    /// How many arguments it takes; the value that a method is called on is the first.
    pub(super) fn arguments(self) -> usize {
        match self {
            Function::Power => 2,
            Function::Named(name) => name.arguments(),
        }
    }

    /// A call of it, for messages.
    pub(super) fn example(self) -> String {
        match self {
            Function::Power => "powi(x, 2)".into(),
            Function::Named(name) if name.arguments() == 2 => format!("{}(a, b)", name.word()),
            Function::Named(name) => format!("{}(x)", name.word()),
        }
    }
}

impl FunctionName {
    /// The word in expressions.
    pub fn word(self) -> &'static str {
        match self {
            FunctionName::Sin => "sin",
            FunctionName::Cos => "cos",
            FunctionName::Tan => "tan",
            FunctionName::Exp => "exp",
            FunctionName::Ln => "ln",
            FunctionName::Sqrt => "sqrt",
            FunctionName::RotationX => "rotation_x",
            FunctionName::RotationY => "rotation_y",
            FunctionName::RotationZ => "rotation_z",
            FunctionName::Dot => "dot",
            FunctionName::Cross => "cross",
            FunctionName::Atan2 => "atan2",
            FunctionName::Twist => "twist",
            FunctionName::Inverse => "inverse",
            FunctionName::Rate => "rate",
        }
    }

    fn arguments(self) -> usize {
        match self {
            FunctionName::Dot | FunctionName::Cross => 2,
            _ => 1,
        }
    }

    /// The kind of each argument.
    pub(super) fn takes(self) -> Kind {
        match self {
            FunctionName::Dot | FunctionName::Cross => Kind::Vector,
            _ => Kind::Scalar,
        }
    }

    /// The kind of the value.
    pub(super) fn gives(self) -> Kind {
        match self {
            FunctionName::Cross => Kind::Vector,
            FunctionName::RotationX | FunctionName::RotationY | FunctionName::RotationZ => Kind::Rotation,
            _ => Kind::Scalar,
        }
    }
}
