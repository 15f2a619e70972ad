//! The equations of one body in coordinates with everything multiplied out, where that makes them short.

use crate::algebra::{Expr, Map, NodeView, Solver};

use super::chart::ConfigurationKind;
use super::equations::readable;
use super::methods::Scene;

/// The equations multiplied out: what does not depend on a coordinate, because the body is the same whichever way it is turned
/// about an axis, is free of it only then.
pub struct Short<'g> {
    /// Where nothing that moves is divided by a sum.
    pub acceleration: Option<Vec<Expr<'g>>>,
    pub residual: Vec<Expr<'g>>,
    pub matrix: Vec<Expr<'g>>,
    pub momentum: Vec<Expr<'g>>,
    /// The same.
    pub velocity: Option<Vec<Expr<'g>>>,
    pub kinetic_energy: Vec<Expr<'g>>,
}

impl<'g> Scene<'g> {
    /// In coordinates the equations multiplied out, where they are short.
    ///
    /// Near a singularity of the coordinates det A vanishes with the square of a sine or of a cosine. The normal form has sin² for
    /// the one, which is reduced and loses nothing, and 1 − sin² for the other, whose leading digits cancel: solutions with such a
    /// divisor are left to the other arrangements.
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
            acceleration: short(solver.solve(&right)).filter(|rows| !rows.iter().any(divides_by_sum)),
            velocity: short(solver.solve(&self.momenta)).filter(|rows| !rows.iter().any(divides_by_sum)),
            momentum: short(self.momentum())?,
            kinetic_energy: short(vec![self.kinetic_energy()])?,
            matrix: matrix.concat(),
            residual,
        })
    }
}

/// Whether a sum that moves stands below the line.
fn divides_by_sum(e: &Expr<'_>) -> bool {
    fn is_sum(e: &Expr<'_>) -> bool {
        match e.view() {
            NodeView::Group(inner) => is_sum(&inner),
            NodeView::Sum(_) => !e.is_constant(&mut Map::default()),
            _ => false,
        }
    }
    match e.view() {
        NodeView::Number(_) | NodeView::Symbol(_) | NodeView::Opaque(_) => false,
        NodeView::Group(inner) | NodeView::Call(_, inner) => divides_by_sum(&inner),
        NodeView::Binary(_, a, b) => divides_by_sum(&a) || divides_by_sum(&b),
        NodeView::Product(factors) => factors.iter().any(|(f, n)| (*n < 0 && is_sum(f)) || divides_by_sum(f)),
        NodeView::Sum(terms) => terms.iter().any(|(_, term)| divides_by_sum(term)),
    }
}
