//! Every method in the arrangements that are worth trying: each decides whether it applies, and gives candidates.

use crate::algebra::{Expr, Map};

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::formula::{Arrangements, Formula, Formulas, Method};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::tidy::sums;

use super::{System, tidied};

/// A way to form the methods of a system.
trait Arrangement<'g> {
    fn applies(&self, system: &System<'g>) -> bool;

    /// Candidates of each method, added to those of the arrangements before; none of a method that is not formed so.
    fn candidates(&self, system: &System<'g>, before: &Formulas<'g>) -> Formulas<'g>;

    /// Whether its candidates are listed first, as those are from which others take rows.
    fn leads(&self) -> bool {
        false
    }
}

/// Sums over links, A factored densely, link by link or by squares.
struct OverLinks;

/// The same with the rows of each free link as its own balance has them.
struct RowsOfFreeLinks;

/// The balance of the free link that is all of the system.
struct BalanceOfAll;

impl<'g> Arrangement<'g> for OverLinks {
    fn applies(&self, system: &System<'g>) -> bool {
        system.balance_of_all().is_none() || !system.constraints.is_empty()
    }

    fn candidates(&self, system: &System<'g>, _: &Formulas<'g>) -> Formulas<'g> {
        system.arranged_over_links()
    }

    fn leads(&self) -> bool {
        true
    }
}

impl<'g> Arrangement<'g> for RowsOfFreeLinks {
    fn applies(&self, system: &System<'g>) -> bool {
        system.is_sum_over_links() && !system.free.is_empty()
    }

    fn candidates(&self, system: &System<'g>, before: &Formulas<'g>) -> Formulas<'g> {
        let balances: Vec<_> = system.free.iter().map(|free| (free, free.balances())).collect();
        let of_all = |f: &dyn Fn(&FreeLink<'g>) -> Arrangements<'g>| -> Vec<Arrangements<'g>> {
            system.free.iter().map(f).collect()
        };
        let accelerations = balances.iter().map(|(free, b)| b.iter().map(|b| free.acceleration(b)).collect()).collect();
        let residuals = of_all(&|free| free.residuals().into());
        let mut formulas = Formulas {
            acceleration: system.with_rows(&before.acceleration, accelerations),
            gauss_residual: system.with_rows(&before.gauss_residual, residuals),
            momentum: system.with_rows(&before.momentum, of_all(&|free| vec![free.momentum()])),
            velocity: system.with_rows(&before.velocity, of_all(&|free| free.velocities_of_momentum())),
            ..Formulas::none()
        };
        if let Some(velocity) = formulas.velocity.last() {
            let speeds = system.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
            let rates = of_all(&|free| free.momentum_rates(&speeds));
            formulas.momentum_rate = system.with_rows(&before.momentum_rate, rates);
        }
        formulas
    }
}

impl<'g> Arrangement<'g> for BalanceOfAll {
    fn applies(&self, system: &System<'g>) -> bool {
        system.balance_of_all().is_some()
    }

    fn candidates(&self, system: &System<'g>, _: &Formulas<'g>) -> Formulas<'g> {
        let Some(body) = system.balance_of_all() else { return Formulas::none() };
        let of_body = system.arranged_as_body(body);
        if system.constraints.is_empty() {
            return of_body;
        }
        // Multipliers are found together with the accelerations.
        let Formulas { momentum, velocity, mass_matrix, kinetic_energy, potential_energy, .. } = of_body;
        Formulas { momentum, velocity, mass_matrix, kinetic_energy, potential_energy, ..Formulas::none() }
    }
}

impl<'g> System<'g> {
    /// Everything in the arrangements that are worth trying.
    pub(super) fn arranged(&self) -> Formulas<'g> {
        let all: [&dyn Arrangement<'g>; 3] = [&BalanceOfAll, &OverLinks, &RowsOfFreeLinks];
        let mut formulas = Formulas::none();
        for arrangement in all.into_iter().filter(|arrangement| arrangement.applies(self)) {
            let mut candidates = arrangement.candidates(self, &formulas);
            if arrangement.leads() {
                std::mem::swap(&mut candidates, &mut formulas);
            }
            formulas.add(candidates);
        }
        self.with_matter_that_varies(&mut formulas);
        formulas
    }

    /// Adds to ṗ what momenta change by where masses do.
    fn with_matter_that_varies(&self, formulas: &mut Formulas<'g>) {
        let (Some(instant), Some(velocity)) = (self.scene.matter_time, formulas.velocity.first()) else { return };
        let speeds: Map<u32, Expr<'g>> =
            self.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
        let momentum = self.scene.tree.momentum();
        let more: Vec<Expr<'g>> = momentum.iter().map(|p| p.partial(instant).substitute(&speeds)).collect();
        formulas.momentum_rate.iter_mut().for_each(|rates| *rates = sums(rates, &more));
    }

