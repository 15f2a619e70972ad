//! Differential dynamic programming: Tassa, Erez, Todorov, *Synthesis and stabilization of complex behaviors through
//! online trajectory optimization*, IROS 2012. With derivatives of first order (iLQR, the method of Gauss and Newton),
//! or with the second ones of the steps where the plant has them, as Jacobson and Mayne had it in 1970.

use std::time::{Duration, Instant};

use gauss_runtime::hessian::Hessian;
use gauss_runtime::nalgebra::{SMatrix, SVector};

/// N numbers.
pub type Vector<const N: usize> = SVector<f64, N>;
/// N rows of M numbers.
pub type Matrix<const N: usize, const M: usize> = SMatrix<f64, N, M>;

/// A step from a state with an input that is held, and its derivatives. Where no step can be made all is not a number.
pub trait Plant<const D: usize, const U: usize> {
    /// What second derivatives are made of.
    type Stages;
    /// Whether it has some.
    const IS_CURVED: bool = false;
    /// Where it ends.
    fn step(&self, x: &Vector<D>, u: &Vector<U>) -> Vector<D>;
    /// ∂(end)/∂x and ∂(end)/∂u.
    fn expansion(&self, x: &Vector<D>, u: &Vector<U>) -> Expansion<Self::Stages, D, U>;
    /// ∂²(weights · end), where that is known; else zero.
    fn curvature(&self, _: &Self::Stages, _: &Vector<U>, _: &Vector<D>) -> Hessian<f64, D, U> {
        flat()
    }
}

/// No curvature.
#[must_use]
pub fn flat<const D: usize, const U: usize>() -> Hessian<f64, D, U> {
    Hessian::new(Matrix::zeros(), Matrix::zeros(), Matrix::zeros())
}

/// The derivatives of a step.
#[derive(Clone, Debug)]
pub struct Expansion<S, const D: usize, const U: usize> {
    /// ∂(end)/∂x.
    pub by_state: Matrix<D, D>,
    /// ∂(end)/∂u.
    pub by_input: Matrix<D, U>,
    /// What second derivatives are made of.
    pub stages: S,
}

/// ½ Σ (uᵀ R u + (x − goal)ᵀ Q (x − goal)) and, at the end, ½ (x − goal)ᵀ F (x − goal); all three diagonal.
#[derive(Clone, Debug)]
pub struct Task<const D: usize, const U: usize> {
    /// The state at the start.
    pub start: Vector<D>,
    /// The state that is wanted.
    pub goal: Vector<D>,
    /// The diagonal of R.
    pub effort: Vector<U>,
    /// The diagonal of Q.
    pub on_the_way: Vector<D>,
    /// The diagonal of F.
    pub at_the_end: Vector<D>,
    /// How many inputs there are.
    pub steps: usize,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Plan<const D: usize, const U: usize> {
    /// Before the first step and after each.
    pub states: Vec<Vector<D>>,
    /// Of each step.
    pub inputs: Vec<Vector<U>>,
    /// After each iteration, the first before any.
    pub costs: Vec<f64>,
    /// Gains of the regulator that comes with it: u = uₖ + Kₖ (x − xₖ).
    pub gains: Vec<Matrix<U, D>>,
    /// What derivatives took of the time.
    pub in_derivatives: Duration,
}

/// The change of inputs that the model of second order asks for.
struct Change<const D: usize, const U: usize> {
    ahead: Vec<Vector<U>>,
    gains: Vec<Matrix<U, D>>,
    /// What it would lower the cost by: α first + α² second.
    first: f64,
    second: f64,
}

impl<const D: usize, const U: usize> Task<D, U> {
    /// What a way costs, by its states and inputs.
    #[must_use]
    pub fn cost(&self, states: &[Vector<D>], inputs: &[Vector<U>]) -> f64 {
        let weighed = |x: &Vector<D>, weight: &Vector<D>| {
            let off = x - self.goal;
            0.5 * off.component_mul(weight).dot(&off)
        };
        let ways = states.iter().map(|x| weighed(x, &self.on_the_way));
        let efforts = inputs.iter().map(|u| 0.5 * u.component_mul(&self.effort).dot(u));
        ways.take(self.steps).sum::<f64>() + efforts.sum::<f64>() + weighed(&states[self.steps], &self.at_the_end)
    }

    /// ∂cost/∂inputs along a way, by its states and inputs: from the end to the start.
    pub fn slopes<P: Plant<D, U>>(&self, plant: &P, states: &[Vector<D>], inputs: &[Vector<U>]) -> Vec<Vector<U>> {
        let mut slope = (states[self.steps] - self.goal).component_mul(&self.at_the_end);
        let mut slopes = Vec::new();
        for (x, u) in states.iter().zip(inputs).rev() {
            let step = plant.expansion(x, u);
            slopes.push(u.component_mul(&self.effort) + step.by_input.tr_mul(&slope));
            slope = (x - self.goal).component_mul(&self.on_the_way) + step.by_state.tr_mul(&slope);
        }
        slopes.reverse();
        slopes
    }

    /// States along a way, by its inputs.
    pub fn way<P: Plant<D, U>>(&self, plant: &P, inputs: &[Vector<U>]) -> Vec<Vector<D>> {
        let mut states = vec![self.start];
        inputs.iter().for_each(|u| states.push(plant.step(&states[states.len() - 1], u)));
        states
    }

