//! Every method in the arrangements that are worth trying.

use crate::algebra::{Expr, Map};

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::formula::Formulas;
use crate::mechanics::links::tree::Tree;

use super::{System, tidied};

impl<'g> System<'g> {
    /// Everything in the arrangements that are worth trying.
    pub(super) fn arranged(&self) -> Formulas<'g> {
        let Some(body) = self.only_body() else {
            let mut general = self.arranged_in_general();
            if self.constraints.is_empty() && !self.free.is_empty() {
                self.put_free_links(&mut general);
            }
            return general;
        };
        let of_body = self.arranged_as_body(body);
        if self.constraints.is_empty() {
            return of_body;
        }
        // Multipliers are found together with the accelerations.
        let mut arranged = self.arranged_in_general();
        arranged.momentum.extend(of_body.momentum);
        arranged.velocity.extend(of_body.velocity);
        arranged.mass_matrix.extend(of_body.mass_matrix);
        arranged.kinetic_energy.extend(of_body.kinetic_energy);
        arranged.potential_energy.extend(of_body.potential_energy);
        arranged
    }

    /// Of the only body, which is free.
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
            kinematics: vec![self.scene.kinematics.clone()],
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

    fn arranged_in_general(&self) -> Formulas<'g> {
        let arrangements = self.arrangements();
        let momentum = self.momentum();
        let velocity = self.velocities(&momentum);
        Formulas {
            kinematics: vec![self.scene.kinematics.clone()],
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

    /// By a factorisation of A, where speeds are rates of coordinates.
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

    /// In the place of the rows of free links what they are in their arrangements.
    fn put_free_links(&self, arranged: &mut Formulas<'g>) {
        let balances: Vec<_> = self.free.iter().map(|free| (free, free.balances())).collect();
        let of_all = |f: &dyn Fn(&FreeLink<'g>) -> Vec<Vec<Expr<'g>>>| -> Vec<Vec<Vec<Expr<'g>>>> {
            self.free.iter().map(f).collect()
        };
        let accelerations = balances.iter().map(|(free, b)| b.iter().map(|b| free.acceleration(b)).collect()).collect();
        let residuals = self.free.iter().map(|free| free.residuals().into()).collect();
        self.put(&mut arranged.acceleration, accelerations);
        self.put(&mut arranged.gauss_residual, residuals);
        self.put(&mut arranged.momentum, of_all(&|free| vec![free.momentum()]));
        self.put(&mut arranged.velocity, of_all(&|free| free.velocities_of_momentum()));
        let velocity = arranged.velocity.last().expect("a way at least");
        let speeds = self.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
        self.put(&mut arranged.momentum_rate, of_all(&|free| free.momentum_rates(&speeds)));
    }

    /// Adds arrangements of the first one with rows of free links replaced.
    fn put(&self, arrangements: &mut Vec<Vec<Expr<'g>>>, of_free: Vec<Vec<Vec<Expr<'g>>>>) {
        let base = arrangements[0].clone();
        let most = of_free.iter().map(Vec::len).max().unwrap_or(0);
        for k in 0..most {
            let mut rows = base.clone();
            for (free, ways) in self.free.iter().zip(&of_free) {
                let way = &ways[k.min(ways.len() - 1)];
                free.block.iter().zip(way).for_each(|(&z, e)| rows[z] = *e);
            }
            arrangements.push(rows);
        }
    }
}
