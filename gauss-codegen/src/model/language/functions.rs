//! The functions that expressions may call, what they take and what they give; and what they may ask of bodies.

use super::kind::ValueKind;
use super::words::Table;
use crate::model::scene::expression::{FunctionName, Property};

/// A function as it is called: integer powers are kept apart, since their exponent is no expression.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum FunctionCall {
    Named(FunctionName),
    Power,
}

/// Every function by its word.
pub const FUNCTIONS: &Table<FunctionCall> = &[
    ("sin", FunctionCall::Named(FunctionName::Sin)),
    ("cos", FunctionCall::Named(FunctionName::Cos)),
    ("tan", FunctionCall::Named(FunctionName::Tan)),
    ("asin", FunctionCall::Named(FunctionName::Asin)),
    ("acos", FunctionCall::Named(FunctionName::Acos)),
    ("atan", FunctionCall::Named(FunctionName::Atan)),
    ("tanh", FunctionCall::Named(FunctionName::Tanh)),
    ("exp", FunctionCall::Named(FunctionName::Exp)),
    ("ln", FunctionCall::Named(FunctionName::Ln)),
    ("sqrt", FunctionCall::Named(FunctionName::Sqrt)),
    ("powi", FunctionCall::Power),
    ("powf", FunctionCall::Named(FunctionName::Powf)),
    ("atan2", FunctionCall::Named(FunctionName::Atan2)),
    ("dot", FunctionCall::Named(FunctionName::Dot)),
    ("cross", FunctionCall::Named(FunctionName::Cross)),
    ("rotation_x", FunctionCall::Named(FunctionName::RotationX)),
    ("rotation_y", FunctionCall::Named(FunctionName::RotationY)),
    ("rotation_z", FunctionCall::Named(FunctionName::RotationZ)),
    ("inverse", FunctionCall::Named(FunctionName::Inverse)),
    ("twist", FunctionCall::Named(FunctionName::Twist)),
    ("rate", FunctionCall::Named(FunctionName::Rate)),
    ("abs", FunctionCall::Named(FunctionName::Abs)),
    ("min", FunctionCall::Named(FunctionName::Min)),
    ("max", FunctionCall::Named(FunctionName::Max)),
    ("hypot", FunctionCall::Named(FunctionName::Hypot)),
    ("signum", FunctionCall::Named(FunctionName::Signum)),
    ("clamp", FunctionCall::Named(FunctionName::Clamp)),
    ("smooth_step", FunctionCall::Named(FunctionName::SmoothStep)),
];

impl FunctionCall {
    /// Number of its arguments; the value that a method is called on is the first.
    pub fn arguments(self) -> usize {
        match self {
            FunctionCall::Power => 2,
            FunctionCall::Named(name) => name.arguments(),
        }
    }

    /// A call of it, for messages.
    pub fn example(self) -> String {
        match self {
            FunctionCall::Power => "powi(x, 2)".into(),
            FunctionCall::Named(FunctionName::Atan2) => "atan2(y, x)".into(),
            FunctionCall::Named(FunctionName::Powf) => "powf(x, 1.5)".into(),
            FunctionCall::Named(FunctionName::Inverse) => "inverse(r)".into(),
            FunctionCall::Named(FunctionName::Clamp) => "clamp(x, low, high)".into(),
            FunctionCall::Named(FunctionName::SmoothStep) => "smooth_step(x, from, to)".into(),
            FunctionCall::Named(name) if name.arguments() == 2 => format!("{}(a, b)", name.word()),
            FunctionCall::Named(name) => format!("{}(x)", name.word()),
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
            FunctionName::Asin => "asin",
            FunctionName::Acos => "acos",
            FunctionName::Atan => "atan",
            FunctionName::Tanh => "tanh",
            FunctionName::Powf => "powf",
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
            FunctionName::Abs => "abs",
            FunctionName::Min => "min",
            FunctionName::Max => "max",
            FunctionName::Hypot => "hypot",
            FunctionName::Signum => "signum",
            FunctionName::Clamp => "clamp",
            FunctionName::SmoothStep => "smooth_step",
        }
    }