    /// The best inputs from a first guess; `None` where the guess leaves all bounds.
    pub fn solve<P: Plant<D, U>>(&self, plant: &P, guess: &[Vector<U>]) -> Option<Plan<D, U>> {
        let (mut states, mut inputs) = (self.way(plant, guess), guess.to_vec());
        let mut costs = vec![self.cost(&states, &inputs)];
        let (mut damping, mut gains, mut in_derivatives) = (1e-6, Vec::new(), Duration::ZERO);
        costs[0].is_finite().then_some(())?;
        while costs.len() < 500 {
            let start = Instant::now();
            let expansions: Vec<_> = states.iter().zip(&inputs).map(|(x, u)| plant.expansion(x, u)).collect();
            in_derivatives += start.elapsed();
            let last = costs[costs.len() - 1];
            let found = loop {
                let mut attempt = |curved: bool| {
                    let along = (states.as_slice(), inputs.as_slice());
                    let change = self.backward(plant, along, &expansions, (curved, damping), &mut in_derivatives)?;
                    let small = change.first.abs() <= 1e-10 * last;
                    let (states, inputs, cost) = self.forward(plant, &states, &inputs, &change, last)?;
                    Some((states, inputs, cost, change.gains, small))
                };
                // Where the bowl is none with the curvature of steps, it is one without.
                match attempt(true).or_else(|| P::IS_CURVED.then(|| attempt(false)).flatten()) {
                    Some(better) => break Some(better),
                    None if damping > 1e10 => break None,
                    None => damping *= 10.0,
                }
            };
            let Some((x, u, cost, k, small)) = found else { break };
            (states, inputs, gains) = (x, u, k);
            costs.push(cost);
            damping = (damping / 5.0).max(1e-9);
            if small {
                break;
            }
        }
        Some(Plan { states, inputs, costs, gains, in_derivatives })
    }

    /// From the end to the start: the value of each state to second order; `None` where an input has no best value.
    fn backward<P: Plant<D, U>>(
        &self,
        plant: &P,
        (states, inputs): (&[Vector<D>], &[Vector<U>]),
        expansions: &[Expansion<P::Stages, D, U>],
        (curved, damping): (bool, f64),
        in_derivatives: &mut Duration,
    ) -> Option<Change<D, U>> {
        let mut slope = (states[self.steps] - self.goal).component_mul(&self.at_the_end);
        let mut value = Matrix::from_diagonal(&self.at_the_end);
        let (mut ahead, mut gains, mut first, mut second) = (Vec::new(), Vec::new(), 0.0, 0.0);
        for k in (0..self.steps).rev() {
            let Expansion { by_state: a, by_input: b, stages } = &expansions[k];
            // The value of where a step ends, along which the step is curved.
            let start = Instant::now();
            let curved = if curved { plant.curvature(stages, &inputs[k], &slope) } else { flat() };
            *in_derivatives += start.elapsed();
            let by_state = (states[k] - self.goal).component_mul(&self.on_the_way) + a.tr_mul(&slope);
            let by_input = inputs[k].component_mul(&self.effort) + b.tr_mul(&slope);
            let (av, bv) = (a.tr_mul(&value), b.tr_mul(&value));
            let damped = bv + b.transpose() * damping;
            let of_inputs = Matrix::from_diagonal(&self.effort) + curved.by_input;
            let bowl = (damped * b + of_inputs).cholesky()?;
            let (change, gain) = (-bowl.solve(&by_input), -bowl.solve(&(damped * a + curved.by_input_and_state)));
            let plain = bv * b + of_inputs;
            let mixed = bv * a + curved.by_input_and_state;
            first += change.dot(&by_input);
            second += 0.5 * change.dot(&(plain * change));
            slope = by_state + gain.tr_mul(&(plain * change)) + gain.tr_mul(&by_input) + mixed.tr_mul(&change);
            value = Matrix::from_diagonal(&self.on_the_way)
                + curved.by_state
                + av * a
                + gain.tr_mul(&(plain * gain))
                + gain.tr_mul(&mixed)
                + mixed.tr_mul(&gain);
            value = (value + value.transpose()) * 0.5;
            ahead.push(change);
            gains.push(gain);
        }
        ahead.reverse();
        gains.reverse();
        Some(Change { ahead, gains, first, second })
    }

    /// From the start to the end with a part of the change; `None` where no part makes the cost as much lower as it
    /// should.
    fn forward(
        &self,
        plant: &impl Plant<D, U>,
        states: &[Vector<D>],
        inputs: &[Vector<U>],
        change: &Change<D, U>,
        last: f64,
    ) -> Option<(Vec<Vector<D>>, Vec<Vector<U>>, f64)> {
        (0..12).find_map(|halvings| {
            let part = 0.5_f64.powi(halvings);
            let (mut new, mut chosen) = (vec![self.start], Vec::new());
            for k in 0..self.steps {
                let x = new[k];
                let u = inputs[k] + change.ahead[k] * part + change.gains[k] * (x - states[k]);
                new.push(plant.step(&x, &u));
                chosen.push(u);
            }
            let cost = self.cost(&new, &chosen);
            let promised = -part * (change.first + part * change.second);
            // What rounding leaves of a difference of costs is no reason to go on.
            (cost <= last - 1e-4 * promised + 1e-13 * last).then_some((new, chosen, cost))
        })
    }
}
