//! Response to contact forces: A⁻¹Wᵀ or its halves, Delassus' matrix D = W A⁻¹Wᵀ, and the motion without them.

use crate::algebra::Expr;

use crate::mechanics::arrangements::articulated::Articulated;
use crate::mechanics::arrangements::halves::Halves;
use crate::mechanics::formula::{Arrangements, Formula, Method};
use crate::mechanics::scene::contact::Contact;

use super::{EquationForm, System};

/// One way to form the motion without contact forces, and what these forces do: what makes velocities of impulses —
/// A⁻¹Wᵀ, row by row of the speeds, or its halves — then D.
struct Response<'g> {
    rates: Vec<Expr<'g>>,
    effect: Vec<Expr<'g>>,
}

impl<'g> System<'g> {
    /// Formulas of the kernel's contacts; `accelerations` are those of the balance of a free link.
    pub(super) fn contact_formulas(&self, accelerations: &Arrangements<'g>) -> Vec<Formula<'g>> {
        if self.contacts.is_empty() {
            return Vec::new();
        }
        let (scene, zero) = (&self.scene, self.scene.graph.zero());
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let coefficient = |value: Option<Expr<'g>>| value.unwrap_or(zero);
        let friction = |contact: &Contact<'g>| {
            let normal = contact.gap.map(|_| zero);
            normal.into_iter().chain(contact.friction.iter().copied()).collect::<Vec<_>>()
        };
        let responses = self.responses(accelerations);
        let frame = |contact: &Contact<'g>| {
            let frame = contact.frame.iter();
            frame.flat_map(|frame| frame.point.iter().chain(frame.axes.iter().flatten())).copied().collect::<Vec<_>>()
        };
        let rows = 0..self.contacts.rates.len();
        let transposed = (0..scene.speeds.len()).flat_map(|k| rows.clone().map(move |row| (row, k)));
        let frames: Vec<Expr<'g>> = scene.contacts.iter().flat_map(frame).collect();
        let mut formulas = vec![
            single(Method::Gaps, scene.contacts.iter().map(|contact| coefficient(contact.gap)).collect()),
            single(Method::ContactRates, self.contacts.rates.clone()),
            single(Method::ContactJacobian, transposed.map(|(row, k)| self.contacts.jacobian[row][k]).collect()),
            single(Method::Friction, scene.contacts.iter().flat_map(friction).collect()),
            single(
                Method::Restitution,
                scene.contacts.iter().map(|contact| coefficient(contact.restitution)).collect(),
            ),
            Formula {
                method: Method::ImpulseResponse,
                arrangements: match self.halves() {
                    Some(_) => responses[..1].iter().map(|response| response.effect.clone()).collect(),
                    None => responses.iter().map(|response| response.effect.clone()).collect(),
                },
            },
            Formula {
                method: Method::ImpulseDynamics,
                arrangements: responses.iter().map(|response| self.contact_dynamics(response)).collect(),
            },
        ];
        if let Some(halves) = self.halves() {
            let velocities = halves.velocities(&halves.symbols, &halves.impulses);
            formulas.push(single(Method::ImpulseVelocities, velocities));
        }
        if !frames.is_empty() {
            formulas.push(single(Method::ContactFrames, frames));
        }
        formulas
    }

    /// The multipliers of the constraints that unit contact forces make, one list for each row; for checks.
    pub(in crate::mechanics) fn multipliers_of_contacts(&self) -> Vec<Vec<Expr<'g>>> {
        match self.constraints.is_empty() {
            true => vec![Vec::new(); self.contacts.jacobian.len()],
            false => self.contacts.jacobian.iter().map(|row| self.constraints.respond(&self.matrix, row).1).collect(),
        }
    }

    /// Halves of A⁻¹Wᵀ of long trees with contacts, where the speeds of the joints are those of the system.
    pub fn halves(&self) -> Option<&Halves<'g>> {
        let halves = || {
            let has = !self.contacts.is_empty() && self.is_long() && self.is_sum_over_links();
            has.then(|| Halves::new(self.tree(), &self.contacts.jacobian)).flatten()
        };
        self.halves.get_or_init(halves).as_ref()
    }

    /// Both in the ways that are worth trying, each with the same factors of A in both.
    fn responses(&self, accelerations: &Arrangements<'g>) -> Vec<Response<'g>> {
        let rows = &self.contacts.jacobian;
        if let Some(halves) = self.halves() {
            let effect = [halves.entries(), halves.delassus()].concat();
            let of = |rates: &Vec<Expr<'g>>| Response { rates: rates.clone(), effect: effect.clone() };
            return accelerations.iter().map(of).collect();
        }
        let response = |rates, columns: Vec<Vec<Expr<'g>>>| Response { rates, effect: self.effect(&columns) };
        let arrangements = self.arrangements();
        if !self.constraints.is_empty() {
            let columns =
                |a: &EquationForm<'g>| rows.iter().map(|row| self.constraints.respond(&a.matrix, row).0).collect();
            return arrangements.iter().map(|a| response(self.acceleration(a).0, columns(a))).collect();
        }
        if let Some(body) = self.balance_of_all() {
            // z = A⁻¹ p of a free link: its momenta are homogeneous in its speeds.
            let solved = |velocity: &Vec<Expr<'g>>, row: &Vec<Expr<'g>>| {
                let impulse = self.scene.momenta.iter().zip(row).map(|(p, w)| (p.key(), *w)).collect();
                velocity.iter().map(|z| z.substitute(&impulse)).collect()
            };
            let velocities = body.velocities_of_momentum();
            let columns = |k: usize| rows.iter().map(|row| solved(&velocities[k % velocities.len()], row)).collect();
            let of = |k: usize| response(accelerations[k % accelerations.len()].clone(), columns(k));
            return (0..accelerations.len().max(velocities.len())).map(of).collect();
        }
        let ways = self.accelerations(&arrangements).into_iter().zip(self.columns(&arrangements));
        ways.map(|(rates, columns)| response(rates, columns)).collect()
    }

    /// A⁻¹ of every row, in the order of [`accelerations`](System::accelerations).
    fn columns(&self, arrangements: &[EquationForm<'g>]) -> Vec<Vec<Vec<Expr<'g>>>> {
        let rows = &self.contacts.jacobian;
        let mut ways = Vec::new();
        for arrangement in arrangements {
            let of_rows: Vec<_> = rows.iter().map(|row| self.solutions(&arrangement.matrix, row)).collect();
            ways.extend((0..of_rows[0].len()).map(|way| of_rows.iter().map(|all| all[way].clone()).collect()));
        }
        if let Some(articulated) = self.is_long().then(|| Articulated::eliminated(self.tree())).flatten() {
            let columns: Vec<Vec<Expr<'g>>> = rows.iter().map(|row| articulated.solve(row)).collect();
            ways.extend(self.tree().inertias(true).iter().map(|_| columns.clone()));
        }
        let elements = self.elements();
        ways.extend(elements.iter().map(|elements| rows.iter().map(|row| elements.solve(row)).collect()));
        ways
    }

    /// A⁻¹Wᵀ, row by row of the speeds, then D.
    fn effect(&self, columns: &[Vec<Expr<'g>>]) -> Vec<Expr<'g>> {
        let columns: Vec<Vec<Expr<'g>>> = columns.iter().map(|x| x.iter().map(|e| e.group()).collect()).collect();
        let rows = &self.contacts.jacobian;
        let mut outputs: Vec<Expr<'g>> =
            (0..self.scene.speeds.len()).flat_map(|k| columns.iter().map(move |column| column[k])).collect();
        // D is symmetric: what is below its diagonal is not formed once more.
        let entry = |i: usize, j: usize| product(&rows[i.min(j)], &columns[i.max(j)]);
        outputs.extend((0..rows.len()).flat_map(|i| (0..rows.len()).map(move |j| (i, j))).map(|(i, j)| entry(i, j)));
        outputs
    }

    /// ż, b = W ż + γ, then the response.
    fn contact_dynamics(&self, response: &Response<'g>) -> Vec<Expr<'g>> {
        let rates: Vec<Expr<'g>> = response.rates.iter().map(|e| e.group()).collect();
        let rows = self.contacts.jacobian.iter().zip(&self.contacts.bias);
        let bias = rows.map(|(row, bias)| product(row, &rates) + *bias);
        rates.iter().copied().chain(bias).chain(response.effect.iter().copied()).collect()
    }

    /// A⁻¹Wᵀ, row by row of the speeds, from what makes velocities of impulses.
    pub(in crate::mechanics) fn columns_of(&self, effect: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let Some(halves) = self.halves() else { return effect.to_vec() };
        let (zero, one) = (self.scene.graph.zero(), self.scene.graph.one());
        let rows = self.contacts.rates.len();
        let unit = |row: usize| (0..rows).map(|other| if other == row { one } else { zero }).collect::<Vec<_>>();
        let columns: Vec<_> = (0..rows).map(|row| halves.velocities(effect, &unit(row))).collect();
        (0..self.scene.speeds.len()).flat_map(|k| columns.iter().map(move |column| column[k])).collect()
    }
}

fn product<'g>(row: &[Expr<'g>], column: &[Expr<'g>]) -> Expr<'g> {
    row.iter().zip(column).map(|(w, x)| *w * *x).sum()
}
