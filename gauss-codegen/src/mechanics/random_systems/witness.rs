//! The same system as particles alone, in double precision: every body by its points, C = ½ Σ m |a − F/m|² at its least
//! among all ż that the constraints admit. Differentiation is by jets along the motion; nothing here is the derive's.

use crate::mechanics::scene::constraint::ConstraintKind;
use crate::mechanics::tests::Random;

use super::dense::{Matrix, Saddle, apply, dot, inverse, largest, norm, transposed};
use super::fluid::{self, Fluid};
use super::numbers::{Jet, SmoothNumber};
use super::plan::{ConstraintPlan, JointPlace, MatterPlan, Plan, PlannedKind, TurnPlan};

/// t, the symbols of q, z.
#[derive(Clone, Debug)]
pub struct WitnessState {
    pub time: f64,
    pub configuration: Vec<f64>,
    pub speeds: Vec<f64>,
    /// One for each rotation among the coordinates: (x, y, z, w).
    pub quaternions: Vec<[f64; 4]>,
}

impl WitnessState {
    pub fn random(plan: &Plan, random: &mut Random) -> Self {
        let (mut configuration, mut quaternions) = (Vec::new(), Vec::new());
        for kind in &plan.coordinates {
            if *kind != PlannedKind::Scalar {
                let any: [f64; 4] = std::array::from_fn(|_| random.next());
                let length = dot(&any, &any).sqrt();
                let unit = any.map(|x| x / length);
                configuration.extend(rotation_matrix(unit).into_iter().flatten());
                quaternions.push(unit);
            }
            let scalars = if *kind == PlannedKind::Scalar { 1 } else { kind.symbols() - 9 };
            configuration.extend((0..scalars).map(|_| 1.2 * random.next()));
        }
        let speeds = (0..plan.speeds).map(|_| random.next()).collect();
        Self { time: random.next(), configuration, speeds, quaternions }
    }

    /// The configuration that rates lead to at time one: rotations and poses by the group.
    pub fn moved(&self, plan: &Plan, rates: &[f64]) -> Self {
        let mut moved = self.clone();
        let (mut at, mut row, mut turned) = (0, 0, 0);
        for kind in &plan.coordinates {
            let own = &rates[row..row + kind.rates()];
            if *kind == PlannedKind::Scalar {
                moved.configuration[at] += own[0];
            } else {
                let omega = [own[own.len() - 3], own[own.len() - 2], own[own.len() - 1]];
                let quaternion = turned_by(self.quaternions[turned], omega);
                if own.len() == 6 {
                    let matrix = rotation_matrix(self.quaternions[turned]);
                    for i in 0..3 {
                        // To first order, which is all that is asked of it.
                        moved.configuration[at + 9 + i] += dot(&matrix[i], &own[..3]);
                    }
                }
                moved.quaternions[turned] = quaternion;
                let entries = rotation_matrix(quaternion).into_iter().flatten();
                moved.configuration[at..at + 9].iter_mut().zip(entries).for_each(|(old, new)| *old = new);
                turned += 1;
            }
            at += kind.symbols();
            row += kind.rates();
        }
        moved
    }
}

fn rotation_matrix([x, y, z, w]: [f64; 4]) -> [[f64; 3]; 3] {
    [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
}

/// Turned on by the vector of an angle about an axis, in the turned axes.
fn turned_by([x, y, z, w]: [f64; 4], omega: [f64; 3]) -> [f64; 4] {
    let angle = dot(&omega, &omega).sqrt();
    let factor = if angle == 0.0 { 0.5 } else { (0.5 * angle).sin() / angle };
    let ([a, b, c], d) = (omega.map(|o| o * factor), (0.5 * angle).cos());
    [
        w * a + x * d + y * c - z * b,
        w * b - x * c + y * d + z * a,
        w * c + x * b - y * a + z * d,
        w * d - x * a - y * b - z * c,
    ]
}

/// `R` by a right angle about an axis.
pub fn quarter_turn(axis: usize) -> [[i64; 3]; 3] {
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = [[0; 3]; 3];
    matrix[axis][axis] = 1;
    matrix[a][b] = -1;
    matrix[b][a] = 1;
    matrix
}

pub type JetTriple = [Jet; 3];
pub type JetMatrix = [[Jet; 3]; 3];

fn product(a: &JetMatrix, b: &JetMatrix) -> JetMatrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).fold(Jet::default(), |sum, k| sum + a[i][k] * b[k][j])))
}

fn turned(a: &JetMatrix, x: &JetTriple) -> JetTriple {
    a.map(|row| inner(&row, x))
}

