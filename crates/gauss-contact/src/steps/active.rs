//! The laws of a step on the contacts that act, as equations for their impulses, and the derivatives of their solution.
//!
//! With rates `u = D P + b` after the step: a closed gap has its rate, what sticks has none, and what slides has
//! `P_T = −μ P_N u_T/|u_T|`. Impulses that satisfy these in values are known; their derivatives follow from those of
//! D, b and μ by the theorem on implicit functions. Where contacts depend on one another, impulses change by the least
//! that will do, in the norm Σ D_ii P_i²: what steps that begin with the impulses before give.

use alloc::vec::Vec;

use gauss_runtime::contact::{Contact, ContactSystem};
use gauss_runtime::dual::Dual;
use gauss_runtime::real::Real;

use crate::dense::{Decomposition, Matrix, norm};
use crate::error::ContactErrorKind;
use crate::friction::Bounds;
use crate::mode::{Mode, presses, tangents};

/// Contacts depend on one another where this is left of a column: as of the solver.
pub(super) const DEPENDENT: f64 = 1e-11;
/// Part of the largest derivative that may be left of those of equations.
pub(super) const LEFT: f64 = 1e-6;

/// Derivatives, by a metre, a radian or their rates, that are none beside the rates themselves.
pub(super) const NOTHING: f64 = 1e-9;

/// One equation for the impulse of a row.
#[derive(Clone, Copy, Debug)]
enum Equation {
    /// A rate, without what an impact passes on, is zero.
    Rate,
    /// Friction of a contact, in its row number so and so, is against the slip.
    Slides { contact: usize, of: usize },
}

/// The contacts that act, with what their equations are made of.
pub(super) struct Active<'a, K: ContactSystem> {
    pub(super) contacts: &'static [Contact],
    pub(super) delassus: &'a K::Delassus,
    /// Rates without impulses, of normals without what an impact passes on.
    pub(super) b: Vec<K::Scalar>,
    pub(super) bounds: Vec<Bounds<K::Scalar>>,
    pub(super) h: f64,
}

/// The equations that hold, and how impulses follow from what they miss.
pub(super) struct Solvable {
    rows: Vec<usize>,
    equations: Vec<Equation>,
    /// The inverse of their derivatives by impulses; of dependent ones the generalised one.
    inverse: Matrix,
    derivatives: Matrix,
}

