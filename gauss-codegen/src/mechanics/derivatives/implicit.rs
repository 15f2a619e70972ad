//! ż as the root of ∂C/∂ż, and its derivatives: `−A⁻¹ ∂(∂C/∂ż)` at fixed ż, with A factored once.

use crate::algebra::{Expr, FactoredColumns, Factorisation};

use crate::mechanics::arrangements::articulated::{Articulated, JointFactors};
use crate::mechanics::derivatives::rigid::{RateSymbols, Rates, ResidualMotion};
use crate::mechanics::derivatives::second::WeightedMotion;
use crate::mechanics::links::inertia::Inertia;
use crate::mechanics::system::{DENSE, System};
use crate::mechanics::tidy::sums;

/// A, ready for right-hand sides.
pub(super) enum Factors<'g> {
    Dense(Factorisation<'g>),
    /// Factors of an elimination link by link at each joint: no large terms are taken from one another.
    Joints(JointFactors<'g>),
}

impl<'g> Factors<'g> {
    /// The ways that are worth trying.
    pub(super) fn of(system: &System<'g>) -> Vec<Self> {
        let articulated = if system.is_long() { Articulated::eliminated(&system.scene.tree) } else { None };
        let mut ways: Vec<Self> = articulated.iter().map(|a| Self::Joints(a.joint_factors())).collect();
        if ways.is_empty() || system.scene.speeds.len() <= DENSE {
            ways.push(Self::Dense(Factorisation::new(&system.matrix)));
        }
        ways
    }

    fn solve(&self, right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        match self {
            Self::Dense(factored) => factored.solve(right),
            Self::Joints(joints) => joints.solve(right),
        }
    }

    fn columns(&self) -> Option<FactoredColumns<'g>> {
        match self {
            Self::Dense(factored) => Some(factored.columns()),
            Self::Joints(joints) => joints.columns(),
        }
    }

    /// The order of elimination, where the unknowns are those of the system.
    fn order(&self) -> Option<Vec<usize>> {
        match self {
            Self::Dense(factored) => Some(factored.order()),
            Self::Joints(joints) => joints.order(),
        }
    }

    /// Solutions for many right-hand sides. Of columns of A⁻¹ entries above its diagonal are those below.
    pub(super) fn solve_each(&self, rights: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
        let mut solutions: Vec<Vec<Expr<'g>>> = rights.iter().map(|right| self.solve(right)).collect();
        let units: Vec<(usize, usize)> =
            rights.iter().enumerate().filter_map(|(k, right)| Some((k, unit(right)?))).collect();
        // What is eliminated first is found last, and nothing else needs it.
        let turns: Vec<usize> = self.order().into_iter().flatten().collect();
        let turn = |unknown: usize| turns.iter().position(|&other| other == unknown);
        for &(k, row) in &units {
            for &(other, unknown) in &units {
                if turn(row) < turn(unknown) {
                    solutions[other][row] = solutions[k][unknown];
                }
            }
        }
        solutions
    }
}

/// ż and its derivatives along directions.
pub struct AccelerationsWithDerivatives<'g> {
    /// ż, then its derivatives along each of the directions.
    pub outputs: Vec<Vec<Expr<'g>>>,
    /// A⁻¹ times what else was to be solved for.
    pub solved: Vec<Expr<'g>>,
    /// Columns and right-hand sides that give the same derivatives where all are solved for together.
    pub unsolved: Option<ColumnSystem<'g>>,
}

/// `A x = right` for every direction, with what is added to x.
pub struct ColumnSystem<'g> {
    pub factors: FactoredColumns<'g>,
    pub rights: Vec<Vec<Expr<'g>>>,
    pub added: Vec<Vec<Expr<'g>>>,
}

