//! The real numbers of functions in C and C++: their type, their literals, the names of elementary functions.

use crate::algebra::Rational;

/// The type of the numbers that functions compute with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::targets) enum Real {
    /// `double`.
    Double,
    /// `float`, with the functions of `<math.h>` that end in `f`: nothing is promoted to `double`.
    Single,
    /// A parameter of a template in C++.
    Scalar,
}

impl Real {
    pub(in crate::targets) fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Single => "float",
            Self::Scalar => "Scalar",
        }
    }

    /// A function of `<math.h>`. In C++ it is found by its argument, and types of one's own have `abs`.
    pub(in crate::targets) fn function(self, name: &str) -> String {
        match (self, name) {
            (Self::Single, _) => format!("{name}f"),
            (Self::Scalar, "fabs") => "abs".to_owned(),
            _ => name.to_owned(),
        }
    }

    /// Stands before the declaration of a function of the type.
    pub(in crate::targets) fn template(self) -> &'static str {
        if self == Self::Scalar { "template <class Scalar>\n" } else { "" }
    }

    /// The shortest digits that read back the same number.
    pub(in crate::targets) fn literal(self, value: f64) -> String {
        let digits = match self {
            Self::Single => format!("{:?}f", value as f32),
            _ => format!("{value:?}"),
        };
        self.wrapped(digits, value.is_sign_negative())
    }

    pub(in crate::targets) fn fraction(self, value: Rational) -> String {
        match value.parts() {
            Some((numerator, denominator)) if !value.is_dyadic() && self != Self::Single => {
                self.wrapped(format!("{:?} / {:?}", numerator as f64, denominator as f64), true)
            }
            _ => self.literal(value.to_f64()),
        }
    }

    fn wrapped(self, text: String, brackets: bool) -> String {
        match self {
            Self::Scalar => format!("Scalar({text})"),
            _ if brackets => format!("({text})"),
            _ => text,
        }
    }

    /// Whether a number is one of the type, not zero or infinite for being beyond its range.
    pub(in crate::targets) fn holds(self, value: f64) -> bool {
        let single = value as f32;
        self != Self::Single || value == 0.0 || !value.is_finite() || (single.is_normal())
    }
}
