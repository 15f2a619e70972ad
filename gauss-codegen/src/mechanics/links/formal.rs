//! Matter besides that of links, which moves with speeds on its own: rotors, and what links have that deform. Its part
//! of every sum.

use crate::algebra::{Expr, Map};

use crate::mechanics::kinematics::vector::{Triple, is_zero, subtract};
use crate::mechanics::links::inertia::{acceleration_gradient, apply};
use crate::mechanics::links::tree::{Pairs, Tree};
use crate::mechanics::matter::modes::Deformation;
use crate::mechanics::matter::rotor::{Rotor, add_projected};

impl<'g> Tree<'g> {
    /// Whether some of it is moved by this speed in a way of its own, not with a link.
    pub fn is_geared(&self, speed: Expr<'g>) -> bool {
        let moves = |modes: &Deformation<'g>| modes.mode_rates().iter().any(|rate| !rate.partial(speed).is_zero());
        self.rotors.iter().any(|rotor| !rotor.row(speed).is_zero()) || self.deformations.iter().any(moves)
    }

    /// Whether this speed moves what deforms.
    pub fn moves_what_deforms(&self, speed: Expr<'g>) -> bool {
        let moves = |modes: &Deformation<'g>| modes.row(speed).iter().any(|e| !e.is_zero());
        self.deformations.iter().any(moves)
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

    /// Adds the forces of inertia of formal matter to the rows, less those of fields on it, with ż by its rates in
    /// `along`, and with `a_O − g` and ω̇ of the links as observers see them.
    pub fn with_formal(
        &self,
        rows: Vec<Expr<'g>>,
        along: &Map<u32, Expr<'g>>,
        accelerations: &Pairs<'g>,
    ) -> Vec<Expr<'g>> {
        let rows = add_projected(&self.rotors, &self.all_speeds(), rows, |rotor| rotor.force(along));
        self.with_modes(rows, |modes| modes.inertia_forces(&self.acceleration_of_o(modes.link, accelerations), along))
    }

    /// The acceleration of O in body axes, by whichever pole and in whichever axes the link works.
    pub fn acceleration_of_o(&self, k: usize, accelerations: &Pairs<'g>) -> Triple<'g> {
        let (link, (a, alpha)) = (&self.links[k], &accelerations[k]);
        let a = link.in_body_axes(a);
        if is_zero(&link.shift) {
            return a;
        }
        let in_body = |a: &Triple<'g>| link.in_body_axes(&link.frame.body_vector(*a));
        let gradient = acceleration_gradient(&in_body(&link.angular_velocity), &in_body(alpha));
        subtract(&a, &apply(&gradient, &link.shift)).map(Expr::group)
    }

    /// Adds the momenta of formal matter to the rows.
    pub fn with_formal_momenta(&self, rows: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        let rows = add_projected(&self.rotors, &self.all_speeds(), rows, Rotor::momentum);
        self.with_modes(rows, Deformation::momenta)
    }

    /// Adds the forces of a field, observer's axes, on the modes of each link.
    pub fn with_formal_weights(&self, rows: Vec<Expr<'g>>, fields: &[Option<Triple<'g>>]) -> Vec<Expr<'g>> {
        let still = [self.graph.zero(); 3];
        self.with_modes(rows, |modes| {
            let own = fields[modes.link].map(|field| self.links[modes.link].axes().to_body(&field).map(Expr::group));
            modes.uniform(&own.unwrap_or(still))
        })
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
