//! Systems of bodies and particles: the Gauss condition (3.3), (3.4) summed over all of them,
//! and every method of their kernels.

mod accounts;
mod arranged;
pub mod elimination;
mod response;

use std::cell::OnceCell;

use crate::algebra::{Expr, Map, solve_pairs, solve_symmetric};

use crate::mechanics::arrangements::articulated::Articulated;
use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::arrangements::halves::Halves;
use crate::mechanics::arrangements::orthogonal::Elements;
use crate::mechanics::constraints::contact_rows::Contacts;
use crate::mechanics::constraints::multipliers::Constraints;
use crate::mechanics::formula::{Formula, Formulas, Method};
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::vector::{Vector, is_zero};
use crate::mechanics::links::inertia::Inertia;
use crate::mechanics::links::link::Link;
use crate::mechanics::links::tree::{Tree, UngatheredResidual};
use crate::mechanics::links::working::WorkingTree;
use crate::mechanics::loads::account::account_formulas;
use crate::mechanics::loads::forces::{Action, Force, Loads, forces_of, potential_of, potential_of_forces};
use crate::mechanics::scene::SystemScene;
use crate::mechanics::tidy::{compact, sums, tidy};

/// Degrees of freedom up to which a factorisation of A can cost less than an elimination link by link.
pub const DENSE: usize = 10;
/// Degrees of freedom up to which C is also orthogonalised as a sum of squares, and where a link floats, which may be
/// light: its program grows with their square, and beyond that would be a third of the time of an expansion.
const SQUARES: [usize; 2] = [6, 12];

/// A system with what its equations are made of.
pub struct System<'g> {
    pub scene: SystemScene<'g>,
    /// Potential and forces of all elements together.
    pub potential: Option<Expr<'g>>,
    pub forces: Vec<Force<'g>>,
    /// Loads on links, fields among them.
    pub(in crate::mechanics) loads: Loads<'g>,
    /// The links about other poles, where that is shorter.
    working: Option<WorkingTree<'g>>,
    /// The links in their own axes for sums of squares, where they work in those of the observer: differences of angles
    /// do not come in.
    in_own_axes: Option<Tree<'g>>,
    pub constraints: Constraints<'g>,
    pub contacts: Contacts<'g>,
    /// Links that nothing else moves with.
    pub free: Vec<FreeLink<'g>>,
    /// Something is moved as a function of time: velocities, or what constraints say of them, do not vanish with z.
    pub driven: bool,
    /// Rates of t and q, and those with ż.
    pub along: Map<u32, Expr<'g>>,
    /// A.
    pub matrix: Vec<Vec<Expr<'g>>>,
    /// Factors of A⁻¹Wᵀ, computed on first use.
    halves: OnceCell<Option<Halves<'g>>>,
}

/// One way to form the equations; the cheapest wins.
struct EquationForm<'g> {
    matrix: Vec<Vec<Expr<'g>>>,
    /// ∂C/∂ż at ż = 0, and at any ż.
    still: Vec<Expr<'g>>,
    residual: Vec<Expr<'g>>,
    /// ∂C/∂ż at ż = ζ, and ζ.
    floating: [Vec<Expr<'g>>; 2],
}

impl<'g> System<'g> {
    /// System of a scene whose equations are only written down, not solved: A is not formed.
    pub fn unsolved(scene: SystemScene<'g>) -> Self {
        let mut along = scene.rates.clone();
        along.extend(scene.speeds.iter().zip(&scene.speed_rates).map(|(z, rate)| (z.key(), *rate)));
        let constraints = Constraints::new(&scene, &scene.rates);
        let contacts = Contacts::new(&scene);
        let (potential, forces) = (potential_of(&scene.elements), forces_of(&scene.elements));
        let loads = Loads::of(&scene.elements);
        Self {
            scene,
            potential,
            forces,
            loads,
            working: None,
            in_own_axes: None,
            constraints,
            contacts,
            free: Vec::new(),
            driven: false,
            along,
            matrix: Vec::new(),
            halves: OnceCell::new(),
        }
    }