/// The number of the only entry other than 0, which is 1.
fn unit(right: &[Expr<'_>]) -> Option<usize> {
    let mut there = (0..right.len()).filter(|&k| !right[k].is_zero());
    let first = there.next().filter(|&k| right[k] == right[k].graph().one())?;
    there.next().is_none().then_some(first)
}

impl<'g> System<'g> {
    /// ż and its derivatives along each of the directions, in the ways that are worth trying. None where the residual
    /// is not that of links alone.
    pub fn accelerations_with_derivatives(
        &self,
        directions: &[Rates<'g>],
        right: Option<&[Expr<'g>]>,
    ) -> Vec<AccelerationsWithDerivatives<'g>> {
        if !self.is_sum_over_links() || !self.rotors_are_plain() {
            return Vec::new();
        }
        let acting = self.acting();
        let acting: Vec<Vec<Expr<'g>>> =
            directions.iter().map(|direction| acting.iter().map(|f| f.derivative(direction)).collect()).collect();
        let factors = Factors::of(self);
        let inertias = self.scene.tree.inertias(self.is_long()).iter();
        let ways = inertias.flat_map(|&inertia| factors.iter().map(move |factors| (inertia, factors)));
        let way = |(inertia, factors): (Inertia, &Factors<'g>)| {
            let mut way = self.by_recursion(inertia, factors, directions, &acting)?;
            way.solved = right.map_or_else(Vec::new, |right| factors.solve(right));
            Some(way)
        };
        ways.filter_map(way).collect()
    }

    /// The terms of ∂C/∂ż other than the inertia of links: rotors, modes and loads.
    pub(super) fn beside(&self) -> Vec<Expr<'g>> {
        let (tree, speeds, zero) = (&self.scene.tree, &self.scene.speeds, self.scene.graph.zero());
        let still = tree.deformations.is_empty();
        let accelerations = if still { Vec::new() } else { tree.accelerations_along(&self.along, &self.loads) };
        let formal = tree.with_formal(vec![zero; speeds.len()], &self.along, &accelerations);
        formal.iter().zip(self.acting()).map(|(row, force)| *row - force).collect()
    }

    /// `weights · ∂C/∂ż` at any ż, twice differentiated: along the first direction of each pair and then along the
    /// second. The weights are symbols. Where [`residuals_with_derivatives`](Self::residuals_with_derivatives) has
    /// something, too.
    pub fn weighted_residual_twice(
        &self,
        weights: &[Expr<'g>],
        directions: &[Rates<'g>],
        pairs: &[(usize, usize)],
    ) -> Vec<Vec<Expr<'g>>> {
        if !self.is_sum_over_links() {
            return Vec::new();
        }
        let tree = &self.scene.tree;
        let beside = weights.iter().zip(self.beside()).map(|(weight, e)| *weight * e);
        let beside = beside.fold(self.scene.graph.zero(), |sum, e| sum + e);
        let once: Vec<Expr<'g>> = directions.iter().map(|direction| beside.derivative(direction)).collect();
        let beside: Vec<Expr<'g>> = pairs.iter().map(|&(i, j)| once[i].derivative(&directions[j])).collect();
        let way = |&inertia: &Inertia| {
            let motion = ResidualMotion::new(tree, &self.loads, &self.along, None, inertia)?;
            Some(sums(&WeightedMotion::new(&motion, weights).second_derivatives(directions, pairs), &beside))
        };
        tree.inertias(self.is_long()).iter().filter_map(way).collect()
    }

    /// Generalised forces of the loads without fields, which are accelerations of the observer.
    fn acting(&self) -> Vec<Expr<'g>> {
        let (tree, zero) = (&self.scene.tree, self.scene.graph.zero());
        let nothing = tree.links.iter().map(|link| (link.frame.zero(), [zero; 3])).collect();
        sums(&tree.acted_on_by(&self.loads.forces, nothing), &self.other_forces())
    }

    /// ∂C/∂ż at any ż, and its derivatives along directions that leave ż as it is, in the ways that are worth trying.
    /// None where the residual is not that of links alone: under constraints it has multipliers that depend on
    /// everything.
    pub fn residuals_with_derivatives(&self, directions: &[Rates<'g>]) -> Vec<Vec<Vec<Expr<'g>>>> {
        if !self.is_sum_over_links() {
            return Vec::new();
        }
        let (tree, beside) = (&self.scene.tree, self.beside());
        let way = |&inertia: &Inertia| {
            let motion = ResidualMotion::new(tree, &self.loads, &self.along, None, inertia)?;
            let derivatives = motion.derivatives(directions).into_iter().zip(directions);
            let derivatives = derivatives.map(|(change, direction)| {
                let beside: Vec<Expr<'g>> = beside.iter().map(|e| e.derivative(direction)).collect();
                sums(&change.residual, &beside)
            });
            Some(std::iter::once(self.residual(&self.along, inertia)).chain(derivatives).collect())
        };
        tree.inertias(self.is_long()).iter().filter_map(way).collect()
    }

    /// Matter besides that of links adds a constant multiple of ż to the residual, and nothing to what is taken at once
    /// where links float.
    pub(super) fn rotors_are_plain(&self) -> bool {
        let (tree, speeds) = (&self.scene.tree, &self.scene.speeds);
        tree.deformations.is_empty()
            && tree.rotors.iter().all(|rotor| {
                let rows: Vec<Expr<'g>> = speeds.iter().map(|&z| rotor.row(z)).collect();
                let floats = (0..rows.len()).any(|k| !rows[k].is_zero() && tree.takes(k));
                !floats
                    && rows.iter().all(|row| row.as_number().is_some())
                    && rotor.rate.derivative(&self.scene.rates).is_zero()
            })
    }

    /// ż, and the motion with it.
    pub(super) fn solved(
        &self,
        inertia: Inertia,
        factors: &Factors<'g>,
    ) -> Option<(Vec<Expr<'g>>, ResidualMotion<'_, 'g>)> {
        let [rows, taken] = self.floating(inertia);
        let right: Vec<Expr<'g>> = rows.iter().map(|r| -*r).collect();
        let relative: Vec<Expr<'g>> = factors.solve(&right).iter().map(|e| e.group()).collect();
        let rates = sums(&relative, &taken);
        let symbols = self.scene.speed_rates.iter().zip(&rates);
        let solved =
            RateSymbols { rates: symbols.map(|(dz, value)| (dz.key(), value.group())).collect(), relative: &relative };
        let motion = ResidualMotion::new(&self.scene.tree, &self.loads, &self.along, Some(solved), inertia)?;
        Some((rates, motion))
    }

    fn by_recursion(
        &self,
        inertia: Inertia,
        factors: &Factors<'g>,
        directions: &[Rates<'g>],
        acting: &[Vec<Expr<'g>>],
    ) -> Option<AccelerationsWithDerivatives<'g>> {
        let (rates, motion) = self.solved(inertia, factors)?;
        let changes = motion.derivatives(directions);
        let difference = |(f, r): (&Expr<'g>, &Expr<'g>)| *f - *r;
        let rights = changes.iter().zip(acting);
        let rights: Vec<Vec<Expr<'g>>> =
            rights.map(|(change, f)| f.iter().zip(&change.residual).map(difference).collect()).collect();
        let solutions = factors.solve_each(&rights).into_iter().zip(&changes);
        let derivatives = solutions.map(|(solution, change)| sums(&solution, &change.taken));
        let outputs = std::iter::once(rates).chain(derivatives).collect();
        let added = changes.iter().map(|change| change.taken.clone()).collect();
        let unsolved = factors.columns().map(|factors| ColumnSystem { factors, rights, added });
        Some(AccelerationsWithDerivatives { outputs, solved: Vec::new(), unsolved })
    }
}
