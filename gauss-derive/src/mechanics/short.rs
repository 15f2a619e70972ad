//! The equations of one body in coordinates with everything multiplied out, where that makes them short.

use crate::algebra::{Expr, Map, Solver};

use super::chart::ConfigurationKind;
use super::equations::readable;
use super::methods::Scene;

/// The equations multiplied out: what does not depend on a coordinate, because the body is the same whichever way it is turned
/// about an axis, is free of it only then.
pub struct Short<'g> {
    pub acceleration: Vec<Expr<'g>>,
    pub residual: Vec<Expr<'g>>,
    pub matrix: Vec<Expr<'g>>,
    pub momentum: Vec<Expr<'g>>,
    pub velocity: Vec<Expr<'g>>,
    pub kinetic_energy: Vec<Expr<'g>>,
}

impl<'g> Scene<'g> {
    /// In coordinates the equations multiplied out, where they are short.
    ///
    /// Quotients are reduced, so that near a singularity of the coordinates nothing is lost that the other arrangements keep.
    pub fn short(&self) -> Option<Short<'g>> {
        let kinematics = &self.kinematics;
        if kinematics.kind != ConfigurationKind::Coordinates {
            return None;
        }
        let short = |rows: Vec<Expr<'g>>| -> Option<Vec<Expr<'g>>> {
            rows.into_iter().map(|row| readable(row).map(|p| p.collect())).collect()
        };
        let residual = short(self.collected_residual())?;
        let zero = kinematics.frame.graph.zero();
        let at_rest: Map<u32, Expr<'g>> = kinematics.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        let matrix: Vec<Vec<Expr<'g>>> =
            residual.iter().map(|row| kinematics.speed_rates.iter().map(|&dz| row.partial(dz)).collect()).collect();
        let right: Vec<Expr<'g>> = residual.iter().map(|row| -row.substitute(&at_rest)).collect();
        let solver = Solver::new(matrix.clone())?;
        Some(Short {
            acceleration: short(solver.solve(&right))?,
            velocity: short(solver.solve(&self.momenta))?,
            momentum: short(self.momentum())?,
            kinetic_energy: short(vec![self.kinetic_energy()])?,
            matrix: matrix.concat(),
            residual,
        })
    }
}
