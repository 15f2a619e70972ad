//! The passes by which programs become short, by name: tests leave one out to see what it gains.

/// A pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// a b + a c is a (b + c), within a sum, the most frequent factor first.
    Factors,
    /// Pairs of factors that several products of all outputs have are products of their own, the most frequent first.
    Products,
    /// The same of terms of sums, up to a common factor.
    Sums,
    /// A product that one sum alone reads is fused with an addition.
    Fusing,
    /// Signs are led to where they cost nothing.
    Signs,
    /// A product that several sums read, and nothing else, is fused with an addition of each.
    ProductsInSums,
    /// A sum of products begins with what is added to it.
    Beginnings,
}

/// The passes that are made: all, or all but one.
#[derive(Clone, Copy, Default)]
pub struct Passes {
    left_out: Option<Pass>,
}

impl Passes {
    #[cfg(test)]
    pub fn without(pass: Pass) -> Self {
        Self { left_out: Some(pass) }
    }

    /// Whether a pass is made. Products that are not fused as they are written would be by those that come later.
    pub fn make(self, pass: Pass) -> bool {
        let fuses = matches!(pass, Pass::Fusing | Pass::ProductsInSums | Pass::Beginnings);
        self.left_out != Some(pass) && !(fuses && self.left_out == Some(Pass::Fusing))
    }
}
