//! Sums over links by recursion: velocities and accelerations outward from the roots, momenta and forces inward, so
//! that what moves together is summed before it is projected. Every sum over bodies of (3.3) and (3.4) is one of these.

use crate::algebra::{Expr, Graph, Map};

use crate::mechanics::kinematics::turn::{Turn, angular_acceleration, inward, outward};
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, dot, is_zero, scale, subtract};
use crate::mechanics::links::floating::Floating;
use crate::mechanics::links::inertia::{Inertia, acceleration_gradient, apply, force_of_inertia};
use crate::mechanics::links::link::{Link, Matter, Placement, WorkingFrame};
use crate::mechanics::links::regroup::regroup;
use crate::mechanics::loads::forces::{Force, Loads};
use crate::mechanics::matter::added_mass::impulse;
use crate::mechanics::matter::modes::Deformation;
use crate::mechanics::matter::moments::Moments;
use crate::mechanics::matter::rotor::Rotor;

/// A linear and an angular part at the pole O of each link: momenta, forces or accelerations.
pub type Pairs<'g> = Vec<(Vector<'g>, Triple<'g>)>;

/// Observers who move with the accelerations that floating links have at once.
enum Observers<'a, 'g> {
    /// Nobody moves.
    Still,
    /// At ż = ζ, which is written down, but for speeds that are held.
    Moved(&'a [bool], &'a mut [Expr<'g>]),
    /// At `ż = ζ + ż′`, with ż′: ζ does not come in, so that the small is not a difference of the large.
    Relative(&'a [Expr<'g>]),
}

/// `∂C/∂ż` at ż = ζ before it is gathered: see [`Tree::under_way`].
pub struct UngatheredResidual<'g> {
    /// Forces of inertia of every link by itself, less the loads on it.
    pub wrenches: Pairs<'g>,
    /// Contributions of rotors and modes.
    pub rows: Vec<Expr<'g>>,
    /// ζ.
    pub taken: Vec<Expr<'g>>,
}

/// Links, parents before children.
pub struct Tree<'g> {
    pub graph: &'g Graph,
    pub links: Vec<Link<'g>>,
    /// The links as they were given.
    placements: Vec<Placement<'g>>,
    /// The axis that every turn is about, if components are taken in k for that.
    planar: Option<usize>,
    speeds: Vec<Expr<'g>>,
    rates: Map<u32, Expr<'g>>,
    /// Acceleration of free fall, observer's axes.
    pub gravity: Option<Triple<'g>>,
    floating: Vec<Option<Floating<'g>>>,
    /// Inertia of rates, added to that of the links.
    pub rotors: Vec<Rotor<'g>>,
    /// Modes of links that deform.
    pub deformations: Vec<Deformation<'g>>,
}

impl<'g> Tree<'g> {
    /// Components are taken in k where every turn is about one and the same axis, else in body axes, in which the added
    /// mass of a fluid is constant.
    pub fn new(
        graph: &'g Graph,
        placements: Vec<Placement<'g>>,
        speeds: Vec<Expr<'g>>,
        rates: Map<u32, Expr<'g>>,
        gravity: Option<Triple<'g>>,
    ) -> Self {
        let chained = placements.iter().any(|p| p.parent.is_some());
        let mut turns = placements.iter().flat_map(|p| &p.turns);
        let axis = turns.clone().next().and_then(|turn| turn.axis_and_angle()).map(|(axis, _)| axis);
        let about_it = |turn: &Turn<'g>| turn.axis_and_angle().is_some_and(|(own, _)| Some(own) == axis);
        let dry = placements.iter().all(|p| !matches!(&p.matter, Matter::Body(body) if body.added_mass.is_some()));
        let planar = axis.filter(|_| chained && dry && turns.all(about_it));
        let mut tree = Self::without_links(graph, planar, speeds, rates, gravity);
        placements.into_iter().for_each(|placement| tree.hang(placement));
        tree
    }

