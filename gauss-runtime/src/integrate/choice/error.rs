//! Mistakes in the choice of a method.

use core::fmt;

use crate::integrate::choice::method::Method;

/// The error for a name that no method has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownMethod {
    /// The method that may be meant: it has a name like that, or other programs call it so.
    pub nearest: Option<Method>,
}

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, method) in Method::ALL.iter().enumerate() {
            write!(f, "{}{method}", if i == 0 { "no such method; there are " } else { ", " })?;
        }
        self.nearest.map_or(Ok(()), |nearest| write!(f, "; is {nearest} meant?"))
    }
}

impl core::error::Error for UnknownMethod {}

/// Steps that a method does not make, or a clause that it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MethodError {
    /// The control has no place for a method that needs a clause of the scene: a parameter of
    /// [`MethodControl`](crate::integrate::MethodControl) makes one.
    Clause(Method, &'static str),
    /// The method estimates no error: its steps are of one length.
    NoEstimate(Method),
    /// The method chooses the length of its steps.
    NoLength(Method),
    /// The control has none of the explicit methods of one step, which alone can be differentiated.
    Implicit(Method),
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clause(method, clause) => {
                write!(f, "the method {method} needs `#[gauss({clause})]` at the struct, which does not say it")
            }
            Self::NoEstimate(method) => {
                write!(f, "the method {method} keeps no tolerances: its steps are of one length")
            }
            Self::NoLength(method) => {
                write!(f, "the method {method} chooses its steps by tolerances, and takes no length of them")
            }
            Self::Implicit(method) => {
                write!(f, "the method {method} is not explicit, or has more than one step: it cannot be differentiated")
            }
        }
    }
}

impl core::error::Error for MethodError {}
