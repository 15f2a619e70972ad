//! Systems of bodies and particles in coordinates of their own: the Gauss condition (3.3), (3.4) summed over all of them,
//! and every method of their kernels.

use crate::algebra::{Expr, Graph, Map, solve_pairs, solve_symmetric};

use super::accounts::account_formulas;
use super::articulated::Articulated;
use super::constraint::{Constraint, Constraints};
use super::equations::tidy;
use super::forces::{Element, Force, forces_of, potential_of};
use super::formula::{Formula, Method};
use super::names::Name;
use super::tree::{Inertia, Tree};
use super::vector::Triple;

/// Degrees of freedom up to which everything is also tried multiplied out: of links that hang on one another, and of links
/// that do not, where a free body must be among them.
const SMALL: [usize; 2] = [3, 6];
/// Degrees of freedom up to which a factorisation of A can cost less than an elimination link by link.
const DENSE: usize = 10;

/// One coordinate of the configuration.
#[derive(Clone)]
pub enum Coordinate<'g> {
    Scalar(Expr<'g>),
    /// R, by its entries.
    Rotation([Triple<'g>; 3]),
    /// (R, b).
    Pose([Triple<'g>; 3], Triple<'g>),
    /// SE(2), in the plane k₁k₂: cos θ and sin θ, b₁ and b₂. Its rate is (u₁, u₂, ω).
    Plane {
        turn: [Expr<'g>; 2],
        position: [Expr<'g>; 2],
    },
}

impl<'g> Coordinate<'g> {
    /// How many components its rate has.
    pub fn size(&self) -> usize {
        match self {
            Coordinate::Scalar(_) => 1,
            Coordinate::Rotation(_) | Coordinate::Plane { .. } => 3,
            Coordinate::Pose(..) => 6,
        }
    }

    /// Of several coordinates the one that a component of their rates belongs to.
    pub fn of_component(all: &[Self], component: usize) -> usize {
        let mut end = 0;
        let ends = all.iter().map(|coordinate| {
            end += coordinate.size();
            end
        });
        ends.take_while(|end| *end <= component).count()
    }

    /// R, where it is stored as a quaternion.
    pub fn rotation(&self) -> Option<&[Triple<'g>; 3]> {
        match self {
            Coordinate::Scalar(_) | Coordinate::Plane { .. } => None,
            Coordinate::Rotation(rotation) | Coordinate::Pose(rotation, _) => Some(rotation),
        }
    }
}

/// A system as it is given: every expression in terms of t, q, z and parameters.
pub struct SystemScene<'g> {
    pub graph: &'g Graph,
    pub time: Expr<'g>,
    pub coordinates: Vec<Coordinate<'g>>,
    pub coordinate_names: Vec<Name>,
    pub speeds: Vec<Expr<'g>>,
    /// What the momenta are momenta of.
    pub momentum_names: Vec<Name>,
    pub speed_rates: Vec<Expr<'g>>,
    pub momenta: Vec<Expr<'g>>,
    /// ψ: rates of scalar coordinates, twists of the others, in the order of the coordinates; affine in z.
    pub kinematics: Vec<Expr<'g>>,
    /// Rates of t and of the symbols of q.
    pub rates: Map<u32, Expr<'g>>,
    pub tree: Tree<'g>,
    pub constraints: Vec<Constraint<'g>>,
    /// Values that arrive at run time.
    pub inputs: Vec<Expr<'g>>,
    /// What acts beside weight and buoyancy.
    pub elements: Vec<Element<'g>>,
}

/// A system with what its equations are made of.
pub struct System<'g> {
    pub scene: SystemScene<'g>,
    /// Of all elements together.
    pub potential: Option<Expr<'g>>,
    pub forces: Vec<Force<'g>>,
    pub constraints: Constraints<'g>,
    /// Something is moved as a function of time: velocities, or what constraints say of them, do not vanish with z.
    pub driven: bool,
    /// Rates of t and q, and those with ż.
    pub along: Map<u32, Expr<'g>>,
    /// A.
    pub matrix: Vec<Vec<Expr<'g>>>,
}

/// One way to form the equations; the cheapest wins.
struct Arrangement<'g> {
    matrix: Vec<Vec<Expr<'g>>>,
    /// ∂C/∂ż at ż = 0, and at any ż.
    still: Vec<Expr<'g>>,
    residual: Vec<Expr<'g>>,
}

impl<'g> System<'g> {
    pub fn new(scene: SystemScene<'g>) -> Self {
        let mut along = scene.rates.clone();
        along.extend(scene.speeds.iter().zip(&scene.speed_rates).map(|(z, rate)| (z.key(), *rate)));
        let constraints = Constraints::new(&scene, &scene.rates);
        let matrix = scene.tree.mass_matrix();
        // Where links hang on one another entries are short as they are, and long multiplied out.
        let matrix = if scene.tree.is_chained() { grouped(&matrix) } else { tidied(&matrix) };
        let (potential, forces) = (potential_of(&scene.elements), forces_of(&scene.elements));
        let mut system = Self { scene, potential, forces, constraints, driven: false, along, matrix };
        let at_rest = system.at_rest();
        let mut velocities = system.momentum();
        velocities.push(system.scene.tree.twice_kinetic_energy());
        velocities.extend(&system.constraints.on_velocities);
        system.driven = velocities.iter().any(|e| !tidy(e.substitute(&at_rest)).is_zero());
        system
    }

    pub fn formulas(&self) -> Vec<Formula<'g>> {
        let single = |method, outputs: Vec<Expr<'g>>| Formula { method, arrangements: vec![outputs] };
        let arrangements = self.arrangements();
        let each = |method, f: &dyn Fn(&Arrangement<'g>) -> Vec<Expr<'g>>| Formula {
            method,
            arrangements: arrangements.iter().map(f).collect(),
        };
        let momentum = self.momentum();
        let velocities = self.velocities(&momentum);
        let rates = velocities.iter().map(|z| self.momentum_rate(z, &arrangements[0])).collect();
        let mut formulas = vec![
            single(Method::Kinematics, self.scene.kinematics.clone()),
            Formula { method: Method::Acceleration, arrangements: self.accelerations(&arrangements) },
            Formula { method: Method::Momentum, arrangements: self.with_tidied(momentum) },
            Formula { method: Method::Velocity, arrangements: velocities },
            Formula { method: Method::MomentumRate, arrangements: rates },
            single(Method::MassMatrix, self.matrix.iter().flatten().copied().collect()),
            Formula { method: Method::KineticEnergy, arrangements: self.kinetic_energies() },
            Formula { method: Method::PotentialEnergy, arrangements: self.with_tidied(vec![self.potential_energy()]) },
            each(Method::ConstraintFunction, &|a| vec![self.constraint_function(a)]),
            each(Method::GaussResidual, &|a| self.gauss_residual(a)),
        ];
        if !self.constraints.is_empty() {
            formulas.extend(self.constraint_formulas());
        }
        formulas.extend(account_formulas(&self.accounts(), self.explicit_power()));
        formulas
    }

    /// What the kernel says of its constraints.
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

    /// Multiplied out as well, where that is not long.
    fn with_tidied(&self, outputs: Vec<Expr<'g>>) -> Vec<Vec<Expr<'g>>> {
        if self.is_long() {
            return vec![outputs];
        }
        vec![outputs.iter().map(|e| tidy(*e)).collect(), outputs]
    }

    /// Whether multiplying out would be slow and of no use.
    pub fn is_long(&self) -> bool {
        let [chained, apart] = SMALL;
        self.scene.speeds.len() > if self.scene.tree.is_chained() { chained } else { apart }
    }

    fn arrangements(&self) -> Vec<Arrangement<'g>> {
        let mut arrangements = Vec::new();
        let tidy_all = |rows: &[Expr<'g>]| -> Vec<Expr<'g>> { rows.iter().map(|e| tidy(*e)).collect() };
        for &inertia in self.scene.tree.inertias(self.is_long()) {
            let residual = self.residual(&self.along, inertia);
            let still = self.residual(&self.scene.rates, inertia);
            if !self.is_long() {
                let matrix = tidied(&self.matrix);
                arrangements.push(Arrangement { matrix, still: tidy_all(&still), residual: tidy_all(&residual) });
            }
            arrangements.push(Arrangement { matrix: self.matrix.clone(), still, residual });
        }
        arrangements
    }

    /// p_α = ∂T/∂z^α.
    pub fn momentum(&self) -> Vec<Expr<'g>> {
        self.scene.tree.momentum()
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
        let loads = self.scene.tree.loads(&self.forces);
        sums(&sums(&self.scene.tree.weights(), &loads), &self.other_forces())
    }

    /// `∫∂v_P/∂z·dF` of the elements alone.
    pub fn element_forces(&self) -> Vec<Expr<'g>> {
        sums(&self.scene.tree.loads(&self.forces), &self.other_forces())
    }

    /// ∂C/∂ż of the unconstrained C without the elements of what acts: inertia, weight and buoyancy.
    pub fn inertial_residuals(&self) -> Vec<Vec<Expr<'g>>> {
        let tree = &self.scene.tree;
        let residuals = tree.inertias(self.is_long()).iter().map(|&inertia| tree.residual(&self.along, inertia, &[]));
        residuals.flat_map(|residual| self.with_tidied(residual)).collect()
    }

    /// Of the potential, and of what acts elsewhere than on links.
    fn other_forces(&self) -> Vec<Expr<'g>> {
        let scene = &self.scene;
        let acting = self.forces.iter().filter_map(|force| force.generalised(&scene.speeds, &scene.rates));
        let potential = self.potential.unwrap_or_else(|| scene.graph.zero());
        acting.fold(self.potential_forces(potential), |sum, forces| sums(&sum, &forces))
    }

    /// ∂C/∂ż of the unconstrained C.
    fn residual(&self, along: &Map<u32, Expr<'g>>, inertia: Inertia) -> Vec<Expr<'g>> {
        let inertia = self.scene.tree.residual(along, inertia, &self.forces);
        inertia.into_iter().zip(self.other_forces()).map(|(r, f)| r - f).collect()
    }

    /// ż and λ: `A ż = −∂C/∂ż(ż = 0) + Jᵀλ`.
    fn acceleration(&self, arrangement: &Arrangement<'g>) -> (Vec<Expr<'g>>, Vec<Expr<'g>>) {
        let right: Vec<Expr<'g>> = arrangement.still.iter().map(|r| -*r).collect();
        self.constraints.solve(&arrangement.matrix, &right)
    }

    /// `∂C/∂ż − Jᵀλ` with the multipliers of the motion.
    fn gauss_residual(&self, arrangement: &Arrangement<'g>) -> Vec<Expr<'g>> {
        if self.constraints.is_empty() {
            return arrangement.residual.clone();
        }
        let forces = self.constraints.forces(&self.acceleration(arrangement).1);
        arrangement.residual.iter().zip(forces).map(|(r, f)| *r - f).collect()
    }

    /// ż in one of the ways in which it is formed.
    pub(super) fn any_acceleration(&self) -> Vec<Expr<'g>> {
        let arrangements = self.arrangements();
        self.accelerations(&arrangements[..1]).swap_remove(0)
    }

    /// A x = right in the ways that are worth trying, with A arranged as given.
    fn solutions(&self, matrix: &[Vec<Expr<'g>>], right: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let articulated = if self.is_long() { Articulated::new(&self.scene.tree) } else { None };
        let mut solutions: Vec<Vec<Expr<'g>>> = articulated.iter().map(|a| a.solve(right)).collect();
        if solutions.is_empty() || right.len() <= DENSE {
            solutions.push(solve_symmetric(matrix, right));
            solutions.extend(solve_pairs(matrix, right));
        }
        solutions
    }

    fn accelerations(&self, arrangements: &[Arrangement<'g>]) -> Vec<Vec<Expr<'g>>> {
        if !self.constraints.is_empty() {
            return arrangements.iter().map(|a| self.acceleration(a).0).collect();
        }
        let solve = |a: &Arrangement<'g>| {
            let right: Vec<Expr<'g>> = a.still.iter().map(|r| -*r).collect();
            self.solutions(&a.matrix, &right)
        };
        arrangements.iter().flat_map(solve).collect()
    }

    /// z from p = A z + p(z = 0).
    fn velocities(&self, momentum: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let still = self.at_rest();
        let beside = momentum.iter().map(|p| {
            let value = p.substitute(&still);
            if self.is_long() { value } else { tidy(value) }
        });
        let right: Vec<Expr<'g>> = self.scene.momenta.iter().zip(beside).map(|(symbol, p)| *symbol - p).collect();
        self.solutions(&self.matrix, &right)
    }

    /// z = 0.
    pub(super) fn at_rest(&self) -> Map<u32, Expr<'g>> {
        self.scene.speeds.iter().map(|z| (z.key(), self.scene.graph.zero())).collect()
    }

    /// `Σ Q·(ȧ_α + v_O × o_α) + Γ_O·ȯ_α`.
    pub fn bracket(&self) -> Vec<Expr<'g>> {
        self.scene.tree.bracket()
    }

    /// ṗ as a function of (t, q, p).
    fn momentum_rate(&self, velocity: &[Expr<'g>], arrangement: &Arrangement<'g>) -> Vec<Expr<'g>> {
        let mut bracket = self.bracket();
        if !self.is_long() {
            bracket.iter_mut().for_each(|e| *e = tidy(*e));
        }
        if !self.constraints.is_empty() {
            bracket = sums(&bracket, &self.constraints.forces(&self.acceleration(arrangement).1));
        }
        let of_momenta: Map<u32, Expr<'g>> =
            self.scene.speeds.iter().zip(velocity).map(|(z, value)| (z.key(), value.group())).collect();
        let rows = bracket.into_iter().zip(self.generalised_forces());
        rows.map(|(bracket, force)| bracket.substitute(&of_momenta) + force.substitute(&of_momenta)).collect()
    }

    /// T, link by link and, where velocities are homogeneous in z, as ½ p·z.
    fn kinetic_energies(&self) -> Vec<Vec<Expr<'g>>> {
        let energy = self.scene.tree.twice_kinetic_energy().half();
        let mut energies = self.with_tidied(vec![energy]);
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
        own + self.scene.tree.potential_energy()
    }

    /// C up to a constant in ż: its gradient is affine in ż, so `C = ½ ż·(∂C/∂ż(ż) + ∂C/∂ż(0))`.
    fn constraint_function(&self, arrangement: &Arrangement<'g>) -> Expr<'g> {
        let rows = arrangement.residual.iter().zip(&arrangement.still);
        let terms = rows.zip(&self.scene.speed_rates).map(|((any, still), &rate)| rate * (*any + *still).group());
        terms.sum::<Expr<'g>>().half()
    }

    /// The increment of the configuration that an increment of z makes: ψ is affine in z.
    fn moved_by(&self, increment: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let named: Vec<Expr<'g>> = increment.iter().map(|e| e.group()).collect();
        let zero = self.scene.graph.zero();
        let row = |rate: &Expr<'g>| {
            let terms = self.scene.speeds.iter().zip(&named).map(|(&z, d)| rate.partial(z) * *d);
            terms.fold(zero, |sum, e| sum + e)
        };
        self.scene.kinematics.iter().map(row).collect()
    }
}

impl<'g> SystemScene<'g> {
    /// Rates whose ψ is not affine in z: velocities would then not be linear in z, and (3.4) not this one. Indices into the
    /// kinematics.
    pub fn rates_not_affine(&self) -> Vec<usize> {
        let affine = |rate: &Expr<'g>| {
            self.speeds.iter().all(|&z| {
                let partial = rate.partial(z);
                self.speeds.iter().all(|&w| tidy(partial.partial(w)).is_zero())
            })
        };
        (0..self.kinematics.len()).filter(|&k| !affine(&self.kinematics[k])).collect()
    }
}

pub(super) fn sums<'g>(a: &[Expr<'g>], b: &[Expr<'g>]) -> Vec<Expr<'g>> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}

fn tidied<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    matrix.iter().map(|row| row.iter().map(|e| tidy(*e)).collect()).collect()
}

fn grouped<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    matrix.iter().map(|row| row.iter().map(|e| e.group()).collect()).collect()
}