    fn without_links(
        graph: &'g Graph,
        planar: Option<usize>,
        speeds: Vec<Expr<'g>>,
        rates: Map<u32, Expr<'g>>,
        gravity: Option<Triple<'g>>,
    ) -> Self {
        Self {
            graph,
            links: Vec::new(),
            placements: Vec::new(),
            planar,
            speeds,
            rates,
            gravity,
            floating: Vec::new(),
            rotors: Vec::new(),
            deformations: Vec::new(),
        }
    }

    /// The same links, each placed by what `change` makes of its placement, before they are settled.
    pub fn changed(
        &self,
        speeds: Vec<Expr<'g>>,
        rates: Map<u32, Expr<'g>>,
        change: impl Fn(&Placement<'g>) -> Placement<'g>,
    ) -> Self {
        let mut tree = Self::without_links(self.graph, self.planar, speeds, rates, self.gravity);
        self.placements.iter().for_each(|placement| tree.hang(change(placement)));
        tree.rotors.clone_from(&self.rotors);
        tree.deformations.clone_from(&self.deformations);
        tree
    }

    /// Adds a link; its parent is there already.
    pub fn hang(&mut self, placement: Placement<'g>) {
        if let Some(parent) = placement.parent {
            self.links[parent].has_children = true;
        }
        let parent = placement.parent.map(|k| &self.links[k]);
        let link = Link::new(self.graph, placement.clone(), parent, self.planar, &self.speeds, &self.rates);
        self.placements.push(placement);
        self.links.push(link);
    }

    /// Gives to parents what moves with them as well; to be called once all links hang.
    pub fn settle(&mut self) {
        self.floating = Floating::of(&self.links, self.speeds.len());
        regroup(self.graph, &mut self.links);
        self.links.iter_mut().for_each(Link::settle);
    }

    /// The same links by the poles that are given, each in its own axes, where all work in those of the observer.
    pub fn in_own_axes(&self) -> Option<Self> {
        let own = |link: &Link<'g>| WorkingFrame {
            shift: link.shift,
            own_offset: link.own_joint.offset,
            joint: link.own_joint.clone(),
            turned: None,
        };
        self.planar.map(|_| self.described(self.links.iter().map(own).collect()))
    }

    /// The same links by other poles and axes; not in the plane.
    pub fn described(&self, descriptions: Vec<WorkingFrame<'g>>) -> Self {
        let mut tree = Self::new(self.graph, Vec::new(), self.speeds.clone(), self.rates.clone(), self.gravity);
        tree.rotors.clone_from(&self.rotors);
        tree.deformations.clone_from(&self.deformations);
        for (link, by) in self.links.iter().zip(descriptions) {
            let link = link.described(link.parent.map(|k| &tree.links[k]), by, &tree.speeds);
            tree.links.push(link);
        }
        tree.settle();
        tree
    }

    /// Leaves all moments where they were given.
    #[cfg(test)]
    pub fn settle_without_regrouping(&mut self) {
        self.links.iter_mut().for_each(Link::settle);
    }

