//! A link that nothing else moves with: what its matter amounts to is constant in body axes, and its speeds determine its twist.
//! With V = W z, `A = Wᵀ M W`, so that `A⁻¹ = W⁻¹ M⁻¹ W⁻ᵀ`: the balance is solved in body axes and the accelerations are carried
//! back by the rate of the kinematics, ż = W⁻¹(V̇ − Ẇ z). One body in a chart is the plainest case.

use std::cmp::Ordering;

use crate::algebra::{Expr, Map, Solver};
use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, dot, is_zero, subtract};
use crate::mechanics::links::link::{Link, Matter};
use crate::mechanics::loads::forces::{Action, Element, Force};
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::print::names::Name;
use crate::mechanics::scene::{Coordinate, SystemScene};

use super::balance::{
    ARRANGEMENTS, Arrangement, Balance, Formal, KineticMatrix, LinearAcceleration, Weight, solve_balance,
    twist_of_momentum,
};

/// Terms that a volume of partial angular velocities may have on the way to its normal form.
const VOLUME_LIMIT: usize = 2000;
/// Unknowns that are solved together when z is found from the twist: three angles, at most.
const COUPLED: usize = 3;

/// Linear momentum and the like, in the axes in which the rows of the kinematics are written.
#[derive(Clone, Copy)]
struct Pair<'g> {
    linear: Triple<'g>,
    angular: Triple<'g>,
}

/// A free link: a body, how it moves, and what acts on it.
pub struct FreeLink<'g> {
    /// Which link it is.
    pub link: usize,
    /// Its speeds among those of the system.
    pub block: Vec<usize>,
    pub kinematics: Kinematics<'g>,
    /// Its configuration is given by scalar coordinates.
    pub in_coordinates: bool,
    pub matrix: KineticMatrix<'g>,
    pub weight: Option<Weight<'g>>,
    /// What acts beside weight and buoyancy: its wrench about O.
    load: Wrench<'g>,
    /// Formal arguments: momenta p, and a twist of O in body axes.
    pub momenta: Vec<Expr<'g>>,
    pub twist: [Expr<'g>; 6],
    formal: Formal<'g>,
    /// Axes in which v_O and ω depend on z most simply, and the rows ∂v_O/∂z, ∂ω/∂z there.
    linear_in: Axes,
    angular_in: Axes,
    linear_rows: Vec<Triple<'g>>,
    angular_rows: Vec<Triple<'g>>,
    /// z from the twist, and (Q, Γ) from p: the rows and their transpose, on the motion's axes.
    from_twist: Solver<'g>,
    from_momenta: Solver<'g>,
}

/// What the balance of a body is made of.
#[derive(Clone, Copy)]
struct Terms<'a, 'g> {
    matrix: &'a KineticMatrix<'g>,
    weight: Option<&'a Weight<'g>>,
    load: &'a Wrench<'g>,
    formal: &'a Formal<'g>,
}

/// The chain z → (u, ω) → (Q, Γ_O) → p, each link in terms of the names of the one before; body axes.
pub struct PrintedMomenta<'g> {
    pub twist: [Expr<'g>; 6],
    pub linear: Triple<'g>,
    pub angular: Triple<'g>,
    pub conjugate: Vec<Expr<'g>>,
}

/// ∂v_O/∂z or ∂ω/∂z in the axes in which they vary least, of those that see motion along the given axes alone.
fn rows<'g>(kinematics: &Kinematics<'g>, velocity: &Vector<'g>, axes: &[usize]) -> (Axes, Vec<Triple<'g>>) {
    let in_axes = |axes| -> Vec<Triple<'g>> {
        let resolved = kinematics.frame.resolve(velocity, axes);
        kinematics.speeds.iter().map(|&z| resolved.map(|e| e.partial(z))).collect()
    };
    let (body, space) = (in_axes(Axes::Body), in_axes(Axes::Space));
    let varying = |rows: &[Triple<'g>]| rows.iter().flatten().filter(|e| e.as_number().is_none()).count();
    let natural = if is_zero(&velocity.body) { Axes::Space } else { Axes::Body };
    let sees_others = (0..3).any(|i| !axes.contains(&i) && space.iter().any(|row| !row[i].is_zero()));
    match varying(&space).cmp(&varying(&body)) {
        _ if sees_others => (Axes::Body, body),
        Ordering::Less => (Axes::Space, space),
        Ordering::Equal if natural == Axes::Space => (Axes::Space, space),
        _ => (Axes::Body, body),
    }
}

