//! Constraints solved at compile time: the user names the speeds that stay, the others follow from them, and the system
//! that is left has no constraints. What only the whole system knows, multipliers and the way back onto constraints of
//! positions, is taken from it.

use crate::algebra::{Expr, Map, Solver, Substitution};

use crate::mechanics::formula::{Formula, Method};
use crate::mechanics::scene::SystemScene;
use crate::mechanics::scene::constraint::ConstraintKind;
use crate::mechanics::tidy::tidy;

use super::System;

/// Terms that a dependent speed may have on the way to its normal form, where sin² + cos² is 1.
const LIMIT: usize = 2000;

/// The whole system, and what its speeds are in terms of those that stay.
pub struct Elimination<'g> {
    pub whole: System<'g>,
    /// All speeds, in terms of t, q and the independent ones.
    pub values: Vec<Expr<'g>>,
    /// The speeds that stay.
    kept: Vec<usize>,
}

/// Why speeds cannot be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The constraint, by its index, is not affine in the speeds.
    NotAffine(usize),
    /// Other than so many speeds are independent.
    Count(usize),
    /// The constraints do not determine the dependent speeds.
    Undetermined,
}

impl<'g> Elimination<'g> {
    /// Solves `J z + c = 0` for the speeds that are not kept.
    pub fn new(whole: System<'g>, kept: &[usize]) -> Result<Self, Obstacle> {
        let speeds = &whole.scene.speeds;
        let constraints = &whole.constraints;
        let curved = |row: &Vec<Expr<'g>>| row.iter().any(|e| speeds.iter().any(|&z| !tidy(e.partial(z)).is_zero()));
        if let Some(k) = constraints.jacobian.iter().position(curved) {
            return Err(Obstacle::NotAffine(k));
        }
        let dependent: Vec<usize> = (0..speeds.len()).filter(|k| !kept.contains(k)).collect();
        if dependent.len() != constraints.count() {
            return Err(Obstacle::Count(speeds.len().saturating_sub(constraints.count())));
        }
        let block = constraints.jacobian.iter().map(|row| dependent.iter().map(|&k| tidy(row[k])).collect()).collect();
        let solver = Solver::new(block).ok_or(Obstacle::Undetermined)?;
        let still: Map<u32, Expr<'g>> = speeds.iter().map(|z| (z.key(), z.graph().zero())).collect();
        let right: Vec<Expr<'g>> = constraints
            .on_velocities
            .iter()
            .zip(&constraints.jacobian)
            .map(|(e, row)| kept.iter().fold(-e.substitute(&still), |sum, &k| sum - row[k] * speeds[k]))
            .collect();
        let mut values = speeds.clone();
        let solved = solver.solve(&right);
        let collected: Vec<Expr<'g>> = solved.iter().map(|value| value.collected(LIMIT)).collect();
        let graph = whole.scene.graph;
        let shorter = if graph.operations(&collected) < graph.operations(&solved) { collected } else { solved };
        for (&k, value) in dependent.iter().zip(shorter) {
            values[k] = value.group();
        }
        Ok(Self { whole, values, kept: kept.to_vec() })
    }

    /// ż of the speeds that stay, from the whole system with its multipliers: at times the cheaper way.
    pub fn accelerations(&self) -> Vec<Vec<Expr<'g>>> {
        let replacement = self.replacement();
        let kept = |rates: Vec<Expr<'g>>| self.kept.iter().map(|&k| rates[k].substitute(&replacement)).collect();
        self.whole.ways_to_accelerations().into_iter().map(kept).collect()
    }

    /// The scene of the speeds that stay.
    pub fn reduced(&self) -> SystemScene<'g> {
        self.whole.scene.reduced(&Substitution::new(self.replacement()), &self.kept)
    }

    /// Values of the dependent speeds.
    pub fn replacement(&self) -> Map<u32, Expr<'g>> {
        let symbols = self.whole.scene.speeds.iter().zip(&self.values).filter(|(z, value)| z != value);
        symbols.map(|(z, value)| (z.key(), *value)).collect()
    }

    /// Values of the dependent speeds and of their rates in the motion of the reduced system.
    pub fn motion(&self, reduced: &System<'g>) -> Map<u32, Expr<'g>> {
        let mut motion = self.replacement();
        let dependent = (0..self.values.len()).filter(|k| !self.kept.contains(k));
        motion.extend(dependent.map(|k| {
            let rate = self.values[k].derivative(&reduced.along).group();
            (self.whole.scene.speed_rates[k].key(), rate)
        }));
        motion
    }

    /// Whether rounding and discretisation can lead away from the constraints: velocities satisfy them by construction.
    pub fn can_drift(&self) -> bool {
        self.whole.scene.constraints.iter().any(|c| c.kind == ConstraintKind::Position)
    }

    /// The methods for constraints in the kernel of the reduced system.
    pub fn formulas(&self) -> Vec<Formula<'g>> {
        let replacement = self.replacement();
        let zero = self.whole.scene.graph.zero();
        let independent = self.values.len() - self.whole.constraints.count();
        self.whole
            .constraint_formulas()
            .into_iter()
            .map(|formula| match formula.method {
                Method::VelocityResidual => zeros(formula.method, zero, self.whole.constraints.count()),
                Method::VelocityCorrection => zeros(formula.method, zero, independent),
                method => {
                    let replaced =
                        |outputs: Vec<Expr<'g>>| outputs.iter().map(|e| e.substitute(&replacement)).collect();
                    Formula { method, arrangements: formula.arrangements.into_iter().map(replaced).collect() }
                }
            })
            .collect()
    }
}

fn zeros(method: Method, zero: Expr<'_>, count: usize) -> Formula<'_> {
    Formula { method, arrangements: vec![vec![zero; count]] }
}
