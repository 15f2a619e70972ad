//! Kinds of values of expressions.

/// The kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    Scalar,
    Vector,
    Rotation,
    /// Linear and angular velocity.
    Twist,
}

impl ValueKind {
    pub fn noun(self) -> &'static str {
        match self {
            ValueKind::Scalar => "a scalar",
            ValueKind::Vector => "a vector",
            ValueKind::Rotation => "a rotation",
            ValueKind::Twist => "a twist",
        }
    }
}
