//! RODAS: a linearly implicit method of order 4(3) for stiff scenes, with exact Jacobians.
//!
//! Explicit methods need steps as short as the fastest decay of the scene, long after it has died out. A Rosenbrock
//! method solves a linear system in each stage instead, with the Jacobian that the derive writes
//! ([`LinearizedSystem`]), and no iteration: it is L-stable, so steps can be as long as what one looks at allows.
//!
//! The method works in the chart about the start of the step (`step/start.rs`), which is a linear space: it keeps its
//! order there.
//!
//! Coefficients: E. Hairer & G. Wanner, *Solving Ordinary Differential Equations II*, IV.7 and IV.10, code RODAS; a
//! test verifies the order conditions.

use crate::configuration::VectorSpace;
use crate::integrate::problem::equations::Problem;
use crate::integrate::problem::error::IntegrationErrorKind;
use crate::integrate::problem::state::{Rates, State};
use crate::integrate::step::one_step::{EstimatingStep, OneStep, Properties, Step, check_contacts};
use crate::integrate::step::start::{Model, Start, Vector, positive_length};
use crate::linearize::{Factored, LinearModel, LinearizedSystem};
use crate::real::Real;

const STAGES: usize = 6;

/// γ of the matrix `1/(hγ) − J`.
const GAMMA: f64 = 0.25;

/// Stages at `y₀ + Σ a_ij u_j`. The last row makes the embedded solution of order 3, and that with u₆ added is the
/// step: the method is stiffly accurate.
const A: [[f64; STAGES]; STAGES] = [
    [0.0; STAGES],
    [1.544, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.946_678_528_081_582_6, 0.255_701_169_898_328_4, 0.0, 0.0, 0.0, 0.0],
    [3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7, 0.0, 0.0, 0.0],
    [1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895, 0.0, 0.0],
    [1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895, 1.0, 0.0],
];

/// Right-hand sides have `Σ c_ij u_j / h` added.
const C: [[f64; STAGES]; STAGES] = [
    [0.0; STAGES],
    [-5.6688, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-2.430_093_356_833_875, -0.206_359_915_709_191_5, 0.0, 0.0, 0.0, 0.0],
    [-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16, 0.0, 0.0, 0.0],
    [7.496_443_313_967_647, -10.246_804_314_643_52, -33.999_903_528_199_05, 11.708_908_932_061_6, 0.0, 0.0],
    [
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
        0.0,
    ],
];

/// Times of the stages, Σ_j α_ij.
const TIMES: [f64; STAGES] = [0.0, 0.386, 0.21, 0.63, 1.0, 1.0];

/// Right-hand sides have `γ_i h ∂f/∂t` added, γ_i = Σ_j γ_ij.
const TIME_SLOPES: [f64; STAGES] = [0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0];

/// RODAS of Hairer and Wanner on the group: six stages, order 4 with an estimate of order 3, L-stable, stiffly
/// accurate.
///
/// For kernels with `#[gauss(linearize)]`. A step costs a linearisation, a factorisation of the size of the state
/// (twice the degrees of freedom) and five more evaluations. It keeps no integral, and damps motions faster than the
/// step: not for conservative scenes.
///
/// Both forms of the equations are integrated in z: the derivatives are those of ż. Derivatives of the equations by
/// time are exact. Those of an input that depends on time or state are differences: by time over points within the
/// step, of order h⁴, as the method; by the state central ones, whose relative error of about 1e-10 limits the order at
/// that size of errors.
///
#[cfg_attr(
    feature = "derive",
    doc = r##"