    fn arguments(self) -> usize {
        match self {
            FunctionName::Dot
            | FunctionName::Cross
            | FunctionName::Atan2
            | FunctionName::Twist
            | FunctionName::Min
            | FunctionName::Max
            | FunctionName::Powf
            | FunctionName::Hypot => 2,
            FunctionName::Clamp | FunctionName::SmoothStep => 3,
            _ => 1,
        }
    }

    /// It takes one number and gives one.
    pub fn is_elementary(self) -> bool {
        matches!(
            self,
            FunctionName::Sin
                | FunctionName::Cos
                | FunctionName::Tan
                | FunctionName::Asin
                | FunctionName::Acos
                | FunctionName::Atan
                | FunctionName::Tanh
                | FunctionName::Exp
                | FunctionName::Ln
                | FunctionName::Sqrt
                | FunctionName::Abs
                | FunctionName::Signum
        )
    }

    /// It jumps, or one of its first two derivatives does, so that only what is not differentiated can contain it.
    pub fn has_kink(self) -> bool {
        matches!(
            self,
            FunctionName::Abs
                | FunctionName::Min
                | FunctionName::Max
                | FunctionName::Signum
                | FunctionName::Clamp
                | FunctionName::SmoothStep
        )
    }

    /// Description of its jump, for messages.
    pub fn jump(self) -> String {
        match self {
            FunctionName::Signum => "`signum` jumps".into(),
            FunctionName::SmoothStep => "the second derivative of `smooth_step` jumps".into(),
            _ => format!("the derivative of `{}` jumps", self.word()),
        }
    }

    /// The kind of each argument; `None` for a scalar or a vector.
    pub fn takes(self) -> Option<ValueKind> {
        match self {
            FunctionName::Dot | FunctionName::Cross | FunctionName::Twist => Some(ValueKind::Vector),
            FunctionName::Inverse => Some(ValueKind::Rotation),
            FunctionName::Rate => None,
            _ => Some(ValueKind::Scalar),
        }
    }

    /// The kind of the value; `None` for that of the argument.
    pub fn gives(self) -> Option<ValueKind> {
        match self {
            FunctionName::Cross => Some(ValueKind::Vector),
            FunctionName::RotationX | FunctionName::RotationY | FunctionName::RotationZ | FunctionName::Inverse => {
                Some(ValueKind::Rotation)
            }
            FunctionName::Twist => Some(ValueKind::Twist),
            FunctionName::Rate => None,
            _ => Some(ValueKind::Scalar),
        }
    }
}

/// The properties of bodies by their words.
pub const PROPERTIES: &Table<Property> = &[
    ("position", Property::Position),
    ("rotation", Property::Rotation),
    ("velocity", Property::Velocity),
    ("angular_velocity", Property::AngularVelocity),
    ("body_velocity", Property::BodyVelocity),
    ("body_angular_velocity", Property::BodyAngularVelocity),
    ("relative_velocity", Property::RelativeVelocity),
    ("force", Property::Force),
    ("torque", Property::Torque),
];

impl Property {
    /// The word after the point.
    pub fn word(self) -> &'static str {
        PROPERTIES.iter().find(|(_, property)| *property == self).map_or("", |(word, _)| word)
    }

    /// It is a velocity.
    pub fn is_velocity(self) -> bool {
        matches!(
            self,
            Property::Velocity
                | Property::AngularVelocity
                | Property::BodyVelocity
                | Property::BodyAngularVelocity
                | Property::RelativeVelocity
        )
    }

    /// It is a part of a wrench.
    pub fn is_of_wrench(self) -> bool {
        matches!(self, Property::Force | Property::Torque)
    }
}
