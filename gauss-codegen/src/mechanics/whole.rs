//! Quantities of the system as a whole, besides its equations: momenta about the centre of mass, forces at ż = 0,
//! weights.

use crate::algebra::{Expr, Map};

use crate::mechanics::formula::{Arrangements, Formula, Method};
use crate::mechanics::system::System;

impl<'g> System<'g> {
    /// Mass and centre of all matter, its momenta about that, ∂(momenta)/∂z, and d(momenta)/dt at ż = 0.
    pub fn centroidal_formulas(&self) -> Vec<Formula<'g>> {
        let tree = &self.scene.tree;
        let whole = tree.whole();
        let center = whole.center();
        let outputs = [
            vec![whole.mass],
            center.to_vec(),
            tree.centroidal_momentum(&center),
            tree.centroidal_matrix(&center),
            tree.centroidal_bias(&center),
        ];
        let formulas = Method::CENTROIDAL.into_iter().zip(outputs);
        formulas.map(|(method, outputs)| Formula { method, arrangements: vec![outputs] }).collect()
    }

    /// ∂C/∂ż at ż = 0, from the ways in which it is formed at any ż.
    pub fn nonlinear_effects(&self, residuals: &Arrangements<'g>) -> Formula<'g> {
        let zero = self.scene.graph.zero();
        let still: Map<u32, Expr<'g>> = self.scene.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        let arrangements =
            residuals.iter().map(|rows| rows.iter().map(|row| row.substitute(&still)).collect()).collect();
        Formula { method: Method::NonlinearEffects, arrangements }
    }

    /// Generalised forces that hold weight and buoyancy.
    pub fn gravity_torques(&self) -> Formula<'g> {
        let weights = self.scene.tree.weights();
        Formula { method: Method::GravityTorques, arrangements: vec![weights.into_iter().map(|e| -e).collect()] }
    }
}
