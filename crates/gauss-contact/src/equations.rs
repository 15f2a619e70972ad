//! The equations of contacts that leave, stay closed, stick or slide: which forces keep which rates at zero.

use alloc::vec;
use alloc::vec::Vec;

use gauss_runtime::real::Real;

use crate::dense::{Decomposition, Matrix, sum};
use crate::solution::State;
use crate::solver::Contacts;

/// The equations of contacts in given states: these rates are zero.
pub(crate) struct Equations<T> {
    pub(crate) rows: Vec<usize>,
    /// Forces by a unit of the unknown of a row, in this row and in those of friction.
    pub(crate) with: Vec<Vec<(usize, T)>>,
    /// Forces that are known.
    forces: Vec<T>,
    pub(crate) factors: Decomposition<T>,
}

impl<T: Real> Contacts<T> {
    /// Closed contacts keep their normal rates at zero, and those that stick all of them.
    pub(crate) fn equations(&self, states: &[State<T>]) -> Equations<T> {
        let mut rows = Vec::new();
        let mut forces = vec![T::zero(); self.b.len()];
        let mut with: Vec<Vec<(usize, T)>> = Vec::new();
        for (i, state) in states.iter().enumerate() {
            let direction = match state {
                State::Leaves => continue,
                State::Slides(direction) => Some(*direction),
                State::Closed => self.laws[i].slip,
                State::Sticks => None,
            };
            let friction = self.laws[i].friction;
            let along =
                direction.into_iter().flat_map(|d| self.tangents(i).zip(d)).map(|(row, d)| (row, -friction * d));
            match self.normal(i) {
                Some(normal) => {
                    rows.push(normal);
                    with.push(core::iter::once((normal, T::one())).chain(along).collect());
                }
                None => match self.presses(i) {
                    // Where that contact leaves there is no unknown, and no friction.
                    Some(normal) => {
                        if let Some(pressing) = rows.iter().position(|row| *row == normal) {
                            with[pressing].extend(along);
                        }
                    }
                    None => along.for_each(|(row, force)| forces[row] = force),
                },
            }
            if matches!(state, State::Sticks) {
                self.tangents(i).for_each(|row| {
                    rows.push(row);
                    with.push(vec![(row, T::one())]);
                });
            }
        }
        let entry = |i: usize, j: usize| sum(with[j].iter().map(|(row, part)| *part * self.matrix.at(rows[i], *row)));
        let matrix = Matrix::from_fn(rows.len(), entry);
        let factors = Decomposition::new(&matrix, |i| self.matrix.at(rows[i], rows[i]));
        Equations { rows, with, forces, factors }
    }

    /// Forces that solve equations: of several those of least norm.
    pub(crate) fn forces_in(&self, states: &[State<T>]) -> Vec<T> {
        let equations = self.equations(states);
        let mut forces = equations.forces.clone();
        // Once more for what the first solution leaves.
        (0..2).for_each(|_| self.correct(&equations, &mut forces));
        forces
    }

    /// Takes away what forces leave of the rates that are to be zero.
    pub(crate) fn correct(&self, equations: &Equations<T>, forces: &mut [T]) {
        let left: Vec<T> = equations.rows.iter().map(|&row| -self.rate(row, forces)).collect();
        for (unknown, with) in equations.factors.solve(&left).into_iter().zip(&equations.with) {
            with.iter().for_each(|(row, part)| forces[*row] += *part * unknown);
        }
    }
}
