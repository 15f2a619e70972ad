//! The equations of one body in coordinates with everything multiplied out, where that makes them short.

use crate::algebra::{Expr, Map, Solver};

use crate::mechanics::tidy;

use super::free_link::FreeLink;

/// Formulas that are short when they are multiplied out.
#[derive(Default)]
pub struct Short<'g> {
    pub acceleration: Option<Vec<Expr<'g>>>,
    pub residual: Option<Vec<Expr<'g>>>,
    pub matrix: Option<Vec<Expr<'g>>>,
    pub momentum: Option<Vec<Expr<'g>>>,
    pub velocity: Option<Vec<Expr<'g>>>,
    pub kinetic_energy: Option<Vec<Expr<'g>>>,
    pub momentum_rate: Option<Vec<Expr<'g>>>,
    /// The residual once more, for C alone: derivatives of what it is made of can be longer.
    pub collected: Option<Vec<Expr<'g>>>,
}

fn short<'g>(rows: Vec<Expr<'g>>) -> Option<Vec<Expr<'g>>> {
    rows.into_iter().map(tidy::short).collect()
}

impl<'g> FreeLink<'g> {
    pub fn short(&self) -> Short<'g> {
        if self.in_coordinates {
            self.short_in_coordinates().unwrap_or_default()
        } else if self.has_constant_rows() {
            self.short_in_components()
        } else {
            Short::default()
        }
    }

    /// In components of the twist: what is written in products and factors first can be shorter without.
    fn short_in_components(&self) -> Short<'g> {
        let momentum = self.momentum();
        let matrix = short(momentum.clone()).map(|momentum| self.mass_matrix(&momentum));
        let velocity = self.velocities_of_momentum().swap_remove(0);
        let speeds = self.kinematics.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group()));
        let of_momenta: Map<u32, Expr<'g>> = speeds.collect();
        let rate = |bracket: Vec<Expr<'g>>| -> Vec<Expr<'g>> {
            let rows = bracket.into_iter().zip(self.generalised_forces());
            rows.map(|(bracket, force)| (bracket + force).substitute(&of_momenta)).collect()
        };
        Short {
            momentum: short(momentum),
            matrix,
            kinetic_energy: short(vec![self.kinetic_energy()]),
            momentum_rate: short(self.bracket_in_speeds()).map(rate),
            collected: short(self.collected_residual()),
            ..Short::default()
        }
    }

    /// In coordinates what does not depend on one of them, because the body is the same whichever way it is turned
    /// about an axis, is free of it only when it is multiplied out.
    fn short_in_coordinates(&self) -> Option<Short<'g>> {
        let kinematics = &self.kinematics;
        let graph = kinematics.frame.graph;
        let zero = graph.zero();
        // Loads stay as they are written: a spring near its length of rest has its digits in the difference.
        let loads = self.load_forces().into_iter().enumerate().map(|(k, force)| match force {
            force if force.is_zero() => (force, force),
            force => (graph.symbol(format!("F{}", k + 1), "F", false), force.group()),
        });
        let loads: Vec<(Expr<'g>, Expr<'g>)> = loads.collect();
        let written: Map<u32, Expr<'g>> =
            loads.iter().filter(|(_, force)| !force.is_zero()).map(|(symbol, force)| (symbol.key(), *force)).collect();
        let with_loads = |rows: Vec<Expr<'g>>| -> Vec<Expr<'g>> {
            if written.is_empty() { rows } else { rows.iter().map(|e| e.substitute(&written)).collect() }
        };
        let inertial = self.inertial_residuals().swap_remove(1);
        let residual = short(inertial.into_iter().zip(&loads).map(|(row, (load, _))| row - *load).collect())?;
        let at_rest: Map<u32, Expr<'g>> = kinematics.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        let matrix: Vec<Vec<Expr<'g>>> =
            residual.iter().map(|row| kinematics.speed_rates.iter().map(|&dz| row.partial(dz)).collect()).collect();
        let right: Vec<Expr<'g>> = residual.iter().map(|row| -row.substitute(&at_rest)).collect();
        let solver = Solver::new(matrix.clone())?;
        let solved = |right: &[Expr<'g>]| short(solver.solve(right)).map(with_loads);
        Some(Short {
            acceleration: solved(&right),
            velocity: solved(&self.momenta),
            momentum: Some(short(self.momentum())?),
            kinetic_energy: Some(short(vec![self.kinetic_energy()])?),
            matrix: Some(matrix.concat()),
            residual: Some(with_loads(residual)),
            ..Short::default()
        })
    }
}
