//! Agreement between the definition and the formulas.

use std::fmt;

use crate::algebra::Number;

use crate::mechanics::formula::Method;

/// A formula does not satisfy the Gauss condition: an error of this crate, never of its user.
#[derive(Debug)]
pub struct Disagreement {
    pub method: Method,
    pub row: usize,
    pub residual: f64,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, row, residual } = self;
        write!(f, "row {row} of {method:?} misses the Gauss condition by {residual:e}")
    }
}

/// The values that the definition gives for formulas at one state.
pub enum Comparison {
    Agrees,
    /// Numbers are so large that it has no value at the accelerations of the formulas, as at those of `exp(exp(1000))`.
    WithoutValue,
}

/// A sum, and the sizes of its terms together: what its roundings are relative to.
pub struct SizedSum<N> {
    pub value: N,
    pub terms: f64,
}

impl<N: Number> SizedSum<N> {
    pub fn of(first: N, terms: Vec<N>) -> Self {
        let start = Self { value: first, terms: first.to_f64().abs() };
        terms.into_iter().fold(start, |sum, x| Self { value: sum.value + x, terms: sum.terms + x.to_f64().abs() })
    }

    pub fn over(self, scale: f64) -> Self {
        Self { value: self.value / N::number(scale), terms: self.terms / scale }
    }

    pub fn is_in_range(&self) -> bool {
        is_in_range(&self.value) && self.terms.is_finite()
    }
}

/// Whether double precision has the number: scales and residuals are taken there, and so are all results of kernels.
pub fn is_in_range<N: Number>(x: &N) -> bool {
    x.to_f64().is_finite()
}

/// Two evaluations of the same rows.
pub fn agree<N: Number>(method: Method, found: &[N], expected: &[SizedSum<N>]) -> Result<(), Disagreement> {
    let sizes = found.iter().chain(expected.iter().map(|row| &row.value));
    let scale = sizes.fold(1.0_f64, |most, x| most.max(x.to_f64().abs()));
    for (row, (x, y)) in found.iter().zip(expected).enumerate() {
        // Numbers of order one and some hundreds of roundings; terms of 1e120 that cancel leave roundings of their own.
        // NaN is no agreement either.
        let residual = (*x - y.value).to_f64();
        let close = residual.abs() <= 1e-8 * scale + N::NEGLIGIBLE * y.terms;
        if !close {
            return Err(Disagreement { method, row, residual });
        }
    }
    Ok(())
}
