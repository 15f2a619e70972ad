//! The passes by which programs become short, by name: tests leave one out to see what it gains.

/// A pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
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

impl Pass {
    /// Whether it is made.
    #[cfg(not(test))]
    pub(crate) fn is_made(self) -> bool {
        true
    }

    #[cfg(test)]
    pub(crate) fn is_made(self) -> bool {
        let left_out = LEFT_OUT.get();
        // What the first leaves the others would fuse.
        let fused = matches!(self, Pass::ProductsInSums | Pass::Beginnings) && left_out == Some(Pass::Fusing);
        left_out != Some(self) && !fused
    }

    /// Result of some work where the pass is left out, on this thread.
    #[cfg(test)]
    pub(crate) fn left_out<T>(left_out: Option<Pass>, of: impl FnOnce() -> T) -> T {
        LEFT_OUT.set(left_out);
        let result = of();
        LEFT_OUT.set(None);
        result
    }
}

#[cfg(test)]
std::thread_local! {
    static LEFT_OUT: std::cell::Cell<Option<Pass>> = const { std::cell::Cell::new(None) };
}