    pub fn new(scene: SystemScene<'g>) -> Self {
        let mut system = Self::unsolved(scene);
        let (scene, loads) = (&system.scene, &system.loads);
        system.free = FreeLink::all(scene);
        // Where sums of squares keep the digits, other links stay as they were given: little is to be gained there.
        let short = scene.speeds.len() <= most_squares(scene);
        system.working =
            if short { WorkingTree::of_rotors(&scene.tree, loads) } else { WorkingTree::of(&scene.tree, loads) };
        system.in_own_axes = if short { scene.tree.in_own_axes() } else { None };
        system.matrix = system.mass_matrix();
        let at_rest = system.at_rest();
        let mut velocities = system.constraints.on_velocities.clone();
        // The velocities of a free link are homogeneous in its speeds.
        if system.balance_of_all().is_none() {
            velocities.extend(system.momentum());
            velocities.push(system.scene.tree.twice_kinetic_energy());
        }
        // Places of forces that the time moves take energy in and out as well, whether they have mass or not.
        let scene = &system.scene;
        for element in &scene.elements {
            if let Action::Forces(forces) = &element.action {
                velocities.extend(forces.iter().flat_map(|force| force.velocities(&scene.tree.links, &scene.rates)));
            }
        }
        // What has no value at rest does not vanish there.
        let moves = |e: &Expr<'g>| !tidy(e.substitute(&at_rest)).is_zero();
        system.driven = velocities.iter().any(|e| system.scene.graph.defined(|| moves(e)).unwrap_or(true));
        system
    }

    /// Leaves out constraints, by their numbers, that follow from the others.
    pub fn leave_out(&mut self, needless: &[usize]) {
        let mut number = 0..;
        self.scene.constraints.retain(|_| number.next().is_some_and(|k| !needless.contains(&k)));
        self.constraints = Constraints::new(&self.scene, &self.scene.rates);
    }

    fn mass_matrix(&self) -> Vec<Vec<Expr<'g>>> {
        if let Some(body) = self.balance_of_all().filter(|_| self.constraints.is_empty()) {
            let entries = body.mass_matrix(&body.momentum());
            return entries.chunks(self.scene.speeds.len()).map(<[Expr<'g>]>::to_vec).collect();
        }
        grouped(&self.tree().mass_matrix())
    }

    /// Forgets what is kept for later because several equations are made of it.
    pub fn forget(&mut self) {
        self.free.iter_mut().for_each(FreeLink::forget);
    }

    /// The free link whose balance is that of the whole system: its only link, moved by all speeds. Equations are then
    /// formed in its body axes, and not as sums over links.
    pub fn balance_of_all(&self) -> Option<&FreeLink<'g>> {
        match self.free.as_slice() {
            [body] if body.block.len() == self.scene.speeds.len() && self.scene.tree.links.len() == 1 => Some(body),
            _ => None,
        }
    }

    /// Whether ∂C/∂ż is the sum over links and nothing else: without multipliers, and not the balance of one free link.
    pub fn is_sum_over_links(&self) -> bool {
        self.constraints.is_empty() && self.balance_of_all().is_none()
    }