impl<const N: usize, K: ContactSystem<Scalar = Dual<N>>> Active<'_, K> {
    /// The rate of a row.
    pub(super) fn rate(&self, row: usize, impulses: &[Dual<N>]) -> Dual<N> {
        let acting = impulses.iter().enumerate().filter(|(_, impulse)| **impulse != Dual::constant(0.0));
        acting.fold(self.b[row], |sum, (j, impulse)| self.delassus[(row, j)].fma(*impulse, sum))
    }

    /// The sizes of the terms of a rate.
    pub(super) fn terms(&self, row: usize, impulses: &[Dual<N>]) -> f64 {
        let each =
            impulses.iter().enumerate().map(|(j, impulse)| (self.delassus[(row, j)].value * impulse.value).abs());
        each.fold(self.b[row].value.abs(), |sum, term| sum + term)
    }

    /// The slip of a contact.
    pub(super) fn slip(&self, contact: usize, impulses: &[Dual<N>]) -> [Dual<N>; 3] {
        let mut slip = [Dual::constant(0.0); 3];
        tangents(&self.contacts[contact]).zip(&mut slip).for_each(|(row, s)| *s = self.rate(row, impulses));
        slip
    }

    /// The impulse that friction is a multiple of: of the normal, or of dry friction the length of the step.
    pub(super) fn pressed(&self, contact: usize, impulses: &[Dual<N>]) -> Dual<N> {
        presses(self.contacts, &self.contacts[contact]).map_or(Dual::constant(self.h), |normal| impulses[normal])
    }

    /// The largest diagonal entry of friction.
    pub(super) fn scale(&self, contact: usize) -> f64 {
        tangents(&self.contacts[contact]).map(|row| self.delassus[(row, row)].value).fold(0.0, f64::max)
    }

    /// The equations of given modes.
    fn equations(&self, modes: &[Mode], impulses: &[Dual<N>]) -> (Vec<usize>, Vec<Equation>) {
        let (mut rows, mut equations) = (Vec::new(), Vec::new());
        for (i, (contact, mode)) in
            self.contacts.iter().zip(modes).enumerate().filter(|(_, (_, mode))| mode.is_closed())
        {
            if contact.has_gap() {
                rows.push(contact.normal);
                equations.push(Equation::Rate);
            }
            // Without friction it slides as well: μ = 0 may have a derivative.
            let slides = match mode {
                Mode::Sticks => Some(false),
                Mode::Slides(_) => Some(true),
                _ => (self.scale(i) > 0.0 && self.slip(i, impulses).iter().any(|s| s.value != 0.0)).then_some(true),
            };
            for (of, row) in tangents(contact).enumerate().filter(|_| slides.is_some()) {
                rows.push(row);
                let friction = Equation::Slides { contact: i, of };
                equations.push(if slides == Some(true) { friction } else { Equation::Rate });
            }
        }
        (rows, equations)
    }

    /// Residual of each equation, in rates.
    fn misses(&self, rows: &[usize], equations: &[Equation], impulses: &[Dual<N>]) -> Vec<Dual<N>> {
        let miss = |(row, equation): (&usize, &Equation)| match *equation {
            Equation::Rate => self.rate(*row, impulses),
            Equation::Slides { contact, of } => {
                let slip = self.slip(contact, impulses);
                let size = norm(&slip);
                let against = self.bounds[contact].against(slip.map(|s| s / size))[of];
                Dual::constant(self.scale(contact)) * (impulses[*row] - against * self.pressed(contact, impulses))
            }
        };
        rows.iter().zip(equations).map(miss).collect()
    }

    /// Amount by which an equation may miss because the direction of a slip is known no better than its rates are:
    /// slips of a corner that just begins to move are as small as these.
    fn unknown_direction(&self, equation: Equation, impulses: &[Dual<N>], rates: f64) -> f64 {
        let Equation::Slides { contact, .. } = equation else { return 0.0 };
        let size = norm(&self.slip(contact, impulses)).value;
        let friction = self.bounds[contact].values().largest * self.pressed(contact, impulses).value;
        (self.scale(contact) * friction * (rates / size).min(2.0)).abs()
    }

    /// The derivative of an equation by the impulse of a row, in values.
    fn entry(&self, (row, equation): (usize, Equation), column: usize, impulses: &[Dual<N>]) -> f64 {
        let d = |row: usize| self.delassus[(row, column)].value;
        let Equation::Slides { contact, of } = equation else { return d(row) };
        let bounds = self.bounds[contact].values();
        let weighted = |k: usize, x: f64| bounds.weights[k] * x;
        let slip = self.slip(contact, impulses).map(|s| s.value);
        let on_circle: [f64; 3] = core::array::from_fn(|k| weighted(k, slip[k]));
        let size = norm(&on_circle);
        let along = on_circle.map(|x| x / size);
        // Of the direction: what is across it, over the size of the slip.
        let changes = tangents(&self.contacts[contact]).enumerate().map(|(k, row)| {
            let across = f64::from(u8::from(k == of)) - along[of] * along[k];
            across * weighted(k, d(row)) / size
        });
        let turns: f64 = changes.sum();
        let friction = -weighted(of, bounds.largest);
        let pressed = self.pressed(contact, impulses).value;
        let by_normal =
            if presses(self.contacts, &self.contacts[contact]) == Some(column) { friction * along[of] } else { 0.0 };
        let own = f64::from(u8::from(row == column));
        self.scale(contact) * (own - by_normal - pressed * friction * turns)
    }

    /// The equations of these modes, ready to be solved.
    pub(super) fn solvable(&self, modes: &[Mode], impulses: &[Dual<N>]) -> Solvable {
        let (rows, equations) = self.equations(modes, impulses);
        let entry = |i: usize, j: usize| self.entry((rows[i], equations[i]), rows[j], impulses);
        let derivatives = Matrix::from_fn(rows.len(), entry);
        let inverse = inverse(&derivatives, |i| self.delassus[(rows[i], rows[i])].value);
        Solvable { rows, equations, inverse, derivatives }
    }

    /// Impulses with their derivatives. Equations are to hold in values within a part of their terms.
    ///
    /// # Errors
    /// `OtherSystem` where they do not, `NoDerivative` where equations that depend on one another do not nearby.
    pub(super) fn solve(
        &self,
        (known, part): (&Solvable, f64),
        mut impulses: Vec<Dual<N>>,
    ) -> Result<Vec<Dual<N>>, ContactErrorKind> {
        let mut misses = self.misses(&known.rows, &known.equations, &impulses);
        let terms = known.rows.iter().map(|row| self.terms(*row, &impulses)).fold(0.0, f64::max);
        let of_direction = |equation: &Equation| self.unknown_direction(*equation, &impulses, part * terms);
        let beyond =
            known.equations.iter().zip(&misses).map(|(equation, miss)| miss.value.abs() - of_direction(equation));
        let difference = beyond.fold(0.0, f64::max);
        if difference > part * terms {
            return Err(ContactErrorKind::OtherSystem { difference });
        }
        misses.iter_mut().for_each(|miss| miss.value = 0.0);
        let by = multiplied(&known.inverse, &misses);
        let left = multiplied(&known.derivatives, &by);
        let differs = |(left, miss): (&Dual<N>, &Dual<N>)| largest_slope(&(*left - *miss));
        let differs = left.iter().zip(&misses).map(differs).fold(0.0, f64::max);
        let misses = misses.iter().map(largest_slope).fold(0.0, f64::max);
        // What is not a number does not agree.
        let agree = differs <= LEFT * misses + NOTHING * terms;
        if !agree {
            return Err(ContactErrorKind::NoDerivative);
        }
        known.rows.iter().zip(by).for_each(|(row, by)| impulses[*row] -= by);
        Ok(impulses)
    }
}

/// The inverse, column by column, of a matrix with the scales of this diagonal.
pub(super) fn inverse(matrix: &Matrix, diagonal: impl Fn(usize) -> f64) -> Matrix {
    let n = matrix.size();
    let factors = Decomposition::with_part(matrix, diagonal, DEPENDENT);
    let columns: Vec<Vec<f64>> =
        (0..n).map(|k| factors.solve(&(0..n).map(|i| f64::from(u8::from(i == k))).collect::<Vec<_>>())).collect();
    Matrix::from_fn(n, |i, j| columns[j][i])
}

/// A matrix times a vector.
pub(super) fn multiplied<const N: usize>(matrix: &Matrix, x: &[Dual<N>]) -> Vec<Dual<N>> {
    let row = |i: usize| {
        let each = matrix.row(i).iter().zip(x);
        each.fold(Dual::constant(0.0), |sum, (entry, x)| Dual::constant(*entry).fma(*x, sum))
    };
    (0..x.len()).map(row).collect()
}

/// The largest derivative.
pub(super) fn largest_slope<const N: usize>(x: &Dual<N>) -> f64 {
    x.slopes.iter().fold(0.0, |largest: f64, slope| if slope.is_nan() { f64::NAN } else { largest.max(slope.abs()) })
}
