//! Sums over all matter that are seen from its centre of mass G: where G is, momenta about it, and their rates.
//! Components are the observer's. The fluid around bodies is no part of them, what deforms is.

use crate::algebra::Expr;

use crate::mechanics::kinematics::turn::outward;
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, is_zero, scale, subtract};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::links::tree::{Pairs, Tree};
use crate::mechanics::matter::modes::Deformation;
use crate::mechanics::matter::moments::Moments;

/// All mass, and ∫x̂ dm.
pub struct MassSum<'g> {
    pub mass: Expr<'g>,
    first: Triple<'g>,
}

impl<'g> MassSum<'g> {
    /// G − Ω.
    pub fn center(&self) -> Triple<'g> {
        let inverse = self.mass.group().recip();
        self.first.map(|e| inverse * e.group())
    }
}

impl<'g> Tree<'g> {
    /// Mass and first moment of all matter, also of what keeps still, so not of moments that are regrouped.
    pub fn whole(&self) -> MassSum<'g> {
        let zero = self.graph.zero();
        let own = |link: &Link<'g>| match &link.matter {
            Matter::Nothing => (zero, [zero; 3]),
            Matter::Particle(mass) => (*mass, [zero; 3]),
            Matter::Body(body) => (body.mass, body.first_moment()),
        };
        let mut gathered: Vec<(Expr<'g>, Triple<'g>)> = self.links.iter().map(own).collect();
        for modes in &self.deformations {
            let first = &mut gathered[modes.link].1;
            *first = add(first, &modes.first_moment()).map(Expr::group);
        }
        let mut whole = MassSum { mass: zero, first: [zero; 3] };
        for k in (0..self.links.len()).rev() {
            let (link, (mass, first)) = (&self.links[k], gathered[k]);
            let turned = outward(&link.own_joint.turns, &first);
            let moved = |at: &Triple<'g>| add(&turned, &scale(mass, at)).map(Expr::group);
            match link.parent {
                Some(parent) => {
                    gathered[parent].0 = gathered[parent].0 + mass;
                    gathered[parent].1 = add(&gathered[parent].1, &moved(&link.own_joint.offset)).map(Expr::group);
                }
                None => {
                    whole.mass = whole.mass + mass;
                    whole.first = add(&whole.first, &moved(&link.position));
                }
            }
        }
        whole
    }

    /// (Q, Γ_G) of all matter.
    pub fn centroidal_momentum(&self, center: &Triple<'g>) -> Vec<Expr<'g>> {
        let momentum = |link: &Link<'g>| {
            let (q, gamma) = linear_and_angular(link, &link.moments, &link.velocity, &link.angular_velocity);
            (link.frame.body_vector(q), gamma)
        };
        let links = self.links.iter().map(momentum).collect();
        self.about_center(self.with_pairs(links, Deformation::momenta), center)
    }

    /// ∂(Q, Γ_G)/∂z row by row: what each speed gives to all that it moves, which hangs together like one body.
    pub fn centroidal_matrix(&self, center: &Triple<'g>) -> Vec<Expr<'g>> {
        let mut together: Vec<Moments<'g>> = self.links.iter().map(|link| link.moments).collect();
        let zero = [self.graph.zero(); 3];
        let mut columns = vec![(zero, zero); self.speed_count()];
        for k in (0..self.links.len()).rev() {
            let link = &self.links[k];
            for (speed, column) in columns.iter_mut().enumerate().filter(|(speed, _)| link.is_moved_by(*speed)) {
                let (a, o) = (&link.linear_rows[speed], &link.angular_rows[speed]);
                let (q, gamma) = linear_and_angular(link, &together[k], a, o);
                let (q, gamma) = self.seen_from(link, (&q, &gamma), center);
                *column = (add(&column.0, &q), add(&column.1, &gamma));
            }
            if let Some(parent) = link.parent {
                let moments = together[k].turned(&link.joint.turns).shifted(&link.joint.offset);
                together[parent] = together[parent].plus(&moments).map(Expr::group);
            }
        }
        for modes in &self.deformations {
            let link = &self.links[modes.link];
            for (speed, column) in columns.iter_mut().enumerate() {
                let (q, gamma) = pair_of(link, &modes.momenta_of(&modes.row(self.speed(speed))));
                let (q, gamma) = self.seen_from(link, (&q, &gamma), center);
                *column = (add(&column.0, &q), add(&column.1, &gamma));
            }
        }
        let linear = (0..3).flat_map(|i| columns.iter().map(move |(q, _)| q[i]));
        let angular = (0..3).flat_map(|i| columns.iter().map(move |(_, gamma)| gamma[i]));
        linear.chain(angular).collect()
    }

    /// d(Q, Γ_G)/dt at ż = 0.
    pub fn centroidal_bias(&self, center: &Triple<'g>) -> Vec<Expr<'g>> {
        let accelerations = self.bias_accelerations();
        let rate = |(link, (a, alpha)): (&Link<'g>, &(Vector<'g>, Triple<'g>))| {
            let (frame, moments, w) = (&link.frame, &link.moments, &link.angular_velocity);
            let a = frame.resolve(a, Axes::Body);
            let (turning, mut torque) = moments.momentum(&a, alpha);
            // ∫ω × (ω × x) dm and ω × I ω besides.
            let (inward, spin) = moments.momentum(&[self.graph.zero(); 3], w);
            let turning = add(&turning, &cross(w, &inward.map(Expr::group)));
            torque = add(&torque, &cross(w, &spin.map(Expr::group)));
            let force = add(&scale(moments.mass, &a), &turning);
            (frame.body_vector(force.map(Expr::group)), torque.map(Expr::group))
        };
        let links = self.links.iter().zip(&accelerations).map(rate).collect();
        let of_modes = |modes: &Deformation<'g>| {
            modes.inertia_forces(&self.acceleration_of_o(modes.link, &accelerations), self.rates())
        };
        self.about_center(self.with_pairs(links, of_modes), center)
    }

    /// Adds the parts of `of(modes)` that pair with u and ω to those of their links.
    fn with_pairs(&self, mut pairs: Pairs<'g>, of: impl Fn(&Deformation<'g>) -> Vec<Expr<'g>>) -> Pairs<'g> {
        for modes in &self.deformations {
            let link = &self.links[modes.link];
            let (q, gamma) = pair_of(link, &of(modes));
            let pair = &mut pairs[modes.link];
            pair.0 = pair.0.plus(&link.frame.body_vector(q)).map(Expr::group);
            pair.1 = add(&pair.1, &gamma).map(Expr::group);
        }
        pairs
    }

    /// The sum of a linear and an angular part at the poles of the links, about G.
    fn about_center(&self, pairs: Pairs<'g>, center: &Triple<'g>) -> Vec<Expr<'g>> {
        let gathered = self.gathered(pairs);
        let zero = [self.graph.zero(); 3];
        let roots = self.links.iter().zip(&gathered).filter(|(link, _)| link.parent.is_none());
        let (q, gamma) = roots.fold((zero, zero), |(q, gamma), (link, (linear, angular))| {
            let (own_q, own_gamma) = self.seen_from(link, (&linear.body, angular), center);
            (add(&q, &own_q), add(&gamma, &own_gamma))
        });
        q.into_iter().chain(gamma).collect()
    }

    /// From O and the working axes of a link to G and the observer's.
    fn seen_from(
        &self,
        link: &Link<'g>,
        (q, gamma): (&Triple<'g>, &Triple<'g>),
        center: &Triple<'g>,
    ) -> (Triple<'g>, Triple<'g>) {
        let turned = |a: &Triple<'g>| link.frame.to_space(&a.map(Expr::group)).map(Expr::group);
        let (q, gamma) = (turned(q), turned(gamma));
        let lever = subtract(&link.position, center).map(Expr::group);
        if is_zero(&q) {
            return (q, gamma);
        }
        (q, add(&gamma, &cross(&lever, &q)).map(Expr::group))
    }
}

/// Components that pair with u and ω, in working axes.
fn pair_of<'g>(link: &Link<'g>, values: &[Expr<'g>]) -> (Triple<'g>, Triple<'g>) {
    let turned = |at: usize| link.in_working_axes(&[values[at], values[at + 1], values[at + 2]], Axes::Body);
    (turned(0), turned(3))
}

/// (Q, Γ_O) in working axes, of moments that move with v_O and ω.
fn linear_and_angular<'g>(
    link: &Link<'g>,
    moments: &Moments<'g>,
    velocity: &Vector<'g>,
    omega: &Triple<'g>,
) -> (Triple<'g>, Triple<'g>) {
    let u = link.frame.resolve(velocity, Axes::Body);
    let (beside, gamma) = moments.momentum(&u, omega);
    let q = add(&scale(moments.mass, &u), &beside);
    (q.map(Expr::group), gamma.map(Expr::group))
}