pub fn inner(a: &JetTriple, b: &JetTriple) -> Jet {
    (0..3).fold(Jet::default(), |sum, i| sum + a[i] * b[i])
}

fn sum(a: &JetTriple, b: &JetTriple) -> JetTriple {
    std::array::from_fn(|i| a[i] + b[i])
}

fn about(axis: usize, angle: Jet) -> JetMatrix {
    let one = angle.fraction(1, 1);
    let (sin, cos) = (angle.sine(), angle.cosine());
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = JetMatrix::default();
    matrix[axis][axis] = one;
    (matrix[a][a], matrix[b][b]) = (cos, cos);
    (matrix[a][b], matrix[b][a]) = (one.fraction(0, 1) - sin, sin);
    matrix
}

/// A motion through a state, and aside from it along one partial velocity.
struct WitnessMotion {
    /// t, q, z with z pushed aside; and t, q with q moved aside by what that does to ψ.
    pushed: Vec<Jet>,
    moved: Vec<Jet>,
    psi: Vec<Jet>,
    links: Vec<(JetTriple, JetMatrix)>,
}

/// A particle: its position, its mass, and what its weight is taken from.
struct Particle {
    position: JetTriple,
    mass: f64,
    weighed: f64,
}

impl WitnessMotion {
    fn new(plan: &Plan, state: &WitnessState, rates: &[f64], aside: Option<usize>) -> Self {
        let count = state.configuration.len();
        let time = Jet { value: state.time, rate: 1.0, ..Jet::default() };
        let speeds = || state.speeds.iter().map(|&z| Jet::constant(z));
        let start = || state.configuration.iter().map(|&q| Jet::constant(q));
        let still: Vec<Jet> = std::iter::once(time).chain(start()).chain(speeds()).collect();
        let (_, velocities) = plan.rates(&still);
        let mut pushed = still;
        for k in 0..count {
            pushed[1 + k].rate = velocities[k].value;
        }
        for (k, z) in pushed[1 + count..].iter_mut().enumerate() {
            z.rate = rates[k];
            z.side = f64::from(u8::from(aside == Some(k)));
        }
        let (psi, velocities) = plan.rates(&pushed);
        let moved = state.configuration.iter().zip(&velocities).map(|(&q, &rate)| Jet::integral(q, rate));
        let moved: Vec<Jet> = std::iter::once(time).chain(moved).chain(pushed[1 + count..].iter().copied()).collect();
        let mut motion = Self { pushed, moved, psi, links: Vec::new() };
        for link in &plan.links {
            let placed = motion.place(plan, link.parent, &link.place, &link.turns);
            motion.links.push(placed);
        }
        motion
    }

    fn place(
        &self,
        plan: &Plan,
        parent: Option<usize>,
        place: &JointPlace,
        turns: &[TurnPlan],
    ) -> (JetTriple, JetMatrix) {
        let one = Jet::constant(1.0);
        let mut identity = JetMatrix::default();
        (0..3).for_each(|i| identity[i][i] = one);
        let (origin, mut rotation) = parent.map_or((JetTriple::default(), identity), |k| self.links[k]);
        let offset = match place {
            JointPlace::Offset(offset) => [0, 1, 2].map(|i| offset[i].at(&self.moved)),
            JointPlace::Pose(k) => [9, 10, 11].map(|i| self.moved[plan.variable_of(*k) + i]),
        };
        let position = sum(&origin, &turned(&rotation, &offset));
        for turn in turns {
            let entry = |k: usize, i: usize, j: usize| self.moved[plan.variable_of(k) + 3 * i + j];
            let matrix = match turn {
                TurnPlan::About(axis, angle) => about(*axis, angle.at(&self.moved)),
                TurnPlan::Given(k) => std::array::from_fn(|i| std::array::from_fn(|j| entry(*k, i, j))),
                TurnPlan::Back(k) => std::array::from_fn(|i| std::array::from_fn(|j| entry(*k, j, i))),
                TurnPlan::Quarter(axis) => quarter_turn(*axis).map(|row| row.map(|e| Jet::constant(e as f64))),
            };
            rotation = product(&rotation, &matrix);
        }
        (position, rotation)
    }

    fn particles(&self, plan: &Plan) -> Vec<Particle> {
        let mut particles = Vec::new();
        for (link, (origin, rotation)) in plan.links.iter().zip(&self.links) {
            let mut add = |x: [f64; 3], mass: f64, weighed: f64| {
                let position = sum(origin, &turned(rotation, &x.map(Jet::constant)));
                particles.push(Particle { position, mass, weighed });
            };
            match &link.matter {
                MatterPlan::Nothing => {}
                MatterPlan::Particle(mass) => add([0.0; 3], *mass, *mass),
                MatterPlan::Solid(solid) => {
                    solid.points.iter().for_each(|&(x, mass)| add(x, mass, mass));
                    solid.displaced.iter().for_each(|&(mass, center)| add(center, 0.0, -mass));
                }
            }
        }
        particles
    }

