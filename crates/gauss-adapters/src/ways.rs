//! Ways to find ∂f/∂x times a vector.

/// Central differences: two evaluations a product, right to ∛ε² of the third derivative (some 1e-10 in double
/// precision) where all components of x are of one size. Implicit methods converge with less; their accuracy does not
/// depend on it.
///
/// The points are `x ± hv` with `h = ∛ε max(1, |x|)/|v|` and the largest components as norms, so that components of x
/// should not be smaller than 1 by many orders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Differences;

/// A function `(t, x, v, result)`: exact derivatives of your own.
#[derive(Clone, Copy, Debug)]
pub struct JacobianFunction<G>(pub G);
