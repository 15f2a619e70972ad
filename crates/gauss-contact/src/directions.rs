//! Directions of slips that begin: those in which friction makes them slip.

use alloc::vec::Vec;

use gauss_runtime::dual::Dual;
use gauss_runtime::real::Real;

use crate::dense::{Decomposition, Matrix, size, sum, value};
use crate::frame::Frame;
use crate::solution::State;
use crate::solver::Contacts;

/// Derivatives along so many turns at once: two rows of four contacts.
const TURNS: usize = 4;

impl<T: Real> Contacts<T> {
    /// Given states with their forces. Directions of two rows or three are those of the slip.
    pub(crate) fn settled(&self, mut states: Vec<State<T>>) -> (Vec<State<T>>, Vec<T>) {
        // The contacts whose directions turn, with the numbers of the planes in which they do.
        let free = |(i, state): (usize, &State<T>)| {
            let planes = if matches!(state, State::Slides(_)) { self.laws[i].tangents.saturating_sub(1) } else { 0 };
            (0..planes).map(move |plane| (i, plane))
        };
        let turning: Vec<(usize, usize)> = states.iter().enumerate().flat_map(free).collect();
        let mut forces = self.forces_in(&states);
        if turning.is_empty() {
            return (states, forces);
        }
        let in_duals = self.in_numbers(|x| Dual::constant(value(x)));
        // Each step leaves of derivatives what values are off by.
        let turns = if T::DERIVATIVES { 3 } else { 0 };
        for n in 0..60 {
            let frames: Vec<Frame<T>> = states.iter().map(|state| Frame::of(direction(state))).collect();
            let miss = self.misses(&turning, &frames, &forces);
            let before = size(&miss);
            let jacobian = in_duals.derivatives_of_misses(&turning, &states);
            let jacobian = Matrix::from_fn(turning.len(), |i, j| T::from_f64(jacobian[j][i]));
            let by = Decomposition::new(&jacobian, |i| jacobian.at(i, i).abs()).solve(&miss);
            let longest = by.iter().fold(0.0_f64, |longest, by| longest.max(value(*by).abs()));
            let part = if longest > 0.5 { 0.5 / longest } else { 1.0 };
            let mut next = frames.clone();
            turning.iter().zip(&by).for_each(|(&(i, plane), by)| next[i].turn(plane, T::from_f64(-part) * *by));
            let turned = along(&states, &next);
            let found = self.forces_in(&turned);
            let ended = part == 1.0 && longest < 1e-5 && size(&self.misses(&turning, &next, &found)) >= before;
            if ended && n >= turns {
                break;
            }
            (states, forces) = (turned, found);
        }
        (states, forces)
    }

    /// The sines of the angles from the directions of contacts to their slip in the planes of turns, times its size.
    fn misses(&self, turning: &[(usize, usize)], frames: &[Frame<T>], forces: &[T]) -> Vec<T> {
        let miss = |&(i, plane): &(usize, usize)| {
            let each = self.tangents(i).zip(frames[i].across[plane]);
            -sum(each.map(|(row, across)| across * self.rate(row, forces)))
        };
        turning.iter().map(miss).collect()
    }
}

impl Contacts<Dual<TURNS>> {
    /// Derivatives of all misses along each turn. Differences would know them to the root of rounding: beside gravity
    /// a slip that begins more slowly than that would have no direction.
    fn derivatives_of_misses<T: Real>(&self, turning: &[(usize, usize)], states: &[State<T>]) -> Vec<Vec<f64>> {
        let constant = |x: T| Dual::constant(value(x));
        let states: Vec<State<Dual<TURNS>>> = states.iter().map(|state| state.in_numbers(constant)).collect();
        let mut derivatives = Vec::with_capacity(turning.len());
        for some in turning.chunks(TURNS) {
            let mut frames: Vec<_> = states.iter().map(|state| Frame::of(direction(state))).collect();
            some.iter().enumerate().for_each(|(k, &(i, plane))| frames[i].turn(plane, Dual::variable(0.0, k)));
            let misses = self.misses(turning, &frames, &self.forces_in(&along(&states, &frames)));
            derivatives.extend((0..some.len()).map(|k| misses.iter().map(|miss| miss.slopes[k]).collect()));
        }
        derivatives
    }
}

fn direction<T: Real>(state: &State<T>) -> [T; 3] {
    if let State::Slides(along) = state { *along } else { [T::zero(); 3] }
}

/// States with the directions of frames.
fn along<T: Real>(states: &[State<T>], frames: &[Frame<T>]) -> Vec<State<T>> {
    let of = |(state, frame): (&State<T>, &Frame<T>)| match state {
        State::Slides(_) => State::Slides(frame.along),
        state => *state,
    };
    states.iter().zip(frames).map(of).collect()
}