    fn fluids(&self, plan: &Plan) -> Vec<Fluid> {
        let links = plan.links.iter().zip(&self.links);
        let wet = links.filter_map(|(link, (origin, rotation))| match &link.matter {
            MatterPlan::Solid(solid) => Some(Fluid::new(solid.added_mass.as_ref()?, origin, rotation)),
            _ => None,
        });
        wet.collect()
    }

    /// The largest of something over all particles, origins and axes.
    fn largest(&self, plan: &Plan, f: impl Fn(&Jet) -> f64) -> f64 {
        let links = self.links.iter().flat_map(|(origin, rotation)| origin.iter().chain(rotation.iter().flatten()));
        let own = links.map(&f).fold(0.0, |m, x| x.abs().max(m));
        self.particles(plan).iter().flat_map(|p| part(&p.position, &f)).fold(own, |m, x| x.abs().max(m))
    }

    fn potential(&self, plan: &Plan) -> Jet {
        plan.potential.as_ref().map_or_else(Jet::default, |potential| potential.at(&self.moved))
    }

    /// φ of positions, if it is one, and its level of velocities: value, rate along the motion, derivative with respect
    /// to z.
    fn constraint(&self, constraint: &ConstraintPlan) -> (f64, Jet) {
        let position = |phi: Jet| (phi.value, phi.velocity());
        match constraint {
            ConstraintPlan::Function(ConstraintKind::Position, function) => position(function.at(&self.moved)),
            ConstraintPlan::Function(ConstraintKind::Velocity, function) => (0.0, function.at(&self.pushed)),
            ConstraintPlan::Distance(a, b) => {
                let from = b.map_or_else(JetTriple::default, |b| self.links[b].0);
                let arm: JetTriple = std::array::from_fn(|i| self.links[*a].0[i] - from[i]);
                position(inner(&arm, &arm) - Jet::constant(1.0))
            }
            ConstraintPlan::Velocity(k, a, b, c) => {
                let (origin, rotation) = &self.links[*k];
                let velocity = origin.map(Jet::velocity);
                // ω₁ = k₃·Ṙ Rᵀ k₂, and so on.
                let omega = std::array::from_fn(|i| {
                    let (rate, row) = (rotation[(i + 2) % 3].map(Jet::velocity), rotation[(i + 1) % 3].map(Jet::along));
                    inner(&rate, &row)
                });
                let factor = |f: &[super::numbers::Smooth; 3]| [0, 1, 2].map(|i| f[i].at(&self.pushed));
                (0.0, inner(&factor(a), &velocity) + inner(&factor(b), &omega) + c.at(&self.pushed))
            }
        }
    }
}

/// Values of (3.1) and of the constraints at one state.
pub struct DenseWitness<'a> {
    plan: &'a Plan,
    state: &'a WitnessState,
    pub matrix: Matrix,
    /// −∂C/∂ż at ż = 0.
    pub force: Vec<f64>,
    pub jacobian: Matrix,
    /// Its rate along the motion.
    pub jacobian_rate: Matrix,
    pub bias: Vec<f64>,
    pub on_positions: Vec<f64>,
    pub on_velocities: Vec<f64>,
    pub saddle: Saddle,
    pub acceleration: Vec<f64>,
    pub multipliers: Vec<f64>,
    pub momentum: Vec<f64>,
    pub momentum_rate: Vec<f64>,
    pub kinetic_energy: f64,
    pub potential_energy: f64,
    pub kinematics: Vec<f64>,
    /// ∂ψ/∂z, one row a speed.
    pub kinematic_rows: Matrix,
    pub sizes: Sizes,
}

/// Absolute values behind each result: what its roundings are measured by. Velocities of origins and axes count too:
/// what they give to particles may cancel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sizes {
    pub matrix: f64,
    pub force: f64,
    pub momentum: f64,
    pub momentum_rate: f64,
    pub kinetic_energy: f64,
    pub potential_energy: f64,
    mass: f64,
    velocity: f64,
    /// ‖A⁻¹‖, and the condition number of A.
    pub inverse: f64,
    pub condition: f64,
}