```
use gauss_runtime::integrate::Fixed;
use gauss_runtime::prelude::*;

/// A plate on a film of oil that brakes it within a millisecond, pulled by a soft spring.
#[derive(GaussDynamics)]
#[gauss(
    linearize,
    coordinates(x),
    particle(mass = m, position = [x, 0, 0]),
    spring(along = x, stiffness = k, damping = c),
)]
struct Plate {
    m: f64,
    k: f64,
    c: f64,
}

# fn main() -> Result<(), Box<dyn std::error::Error>> {
let kernel = Plate { m: 1.0, k: 100.0, c: 1000.0 }.kernel()?;
let (x, v) = (SVector::from([1.0]), SVector::from([0.0]));
// ẍ + 1000 ẋ + 100 x = 0 creeps with e^(−t/10): steps a thousand times longer than the film's time.
let end = Simulation::new(&kernel).control(Fixed::by(Rosenbrock, 1.0)).run_to_end(x, v, 0.0..10.0)?;
let slow = -500.0 + (500.0_f64 * 500.0 - 100.0).sqrt();
assert!((end.q[0] / (slow * 10.0).exp() - 1.0).abs() < 1e-3);
# Ok(())
# }
```
"##
)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rosenbrock;

impl<S: LinearizedSystem> OneStep<S> for Rosenbrock {
    fn properties(&self) -> Properties {
        Properties { stiff: true, ..Properties::of_order(4) }
    }

    /// Refuses stages that turn by more than π ([`IntegrationErrorKind::IncrementTooLarge`]), singularities of the
    /// coordinates ([`IntegrationErrorKind::SingularChart`]), and overflowing or undefined results, as with a singular
    /// matrix ([`IntegrationErrorKind::NonFinite`]).
    fn step<P: Problem<System = S>>(
        &self,
        problem: &P,
        state: &State<S>,
        rates: &Rates<S>,
        h: S::Scalar,
    ) -> Result<Step<S>, IntegrationErrorKind> {
        check_contacts(problem)?;
        let number = S::Scalar::from_f64;
        let one = S::Scalar::one();
        let start = Start::of(problem, state);
        let (linear, input) = start.linearize(problem, rates);
        let length = positive_length(h);
        let diagonal = one / (length * number(GAMMA));
        let factors = Model::<S>::factor(|row, column| {
            let slope = linear.by_state(row, column);
            if row == column { diagonal - slope } else { -slope }
        });
        let by_time = start.by_time(problem, &linear, &input, h);
        let reciprocal = one / length;

        let mut stages = [Vector::<S>::zero(); STAGES];
        let mut increment = Vector::<S>::zero();
        for i in 0..STAGES {
            let mut right = if i == 0 {
                *linear.rate()
            } else {
                increment = Vector::<S>::zero();
                for j in 0..i {
                    increment = increment.add_scaled(number(A[i][j]), &stages[j]);
                }
                let reached = start.moved(&increment)?;
                start.rates(problem, &increment, &reached, number(TIMES[i]).fma(h, start.t))
            };
            for j in 0..i {
                right = right.add_scaled(number(C[i][j]) * reciprocal, &stages[j]);
            }
            right = right.add_scaled(number(TIME_SLOPES[i]) * h, &by_time);
            stages[i] = factors.solve(&right);
        }
        let last = &stages[STAGES - 1];
        start.step(problem, state, h, (&increment.add_scaled(one, last), last))
    }
}