    /// Masses of all matter.
    pub fn masses(&self) -> impl Iterator<Item = Expr<'g>> {
        self.links.iter().filter_map(|link| match &link.matter {
            Matter::Nothing => None,
            Matter::Particle(mass) => Some(*mass),
            Matter::Body(body) => Some(body.mass),
        })
    }

    /// Whether some link floats.
    pub fn floats(&self) -> bool {
        self.floating.iter().any(Option::is_some)
    }

    /// Rates of t and of the symbols of q.
    pub fn rates(&self) -> &Map<u32, Expr<'g>> {
        &self.rates
    }

    fn speeds(&self) -> std::ops::Range<usize> {
        0..self.speeds.len()
    }

    pub fn speed(&self, k: usize) -> Expr<'g> {
        self.speeds[k]
    }

    /// Whether links that float take of their accelerations by this speed.
    pub fn takes(&self, speed: usize) -> bool {
        self.floating.iter().flatten().any(|floating| floating.takes(speed))
    }

    pub fn speed_count(&self) -> usize {
        self.speeds.len()
    }

    /// The ways to form the rates of angular momenta that are worth trying: about a single axis the tensor is a number,
    /// and particles have none.
    pub fn inertias(&self, long: bool) -> &'static [Inertia] {
        let particles = self.links.iter().all(|link| link.body().is_none());
        match (self.planar.is_some() || particles, long) {
            (true, true) => &[Inertia::Tensor],
            (true, false) if particles => &[Inertia::Tensor],
            (false, true) => &[Inertia::Field],
            (_, false) => &[Inertia::Tensor, Inertia::Field],
        }
    }

    pub fn is_chained(&self) -> bool {
        self.links.iter().any(|link| link.parent.is_some())
    }

    /// (Q, Γ_O) of every link by itself.
    fn momenta(&self) -> Pairs<'g> {
        self.links.iter().map(|link| link.momentum(&link.moments, &link.velocity, &link.angular_velocity)).collect()
    }

    /// Adds to every link what hangs on it, moved to its pole.
    pub fn gathered(&self, mut pairs: Pairs<'g>) -> Pairs<'g> {
        for k in (0..self.links.len()).rev() {
            let Some(parent) = self.links[k].parent else { continue };
            let (linear, angular) = self.carried(k, &pairs[k].0.body, &pairs[k].1);
            let pair = &mut pairs[parent];
            pair.0.body = add(&pair.0.body, &linear).map(Expr::group);
            pair.1 = add(&pair.1, &angular).map(Expr::group);
        }
        pairs
    }

    /// A linear and an angular part at the pole of a link, at its parent's pole and in its axes.
    pub fn carried(&self, k: usize, linear: &Triple<'g>, angular: &Triple<'g>) -> (Triple<'g>, Triple<'g>) {
        let joint = &self.links[k].joint;
        let linear = outward(&joint.turns, linear);
        let angular = outward(&joint.turns, angular);
        (linear, add(&angular, &cross(&joint.offset, &linear)))
    }

    /// `Σ linear·a_α + angular·o_α` over all links.
    fn projected(&self, pairs: &Pairs<'g>) -> Vec<Expr<'g>> {
        let row = |k: usize| {
            let links = self.links.iter().zip(pairs).filter(|(link, _)| link.is_moved_by(k));
            let terms = links.map(|(link, (linear, angular))| link.project(k, linear, angular));
            terms.fold(self.graph.zero(), |sum, e| sum + e)
        };
        self.speeds().map(row).collect()
    }

    /// p_α = ∂T/∂z^α.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        let momenta = self.projected(&self.gathered(self.momenta()));
        self.with_formal_momenta(momenta)
    }

    /// A_αβ: the momentum that each partial velocity gives to all that it moves, paired with the partial velocities of
    /// the links on the way to the root.
    pub fn mass_matrix(&self) -> Vec<Vec<Expr<'g>>> {
        let n = self.speeds.len();
        let mut matrix = vec![vec![self.graph.zero(); n]; n];
        let mut together: Vec<Moments<'g>> = self.links.iter().map(|link| link.moments).collect();
        let moved_by = |link: &Link<'g>| self.speeds().filter(|&z| link.is_moved_by(z)).collect();
        let moving: Vec<Vec<usize>> = self.links.iter().map(moved_by).collect();
        for k in (0..self.links.len()).rev() {
            let (link, moved) = (&self.links[k], &moving[k]);
            for &column in moved {
                let (row_a, row_o) = (&link.linear_rows[column], &link.angular_rows[column]);
                let (q, gamma) = link.momentum(&together[k], row_a, row_o);
                for &row in moved.iter().filter(|&&row| row <= column) {
                    matrix[row][column] = matrix[row][column] + link.project(row, &q, &gamma);
                }
                let (mut at, mut linear, mut angular) = (k, q.body, gamma);
                while let Some(parent) = self.links[at].parent {
                    (linear, angular) = self.carried(at, &linear, &angular);
                    (linear, angular) = (linear.map(Expr::group), angular.map(Expr::group));
                    at = parent;
                    let above = &self.links[at];
                    for &row in &moving[at] {
                        let entry = above.project(row, &above.frame.body_vector(linear), &angular);
                        let (low, high) = (row.min(column), row.max(column));
                        // On the diagonal the pair of links counts in both orders.
                        let entry = if low == high { entry + entry } else { entry };
                        matrix[low][high] = matrix[low][high] + entry;
                    }
                }
            }
            if let Some(parent) = link.parent {
                let moments = together[k].turned(&link.joint.turns).shifted(&link.joint.offset);
                together[parent] = together[parent].plus(&moments).map(Expr::group);
            }
        }
        self.add_carried_fluid(&mut matrix);
        self.add_formal(&mut matrix);
        for row in 0..n {
            for column in 0..row {
                matrix[row][column] = matrix[column][row];
            }
        }
        matrix
    }

    /// Adds to A the inertia of the fluid around a link in the motion of its ancestors alone: it is no moment, so it is
    /// not in what moves together with them.
    fn add_carried_fluid(&self, matrix: &mut [Vec<Expr<'g>>]) {
        for (k, link) in self.links.iter().enumerate() {
            let added = link.body().and_then(|body| body.added_mass.as_ref());
            let (Some(added), Some(_)) = (added, link.parent) else { continue };
            let carried: Vec<_> = self.speeds().map(|speed| self.carried_motion(k, speed)).collect();
            let moves = |z: &usize| !is_zero(&carried[*z].0) || !is_zero(&carried[*z].1);
            for column in self.speeds().filter(moves) {
                let (linear, angular) = impulse(added, &carried[column].0, &carried[column].1);
                for row in (0..=column).filter(moves) {
                    let entry = dot(&linear, &carried[row].0) + dot(&angular, &carried[row].1);
                    matrix[row][column] = matrix[row][column] + entry;
                }
            }
        }
    }

    /// ∂v_O/∂z^α and ∂ω/∂z^α that a link has from its ancestors, in its working axes.
    fn carried_motion(&self, k: usize, speed: usize) -> (Triple<'g>, Triple<'g>) {
        let Some(parent) = self.links[k].parent else { return ([self.graph.zero(); 3], [self.graph.zero(); 3]) };
        let (above, joint) = (&self.links[parent], &self.links[k].joint);
        let (linear, angular) = self.carried_motion(parent, speed);
        let own = above.frame.resolve(&above.linear_rows[speed], Axes::Body);
        let (linear, angular) = (add(&linear, &own), add(&angular, &above.angular_rows[speed]));
        let moved = add(&linear, &cross(&angular, &joint.offset)).map(Expr::group);
        (inward(&joint.turns, &moved), inward(&joint.turns, &angular))
    }

    /// `∂C/∂ż` without the potential and the forces that are not on links: `∫(a_P − g)·w_α dm`, the fluid's share and
    /// the loads, with ż by its rates in `along`.
    pub fn residual(&self, along: &Map<u32, Expr<'g>>, inertia: Inertia, loads: &Loads<'g>) -> Vec<Expr<'g>> {
        self.balance(along, inertia, loads, &self.accelerations(along, Some(loads), Observers::Still))
    }

    /// The same at ż = ζ, seen by observers who move with the links that float, and ζ. Speeds of which `held` is true
    /// stay at rest.
    pub fn floating_residual(
        &self,
        inertia: Inertia,
        loads: &Loads<'g>,
        held: &[bool],
    ) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let (accelerations, taken) = self.floating_accelerations(loads, held);
        (self.balance(&self.rates, inertia, loads, &accelerations), taken)
    }

    /// The same before it is gathered, for those who gather something else on the way to the root as well.
    pub fn under_way(&self, inertia: Inertia, loads: &Loads<'g>, held: &[bool]) -> UngatheredResidual<'g> {
        let (accelerations, taken) = self.floating_accelerations(loads, held);
        let wrenches = self.wrenches(&self.rates, inertia, loads, &accelerations);
        let rows = self.with_formal(vec![self.graph.zero(); self.speeds.len()], &self.rates, &accelerations);
        UngatheredResidual { wrenches, rows, taken }
    }

    /// `a_O − g` and ω̇ of every link at ż = ζ for these observers, and ζ.
    pub fn floating_accelerations(&self, loads: &Loads<'g>, held: &[bool]) -> (Pairs<'g>, Vec<Expr<'g>>) {
        let mut taken = vec![self.graph.zero(); self.speeds.len()];
        (self.accelerations(&self.rates, Some(loads), Observers::Moved(held, &mut taken)), taken)
    }

    /// `a_O − g` and ω̇ of every link, and the forces of inertia of all that hangs on it, at its O. `relative` is ż′
    /// where `along` is known to have `ż = ζ + ż′`.
    pub fn forces_of_inertia(
        &self,
        along: &Map<u32, Expr<'g>>,
        inertia: Inertia,
        loads: &Loads<'g>,
        relative: Option<&[Expr<'g>]>,
    ) -> (Pairs<'g>, Pairs<'g>) {
        let observers = relative.map_or(Observers::Still, Observers::Relative);
        let accelerations = self.accelerations(along, Some(loads), observers);
        let of_links = self.links.iter().zip(&accelerations);
        let forces = of_links.map(|(link, (a, alpha))| self.inertia_force(link, (a, alpha), along, inertia)).collect();
        let forces = self.gathered(forces);
        (accelerations, forces)
    }

    fn balance(
        &self,
        along: &Map<u32, Expr<'g>>,
        inertia: Inertia,
        loads: &Loads<'g>,
        accelerations: &Pairs<'g>,
    ) -> Vec<Expr<'g>> {
        let wrenches = self.wrenches(along, inertia, loads, accelerations);
        self.with_formal(self.projected(&self.gathered(wrenches)), along, accelerations)
    }

    /// Forces of inertia of every link by itself, less the loads on it.
    fn wrenches(
        &self,
        along: &Map<u32, Expr<'g>>,
        inertia: Inertia,
        loads: &Loads<'g>,
        accelerations: &Pairs<'g>,
    ) -> Pairs<'g> {
        let inertia_forces = self.links.iter().zip(accelerations);
        let mut pairs: Pairs<'g> =
            inertia_forces.map(|(link, (a, alpha))| self.inertia_force(link, (a, alpha), along, inertia)).collect();
        for (link, force, torque) in loads.forces.iter().filter_map(|force| force.load(&self.links)) {
            let (linear, angular) = &mut pairs[link];
            *linear = linear.minus(&force).map(Expr::group);
            *angular = subtract(angular, &torque).map(Expr::group);
        }
        pairs
    }

    /// `R·a_α + M_O·o_α` of the loads on links.
    pub fn loads(&self, loads: &Loads<'g>) -> Vec<Expr<'g>> {
        let fields: Vec<Option<Triple<'g>>> = (0..self.links.len()).map(|k| loads.field_on(self.root_of(k))).collect();
        self.with_formal_weights(self.acted_on_by(&loads.forces, self.weights_in(&fields, |_| None)), &fields)
    }

    /// `R·a_α + M_O·o_α` of forces, and of a resultant and a torque about O on each link.
    pub fn acted_on_by(&self, forces: &[Force<'g>], mut pairs: Pairs<'g>) -> Vec<Expr<'g>> {
        for (link, force, torque) in forces.iter().filter_map(|force| force.load(&self.links)) {
            let (linear, angular) = &mut pairs[link];
            *linear = linear.plus(&force);
            *angular = add(angular, &torque);
        }
        self.projected(&self.gathered(pairs))
    }

    /// The axis that every turn is about, if components are taken in k for that.
    pub fn planar_axis(&self) -> Option<usize> {
        self.planar
    }

    /// ∂v_O/∂z^α and ∂ω/∂z^α of a link, in its working axes.
    pub fn motion(&self, k: usize, speed: usize) -> (Triple<'g>, Triple<'g>) {
        let (linear, angular) = self.carried_motion(k, speed);
        let own = self.links[k].frame.resolve(&self.links[k].linear_rows[speed], Axes::Body);
        (add(&linear, &own).map(Expr::group), add(&angular, &self.links[k].angular_rows[speed]).map(Expr::group))
    }

    /// The root that a link hangs on.
    pub fn root_of(&self, k: usize) -> usize {
        self.links[k].parent.map_or(k, |parent| self.root_of(parent))
    }

    /// a_O and ω̇ of every link at ż = 0.
    pub fn bias_accelerations(&self) -> Pairs<'g> {
        self.accelerations(&self.rates, None, Observers::Still)
    }

    /// `a_O − g` and ω̇ of every link at any ż.
    pub fn accelerations_along(&self, along: &Map<u32, Expr<'g>>, loads: &Loads<'g>) -> Pairs<'g> {
        self.accelerations(along, Some(loads), Observers::Still)
    }

    /// `a_O − g` and ω̇ of every link; a uniform field is an acceleration of the observer, and so is what links that
    /// float have at ż = 0, unless the speed is held: it is written down. Without loads there is no field.
    fn accelerations(
        &self,
        along: &Map<u32, Expr<'g>>,
        loads: Option<&Loads<'g>>,
        mut observers: Observers<'_, 'g>,
    ) -> Pairs<'g> {
        let mut accelerations: Pairs<'g> = Vec::with_capacity(self.links.len());
        for (k, link) in self.links.iter().enumerate() {
            let frame = &link.frame;
            let floating = self.floating.get(k).and_then(Option::as_ref);
            let relative = match observers {
                Observers::Relative(rates) if link.parent.is_none() => floating.zip(Some(rates)),
                _ => None,
            };
            let (mut a, alpha) = match link.parent {
                None => {
                    let omega = frame.body_vector(link.axes_velocity());
                    let along_o = if relative.is_some() { &self.rates } else { along };
                    let a = frame.derivative(&link.velocity, along_o, &omega).map(Expr::group);
                    let fields = loads.into_iter().flat_map(|loads| self.gravity.into_iter().chain(loads.field_on(k)));
                    let a = fields.fold(a, |a, g| a.minus(&frame.space_vector(g)));
                    (a, link.angular_velocity.map(|e| e.derivative(along).group()))
                }
                Some(parent) => {
                    let (above, joint) = (&self.links[parent], &link.joint);
                    let (a, alpha) = &accelerations[parent];
                    let omega = &above.angular_velocity;
                    let carried = add(&a.body, &apply(&acceleration_gradient(omega, alpha), &joint.offset));
                    let rate = &joint.offset_rate;
                    // The components of the rate turn with the parent's axes, unless they are in k: the rate of their
                    // rate then has one ω × rate in it already.
                    let drift = cross(omega, rate);
                    let drift = if self.planar.is_some() { drift } else { scale(self.graph.integer(2), &drift) };
                    let own = add(&rate.map(|e| e.derivative(along)), &drift);
                    let a = frame.body_vector(inward(&joint.turns, &add(&carried, &own).map(Expr::group)));
                    let alpha = if self.planar.is_some() {
                        add(alpha, &link.spin.map(|e| e.derivative(along))).map(Expr::group)
                    } else {
                        angular_acceleration(&joint.turns, [omega, alpha], along)
                    };
                    (a, alpha)
                }
            };
            if let (Observers::Moved(held, taken), Some(floating)) = (&mut observers, floating) {
                a = floating.taken_from(link, &a, held, taken);
            }
            if let Some((floating, rates)) = relative {
                let none = vec![false; rates.len()];
                let rest = floating.taken_from(link, &a, &none, &mut vec![self.graph.zero(); rates.len()]);
                let rows = link.linear_rows.iter().zip(rates);
                a = rows.fold(rest, |a, (row, rate)| a.plus(&row.times(*rate))).map(Expr::group);
            }
            if !link.is_alone() {
                a = frame.body_vector(frame.resolve(&a, Axes::Body).map(Expr::group));
            }
            accelerations.push((a, alpha));
        }
        accelerations
    }

    fn inertia_force(
        &self,
        link: &Link<'g>,
        (a, alpha): (&Vector<'g>, &Triple<'g>),
        along: &Map<u32, Expr<'g>>,
        inertia: Inertia,
    ) -> (Vector<'g>, Triple<'g>) {
        force_of_inertia((self.graph, self.gravity), link, (a, alpha), along, inertia)
    }

    /// `Σ Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α` with the momenta of all that moves together.
    pub fn bracket(&self) -> Vec<Expr<'g>> {
        let own = self.momenta();
        let gathered = self.gathered(own);
        let mut bracket = vec![self.graph.zero(); self.speeds.len()];
        for (link, (q, gamma)) in self.links.iter().zip(&gathered) {
            let frame = &link.frame;
            let omega = if self.planar.is_some() { frame.zero() } else { frame.body_vector(link.axes_velocity()) };
            // A multiple of v_O drops out of v_O × Q.
            let beside = if link.is_alone() && link.body().is_none_or(|body| body.added_mass.is_none()) {
                frame.body_vector(cross(&link.angular_velocity, &link.moments.first))
            } else {
                *q
            };
            let moved = frame.resolve(&frame.cross(&beside, &link.velocity), Axes::Body);
            let turned = add(&cross(gamma, &frame.resolve(&omega, Axes::Body)), &moved);
            for k in self.speeds().filter(|&k| link.is_moved_by(k)) {
                let a = frame.derivative(&link.linear_rows[k], &self.rates, &omega);
                let o = link.angular_rows[k].map(|e| e.derivative(&self.rates));
                let turned = dot(&turned, &link.angular_rows[k]);
                bracket[k] = bracket[k] + frame.dot(q, &a) + dot(gamma, &o) + turned;
            }
        }
        self.add_formal_bracket(&mut bracket);
        bracket
    }

    /// `R·a_α + M_O·o_α` of weight and buoyancy.
    pub fn weights(&self) -> Vec<Expr<'g>> {
        if self.gravity.is_none() {
            return vec![self.graph.zero(); self.speeds.len()];
        }
        let fields = vec![self.gravity; self.links.len()];
        let links = self.weights_in(&fields, Link::displaced);
        self.with_formal_weights(self.projected(&self.gathered(links)), &fields)
    }

    /// Resultant and torque about O, on each link, of a field that is uniform over it; what is displaced is lifted.
    fn weights_in(
        &self,
        fields: &[Option<Triple<'g>>],
        displaced: impl Fn(&Link<'g>) -> Option<(Expr<'g>, Triple<'g>)>,
    ) -> Pairs<'g> {
        let none = [self.graph.zero(); 3];
        let weight = |(link, field): (&Link<'g>, &Option<Triple<'g>>)| {
            let frame = &link.frame;
            let Some(field) = *field else { return (frame.zero(), none) };
            let (mut mass, mut first) = (link.moments.mass, link.moments.first);
            if let Some((displaced, center)) = displaced(link) {
                mass = mass - displaced;
                first = subtract(&first, &scale(displaced, &center));
            }
            let g = frame.space_vector(field);
            let force = g.times(mass);
            let torque = if is_zero(&first) { first } else { cross(&first, &frame.resolve(&g, Axes::Body)) };
            let force = if link.is_alone() { force } else { frame.body_vector(frame.resolve(&force, Axes::Body)) };
            (force, torque.map(Expr::group))
        };
        self.links.iter().zip(fields).map(weight).collect()
    }

    /// 2T = Σ Q·v_O + Γ_O·ω.
    pub fn twice_kinetic_energy(&self) -> Expr<'g> {
        let links = self.links.iter().zip(self.momenta());
        let terms =
            links.map(|(link, (q, gamma))| link.frame.dot(&q, &link.velocity) + dot(&gamma, &link.angular_velocity));
        let links = terms.fold(self.graph.zero(), |sum, e| sum + e);
        self.with_formal_energy(links)
    }
}