impl Sizes {
    fn new(plan: &Plan, state: &WitnessState, motions: &[WitnessMotion]) -> Self {
        let particles = motions[0].particles(plan);
        let solid: f64 = particles.iter().map(|p| p.mass.max(p.weighed.abs())).sum();
        // Components of twists are no larger than √3 times those of velocities.
        let wet = plan.links.iter().filter_map(|link| match &link.matter {
            MatterPlan::Solid(solid) => solid.added_mass,
            _ => None,
        });
        let mass = solid + wet.map(|added| 3.0 * norm(&added.map(Vec::from).to_vec())).sum::<f64>();
        let rows: Vec<f64> = motions.iter().map(|motion| motion.largest(plan, |x| x.side)).collect();
        let (row, rows) = (largest(&rows), rows.iter().sum::<f64>());
        let velocity = motions[0].largest(plan, |x| x.rate) + rows * largest(&state.speeds);
        let acceleration = motions[0].largest(plan, |x| x.second) + velocity.powi(2);
        let gravity = largest(&plan.gravity.unwrap_or_default());
        let power: f64 = motions.iter().map(|motion| motion.potential(plan).side.abs()).sum();
        // Three components, each.
        let all = 3.0 * mass;
        Self {
            matrix: all * row * rows,
            force: all * (acceleration + gravity) * row + power,
            momentum: all * velocity * row,
            kinetic_energy: all * velocity * velocity,
            potential_energy: all * gravity * motions[0].largest(plan, |x| x.value)
                + motions[0].potential(plan).value.abs()
                + 1.0,
            mass,
            velocity,
            ..Self::default()
        }
    }
}

fn part(triple: &JetTriple, f: impl Fn(&Jet) -> f64) -> [f64; 3] {
    [0, 1, 2].map(|i| f(&triple[i]))
}

/// φ of positions, and the level of velocities.
pub fn residuals(plan: &Plan, state: &WitnessState) -> (Vec<f64>, Vec<f64>) {
    let motion = WitnessMotion::new(plan, state, &vec![0.0; plan.speeds], None);
    let levels = plan.constraints.iter().map(|constraint| motion.constraint(constraint));
    levels.map(|(position, velocity)| (position, velocity.value)).unzip()
}

impl<'a> DenseWitness<'a> {
    /// `None` where there is no single minimiser.
    pub fn new(plan: &'a Plan, state: &'a WitnessState) -> Option<Self> {
        let n = plan.speeds;
        let gravity = plan.gravity.unwrap_or_default();
        let still = vec![0.0; n];
        let motions: Vec<WitnessMotion> = (0..n).map(|k| WitnessMotion::new(plan, state, &still, Some(k))).collect();
        let particles: Vec<Vec<Particle>> = motions.iter().map(|motion| motion.particles(plan)).collect();
        let fluids: Vec<Vec<Fluid>> = motions.iter().map(|motion| motion.fluids(plan)).collect();
        let (mut matrix, mut force, mut momentum) = (vec![vec![0.0; n]; n], vec![0.0; n], vec![0.0; n]);
        for row in 0..n {
            for (index, particle) in particles[row].iter().enumerate() {
                let w = part(&particle.position, |x| x.side);
                let (v, a) = (part(&particle.position, |x| x.rate), part(&particle.position, |x| x.second));
                for column in 0..n {
                    let other = part(&particles[column][index].position, |x| x.side);
                    matrix[row][column] += particle.mass * dot(&w, &other);
                }
                momentum[row] += particle.mass * dot(&v, &w);
                force[row] += particle.weighed * dot(&gravity, &w) - particle.mass * dot(&a, &w);
            }
            force[row] -= motions[row].potential(plan).side;
            for (index, fluid) in fluids[row].iter().enumerate() {
                for column in 0..n {
                    let other = &fluids[column][index].twist;
                    let impulse = fluid::part(&fluid.impulse, |x| x.side);
                    matrix[row][column] += dot(&impulse, &fluid::part(other, |x| x.side));
                }
                momentum[row] += dot(&fluid::part(&fluid.impulse, |x| x.value), &fluid::part(&fluid.twist, |x| x.side));
                force[row] -= fluid.inertia_force();
            }
        }
        let constraints: Vec<Vec<(f64, Jet)>> =
            motions.iter().map(|m| plan.constraints.iter().map(|c| m.constraint(c)).collect()).collect();
        let count = plan.constraints.len();
        let jacobian: Matrix = (0..count).map(|k| (0..n).map(|z| constraints[z][k].1.side).collect()).collect();
        let jacobian_rate = (0..count).map(|k| (0..n).map(|z| constraints[z][k].1.side_rate).collect()).collect();
        let bias: Vec<f64> = (0..count).map(|k| -constraints[0][k].1.rate).collect();
        let saddle = Saddle::new(&matrix, &jacobian)?;
        let (acceleration, multipliers) = saddle.solve(&force, &bias);
        let inverse = inverse(&matrix)?;
        let velocity = |p: &Particle| part(&p.position, |x| x.rate);
        let solid = particles[0].iter().map(|p| 0.5 * p.mass * dot(&velocity(p), &velocity(p)));
        let values = |six: &[Jet; 6]| fluid::part(six, |x| x.value);
        let wet = fluids[0].iter().map(|fluid| 0.5 * dot(&values(&fluid.impulse), &values(&fluid.twist)));
        let kinetic_energy = solid.chain(wet).sum();
        let potential = motions[0].potential(plan).value;
        let heights = particles[0].iter().map(|p| -p.weighed * dot(&gravity, &part(&p.position, |x| x.value)));
        let potential_energy = potential + heights.sum::<f64>();
        let mut sizes = Sizes::new(plan, state, &motions);
        (sizes.inverse, sizes.condition) = (norm(&inverse), norm(&inverse) * norm(&matrix));
        let mut witness = Self {
            plan,
            state,
            matrix,
            force,
            jacobian,
            jacobian_rate,
            bias,
            on_positions: constraints[0].iter().map(|(phi, _)| *phi).collect(),
            on_velocities: constraints[0].iter().map(|(_, phi)| phi.value).collect(),
            saddle,
            acceleration,
            multipliers,
            momentum,
            momentum_rate: Vec::new(),
            kinetic_energy,
            potential_energy,
            kinematics: motions[0].psi.iter().map(|psi| psi.value).collect(),
            kinematic_rows: motions.iter().map(|m| m.psi.iter().map(|psi| psi.side).collect()).collect(),
            sizes,
        };
        witness.add_momentum_rate();
        Some(witness)
    }

