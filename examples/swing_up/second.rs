//! Steps with their second derivatives, of `linearize` and `hessian` at their stages.

use gauss_examples::ddp::{Expansion, Matrix, Plant, Vector, flat};
use gauss_runtime::hessian::Hessian;

use crate::model::{Exact, Scalar, parts};

/// The same steps as of [`Exact`]: on a linear space the method is the classical one of order 4.
pub struct Second<'k, K, const N: usize>(pub Exact<'k, K, N>);

/// Share of a step by which a stage is ahead of the start, along the rates of the stage before, and weight of its own
/// rates.
const AHEAD: [f64; 4] = [0.0, 0.5, 0.5, 1.0];
const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Where a stage is, how it moves with x and u, and how its rates change with its place.
pub struct Stage<const D: usize, const U: usize> {
    at: Vector<D>,
    by_state: Matrix<D, D>,
    by_input: Matrix<D, U>,
    slope: Matrix<D, D>,
}

impl<K: Scalar<N, D, U>, const N: usize, const D: usize, const U: usize> Plant<D, U> for Second<'_, K, N> {
    type Stages = Vec<Stage<D, U>>;
    const IS_CURVED: bool = true;

    fn step(&self, x: &Vector<D>, u: &Vector<U>) -> Vector<D> {
        self.0.step(x, u)
    }

    fn expansion(&self, x: &Vector<D>, u: &Vector<U>) -> Expansion<Self::Stages, D, U> {
        let Exact { kernel, h } = self.0;
        let mut end = Expansion { by_state: Matrix::identity(), by_input: Matrix::zeros(), stages: Vec::new() };
        let (mut rate, mut by_state, mut by_input) = (Vector::zeros(), Matrix::zeros(), Matrix::zeros());
        for (ahead, weight) in AHEAD.into_iter().zip(WEIGHTS) {
            let at = x + rate * (h * ahead);
            let (q, z) = parts::<N, D>(&at);
            let linear = kernel.linearize(0.0, &q, &z, u);
            let slope = linear.by_state;
            let moved = (Matrix::identity() + by_state * (h * ahead), by_input * (h * ahead));
            rate = linear.rate;
            by_state = slope * moved.0;
            by_input = slope * moved.1 + linear.by_input;
            end.by_state += by_state * (h * weight);
            end.by_input += by_input * (h * weight);
            end.stages.push(Stage { at, by_state: moved.0, by_input: moved.1, slope });
        }
        end
    }

    /// Rates of stages are weighed by what they do to the end, found from the last stage to the first.
    fn curvature(&self, stages: &Self::Stages, u: &Vector<U>, weights: &Vector<D>) -> Hessian<f64, D, U> {
        let Exact { kernel, h } = self.0;
        let mut sum = flat();
        let mut later = Vector::zeros();
        for (k, stage) in stages.iter().enumerate().rev() {
            let own = weights * (h * WEIGHTS[k]) + later;
            let (q, z) = parts::<N, D>(&stage.at);
            let of_rates = kernel.hessian(0.0, &q, &z, u, &own);
            let by_stage = of_rates.by_state * stage.by_state;
            let mixed = of_rates.by_input_and_state * stage.by_input;
            sum.by_state += stage.by_state.tr_mul(&by_stage);
            sum.by_input_and_state += of_rates.by_input_and_state * stage.by_state + stage.by_input.tr_mul(&by_stage);
            sum.by_input += of_rates.by_input
                + stage.by_input.tr_mul(&(of_rates.by_state * stage.by_input))
                + mixed
                + mixed.transpose();
            later = stage.slope.tr_mul(&own) * (h * AHEAD[k]);
        }
        sum
    }
}
