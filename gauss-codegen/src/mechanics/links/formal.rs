//! Matter besides that of links, which moves with speeds on its own: rotors, and what links have that deform. Its part
//! of every sum.

use crate::algebra::{Expr, Map};

use crate::mechanics::links::tree::Tree;
use crate::mechanics::matter::modes::Deformation;
use crate::mechanics::matter::rotor::{Rotor, add_projected};

impl<'g> Tree<'g> {
    /// Whether some of it is moved by this speed.
    pub fn is_geared(&self, speed: Expr<'g>) -> bool {
        let moves = |deformation: &Deformation<'g>| deformation.row(speed).iter().any(|e| !e.is_zero());
        self.rotors.iter().any(|rotor| !rotor.row(speed).is_zero()) || self.deformations.iter().any(moves)
    }

    /// Whether there is any.
    pub fn has_formal_matter(&self) -> bool {
        !self.rotors.is_empty() || !self.deformations.is_empty()
    }

    /// ∂q̇/∂z^α of a rotor.
    pub fn row_of(&self, rotor: &Rotor<'g>, speed: usize) -> Expr<'g> {
        rotor.row(self.speed(speed))
    }

    fn all_speeds(&self) -> Vec<Expr<'g>> {
        (0..self.speed_count()).map(|k| self.speed(k)).collect()
    }

    /// With its forces of inertia, less its weight, with ż by its rates in `along`.
    pub fn with_formal(&self, rows: Vec<Expr<'g>>, along: &Map<u32, Expr<'g>>) -> Vec<Expr<'g>> {
        let rows = add_projected(&self.rotors, &self.all_speeds(), rows, |rotor| rotor.force(along));
        self.with_modes(rows, |deformation| {
            let weights = deformation.weights().into_iter();
            deformation.inertia_forces(along).iter().zip(weights).map(|(force, weight)| *force - weight).collect()
        })
    }

    /// With its momenta.
    pub fn with_formal_momenta(&self, rows: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let rows = add_projected(&self.rotors, &self.all_speeds(), rows, Rotor::momentum);
        self.with_modes(rows, Deformation::momenta)
    }

    /// With its weight: that of what deforms.
    pub fn with_formal_weights(&self, rows: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        self.with_modes(rows, Deformation::weights)
    }

    /// Adds `Σ of(modes)·∂ν/∂z^α` to the rows.
    fn with_modes(&self, mut rows: Vec<Expr<'g>>, of: impl Fn(&Deformation<'g>) -> Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        for deformation in &self.deformations {
            let values = of(deformation);
            for (k, row) in rows.iter_mut().enumerate() {
                *row = *row + deformation.projected(&values, self.speed(k));
            }
        }
        rows
    }

    /// Adds its part to the upper half of A.
    pub fn add_formal(&self, matrix: &mut [Vec<Expr<'g>>]) {
        let (n, speeds) = (self.speed_count(), self.all_speeds());
        for rotor in &self.rotors {
            let rows: Vec<Expr<'g>> = speeds.iter().map(|&z| rotor.row(z)).collect();
            for (row, column) in (0..n).flat_map(|column| (0..=column).map(move |row| (row, column))) {
                matrix[row][column] = matrix[row][column] + rotor.inertia * rows[row] * rows[column];
            }
        }
        self.deformations.iter().for_each(|deformation| deformation.add_to(matrix, &speeds));
    }

    /// Adds its part to the bracket.
    pub fn add_formal_bracket(&self, bracket: &mut [Expr<'g>]) {
        for rotor in &self.rotors {
            for (k, row) in bracket.iter_mut().enumerate() {
                *row = *row + rotor.momentum() * rotor.row(self.speed(k)).derivative(self.rates());
            }
        }
        for deformation in &self.deformations {
            for (k, row) in bracket.iter_mut().enumerate() {
                *row = *row + deformation.bracket(self.speed(k), self.rates());
            }
        }
    }

    /// 2T with its part.
    pub fn with_formal_energy(&self, links: Expr<'g>) -> Expr<'g> {
        let rotors = self.rotors.iter().fold(links, |sum, rotor| sum + rotor.momentum() * rotor.rate);
        self.deformations.iter().fold(rotors, |sum, modes| sum + modes.twice_kinetic_energy())
    }
}