    /// `Σ m (a·w_α + v·ẇ_α)` along the motion that the forces and constraints make.
    fn add_momentum_rate(&mut self) {
        for k in 0..self.plan.speeds {
            let motion = WitnessMotion::new(self.plan, self.state, &self.acceleration, Some(k));
            let mut rate = 0.0;
            for Particle { position, mass, .. } in motion.particles(self.plan) {
                let (v, a) = (part(&position, |x| x.rate), part(&position, |x| x.second));
                let (w, turning) = (part(&position, |x| x.side), part(&position, |x| x.side_rate));
                rate += mass * (dot(&a, &w) + dot(&v, &turning));
            }
            rate += motion.fluids(self.plan).iter().map(Fluid::momentum_rate).sum::<f64>();
            let (a, w) = (motion.largest(self.plan, |x| x.second), motion.largest(self.plan, |x| x.side));
            let turning = motion.largest(self.plan, |x| x.side_rate) + self.sizes.velocity * w;
            let all = 3.0 * self.sizes.mass;
            let size = all * ((a + self.sizes.velocity.powi(2)) * w + self.sizes.velocity * turning);
            self.sizes.momentum_rate = self.sizes.momentum_rate.max(size);
            self.momentum_rate.push(rate);
        }
    }

    pub fn state(&self) -> &WitnessState {
        self.state
    }

    /// Jᵀ λ.
    pub fn constraint_forces(&self) -> Vec<f64> {
        apply(&transposed(&self.jacobian, self.matrix.len()), &self.multipliers)
    }

    /// (3.1) up to what does not depend on ż: `½ Σ m |a − F/m|²`, the potential by its power.
    pub fn constraint_function(&self, rates: &[f64]) -> f64 {
        let gravity = self.plan.gravity.unwrap_or_default();
        let motion = WitnessMotion::new(self.plan, self.state, rates, None);
        let mut c = 0.0;
        for Particle { position, mass, weighed } in motion.particles(self.plan) {
            let a = part(&position, |x| x.second);
            c += 0.5 * mass * dot(&a, &a) - weighed * dot(&gravity, &a);
        }
        c += motion.fluids(self.plan).iter().map(Fluid::constraint_function).sum::<f64>();
        // d²U/dt² has all that depends on ż.
        c + motion.potential(self.plan).second
    }

    /// Absolute values in a difference of two of them, one at ż = 0.
    pub fn function_size(&self, rates: &[f64]) -> f64 {
        let motion = WitnessMotion::new(self.plan, self.state, rates, None);
        let acceleration = motion.largest(self.plan, |x| x.second) + self.sizes.velocity.powi(2);
        let own = 3.0 * self.sizes.mass * acceleration.powi(2);
        own + largest(rates) * (self.sizes.force + self.sizes.matrix * largest(rates))
    }
}
