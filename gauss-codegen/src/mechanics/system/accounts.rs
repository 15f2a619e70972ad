//! Accounts: the power and the generalised force of every element of the loads, and the rate of the energy.

use crate::algebra::Expr;

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::loads::account::{Account, GRAVITY};
use crate::mechanics::loads::forces::{Action, Force, Loads};
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::tidy::sums;

use super::System;

/// The name of the account of prescribed motion: coordinates and constraints that are given functions of time.
const GUIDES: &str = "guides";
/// The name of the account of mass that varies.
const MATTER: &str = "mass";

/// One account of a name: an element with a potential and forces, as a spring with a damper, is in the energy by the
/// first.
fn joined(accounts: Vec<Account<'_>>) -> Vec<Account<'_>> {
    let mut all: Vec<Account<'_>> = Vec::with_capacity(accounts.len());
    for account in accounts {
        match all.last_mut().filter(|earlier| earlier.name == account.name) {
            Some(earlier) => {
                earlier.conservative |= account.conservative;
                earlier.forces = sums(&earlier.forces, &account.forces);
                earlier.power = earlier.power + account.power;
                earlier.outside = earlier.outside.into_iter().chain(account.outside).reduce(|sum, power| sum + power);
            }
            None => all.push(account),
        }
    }
    all
}

/// The elements in the order of the accounts: those of the energy first.
fn sorted(mut accounts: Vec<Account<'_>>) -> Vec<Account<'_>> {
    accounts.sort_by_key(|account| !account.conservative);
    accounts
}

impl<'g> System<'g> {
    /// One account for each element, with weight and buoyancy first.
    pub fn accounts(&self) -> Vec<Account<'g>> {
        let scene = &self.scene;
        let potential = |name: &str, potential: Expr<'g>| Account {
            name: name.to_owned(),
            conservative: true,
            forces: self.potential_forces(potential),
            // What the force does, not the change of the field in time.
            power: potential.partial(scene.time) - potential.derivative(&scene.rates),
            outside: None,
        };
        let by_wrench = |body: &FreeLink<'g>, name: &str, conservative: bool, wrench: &Wrench<'g>| {
            let power = body.power(wrench);
            let outside = (!conservative).then_some(power);
            Account { name: name.to_owned(), conservative, forces: body.project_wrench(wrench), power, outside }
        };
        let body = self.balance_of_all();
        let mut accounts = Vec::new();
        if let Some((body, wrench)) = body.and_then(|body| Some((body, body.weight_wrench()?))) {
            accounts.push(by_wrench(body, GRAVITY, true, &wrench));
        } else if scene.tree.gravity.is_some() {
            let own = potential(GRAVITY, scene.tree.potential_energy());
            accounts.push(Account { forces: scene.tree.weights(), ..own });
        }
        accounts.extend(scene.elements.iter().map(|element| match (&element.action, body, &element.on_link) {
            (action, Some(body), Some((_, wrench))) => {
                by_wrench(body, &element.name, !matches!(action, Action::Forces(_)), wrench)
            }
            (Action::Potential(energy), ..) => potential(&element.name, *energy),
            (Action::Field(field), ..) => potential(&element.name, field.potential),
            (Action::Forces(forces), ..) => self.account_of(&element.name, forces),
        }));
        let mut accounts = joined(accounts);
        if self.driven {
            accounts.push(self.account_of_guides(&accounts));
        }
        accounts.extend(scene.matter_time.map(|instant| self.account_of_matter(instant)));
        sorted(accounts)
    }

    /// Account of the kinetic energy that matter brings or takes along, where masses vary. It has no generalised force.
    fn account_of_matter(&self, instant: Expr<'g>) -> Account<'g> {
        let power = self.scene.tree.twice_kinetic_energy().half().partial(instant);
        let forces = vec![self.scene.graph.zero(); self.scene.speeds.len()];
        Account { name: MATTER.to_owned(), conservative: false, forces, power, outside: Some(power) }
    }

    /// Account of the work of guides: it is all that changes the kinetic energy and is done by nothing else. It has no
    /// generalised force: its forces do no work in ∂v_P/∂z, or are multipliers.
    fn account_of_guides(&self, others: &[Account<'g>]) -> Account<'g> {
        let scene = &self.scene;
        let rates = scene.speed_rates.iter().zip(self.any_acceleration()).map(|(s, e)| (s.key(), e.group())).collect();
        let energy = scene.tree.twice_kinetic_energy().half().derivative(&self.along).substitute(&rates);
        let known = others.iter().map(|account| account.power.group());
        let power = known.fold(energy, |rest, power| rest - power);
        let forces = vec![scene.graph.zero(); scene.speeds.len()];
        Account { name: GUIDES.to_owned(), conservative: false, forces, power, outside: Some(power) }
    }

    fn account_of(&self, name: &str, forces: &[Force<'g>]) -> Account<'g> {
        let scene = &self.scene;
        let elsewhere =
            forces.iter().filter_map(|force| force.generalised(&scene.tree.links, &scene.speeds, &scene.rates));
        let powers = forces.iter().map(|force| force.power(&scene.tree.links, &scene.speeds, &scene.rates));
        let power = powers.fold(scene.graph.zero(), |sum, power| sum + power);
        let forces = elsewhere.fold(scene.tree.loads(&Loads::of_forces(forces)), |sum, own| sums(&sum, &own));
        Account { name: name.to_owned(), conservative: false, forces, power, outside: Some(power) }
    }

    /// Whether nothing raises the energy: all forces are in it, or Rayleigh's, and nothing depends on the time.
    pub fn keeps_energy(&self) -> bool {
        let scene = &self.scene;
        let takes = |force: &Force<'g>| matches!(force, Force::Dissipation(_));
        let mut actions = scene.elements.iter().map(|element| &element.action);
        let none_gives = actions.all(|action| match action {
            Action::Potential(_) | Action::Field(_) => true,
            Action::Forces(forces) => forces.iter().all(takes),
        });
        let of_masses = scene.tree.twice_kinetic_energy().partial(scene.time);
        none_gives
            && scene.matter_time.is_none()
            && !self.driven
            && self.explicit_power().is_zero()
            && of_masses.is_zero()
    }

    /// ∂U/∂t, with the weight of matter that comes or goes.
    pub(in crate::mechanics) fn explicit_power(&self) -> Expr<'g> {
        let potential = self.potential.unwrap_or_else(|| self.scene.graph.zero());
        let weight = self.scene.tree.potential_energy();
        let explicit = potential.partial(self.scene.time) + weight.partial(self.scene.time);
        self.scene.matter_time.map_or(explicit, |instant| explicit + (weight + potential).partial(instant))
    }
}