/// Whether twists with the given components (u, ω) are those of a group of motions: with every axis of rotation and every other
/// axis they have the axis across the two. Only then does the balance along these components say nothing of the others.
fn is_group(active: &[usize]) -> bool {
    let across = |i: usize, j: usize| 3 - i - j;
    let turns = active.iter().filter(|&&k| k >= 3).map(|k| k - 3);
    turns.clone().next().is_some()
        && turns
            .clone()
            .all(|i| active.iter().filter(|&&k| k % 3 != i).all(|&k| active.contains(&(across(i, k % 3) + k / 3 * 3))))
}

/// Kinematics of a link in terms of the speeds that move it alone.
fn own_kinematics<'g>(scene: &SystemScene<'g>, k: usize) -> Option<(Vec<usize>, Kinematics<'g>)> {
    let link = &scene.tree.links[k];
    if !link.is_alone() || !link.works_in_body_axes() {
        return None;
    }
    let block: Vec<usize> = (0..scene.speeds.len()).filter(|&z| link.is_moved_by(z)).collect();
    let heavy = |link: &Link<'g>| !matches!(link.matter, Matter::Nothing);
    let others = scene.tree.links.iter().enumerate().filter(|(other, link)| *other != k && heavy(link));
    if block.is_empty() || others.into_iter().any(|(_, other)| block.iter().any(|&z| other.is_moved_by(z))) {
        return None;
    }
    let at_rest: Map<u32, Expr<'g>> = scene.speeds.iter().map(|z| (z.key(), scene.graph.zero())).collect();
    let moves = |a: &Vector<'g>| a.body.iter().chain(&a.space).any(|e| !e.substitute(&at_rest).is_zero());
    if moves(&link.velocity) || moves(&link.angular_velocity_in_parts) {
        return None;
    }
    let pick = |all: &[Expr<'g>]| -> Vec<Expr<'g>> { block.iter().map(|&z| all[z]).collect() };
    let mut kinematics = Kinematics {
        frame: link.axes(),
        position: link.position,
        speeds: pick(&scene.speeds),
        speed_rates: pick(&scene.speed_rates),
        rates: scene.rates.clone(),
        velocity: link.velocity,
        angular_velocity: link.angular_velocity_in_parts,
        active: Vec::new(),
    };
    let moved = |e: &Expr<'g>| kinematics.speeds.iter().any(|&z| !e.partial(z).is_zero());
    let twist = [&kinematics.velocity, &kinematics.angular_velocity].map(|v| kinematics.frame.resolve(v, Axes::Body));
    let active: Vec<usize> = (0..6).filter(|&i| moved(&twist[i / 3][i % 3])).collect();
    kinematics.active = active;
    (kinematics.active.len() == block.len() && is_group(&kinematics.active)).then_some((block, kinematics))
}

impl<'g> FreeLink<'g> {
    /// All free links of a system.
    pub fn all(scene: &SystemScene<'g>) -> Vec<Self> {
        (0..scene.tree.links.len()).filter_map(|k| Self::new(scene, k)).collect()
    }

    fn new(scene: &SystemScene<'g>, link: usize) -> Option<Self> {
        let graph = scene.graph;
        let body = scene.tree.links[link].body()?;
        let (block, kinematics) = own_kinematics(scene, link)?;
        let (linear, angular) = (kinematics.linear_axes(), kinematics.angular_axes());
        let (linear_in, linear_rows) = rows(&kinematics, &kinematics.velocity, &linear);
        let (angular_in, angular_rows) = rows(&kinematics, &kinematics.angular_velocity, &angular);
        let of_twist: Vec<Vec<Expr<'g>>> = kinematics
            .active
            .iter()
            .map(|&k| {
                let rows = if k < 3 { &linear_rows } else { &angular_rows };
                rows.iter().map(|row| row[k % 3]).collect()
            })
            .collect();
        let transpose = (0..of_twist.len()).map(|j| of_twist.iter().map(|row| row[j]).collect()).collect();
        let from_twist = Solver::with_blocks_up_to(of_twist, COUPLED)?;
        let from_momenta = Solver::with_blocks_up_to(transpose, COUPLED)?;
        let angular_axes: Vec<usize> = angular.iter().map(|k| k + 3).collect();
        let matrix = KineticMatrix::new(graph, body, &linear, &angular_axes);
        let weight = Weight::new(body);
        let nothing = Wrench::zero(graph);
        let formal = Formal::new(&kinematics, &nothing);
        let twist = std::array::from_fn(|k| {
            let name = if k < 3 { Name::new("u", "u") } else { Name::new("ω", "\\omega") }.index(k % 3);
            graph.symbol(name.text, name.latex, false)
        });
        let momenta = block.iter().map(|&z| scene.momenta[z]).collect();
        let mut free = Self {
            link,
            block,
            from_twist,
            from_momenta,
            kinematics,
            in_coordinates: scene.coordinates.iter().all(|q| matches!(q, Coordinate::Scalar(_))),
            matrix,
            weight,
            load: nothing,
            momenta,
            twist,
            formal,
            linear_in,
            angular_in,
            linear_rows,
            angular_rows,
        };
        if !scene.elements.is_empty() {
            let wrenches = scene.elements.iter().map(|element| free.wrench_of(scene, element));
            free.load = wrenches.fold(nothing, |sum, wrench| sum.plus(&wrench));
            free.formal = Formal::new(&free.kinematics, &free.load);
        }
        Some(free)
    }

    /// The wrench of an element on this link: by what is known of it, by the derivatives of a potential along the pose, else as the dual
    /// of its generalised forces.
    pub fn wrench_of(&self, scene: &SystemScene<'g>, element: &Element<'g>) -> Wrench<'g> {
        let nothing = Wrench::zero(scene.graph);
        if let Some((link, wrench)) = &element.on_link {
            return if *link == self.link { *wrench } else { nothing };
        }
        match &element.action {
            Action::Potential(potential) => self.along_pose(scene, *potential).unwrap_or_else(|| {
                let power = potential.derivative(&scene.rates);
                self.dual(self.kinematics.speeds.iter().map(|&z| -power.partial(z)).collect())
            }),
            Action::Forces(forces) => {
                let wrenches = forces.iter().map(|force| match force {
                    Force::OnLink { link, .. } if *link == self.link => {
                        force.wrench(&self.kinematics.frame).unwrap_or(nothing)
                    }
                    Force::OnLink { .. } => self.dual(self.of_block(&scene.tree.loads(&[*force]))),
                    _ => match force.generalised(&scene.speeds, &scene.rates) {
                        Some(rows) => self.dual(self.of_block(&rows)),
                        None => nothing,
                    },
                });
                wrenches.fold(nothing, |sum, wrench| sum.plus(&wrench))
            }
        }
    }

    fn of_block(&self, rows: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.block.iter().map(|&z| rows[z]).collect()
    }

    /// The wrench with the given generalised forces.
    fn dual(&self, forces: Vec<Expr<'g>>) -> Wrench<'g> {
        if forces.iter().all(|e| e.is_zero()) {
            return Wrench::zero(self.kinematics.frame.graph);
        }
        let pair = self.momentum_pair(&forces);
        Wrench { force: self.vector(self.linear_in, pair.linear), torque: self.vector(self.angular_in, pair.angular) }
    }

    /// Whether the coordinate is its pose.
    pub fn is_placed_by(&self, coordinate: &Coordinate<'g>) -> bool {
        let (rotation, position) = (&self.kinematics.frame.rotation, &self.kinematics.position);
        match coordinate {
            Coordinate::Pose(own, b) => own == rotation && b == position,
            Coordinate::Rotation(own) => own == rotation && is_zero(position),
            _ => false,
        }
    }

    /// The wrench of a potential, where the pose of the link is a coordinate: `−∂U/∂b`, and −∂U along the turns about the body's axes.
    fn along_pose(&self, scene: &SystemScene<'g>, potential: Expr<'g>) -> Option<Wrench<'g>> {
        let frame = &self.kinematics.frame;
        scene.coordinates.iter().find(|coordinate| self.is_placed_by(coordinate))?;
        let zero = scene.graph.zero();
        let moved = self.kinematics.position.map(|b| if b.is_zero() { zero } else { -potential.partial(b) });
        let by_entries = frame.rotation.map(|row| row.map(|entry| potential.partial(entry)));
        let turned = std::array::from_fn(|axis| {
            let unit: Triple<'g> = std::array::from_fn(|i| if i == axis { scene.graph.one() } else { zero });
            let rates = frame.rotation.map(|row| cross(&row, &unit));
            let terms = by_entries.iter().flatten().zip(rates.iter().flatten()).map(|(d, rate)| *d * *rate);
            -terms.sum::<Expr<'g>>()
        });
        Some(Wrench { force: frame.space_vector(moved), torque: frame.body_vector(turned) })
    }

    /// Whether the speeds are components of the twist about O, in body or in observer's axes.
    pub fn has_constant_rows(&self) -> bool {
        self.linear_rows.iter().chain(&self.angular_rows).flatten().all(|e| e.as_number().is_some())
    }

    /// The balance in all the ways that are worth trying.
    pub fn balances(&self) -> Vec<Balance<'g>> {
        let mut balances = Vec::from(ARRANGEMENTS.map(|arrangement| self.balance(arrangement)));
        if self.adds_momentum() {
            balances.push(self.balance(Arrangement::Whole));
        }
        if self.matrix.is_coupled(&self.kinematics.active) {
            balances.push(self.balance(Arrangement::Eliminated));
        }
        balances
    }

    /// ∂C/∂ż without what acts beside weight and buoyancy, arranged in two ways.
    pub fn inertial_residuals(&self) -> Vec<Vec<Expr<'g>>> {
        let load = Wrench::zero(self.kinematics.frame.graph);
        let formal = Formal::new(&self.kinematics, &load);
        let terms = Terms { load: &load, formal: &formal, ..self.terms() };
        let residual = |arrangement| {
            let Terms { matrix, weight, load, formal } = terms;
            self.residual_of(&terms, &solve_balance(&self.kinematics, matrix, weight, load, formal, arrangement))
        };
        [Arrangement::Structured, Arrangement::Collected].map(residual).into()
    }

    /// `R·a_α + M_O·o_α` of what acts beside weight and buoyancy.
    pub fn load_forces(&self) -> Vec<Expr<'g>> {
        self.project_wrench(&self.load)
    }

    /// Whether Q has parts of u and of ω that turn together: then their sum is turned once.
    fn adds_momentum(&self) -> bool {
        let coupled = || (0..3).any(|i| (3..6).any(|j| !self.matrix.entries[i][j].is_zero()));
        self.matrix.isotropic.is_some() && self.linear_in == Axes::Body && coupled()
    }

    /// `R·a_α + M_O·o_α` of a wrench about O.
    pub fn project_wrench(&self, wrench: &Wrench<'g>) -> Vec<Expr<'g>> {
        let pair = self.resolve(&wrench.force, &wrench.torque);
        self.project(Pair { linear: pair.linear.map(Expr::group), angular: pair.angular.map(Expr::group) })
    }

    /// `None` where the coordinates have no singularity: the volume that the columns of ∂ω/∂q̇ span is constant.
    pub fn regularity(&self) -> Option<Vec<Expr<'g>>> {
        let columns: Vec<&Triple<'g>> = self.angular_rows.iter().filter(|column| !is_zero(column)).collect();
        let [a, b, c] = columns[..] else { return None };
        let volume = dot(a, &cross(b, c)).collected(VOLUME_LIMIT);
        let lengths = [a, b, c].map(|column| dot(column, column).collected(VOLUME_LIMIT));
        let product = lengths[0] * lengths[1] * lengths[2];
        let ratio = (volume * volume * product.recip()).collected(VOLUME_LIMIT);
        ratio.as_number().is_none().then(|| vec![volume, product])
    }

    fn in_body(&self, a: &Vector<'g>) -> Triple<'g> {
        self.kinematics.frame.resolve(a, Axes::Body).map(Expr::group)
    }

    fn zero(&self) -> Triple<'g> {
        [self.kinematics.frame.graph.zero(); 3]
    }

    /// `Σ linear_k ∂v_k/∂z^α + angular_k ∂ω_k/∂z^α` for every α: pairs what is dual to the twist with a_α and o_α.
    fn project(&self, dual: Pair<'g>) -> Vec<Expr<'g>> {
        self.linear_rows
            .iter()
            .zip(&self.angular_rows)
            .map(|(a, o)| dot(a, &dual.linear) + dot(o, &dual.angular))
            .collect()
    }

    /// z from the twist (or ż from its rate): solves `Σ_α (a_α, o_α) z^α = right` on the motion's axes.
    fn lift(&self, right: Pair<'g>) -> Vec<Expr<'g>> {
        let on = |&k: &usize| if k < 3 { right.linear[k] } else { right.angular[k - 3] };
        self.from_twist.solve(&self.kinematics.active.iter().map(on).collect::<Vec<_>>())
    }

    /// The dual of `lift`: (Q, Γ) from p.
    fn momentum_pair(&self, p: &[Expr<'g>]) -> Pair<'g> {
        let mut pair = Pair { linear: self.zero(), angular: self.zero() };
        for (&k, value) in self.kinematics.active.iter().zip(self.from_momenta.solve(p)) {
            if k < 3 { pair.linear[k] = value } else { pair.angular[k - 3] = value }
        }
        pair
    }

    fn vector(&self, axes: Axes, a: Triple<'g>) -> Vector<'g> {
        match axes {
            Axes::Body => self.kinematics.frame.body_vector(a),
            Axes::Space => self.kinematics.frame.space_vector(a),
        }
    }

    /// Components in the axes of the rows.
    fn resolve(&self, linear: &Vector<'g>, angular: &Vector<'g>) -> Pair<'g> {
        let frame = &self.kinematics.frame;
        Pair { linear: frame.resolve(linear, self.linear_in), angular: frame.resolve(angular, self.angular_in) }
    }

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
        self.project(self.momentum_of_speeds())
    }

    /// `Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α` as a function of (q, z).
    pub fn bracket_in_speeds(&self) -> Vec<Expr<'g>> {
        self.bracket(self.momentum_of_speeds())
    }

    /// From (q, p): (Q, Γ) by duality, the twist by M⁻¹, z by the kinematics.
    fn state_of_momentum(&self, arrangement: Arrangement) -> (Pair<'g>, Vec<Expr<'g>>) {
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

    /// How (u, ω) is found from (Q, Γ).
    fn solutions(&self) -> impl Iterator<Item = Arrangement> {
        let coupled = self.matrix.is_coupled(&self.kinematics.active);
        [Arrangement::Structured].into_iter().chain(coupled.then_some(Arrangement::Eliminated))
    }

    /// ṗ_α = Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α + R·a_α + M_O·o_α, a function of (q, p), in the ways that are worth trying: `others` are the
    /// other speeds of the system in terms of their momenta.
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

    /// ∂C/∂ż with what cancels gone.
    pub fn collected_residual(&self) -> Vec<Expr<'g>> {
        self.residual(&self.balance(Arrangement::Collected))
    }

    /// R·a_α + M_O·o_α.
    pub fn generalised_forces(&self) -> Vec<Expr<'g>> {
        let frame = &self.kinematics.frame;
        let pair = match &self.weight {
            Some(w) => Pair {
                linear: frame.resolve(&w.resultant(frame), self.linear_in),
                angular: w.torque(frame, self.angular_in),
            },
            None => Pair { linear: self.zero(), angular: self.zero() },
        };
        let load = self.resolve(&self.load.force, &self.load.torque);
        let named = |a: &Triple<'g>, b: &Triple<'g>| if is_zero(b) { *a } else { add(a, &b.map(Expr::group)) };
        self.project(Pair { linear: named(&pair.linear, &load.linear), angular: named(&pair.angular, &load.angular) })
    }

    fn balance(&self, arrangement: Arrangement) -> Balance<'g> {
        solve_balance(&self.kinematics, &self.matrix, self.weight.as_ref(), &self.load, &self.formal, arrangement)
    }

    /// ż from the balance in body axes, through the rate of the kinematics.
    pub fn acceleration(&self, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let real = self.formal.realisation(kinematics, self.weight.as_ref(), &self.load);
        let realise = |e: Expr<'g>| e.substitute(&real);
        let angular = frame.body_vector(balance.angular.map(realise).map(Expr::group));
        let velocity = frame.resolve(&kinematics.velocity, self.linear_in);
        let omega = frame.resolve(&kinematics.angular_velocity, self.angular_in);
        // Rates of the components for ż = 0 go to the right-hand side.
        let still = |a: &Triple<'g>| a.map(|e| e.derivative(&kinematics.rates));
        let in_body = |a: &Vector<'g>| self.in_body(a);
        let linear = match (&balance.linear, self.linear_in) {
            (LinearAcceleration::Observed(a), Axes::Space) => frame.resolve(&a.map(realise), Axes::Space),
            (LinearAcceleration::Observed(a), Axes::Body) => {
                let drift = cross(&in_body(&kinematics.angular_velocity), &in_body(&kinematics.velocity));
                subtract(&frame.resolve(&a.map(realise), Axes::Body), &drift)
            }
            (LinearAcceleration::Relative(a), Axes::Body) => a.map(realise),
            (LinearAcceleration::Relative(a), Axes::Space) => {
                let drift = cross(&in_body(&kinematics.angular_velocity), &in_body(&kinematics.velocity));
                frame.resolve(&frame.body_vector(add(&a.map(realise), &drift)), Axes::Space)
            }
        };
        let angular = frame.resolve(&angular, self.angular_in);
        let right = Pair { linear: subtract(&linear, &still(&velocity)), angular: subtract(&angular, &still(&omega)) };
        self.lift(right)
    }

    /// A: the upper triangle is derived, ∂p_α/∂z^β, and mirrored.
    pub fn mass_matrix(&self, momentum: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let n = momentum.len();
        let speeds = &self.kinematics.speeds;
        let mut matrix = vec![self.kinematics.frame.graph.zero(); n * n];
        for row in 0..n {
            for column in row..n {
                let entry = momentum[row].partial(speeds[column]);
                matrix[row * n + column] = entry;
                matrix[column * n + row] = entry;
            }
        }
        matrix
    }

    /// T, as ½ (Q·v_O + Γ_O·ω) and as ½ p·z.
    pub fn kinetic_energies(&self) -> [Expr<'g>; 2] {
        let terms = self.momentum().into_iter().zip(&self.kinematics.speeds).map(|(p, z)| p.group() * *z);
        [self.kinetic_energy(), terms.sum::<Expr<'g>>().half()]
    }

    /// T = ½ (Q·v_O + Γ_O·ω).
    pub fn kinetic_energy(&self) -> Expr<'g> {
        let frame = &self.kinematics.frame;
        let (u, omega) = (self.in_body(&self.kinematics.velocity), self.in_body(&self.kinematics.angular_velocity));
        let q = self.matrix.linear_momentum(frame, &self.kinematics.velocity, &omega).map(Expr::group);
        let spin = &self.kinematics.angular_velocity;
        let gamma = self.matrix.angular_momentum_vector(frame, &u, spin, &omega).map(Expr::group);
        (frame.dot(&q, &self.kinematics.velocity) + frame.dot(&gamma, spin)).half()
    }

    /// Of weight and buoyancy.
    pub fn potential_energy(&self) -> Expr<'g> {
        let frame = &self.kinematics.frame;
        self.weight.as_ref().map_or(frame.graph.zero(), |w| w.potential(frame, &self.kinematics.position))
    }

    /// The wrench of weight and buoyancy.
    pub fn weight_wrench(&self) -> Option<Wrench<'g>> {
        let frame = &self.kinematics.frame;
        self.weight.as_ref().map(|w| Wrench {
            force: w.resultant(frame),
            torque: self.vector(self.angular_in, w.torque(frame, self.angular_in)),
        })
    }

    /// The power of a wrench.
    pub fn power(&self, wrench: &Wrench<'g>) -> Expr<'g> {
        let kinematics = &self.kinematics;
        kinematics.frame.dot(&wrench.force.map(Expr::group), &kinematics.velocity)
            + kinematics.frame.dot(&wrench.torque.map(Expr::group), &kinematics.angular_velocity)
    }

    /// ∂C/∂ż: `(dQ/dt − R)·a_α + (dΓ_O/dt + v_O × Q − M_O)·o_α` at a given ż.
    pub fn residual(&self, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        self.residual_of(&self.terms(), balance)
    }

    fn terms(&self) -> Terms<'_, 'g> {
        Terms { matrix: &self.matrix, weight: self.weight.as_ref(), load: &self.load, formal: &self.formal }
    }

    fn residual_of(&self, terms: &Terms<'_, 'g>, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let real = terms.formal.realisation(kinematics, terms.weight, terms.load);
        let bias = |a: Triple<'g>| a.map(|e| e.substitute(&real));
        let along = kinematics.rates_with_accelerations();
        let omega = &kinematics.angular_velocity;
        let a = frame.derivative(&kinematics.velocity, &along, omega).map(Expr::group);
        let angular_rate = frame.resolve(omega, self.angular_in).map(|e| e.derivative(&along).group());
        let alpha = self.in_body(&self.vector(self.angular_in, angular_rate));
        let drift = cross(&self.in_body(omega), &self.in_body(&kinematics.velocity));
        let coupling = terms.matrix.block(0, 3, &alpha);
        let (linear, u_rate) = match terms.matrix.isotropic {
            Some(mu) => {
                let weight = terms.weight.map_or(frame.zero(), |w| w.resultant(frame));
                let weight = weight.plus(&frame.space_vector(terms.load.force.space));
                let in_body = add(&coupling, &bias(balance.linear_bias));
                (a.times(mu).plus(&frame.body_vector(in_body)).minus(&weight), self.in_body(&a))
            }
            None => {
                let u_rate = match self.linear_in {
                    Axes::Body => frame.resolve(&kinematics.velocity, Axes::Body).map(|e| e.derivative(&along)),
                    Axes::Space => subtract(&self.in_body(&a), &drift).map(Expr::group),
                };
                let inertia = add(&terms.matrix.block(0, 0, &u_rate), &coupling);
                (frame.body_vector(add(&inertia, &bias(balance.linear_bias))), u_rate)
            }
        };
        let angular = add(&terms.matrix.angular_momentum(&u_rate, &alpha), &bias(balance.angular_bias));
        let linear = linear.map(Expr::group);
        self.project(self.resolve(&linear, &frame.body_vector(angular.map(Expr::group))))
    }
}
