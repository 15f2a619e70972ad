//! Kinds of values of expressions.

/// The kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Scalar,
    Vector,
    Rotation,
    /// Linear and angular velocity.
    Twist,
}

impl Kind {
    pub fn noun(self) -> &'static str {
        match self {
            Kind::Scalar => "a scalar",
            Kind::Vector => "a vector",
            Kind::Rotation => "a rotation",
            Kind::Twist => "a twist",
        }
    }
}