/// The estimate is the difference to the solution of order 3.
impl<S: LinearizedSystem> EstimatingStep<S> for Rosenbrock {
    fn estimate_order(&self) -> f64 {
        4.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; STAGES]; STAGES];

    /// α, γ and the weights of both solutions in the form in which conditions are stated: `u = Γ k`, `a = α Γ⁻¹`,
    /// `c = 1/γ − Γ⁻¹`, `m = b Γ⁻¹`.
    struct Classical {
        alpha: Matrix,
        gamma: Matrix,
        weights: [f64; STAGES],
        embedded: [f64; STAGES],
    }

    fn product(a: &Matrix, b: &Matrix) -> Matrix {
        core::array::from_fn(|i| core::array::from_fn(|j| (0..STAGES).map(|k| a[i][k] * b[k][j]).sum()))
    }

    fn row_times(v: &[f64; STAGES], m: &Matrix) -> [f64; STAGES] {
        core::array::from_fn(|j| (0..STAGES).map(|k| v[k] * m[k][j]).sum())
    }

    fn dot(a: &[f64; STAGES], b: &[f64; STAGES]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn sums(m: &Matrix) -> [f64; STAGES] {
        m.map(|row| row.iter().sum())
    }

    fn classical() -> Classical {
        // Γ by forward substitution: Γ⁻¹ is lower triangular with 1/γ on its diagonal.
        let mut gamma = [[0.0; STAGES]; STAGES];
        for column in 0..STAGES {
            for i in 0..STAGES {
                let unit = if i == column { 1.0 } else { 0.0 };
                let known: f64 = (0..i).map(|k| -C[i][k] * gamma[k][column]).sum();
                gamma[i][column] = (unit - known) * GAMMA;
            }
        }
        let mut last = A[STAGES - 1];
        let embedded = row_times(&last, &gamma);
        last[STAGES - 1] = 1.0;
        Classical { alpha: product(&A, &gamma), gamma, weights: row_times(&last, &gamma), embedded }
    }

    /// Hairer & Wanner, IV.7, table 7.1, with β = α + γ, the diagonal included: up to order 3, then order 4.
    fn conditions(m: &Classical, b: &[f64; STAGES]) -> ([f64; 4], [f64; 4]) {
        let beta: Matrix = core::array::from_fn(|i| core::array::from_fn(|j| m.alpha[i][j] + m.gamma[i][j]));
        let (alpha_i, beta_i) = (sums(&m.alpha), sums(&beta));
        let square = alpha_i.map(|x| x * x);
        let through = row_times(b, &beta);
        let weighted: [f64; STAGES] = core::array::from_fn(|i| b[i] * alpha_i[i]);
        (
            [
                b.iter().sum::<f64>() - 1.0,
                dot(b, &beta_i) - 0.5,
                dot(b, &square) - 1.0 / 3.0,
                dot(&through, &beta_i) - 1.0 / 6.0,
            ],
            [
                dot(&weighted, &square) - 0.25,
                dot(&row_times(&weighted, &m.alpha), &beta_i) - 0.125,
                dot(&through, &square) - 1.0 / 12.0,
                dot(&row_times(&through, &beta), &beta_i) - 1.0 / 24.0,
            ],
        )
    }

    /// Sums of at most 6³ products of numbers up to 100 that cancel to less than 1.
    const ROUNDING: f64 = 216.0 * 100.0 * f64::EPSILON;

    #[test]
    fn order_conditions() {
        let method = classical();
        let (third, fourth) = conditions(&method, &method.weights);
        assert!(third.iter().chain(&fourth).all(|x| x.abs() < ROUNDING), "{third:?} {fourth:?}");
        let (third, fourth) = conditions(&method, &method.embedded);
        assert!(third.iter().all(|x| x.abs() < ROUNDING), "{third:?}");
        assert!(fourth.iter().any(|x| x.abs() > 1e-3), "{fourth:?}");
        for (stated, sum) in TIMES.iter().zip(sums(&method.alpha)).chain(TIME_SLOPES.iter().zip(sums(&method.gamma))) {
            assert!((stated - sum).abs() < ROUNDING, "{stated} {sum}");
        }
    }

    /// The last stage is the solution with its own rates, so that R(∞) = 0: rows α + γ of the last two stages are the
    /// weights.
    #[test]
    fn stiffly_accurate() {
        let method = classical();
        for (row, weights) in [(STAGES - 2, &method.embedded), (STAGES - 1, &method.weights)] {
            for j in 0..STAGES {
                let beta = method.alpha[row][j] + method.gamma[row][j];
                assert!((beta - weights[j]).abs() < ROUNDING, "{row} {j}: {beta} {}", weights[j]);
            }
        }
    }
}