    pub fn formulas(&self) -> Formulas<'g> {
        let mut formulas = self.arranged();
        formulas.extend(self.formulas_by_pose());
        if !self.constraints.is_empty() {
            formulas.extend(self.constraint_formulas());
        }
        formulas.extend(account_formulas(&self.accounts(), self.explicit_power()));
        formulas.extend(self.contact_formulas(&formulas.acceleration));
        formulas.others.sort_by_key(|(method, _)| *method);
        formulas
    }

    /// The methods for constraints: multipliers, residuals, corrections.
    pub fn constraint_formulas(&self) -> Vec<Formula<'g>> {
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let multipliers = self.arrangements().iter().map(|a| self.acceleration(a).1).collect();
        let correction = self.constraints.position_correction(&self.matrix);
        vec![
            Formula { method: Method::Multipliers, arrangements: multipliers },
            single(Method::PositionResidual, self.constraints.on_positions()),
            single(Method::VelocityResidual, self.constraints.on_velocities.clone()),
            single(Method::PositionCorrection, self.moved_by(&correction)),
            single(Method::VelocityCorrection, self.constraints.velocity_correction(&self.matrix)),
        ]
    }

    /// Multiplied out, where that is not long.
    fn tidied_too(&self, outputs: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
        (!self.is_long()).then(|| outputs.iter().map(|e| compact(*e)).collect())
    }

    /// Multiplied out as well, where that is not long.
    fn with_tidied(&self, outputs: Vec<Expr<'g>>) -> Vec<Vec<Expr<'g>>> {
        if self.is_long() {
            return vec![outputs];
        }
        vec![outputs.iter().map(|e| compact(*e)).collect(), outputs]
    }

    /// Whether multiplying out would be slow and of no use.
    pub fn is_long(&self) -> bool {
        self.scene.is_long()
    }

    /// The links by the poles and in the axes in which sums over them are formed.
    pub(in crate::mechanics) fn tree(&self) -> &Tree<'g> {
        self.working.as_ref().map_or(&self.scene.tree, |working| &working.tree)
    }

    /// The same once more by the poles and in the axes that were given, where others are worked with: what needs no
    /// forces can be shorter there.
    fn by_given_poles(&self, of: impl Fn(&Tree<'g>) -> Vec<Expr<'g>>) -> Option<Vec<Expr<'g>>> {
        self.working.as_ref().map(|_| of(&self.scene.tree))
    }

    pub(in crate::mechanics) fn loads(&self) -> &Loads<'g> {
        self.working.as_ref().map_or(&self.loads, |working| &working.loads)
    }

    fn arrangements(&self) -> Vec<EquationForm<'g>> {
        let mut arrangements = Vec::new();
        let tidy_all = |rows: &[Expr<'g>]| -> Vec<Expr<'g>> { rows.iter().map(|e| compact(*e)).collect() };
        for &inertia in self.tree().inertias(self.is_long()) {
            let residual = self.residual(&self.along, inertia);
            let still = self.residual(&self.scene.rates, inertia);
            let floating = match self.tree().floats() {
                true => self.floating(inertia),
                false => [still.clone(), vec![self.scene.graph.zero(); still.len()]],
            };
            if !self.is_long() {
                let (matrix, floating) =
                    (tidied(&self.matrix), [&floating[0], &floating[1]].map(|rows| tidy_all(rows)));
                let (still, residual) = (tidy_all(&still), tidy_all(&residual));
                arrangements.push(EquationForm { matrix, still, residual, floating });
            }
            arrangements.push(EquationForm { matrix: self.matrix.clone(), still, residual, floating });
        }
        arrangements
    }

    /// p_α = ∂T/∂z^α.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        self.tree().momentum()
    }

    /// Speeds that no velocity depends on: their rows of A are zero.
    pub fn idle_speeds(&self) -> Vec<usize> {
        (0..self.scene.speeds.len()).filter(|&k| self.matrix[k].iter().all(|e| e.is_zero())).collect()
    }

    /// −∂(dU/dt)/∂z^α of a potential.
    pub fn potential_forces(&self, potential: Expr<'g>) -> Vec<Expr<'g>> {
        let power = potential.derivative(&self.scene.rates);
        self.scene.speeds.iter().map(|&z| -power.partial(z)).collect()
    }

    /// `∫∂v_P/∂z·dF` of everything that acts: weight and buoyancy, the potential, forces.
    pub fn generalised_forces(&self) -> Vec<Expr<'g>> {
        sums(&self.tree().weights(), &self.element_forces_in_general())
    }

    /// `∫∂v_P/∂z·dF` of the elements alone.
    pub fn element_forces(&self) -> Vec<Expr<'g>> {
        if let Some(body) = self.balance_of_all() {
            return body.load_forces();
        }
        self.element_forces_in_general()
    }

    fn element_forces_in_general(&self) -> Vec<Expr<'g>> {
        sums(&self.tree().loads(self.loads()), &self.other_forces())
    }

    /// ∂C/∂ż of the unconstrained C without the elements of the loads: inertia, weight and buoyancy.
    pub fn inertial_residuals(&self) -> Vec<Vec<Expr<'g>>> {
        if let Some(body) = self.balance_of_all() {
            return body.inertial_residuals();
        }
        let tree = self.tree();
        let residuals =
            tree.inertias(self.is_long()).iter().map(|&inertia| tree.residual(&self.along, inertia, &Loads::default()));
        residuals.flat_map(|residual| self.with_tidied(residual)).collect()
    }

    /// Generalised forces of the potential, and of the forces that are not on links.
    pub(in crate::mechanics) fn other_forces(&self) -> Vec<Expr<'g>> {
        let scene = &self.scene;
        let acting = self
            .loads
            .forces
            .iter()
            .filter_map(|force| force.generalised(&scene.tree.links, &scene.speeds, &scene.rates));
        let potential = potential_of_forces(&scene.elements).unwrap_or_else(|| scene.graph.zero());
        acting.fold(self.potential_forces(potential), |sum, forces| sums(&sum, &forces))
    }

    /// ∂C/∂ż of the unconstrained C.
    pub(in crate::mechanics) fn residual(&self, along: &Map<u32, Expr<'g>>, inertia: Inertia) -> Vec<Expr<'g>> {
        self.without_others(self.tree().residual(along, inertia, self.loads()))
    }

    fn without_others(&self, rows: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
        rows.into_iter().zip(self.other_forces()).map(|(r, f)| r - f).collect()
    }

    /// ∂C/∂ż of the unconstrained C at ż = ζ, and ζ: what links that float have of the accelerations at ż = 0, along
    /// speeds that no constraint mentions.
    pub(in crate::mechanics) fn floating(&self, inertia: Inertia) -> [Vec<Expr<'g>>; 2] {
        let (rows, taken) = self.tree().floating_residual(inertia, self.loads(), &self.held());
        [self.without_others(rows), taken]
    }

    /// Speeds whose rates are not taken at once where links float: constraints mention them, or rotors need something
    /// besides, which is no acceleration of the observer.
    fn held(&self) -> Vec<bool> {
        let held = |speed: usize| self.constraints.jacobian.iter().any(|row| !row[speed].is_zero());
        let geared = |speed: usize| self.scene.tree.is_geared(self.scene.speeds[speed]);
        (0..self.scene.speeds.len()).map(|speed| held(speed) || geared(speed)).collect()
    }

    /// ż link by link, with loads gathered together with the forces of inertia.
    pub(in crate::mechanics) fn gathered_accelerations(&self) -> Vec<Vec<Expr<'g>>> {
        let articulated = if self.is_long() { Articulated::eliminated(self.tree()) } else { None };
        let of = |articulated: &Articulated<'_, 'g>, inertia: Inertia| {
            let [relative, taken] = self.gathered(articulated, inertia);
            sums(&relative, &taken)
        };
        let inertias = self.tree().inertias(true);
        articulated.iter().flat_map(|articulated| inertias.iter().map(|&inertia| of(articulated, inertia))).collect()
    }

    /// The same as ż′ and ζ.
    fn gathered(&self, articulated: &Articulated<'_, 'g>, inertia: Inertia) -> [Vec<Expr<'g>>; 2] {
        let UngatheredResidual { wrenches, rows, taken } = self.tree().under_way(inertia, self.loads(), &self.held());
        let right: Vec<Expr<'g>> = self.without_others(rows).into_iter().map(|row| -row).collect();
        [articulated.solve_under(&wrenches, &right), taken]
    }

    /// ż and λ: with `ż = ζ + ż′`, `A ż′ = −∂C/∂ż(ζ) + Jᵀλ`.
    fn acceleration(&self, arrangement: &EquationForm<'g>) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let [rows, taken] = &arrangement.floating;
        let right: Vec<Expr<'g>> = rows.iter().map(|r| -*r).collect();
        let (rates, multipliers) = self.constraints.solve(&arrangement.matrix, &right);
        (sums(&rates, taken), multipliers)
    }

    /// `∂C/∂ż − Jᵀλ` with the multipliers of the motion.
    fn gauss_residual(&self, arrangement: &EquationForm<'g>) -> Vec<Expr<'g>> {
        if self.constraints.is_empty() {
            return arrangement.residual.clone();
        }
        let forces = self.constraints.forces(&self.acceleration(arrangement).1);
        arrangement.residual.iter().zip(forces).map(|(r, f)| *r - f).collect()
    }

    /// ż in all of the ways in which it is formed.
    pub(in crate::mechanics) fn ways_to_accelerations(&self) -> Vec<Vec<Expr<'g>>> {
        self.accelerations(&self.arrangements())
    }

    /// ż in one of the ways in which it is formed.
    pub(in crate::mechanics) fn any_acceleration(&self) -> Vec<Expr<'g>> {
        let arrangements = self.arrangements();
        self.accelerations(&arrangements[..1]).swap_remove(0)
    }

    /// A x = right in the ways that are worth trying, with A arranged as given.
    fn solutions(&self, matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let articulated = if self.is_long() { Articulated::eliminated(self.tree()) } else { None };
        let mut solutions: Vec<Vec<Expr<'g>>> = articulated.iter().map(|a| a.solve(right)).collect();
        if solutions.is_empty() || right.len() <= DENSE {
            solutions.push(solve_symmetric(matrix, right));
            solutions.extend(solve_pairs(matrix, right));
        }
        solutions
    }

    fn accelerations(&self, arrangements: &[EquationForm<'g>]) -> Vec<Vec<Expr<'g>>> {
        if !self.constraints.is_empty() {
            return arrangements.iter().map(|a| self.acceleration(a).0).collect();
        }
        let solve = |a: &EquationForm<'g>| {
            let [rows, taken] = &a.floating;
            let right: Vec<Expr<'g>> = rows.iter().map(|r| -*r).collect();
            let solutions = self.solutions(&a.matrix, &right).into_iter();
            solutions.map(|rates| sums(&rates, taken)).collect::<Vec<_>>()
        };
        let orthogonal = self.elements();
        let orthogonal = orthogonal.iter().map(|elements| elements.accelerations(&self.loads, &self.other_forces()));
        arrangements.iter().flat_map(solve).chain(self.gathered_accelerations()).chain(orthogonal).collect()
    }

    /// C as a sum of squares, where several speeds share it. Where a speed turns a root about a pole that may be far
    /// from its O, as those of twists about Ω do, the squares are not of what is relative.
    fn elements(&self) -> Vec<Elements<'_, 'g>> {
        let few = self.scene.speeds.len() <= most_squares(&self.scene);
        let trees = few.then(|| [self.tree()].into_iter().chain(&self.in_own_axes));
        trees.into_iter().flatten().filter_map(|tree| self.elements_of(tree)).collect()
    }

    /// ż from C as a sum of squares where a scene has too many speeds for that to be tried at once: if nothing else
    /// keeps the digits.
    pub fn accelerations_by_squares(&self) -> Vec<Vec<Expr<'g>>> {
        let [_, most] = SQUARES;
        let many = most_squares(&self.scene) + 1..=most;
        if !many.contains(&self.scene.speeds.len()) || !self.constraints.is_empty() {
            return Vec::new();
        }
        let own = self.scene.tree.in_own_axes();
        let elements = [&self.scene.tree].into_iter().chain(&own).filter_map(|tree| self.elements_of(tree));
        elements.map(|elements| elements.accelerations(&self.loads, &self.other_forces())).collect()
    }

    fn elements_of<'a>(&self, tree: &'a Tree<'g>) -> Option<Elements<'a, 'g>> {
        let several = self.scene.speeds.len() > 1 && self.balance_of_all().is_none();
        let lengths = if several { self.lengths() } else { Vec::new() };
        let far = |a: &Vector<'g>| {
            let mut parts = a.body.iter().chain(&a.space);
            parts.any(|e| lengths.iter().any(|&length| !e.partial(length).is_zero()))
        };
        let about_far_pole = |link: &Link<'g>| {
            let rows = link.linear_rows.iter().zip(&link.angular_rows);
            link.parent.is_none() && rows.into_iter().any(|(a, o)| !is_zero(o) && far(a))
        };
        let relative = !self.scene.tree.links.iter().any(about_far_pole);
        if !several || !relative || self.scene.tree.has_formal_matter() {
            return None;
        }
        Elements::new(tree, self.scene.tree.planar_axis())
    }

    /// Coordinates that turn nothing.
    fn lengths(&self) -> Vec<Expr<'g>> {
        let turns = |q: Expr<'g>| {
            self.scene.tree.links.iter().any(|link| link.rotation.iter().flatten().any(|e| !e.partial(q).is_zero()))
        };
        let of = |coordinate: &Coordinate<'g>| match coordinate {
            Coordinate::Scalar(q) => vec![*q],
            Coordinate::Rotation(_) => Vec::new(),
            Coordinate::Pose(_, position) => position.to_vec(),
            Coordinate::Plane { position, .. } => position.to_vec(),
        };
        self.scene.coordinates.iter().flat_map(of).filter(|&q| !turns(q)).collect()
    }

    /// z from p = A z + p(z = 0).
    fn velocities(&self, momentum: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let still = self.at_rest();
        let beside = momentum.iter().map(|p| {
            let value = p.substitute(&still);
            if self.is_long() { value } else { tidy(value) }
        });
        let right: Vec<Expr<'g>> = self.scene.momenta.iter().zip(beside).map(|(symbol, p)| *symbol - p).collect();
        let compact = (!self.is_long()).then(|| tidied(&self.matrix));
        let matrices = compact.iter().chain([&self.matrix]);
        let elements = self.elements();
        let orthogonal = elements.iter().map(|elements| elements.solve(&right));
        matrices.flat_map(|matrix| self.solutions(matrix, &right)).chain(orthogonal).collect()
    }

    /// z = 0.
    pub(in crate::mechanics) fn at_rest(&self) -> Map<u32, Expr<'g>> {
        self.scene.speeds.iter().map(|z| (z.key(), self.scene.graph.zero())).collect()
    }

    /// `Σ Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α`.
    pub fn bracket(&self) -> Vec<Expr<'g>> {
        self.tree().bracket()
    }

    /// ṗ as a function of (t, q, p), with the bracket multiplied out and as it is.
    fn momentum_rates(&self, velocity: &[Expr<'g>], arrangement: &EquationForm<'g>) -> Vec<Vec<Expr<'g>>> {
        let of_momenta: Map<u32, Expr<'g>> =
            self.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
        let constraints =
            (!self.constraints.is_empty()).then(|| self.constraints.forces(&self.acceleration(arrangement).1));
        let forces = self.generalised_forces();
        let rate = |bracket: Vec<Expr<'g>>| -> Vec<Expr<'g>> {
            let bracket = constraints.iter().fold(bracket, |bracket, forces| sums(&bracket, forces));
            let rows = bracket.into_iter().zip(&forces);
            rows.map(|(bracket, force)| bracket.substitute(&of_momenta) + force.substitute(&of_momenta)).collect()
        };
        self.with_tidied(self.bracket()).into_iter().map(rate).collect()
    }

    /// T, link by link and, where velocities are homogeneous in z, as ½ p·z.
    fn kinetic_energies(&self) -> Vec<Vec<Expr<'g>>> {
        let energy = self.tree().twice_kinetic_energy().half();
        let mut energies = self.with_tidied(vec![energy]);
        energies.extend(self.by_given_poles(|tree| vec![tree.twice_kinetic_energy().half()]));
        if energy.substitute(&self.at_rest()).is_zero() {
            let momentum = self.momentum();
            if momentum.iter().all(|p| p.substitute(&self.at_rest()).is_zero()) {
                let terms = momentum.iter().zip(&self.scene.speeds).map(|(p, z)| p.group() * *z);
                energies.push(vec![terms.sum::<Expr<'g>>().half()]);
            }
        }
        energies
    }

    fn potential_energy(&self) -> Expr<'g> {
        let own = self.potential.unwrap_or_else(|| self.scene.graph.zero());
        own + self.tree().potential_energy()
    }

    /// C up to a constant in ż: its gradient is affine in ż, so `C = ½ ż·(∂C/∂ż(ż) + ∂C/∂ż(0))`.
    fn constraint_function(&self, arrangement: &EquationForm<'g>) -> Expr<'g> {
        let rows = arrangement.residual.iter().zip(&arrangement.still);
        let terms = rows.zip(&self.scene.speed_rates).map(|((any, still), &rate)| rate * (*any + *still).group());
        terms.sum::<Expr<'g>>().half()
    }

    /// The same from the gradient alone, its two values added as they are and as quantities of their own.
    fn constraints_of(&self, residual: &[Expr<'g>]) -> [Expr<'g>; 2] {
        let zero = self.scene.graph.zero();
        let still: Map<u32, Expr<'g>> = self.scene.speed_rates.iter().map(|dz| (dz.key(), zero)).collect();
        let sums = residual.iter().map(|r| *r + r.substitute(&still));
        let rows = || sums.clone().zip(&self.scene.speed_rates);
        let plain = rows().map(|(sum, &dz)| dz * sum).sum::<Expr<'g>>();
        let grouped = rows().map(|(sum, &dz)| dz * sum.group()).sum::<Expr<'g>>();
        [plain.half(), grouped.half()]
    }

    /// The increment of the configuration that an increment of z makes: ψ is affine in z.
    fn moved_by(&self, increment: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let named: Vec<Expr<'g>> = increment.iter().map(|e| e.group()).collect();
        let zero = self.scene.graph.zero();
        let row = |rate: &Expr<'g>| {
            let terms = self.scene.speeds.iter().zip(&named).map(|(&z, d)| rate.partial(z) * *d);
            terms.fold(zero, |sum, e| sum + e)
        };
        self.scene.motion().iter().map(row).collect()
    }
}

fn most_squares(scene: &SystemScene<'_>) -> usize {
    let [held, floating] = SQUARES;
    // What deforms is in none.
    if scene.tree.floats() && scene.tree.deformations.is_empty() { floating } else { held }
}

fn tidied<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    matrix.iter().map(|row| row.iter().map(|e| compact(*e)).collect()).collect()
}

fn grouped<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    matrix.iter().map(|row| row.iter().map(|e| e.group()).collect()).collect()
}
