//! The inertia that a frame shows and the factors of the mass matrix are what their definitions say, within the bounds.

use gauss_bounded::Bounded;
use gauss_runtime::operational::{Factor, OperationalSpace};
use gauss_runtime::prelude::*;

/// A positive definite matrix, and a Jacobian of full rank with entries that nothing relates.
fn sample() -> (SMatrix<Bounded<f64>, 5, 5>, SMatrix<Bounded<f64>, 3, 5>) {
    let number = |i: usize, k: usize| (1.7 * (3 * i * i + 5 * k * k + i * k) as f64).sin();
    let b: SMatrix<f64, 5, 5> = SMatrix::from_fn(number);
    let jacobian: SMatrix<f64, 3, 5> = SMatrix::from_fn(|i, k| number(i + 7, k));
    let matrix = b * b.transpose() + SMatrix::identity();
    (matrix.map(Bounded::exact), jacobian.map(Bounded::exact))
}

fn identity_up_to_bounds<const N: usize>(m: &SMatrix<Bounded<f64>, N, N>) {
    for i in 0..N {
        for k in 0..N {
            let expected = if i == k { 1.0 } else { 0.0 };
            let entry = m[(i, k)];
            assert!((entry.value - expected).abs() <= entry.bound && entry.bound < 1e-11, "({i}, {k}): {entry:?}");
        }
    }
}

fn product<const R: usize, const S: usize, const C: usize>(
    a: &SMatrix<Bounded<f64>, R, S>,
    b: &SMatrix<Bounded<f64>, S, C>,
) -> SMatrix<Bounded<f64>, R, C> {
    SMatrix::from_fn(|i, k| (0..S).fold(Bounded::zero(), |sum, j| sum + a[(i, j)] * b[(j, k)]))
}

#[test]
fn it_is_what_its_definition_says() {
    let (matrix, jacobian) = sample();
    let space = OperationalSpace::new(&matrix, &jacobian).unwrap();
    let factor = Factor::of(&matrix).unwrap();
    identity_up_to_bounds(&product(
        &matrix,
        &factor.solve(&SMatrix::<_, 5, 5>::from_fn(|i, k| if i == k { Bounded::one() } else { Bounded::zero() })),
    ));
    // Λ (J A⁻¹ Jᵀ) = 1 and J J̄ = 1.
    let transposed = SMatrix::from_fn(|i, k| jacobian[(k, i)]);
    let mobility = product(&jacobian, &factor.solve(&transposed));
    identity_up_to_bounds(&product(&space.inertia, &mobility));
    identity_up_to_bounds(&product(&jacobian, &space.inverse));
}
