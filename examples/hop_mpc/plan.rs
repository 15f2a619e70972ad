//! Plans of one input, improved by the method of Gauss and Newton.

use gauss_runtime::nalgebra::{SMatrix, SVector};

pub type State = SVector<f64, 4>;
type Square = SMatrix<f64, 4, 4>;

/// What is planned for.
pub trait Plant {
    /// The state after a step.
    fn step(&self, x: &State, input: f64) -> Option<State>;
    /// Its derivatives by state and input.
    fn linear(&self, x: &State, input: f64) -> Option<(Square, State)>;
}

/// Where the state should be at the start and after each input.
pub struct Horizon {
    pub wanted: Vec<State>,
}

const EFFORT: f64 = 2e-6;

fn weights() -> State {
    State::new(100.0, 30.0, 1.0, 0.03)
}

impl Horizon {
    fn cost(&self, states: &[State], inputs: &[f64]) -> f64 {
        let off = |(x, wanted): (&State, &State)| (x - wanted).component_mul(&weights()).dot(&(x - wanted));
        let of_states: f64 = states.iter().zip(&self.wanted).map(off).sum();
        0.5 * (of_states + inputs.iter().map(|u| EFFORT * u * u).sum::<f64>())
    }

    /// States, inputs and cost with a part of a change.
    fn forward<P: Plant>(
        &self,
        plant: &P,
        (states, inputs): (&[State], &[f64]),
        change: &[(f64, State)],
        part: f64,
    ) -> Option<(Vec<State>, Vec<f64>, f64)> {
        let (mut made, mut used) = (vec![states[0]], Vec::new());
        for (k, (ahead, gain)) in change.iter().enumerate() {
            let x = made[k];
            let input = inputs[k] + part * ahead + gain.dot(&(x - states[k]));
            used.push(input);
            made.push(plant.step(&x, input)?);
        }
        let cost = self.cost(&made, &used);
        Some((made, used, cost))
    }

    /// Better inputs, after some iterations; `None` where the given ones leave all bounds.
    pub fn improve<P: Plant>(&self, plant: &P, start: &State, inputs: Vec<f64>, iterations: usize) -> Option<Vec<f64>> {
        let none = vec![(0.0, State::zeros()); inputs.len()];
        let at = vec![*start; inputs.len() + 1];
        let (mut states, mut inputs, mut cost) = self.forward(plant, (&at, &inputs), &none, 0.0)?;
        for _ in 0..iterations {
            let change = self.backward(plant, &states, &inputs)?;
            let parts = (0..8).map(|n| 0.5_f64.powi(n));
            let better = parts
                .filter_map(|part| self.forward(plant, (&states, &inputs), &change, part))
                .find(|(.., next)| *next < cost);
            let Some(better) = better else { break };
            (states, inputs, cost) = better;
        }
        Some(inputs)
    }

    /// From the end to the start: changes of inputs, and gains.
    fn backward<P: Plant>(&self, plant: &P, states: &[State], inputs: &[f64]) -> Option<Vec<(f64, State)>> {
        let end = inputs.len();
        let weighed = Square::from_diagonal(&weights());
        let mut slope = weighed * (states[end] - self.wanted[end]);
        let mut value = weighed;
        let mut changes = Vec::new();
        for k in (0..end).rev() {
            let (a, b) = plant.linear(&states[k], inputs[k])?;
            let by_state = weighed * (states[k] - self.wanted[k]) + a.tr_mul(&slope);
            let by_input = EFFORT * inputs[k] + b.dot(&slope);
            let bowl = EFFORT + b.dot(&(value * b));
            let mixed = a.tr_mul(&(value * b));
            let (ahead, gain) = (-by_input / bowl, -mixed / bowl);
            slope = by_state + mixed * ahead;
            value = weighed + a.tr_mul(&(value * a)) + mixed * gain.transpose();
            value = (value + value.transpose()) * 0.5;
            changes.push((ahead, gain));
        }
        changes.reverse();
        Some(changes)
    }
}
