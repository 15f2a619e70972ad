//! `modes(panel, coordinates = [a, b], translation = […], …)`: a body that deforms, by integrals of its modes.

use super::expression::Expression;
use proc_macro2::Span;
use syn::Ident;

/// The clause, read and checked.
#[derive(Clone)]
pub struct ModesClause {
    /// The body whose axes the modes are clamped to.
    pub body: Ident,
    /// η: scalar coordinates, one for each mode.
    pub coordinates: Vec<Ident>,
    /// Integrals that are given of the body, entry by entry, the last index running first.
    pub integrals: Vec<GivenIntegral>,
    /// The file that these are from, as it is written.
    pub file: Option<String>,
    /// The word `modes`.
    pub span: Span,
}

/// An integral, and where it is written.
#[derive(Clone)]
pub struct GivenIntegral {
    pub integral: Integral,
    /// Scalars of fields and numbers.
    pub entries: Vec<Expression>,
    pub span: Span,
}

/// Integrals over the modes of a body, body axes, pole O.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integral {
    /// δ₀: ∫φ_k dm.
    Translation,
    /// δ₁: ∫x × φ_k dm.
    Rotation,
    /// M: ∫φ_k·φ_l dm.
    Mass,
    /// C.
    Damping,
    /// K.
    Stiffness,
    /// ∂I_O/∂η_k, in the order xx, yy, zz, xy, xz, yz.
    Inertia,
    /// ∫ψ_kl dm of the foreshortening ½ Σ ψ_kl η_k η_l.
    Shortening,
    /// ∫(φ_l × φ_k + x × ψ_kl) dm.
    Gyroscopic,
    /// ∂²I_O/∂η_k∂η_l.
    SecondInertia,
}

impl Integral {
    /// All of them, by their words.
    pub const ALL: [(&'static str, Integral); 9] = [
        ("translation", Integral::Translation),
        ("rotation", Integral::Rotation),
        ("mass", Integral::Mass),
        ("damping", Integral::Damping),
        ("stiffness", Integral::Stiffness),
        ("inertia", Integral::Inertia),
        ("shortening", Integral::Shortening),
        ("gyroscopic", Integral::Gyroscopic),
        ("second_inertia", Integral::SecondInertia),
    ];

    pub fn word(self) -> &'static str {
        Self::ALL.into_iter().find(|(_, integral)| *integral == self).map_or("", |(word, _)| word)
    }

    /// Numbers of entries along each index, of n modes.
    pub fn sizes(self, n: usize) -> Vec<usize> {
        match self {
            Integral::Translation | Integral::Rotation => vec![n, 3],
            Integral::Mass | Integral::Damping | Integral::Stiffness => vec![n, n],
            Integral::Inertia => vec![n, 6],
            Integral::Shortening | Integral::Gyroscopic => vec![n, n, 3],
            Integral::SecondInertia => vec![n, n, 6],
        }
    }

    /// Whether it is a matrix that can be given by its diagonal.
    pub fn is_matrix(self) -> bool {
        matches!(self, Integral::Mass | Integral::Damping | Integral::Stiffness)
    }

    /// Whether its first two indices can be exchanged.
    pub fn is_symmetric(self) -> bool {
        self.is_matrix() || matches!(self, Integral::Shortening | Integral::SecondInertia)
    }
}

impl ModesClause {
    /// Entries that are given of an integral.
    pub fn find(&self, integral: Integral) -> Option<&GivenIntegral> {
        self.integrals.iter().find(|given| given.integral == integral)
    }

    /// Prefix of a word of it in messages.
    pub fn place(&self) -> String {
        self.file.as_ref().map_or_else(String::new, |file| format!("{file}: "))
    }

    /// Its expressions.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> {
        self.integrals.iter().flat_map(|given| &given.entries)
    }
}