    /// q̇ with the rates of states; `None` where no element has states.
    pub fn configuration_rates(&self) -> Option<Formula<'g>> {
        let outputs = || vec![self.scene.kinematics.clone()];
        let stateful = !self.scene.states.is_empty();
        stateful.then(|| Formula { method: Method::ConfigurationRates, arrangements: outputs() })
    }

    /// Formulas by the balance of the free link that is all of the system.
    fn arranged_as_body(&self, body: &FreeLink<'g>) -> Formulas<'g> {
        let balances = body.balances();
        let short = body.short();
        let and = |mut ways: Vec<Vec<Expr<'g>>>, short: Option<Vec<Expr<'g>>>| -> Vec<Vec<Expr<'g>>> {
            ways.extend(short);
            ways
        };
        let residual = and(body.residuals().into(), short.residual);
        let for_constraint = residual.iter().chain(&short.collected);
        let momentum = body.momentum();
        let dense = self.dense_accelerations(body, &residual);
        let potential = body.potential_energy();
        let potential = self.potential.map_or(potential, |other| potential + other);
        Formulas {
            kinematics: vec![self.scene.motion()],
            acceleration: and(balances.iter().map(|b| body.acceleration(b)).chain(dense).collect(), short.acceleration),
            momentum_rate: and(body.momentum_rates(&Map::default()), short.momentum_rate),
            velocity: and(body.velocities_of_momentum(), short.velocity),
            mass_matrix: and(vec![body.mass_matrix(&momentum)], short.matrix),
            momentum: and(vec![momentum], short.momentum),
            kinetic_energy: and(body.kinetic_energies().map(|e| vec![e]).into(), short.kinetic_energy),
            potential_energy: and(vec![vec![potential]], self.tidied_too(&[potential])),
            constraint_function: for_constraint.flat_map(|r| self.constraints_of(r)).map(|c| vec![c]).collect(),
            gauss_residual: residual,
            others: Vec::new(),
        }
    }

    fn arranged_over_links(&self) -> Formulas<'g> {
        let arrangements = self.arrangements();
        let momentum = self.momentum();
        let velocity = self.velocities(&momentum);
        Formulas {
            kinematics: vec![self.scene.motion()],
            acceleration: self.accelerations(&arrangements),
            momentum: self.with_tidied(momentum).into_iter().chain(self.by_given_poles(Tree::momentum)).collect(),
            momentum_rate: velocity.iter().flat_map(|z| self.momentum_rates(z, &arrangements[0])).collect(),
            velocity,
            mass_matrix: self.with_tidied(self.matrix.concat()),
            kinetic_energy: self.kinetic_energies(),
            potential_energy: self.with_tidied(vec![self.potential_energy()]),
            constraint_function: arrangements.iter().map(|a| vec![self.constraint_function(a)]).collect(),
            gauss_residual: arrangements.iter().map(|a| self.gauss_residual(a)).collect(),
            others: Vec::new(),
        }
    }

    /// Accelerations by a factorisation of A, where speeds are rates of coordinates.
    fn dense_accelerations(&self, body: &FreeLink<'g>, residuals: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
        if !body.in_coordinates || !self.constraints.is_empty() {
            return Vec::new();
        }
        let zero = self.scene.graph.zero();
        let still: Map<u32, Expr<'g>> = self.scene.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        let right: Vec<Expr<'g>> = residuals[0].iter().map(|row| -row.substitute(&still)).collect();
        let compact = (!self.is_long()).then(|| tidied(&self.matrix));
        compact.iter().chain([&self.matrix]).flat_map(|matrix| self.solutions(matrix, &right)).collect()
    }

    /// The first of the arrangements, with the rows of free links as these have them.
    fn with_rows(&self, before: &Arrangements<'g>, of_free: Vec<Arrangements<'g>>) -> Arrangements<'g> {
        let most = of_free.iter().map(Vec::len).max().unwrap_or(0);
        let with_way = |k: usize| {
            let mut rows = before[0].clone();
            for (free, ways) in self.free.iter().zip(&of_free) {
                let way = &ways[k.min(ways.len() - 1)];
                free.block.iter().zip(way).for_each(|(&z, e)| rows[z] = *e);
            }
            rows
        };
        (0..most).map(with_way).collect()
    }
}
