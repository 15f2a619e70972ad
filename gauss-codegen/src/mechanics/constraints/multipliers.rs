//! Constraints that coordinates and speeds do not solve by themselves: C is minimised subject to `J ż = γ`, which is
//! what `φ(t, q) = 0` differentiated twice, and `φ(t, q, z) = 0` differentiated once, say.

use crate::algebra::{ConstrainedSolution, Expr, Map, solve_dependent, solve_saddle};

use crate::mechanics::scene::SystemScene;
use crate::mechanics::scene::constraint::{Constraint, ConstraintKind};

/// All constraints on the level of velocities.
pub struct Constraints<'g> {
    list: Vec<Constraint<'g>>,
    /// They may depend on one another.
    redundant: bool,
    /// dφ/dt of positions, φ of velocities.
    pub on_velocities: Vec<Expr<'g>>,
    /// J = ∂(that)/∂z, one row a constraint.
    pub jacobian: Vec<Vec<Expr<'g>>>,
    /// γ of J ż = γ.
    bias: Vec<Expr<'g>>,
    /// Symbols of the residuals that corrections remove.
    pub residuals: Vec<Expr<'g>>,
}

impl<'g> Constraints<'g> {
    pub fn new(scene: &SystemScene<'g>, rates: &Map<u32, Expr<'g>>) -> Self {
        let on_velocities: Vec<Expr<'g>> = scene
            .constraints
            .iter()
            .map(|constraint| match constraint.kind {
                ConstraintKind::Position => constraint.value.derivative(rates),
                ConstraintKind::Velocity => constraint.value,
            })
            .collect();
        let row = |e: &Expr<'g>| scene.speeds.iter().map(|&z| e.partial(z).group()).collect();
        let residuals = (1..=on_velocities.len()).map(|k| {
            let name = format!("r{k}");
            scene.graph.symbol(name.clone(), name, false)
        });
        Self {
            jacobian: on_velocities.iter().map(row).collect(),
            bias: on_velocities.iter().map(|e| (-e.derivative(rates)).group()).collect(),
            residuals: residuals.collect(),
            list: scene.constraints.clone(),
            redundant: scene.redundant,
            on_velocities,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub fn count(&self) -> usize {
        self.list.len()
    }

    /// ż and λ with `A ż = right + Jᵀ λ` and `J ż = γ`.
    pub fn solve(&self, matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        self.saddle(matrix, &self.jacobian, right, &self.bias)
    }

    /// x and μ with `A x = right + Jᵀ μ` and `J x = 0`: velocities that impulses make.
    pub fn respond(&self, matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let still = vec![right[0].graph().zero(); self.count()];
        self.saddle(matrix, &self.jacobian, right, &still)
    }

    fn saddle(
        &self,
        matrix: &[Vec<Expr<'g>>],
        jacobian: &[Vec<Expr<'g>>],
        right: &[Expr<'g>],
        bias: &[Expr<'g>],
    ) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let (rates, multipliers) = match self.redundant {
            true => {
                let ConstrainedSolution { solution, multipliers, .. } = solve_dependent(matrix, jacobian, right, bias);
                (solution, multipliers)
            }
            false => solve_saddle(matrix, jacobian, right, bias),
        };
        (rates, multipliers.into_iter().map(|e| -e).collect())
    }

    /// 1 for a constraint that is independent of those before it, else 0; `None` where all have to be.
    pub fn kept(&self, matrix: &[Vec<Expr<'g>>]) -> Option<Vec<Expr<'g>>> {
        let still = vec![matrix[0][0].graph().zero(); matrix.len()];
        self.redundant.then(|| solve_dependent(matrix, &self.jacobian, &still, &self.bias).kept)
    }

    /// Jᵀ λ.
    pub fn forces(&self, multipliers: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let n = self.jacobian.first().map_or(0, Vec::len);
        let column = |k: usize| self.jacobian.iter().zip(multipliers).map(|(row, l)| row[k] * *l).sum::<Expr<'g>>();
        (0..n).map(column).collect()
    }

    /// φ of positions; zero in the places of velocities.
    pub fn on_positions(&self) -> Vec<Expr<'g>> {
        self.list
            .iter()
            .map(|c| match c.kind {
                ConstraintKind::Position => c.value,
                ConstraintKind::Velocity => c.value.graph().zero(),
            })
            .collect()
    }

    /// The increment of z, least in the metric A, that cancels the residuals to first order.
    pub fn velocity_correction(&self, matrix: &[Vec<Expr<'g>>]) -> Vec<Expr<'g>> {
        let all: Vec<usize> = (0..self.list.len()).collect();
        self.correction(matrix, &all)
    }

    /// The same for positions, as an increment of z: what moves q by ψ of it.
    pub fn position_correction(&self, matrix: &[Vec<Expr<'g>>]) -> Vec<Expr<'g>> {
        let positions = |k: &usize| self.list[*k].kind == ConstraintKind::Position;
        let positions: Vec<usize> = (0..self.list.len()).filter(positions).collect();
        self.correction(matrix, &positions)
    }

    fn correction(&self, matrix: &[Vec<Expr<'g>>], rows: &[usize]) -> Vec<Expr<'g>> {
        let jacobian: Vec<Vec<Expr<'g>>> = rows.iter().map(|&k| self.jacobian[k].clone()).collect();
        let wanted: Vec<Expr<'g>> = rows.iter().map(|&k| -self.residuals[k]).collect();
        let still: Vec<Expr<'g>> = matrix.iter().map(|row| row[0].graph().zero()).collect();
        self.saddle(matrix, &jacobian, &still, &wanted).0
    }
}
