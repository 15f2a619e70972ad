//! A link that nothing else moves with: what its matter amounts to is constant in body axes, and its speeds determine
//! its twist. With V = W z, `A = Wᵀ M W`, so that `A⁻¹ = W⁻¹ M⁻¹ W⁻ᵀ`: the balance is solved in body axes and the
//! accelerations are carried back by the rate of the kinematics, ż = W⁻¹(V̇ − Ẇ z). One body in a chart is the plainest
//! case.

use std::cell::OnceCell;
use std::cmp::Ordering;

mod loads;
mod momenta;

use crate::algebra::{Expr, Map, NodeView, Solver, Substitution};
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, add, cross, dot, is_zero, subtract};
use crate::mechanics::links::link::Matter;
use crate::mechanics::loads::forces::Loads;
use crate::mechanics::loads::wrench::Wrench;
use crate::mechanics::matter::weight::Weight;
use crate::mechanics::name::Name;
use crate::mechanics::scene::SystemScene;
use crate::mechanics::tidy::sums;

use crate::mechanics::arrangements::balance::{
    ARRANGEMENTS, Balance, BalanceForm, FormalComponents, KineticMatrix, LinearAcceleration, Weights, solve_balance,
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

/// A free link: a body, its kinematics, and its loads.
pub struct FreeLink<'g> {
    /// Which link it is.
    pub link: usize,
    /// Its speeds among those of the system.
    pub block: Vec<usize>,
    pub kinematics: Kinematics<'g>,
    /// Its configuration is given by scalar coordinates.
    pub in_coordinates: bool,
    pub matrix: KineticMatrix<'g>,
    pub weights: Weights<'g>,
    /// Load beside the weights: its wrench about O.
    load: Wrench<'g>,
    /// Formal arguments: momenta p, and a twist of O in body axes.
    pub momenta: Vec<Expr<'g>>,
    pub twist: [Expr<'g>; 6],
    formal: FormalComponents<'g>,
    /// Axes in which v_O and ω depend on z most simply, and the rows ∂v_O/∂z, ∂ω/∂z there.
    linear_in: Axes,
    angular_in: Axes,
    linear_rows: Vec<Triple<'g>>,
    angular_rows: Vec<Triple<'g>>,
    /// z from the twist, and (Q, Γ) from p: the rows and their transpose, on the motion's axes.
    from_twist: Solver<'g>,
    from_momenta: Solver<'g>,
    formed: BalanceCache<'g>,
}

/// Parts that several equations share, formed when the first of them needs them.
#[derive(Default)]
struct BalanceCache<'g> {
    /// Values of the formal components of the balance.
    realisation: OnceCell<Substitution<'g>>,
    balances: OnceCell<Vec<Balance<'g>>>,
    collected_residual: OnceCell<Vec<Expr<'g>>>,
    momentum: OnceCell<Vec<Expr<'g>>>,
}

