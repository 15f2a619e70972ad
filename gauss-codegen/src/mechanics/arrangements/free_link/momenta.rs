//! Momenta of a free link: p from z, z from p, and ṗ.

use crate::algebra::{Expr, Map};
use crate::mechanics::arrangements::balance::{BalanceForm, twist_of_momentum};
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, dot};
use crate::mechanics::name::Name;

use super::{FreeLink, Pair, PrintedMomenta};

impl<'g> FreeLink<'g> {
    /// z from (u, ω).
    pub fn speeds_of_twist(&self) -> Vec<Expr<'g>> {
        let [u1, u2, u3, w1, w2, w3] = self.twist;
        let frame = &self.kinematics.frame;
        self.lift(self.resolve(&frame.body_vector([u1, u2, u3]), &frame.body_vector([w1, w2, w3])))
    }

    /// (Q, Γ_O) of body and fluid, body axes: all six components, also those that the motion's guide takes up.
    pub fn body_momentum(&self) -> Vec<Expr<'g>> {
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = add(&self.matrix.block(0, 0, &u), &self.matrix.block(0, 3, &omega));
        let gamma = self.matrix.angular_momentum(&u, &omega);
        q.into_iter().chain(gamma).collect()
    }

    /// (Q, Γ_O) in the axes of the rows.
    fn momentum_of_speeds(&self) -> Pair<'g> {
        let frame = &self.kinematics.frame;
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = self.matrix.linear_momentum(frame, &self.kinematics.velocity, &omega);
        let spin = &self.kinematics.angular_velocity;
        let gamma = self.matrix.angular_momentum_vector(frame, &u, spin, &omega).map(Expr::group);
        let pair = self.resolve(&q, &gamma);
        Pair { linear: pair.linear.map(Expr::group), angular: pair.angular.map(Expr::group) }
    }

    /// p_α = Q·a_α + Γ_O·o_α.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        self.formed.momentum.get_or_init(|| self.project(self.momentum_of_speeds())).clone()
    }

    /// `Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α` as a function of (q, z).
    pub fn bracket_in_speeds(&self) -> Vec<Expr<'g>> {
        self.bracket(self.momentum_of_speeds())
    }

    /// From (q, p): (Q, Γ) by duality, the twist by M⁻¹, z by the kinematics.
    fn state_of_momentum(&self, arrangement: BalanceForm) -> (Pair<'g>, Vec<Expr<'g>>) {
        let pair = self.momentum_pair(&self.momenta);
        let linear = self.vector(self.linear_in, pair.linear.map(Expr::group));
        let gamma = self.vector(self.angular_in, pair.angular.map(Expr::group));
        let (velocity, omega) = twist_of_momentum(&self.kinematics, &self.matrix, &linear, &gamma, arrangement);
        (pair, self.lift(self.resolve(&velocity, &omega)))
    }

    /// z from (q, p), in the ways that are worth trying.
    pub fn velocities_of_momentum(&self) -> Vec<Vec<Expr<'g>>> {
        self.solutions().map(|arrangement| self.state_of_momentum(arrangement).1).collect()
    }

    /// Ways in which (u, ω) is found from (Q, Γ).
    fn solutions(&self) -> impl Iterator<Item = BalanceForm> {
        let coupled = self.matrix.is_coupled(&self.kinematics.active);
        [BalanceForm::Structured].into_iter().chain(coupled.then_some(BalanceForm::Eliminated))
    }

    /// ṗ_α = Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α + R·a_α + M_O·o_α, a function of (q, p), in the ways that are worth trying:
    /// `others` are the other speeds of the system in terms of their momenta.
    pub fn momentum_rates(&self, others: &Map<u32, Expr<'g>>) -> Vec<Vec<Expr<'g>>> {
        // The bracket is formed with formal Q, Γ and z, which are then replaced by what they are in terms of p.
        let graph = self.kinematics.frame.graph;
        let formal = |a: &Triple<'g>| a.map(|e| if e.is_zero() { e } else { graph.symbol("P", "P", false) });
        let rate = |arrangement| {
            let (pair, speeds) = self.state_of_momentum(arrangement);
            let symbols = Pair { linear: formal(&pair.linear), angular: formal(&pair.angular) };
            let mut replacement = others.clone();
            for (symbols, values) in [(symbols.linear, pair.linear), (symbols.angular, pair.angular)] {
                replacement.extend(symbols.iter().zip(values).map(|(s, v)| (s.key(), v.group())));
            }
            replacement.extend(self.kinematics.speeds.iter().zip(&speeds).map(|(z, value)| (z.key(), value.group())));
            let rows = self.bracket(symbols).into_iter().zip(self.generalised_forces());
            rows.map(|(bracket, force)| (bracket + force).substitute(&replacement)).collect()
        };
        self.solutions().map(rate).collect()
    }

    /// `Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α` along the flow with ż = 0; Q and Γ_O in the axes of the rows. Where a_α or o_α
    /// turns with the body, `Q·(ω × a_α) = (Q × ω)·a_α`: one cross product serves all α.
    fn bracket(&self, momentum: Pair<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let q = self.vector(self.linear_in, momentum.linear);
        let gamma = self.vector(self.angular_in, momentum.angular);
        let turning = |a: &Vector<'g>, axes: Axes| match axes {
            Axes::Body => frame.resolve(&frame.cross(a, &kinematics.angular_velocity), Axes::Body),
            Axes::Space => self.zero(),
        };
        let linear_dual = turning(&q, self.linear_in);
        let moved = frame.resolve(&frame.cross(&q, &kinematics.velocity), self.angular_in);
        let angular_dual = add(&moved, &turning(&gamma, self.angular_in));
        let constant = self.project(Pair { linear: linear_dual, angular: angular_dual });
        let rate = |row: &Triple<'g>| row.map(|e| e.derivative(&kinematics.rates));
        self.linear_rows
            .iter()
            .zip(&self.angular_rows)
            .zip(constant)
            .map(|((a, o), turned)| turned + dot(&momentum.linear, &rate(a)) + dot(&momentum.angular, &rate(o)))
            .collect()
    }

    /// The bracket for a reader: in terms of p where (Q, Γ) follow from p without division, else of Γ_O too.
    pub fn printed_bracket(&self) -> Vec<Expr<'g>> {
        if !self.in_coordinates {
            return self.bracket(self.momentum_pair(&self.momenta));
        }
        let uncoupled = (0..3).all(|i| (3..6).all(|j| self.matrix.entries[i][j].is_zero()));
        // Q = μ v_O needs no name: v_O × Q is then seen to vanish. Else its components are the momenta of b.
        let mut q = self.zero();
        self.kinematics.linear_axes().into_iter().zip(&self.momenta).for_each(|(k, p)| q[k] = *p);
        let linear = match self.matrix.isotropic {
            Some(mu) if uncoupled => self.kinematics.frame.resolve(&self.kinematics.velocity.times(mu), self.linear_in),
            _ => q,
        };
        let mut gamma = self.zero();
        for i in self.kinematics.angular_axes() {
            let name = Name::new("Γ", "\\Gamma").index(i);
            gamma[i] = self.kinematics.frame.graph.symbol(name.text, name.latex, false);
        }
        self.bracket(Pair { linear, angular: gamma })
    }

    /// p in terms of names for Q and Γ_O, and their components in body axes in terms of the twist: for readers of
    /// scenes whose p would be too long in terms of z.
    pub fn printed_momenta(&self) -> PrintedMomenta<'g> {
        let frame = &self.kinematics.frame;
        let symbol = |name: Name| frame.graph.symbol(name.text, name.latex, false);
        let triple = |name: Name, axes: &[usize]| -> Triple<'g> {
            std::array::from_fn(|i| if axes.contains(&i) { symbol(name.index(i)) } else { frame.graph.zero() })
        };
        let on = |first: usize| -> Triple<'g> {
            let kept = |i: usize| self.kinematics.active.contains(&(first + i));
            std::array::from_fn(|i| if kept(i) { self.twist[first + i] } else { frame.graph.zero() })
        };
        let (u, omega) = (on(0), on(3));
        let linear = add(&self.matrix.block(0, 0, &u), &self.matrix.block(0, 3, &omega));
        let q = triple(Name::new("Q", "Q"), &self.kinematics.linear_axes());
        let gamma = triple(Name::new("Γ", "\\Gamma"), &self.kinematics.angular_axes());
        PrintedMomenta {
            twist: self.kinematics.body_twist(),
            linear,
            angular: self.matrix.angular_momentum(&u, &omega),
            conjugate: self.project(self.resolve(&frame.body_vector(q), &frame.body_vector(gamma))),
        }
    }
}