/// Terms of the balance of a body.
#[derive(Clone, Copy)]
struct Terms<'a, 'g> {
    matrix: &'a KineticMatrix<'g>,
    weights: &'a Weights<'g>,
    load: &'a Wrench<'g>,
    /// Values of the formal components of the balance.
    realisation: &'a Substitution<'g>,
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

/// Whether twists with the given components (u, ω) are those of a group of motions: with every axis of rotation and
/// every other axis they have the axis across the two. Only then does the balance along these components say nothing of
/// the others.
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
    let links = &scene.tree.links;
    let heavy = |&other: &usize| other != k && !matches!(links[other].matter, Matter::Nothing);
    // What moves a frame moves the matter that hangs on it.
    let with_ancestors = |other: usize| std::iter::successors(Some(other), |&at| links[at].parent);
    let mut moving = (0..links.len()).filter(heavy).flat_map(with_ancestors);
    let geared = |&z: &usize| {
        let speed = scene.speeds[z];
        scene.tree.is_geared(speed) || scene.tree.moves_what_deforms(speed)
    };
    let others_too = moving.any(|at| block.iter().any(|&z| links[at].is_moved_by(z)));
    if block.is_empty() || block.iter().any(geared) || others_too {
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
        let weights = Weights { gravity: Weight::new(body), field: None };
        let nothing = Wrench::zero(graph);
        let formal = FormalComponents::new(&kinematics, &nothing);
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
            weights,
            load: nothing,
            momenta,
            twist,
            formal,
            linear_in,
            angular_in,
            linear_rows,
            angular_rows,
            formed: BalanceCache::default(),
        };
        if !scene.elements.is_empty() {
            let wrenches = scene.elements.iter().map(|element| free.wrench_of(scene, element));
            free.load = wrenches.fold(nothing, |sum, wrench| sum.plus(&wrench));
            free.formal = FormalComponents::new(&free.kinematics, &free.load);
            let root = scene.tree.root_of(link);
            let field = Loads::of(&scene.elements).field_on(root);
            free.weights.field = field.map(|gravity| Weight::of_matter(body, gravity));
        }
        Some(free)
    }

    /// Whether the speeds are components of the twist about O, in body or in observer's axes.
    pub fn has_constant_rows(&self) -> bool {
        self.linear_rows.iter().chain(&self.angular_rows).flatten().all(|e| e.as_number().is_some())
    }

    /// Forgets what was formed.
    pub fn forget(&mut self) {
        self.formed = BalanceCache::default();
    }

    /// The balance in all the ways that are worth trying.
    pub fn balances(&self) -> &[Balance<'g>] {
        self.formed.balances.get_or_init(|| {
            let mut balances = Vec::from(ARRANGEMENTS.map(|arrangement| self.balance(arrangement)));
            if self.adds_momentum() {
                balances.push(self.balance(BalanceForm::Whole));
            }
            if self.matrix.is_coupled(&self.kinematics.active) {
                balances.push(self.balance(BalanceForm::Eliminated));
            }
            balances
        })
    }

    /// ∂C/∂ż without the loads other than weight and buoyancy, arranged in two ways.
    pub fn inertial_residuals(&self) -> Vec<Vec<Expr<'g>>> {
        let load = Wrench::zero(self.kinematics.frame.graph);
        let formal = FormalComponents::new(&self.kinematics, &load);
        let (matrix, weights) = (&self.matrix, &Weights { gravity: self.weights.gravity, field: None });
        let realisation = OnceCell::new();
        let residual = |arrangement| {
            let balance = solve_balance(&self.kinematics, matrix, weights, &load, &formal, arrangement);
            let realisation = realisation.get_or_init(|| formal.realisation(&self.kinematics, weights, &load));
            self.residual_of(&Terms { matrix, weights, load: &load, realisation }, &balance)
        };
        [BalanceForm::Structured, BalanceForm::Collected].map(residual).into()
    }

    /// `R·a_α + M_O·o_α` of the loads other than weight and buoyancy.
    pub fn load_forces(&self) -> Vec<Expr<'g>> {
        let rows = self.project_wrench(&self.load);
        let field = self.weights.field.map(|field| self.project_wrench(&self.wrench_of_weight(&field)));
        field.map_or(rows.clone(), |field| sums(&rows, &field))
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

    /// A numerator, and the square of its denominator; `None` where the coordinates have no singularity.
    ///
    /// Where the volume that the columns of ∂ω/∂q̇ span is a power D⁻ᵏ of one sum, coordinates become infinite where it
    /// vanishes: those of Rodrigues with D = 1 + |g|² and k = 2, the modified ones with D = 1 + |σ|² and k = 3. D then
    /// grows as the square of their size, and that as the reciprocal of the distance from the singularity: it is 1/√D.
    /// Else it is the volume over the lengths of the columns, 0 where these lie in a plane.
    pub fn regularity(&self) -> Option<Vec<Expr<'g>>> {
        let columns: Vec<&Triple<'g>> = self.angular_rows.iter().filter(|column| !is_zero(column)).collect();
        let [a, b, c] = columns[..] else { return None };
        let volume = dot(a, &cross(b, c)).collected(VOLUME_LIMIT);
        if let NodeView::Product(factors) = volume.split_coefficient().1.view()
            && let [(sum, ..0)] = factors[..]
        {
            return Some(vec![volume.graph().one(), sum]);
        }
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

    /// ∂C/∂ż in the two ways that are worth trying.
    pub fn residuals(&self) -> [Vec<Expr<'g>>; 2] {
        [self.residual(&self.balances()[0]), self.collected_residual()]
    }

    /// ∂C/∂ż with what cancels gone.
    pub fn collected_residual(&self) -> Vec<Expr<'g>> {
        let collected = || self.residual(&self.balances()[1]);
        self.formed.collected_residual.get_or_init(collected).clone()
    }

    /// R·a_α + M_O·o_α.
    pub fn generalised_forces(&self) -> Vec<Expr<'g>> {
        let frame = &self.kinematics.frame;
        let pair = Pair {
            linear: frame.resolve(&self.weights.resultant(frame), self.linear_in),
            angular: self.weights.torque(frame, self.angular_in),
        };
        let load = self.resolve(&self.load.force, &self.load.torque);
        let named = |a: &Triple<'g>, b: &Triple<'g>| if is_zero(b) { *a } else { add(a, &b.map(Expr::group)) };
        self.project(Pair { linear: named(&pair.linear, &load.linear), angular: named(&pair.angular, &load.angular) })
    }

    fn balance(&self, arrangement: BalanceForm) -> Balance<'g> {
        solve_balance(&self.kinematics, &self.matrix, &self.weights, &self.load, &self.formal, arrangement)
    }

    /// ż from the balance in body axes, through the rate of the kinematics.
    pub fn acceleration(&self, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let real = self.realisation();
        let realise = |e: Expr<'g>| real.of(e);
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

    /// Potential energy of weight and buoyancy.
    pub fn potential_energy(&self) -> Expr<'g> {
        let frame = &self.kinematics.frame;
        self.weights.gravity.map_or(frame.graph.zero(), |w| w.potential(frame, &self.kinematics.position))
    }

    /// The wrench of weight and buoyancy.
    pub fn weight_wrench(&self) -> Option<Wrench<'g>> {
        self.weights.gravity.map(|weight| self.wrench_of_weight(&weight))
    }

    fn wrench_of_weight(&self, weight: &Weight<'g>) -> Wrench<'g> {
        let frame = &self.kinematics.frame;
        let torque = self.vector(self.angular_in, weight.torque(frame, self.angular_in));
        Wrench { force: weight.resultant(frame), torque }
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
        let (weights, realisation) = (&self.weights, self.realisation());
        Terms { matrix: &self.matrix, weights, load: &self.load, realisation }
    }

    fn realisation(&self) -> &Substitution<'g> {
        let real = || self.formal.realisation(&self.kinematics, &self.weights, &self.load);
        self.formed.realisation.get_or_init(real)
    }

    fn residual_of(&self, terms: &Terms<'_, 'g>, balance: &Balance<'g>) -> Vec<Expr<'g>> {
        let kinematics = &self.kinematics;
        let frame = &kinematics.frame;
        let bias = |a: Triple<'g>| a.map(|e| terms.realisation.of(e));
        let along = kinematics.rates_with_accelerations();
        let omega = &kinematics.angular_velocity;
        let a = frame.derivative(&kinematics.velocity, &along, omega).map(Expr::group);
        let angular_rate = frame.resolve(omega, self.angular_in).map(|e| e.derivative(&along).group());
        let alpha = self.in_body(&self.vector(self.angular_in, angular_rate));
        let drift = cross(&self.in_body(omega), &self.in_body(&kinematics.velocity));
        let coupling = terms.matrix.block(0, 3, &alpha);
        let (linear, u_rate) = match terms.matrix.isotropic {
            Some(mu) => {
                let weight = terms.weights.resultant(frame).plus(&frame.space_vector(terms.load.force.space));
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
