//! Systems as data, from which both sides are built: coordinates, speeds, links and constraints, drawn at random.

use crate::mechanics::scene::constraint::ConstraintKind;
use crate::mechanics::tests::Random;
use crate::terms::Shape;

use super::numbers::{Smooth, SmoothNumber, below};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlannedKind {
    Scalar,
    Rotation,
    /// A pose with ḃ in observer's axes for its first three rates, or u in its own.
    Pose {
        observed: bool,
    },
}

impl PlannedKind {
    pub fn symbols(self) -> usize {
        match self {
            PlannedKind::Scalar => 1,
            PlannedKind::Rotation => 9,
            PlannedKind::Pose { .. } => 12,
        }
    }

    pub fn rates(self) -> usize {
        match self {
            PlannedKind::Scalar => 1,
            PlannedKind::Rotation => 3,
            PlannedKind::Pose { .. } => 6,
        }
    }
}

#[derive(Clone, Debug)]
pub enum JointPlace {
    /// In the parent's axes.
    Offset([Smooth; 3]),
    /// b of a coordinate.
    Pose(usize),
}

#[derive(Clone, Debug)]
pub enum TurnPlan {
    About(usize, Smooth),
    /// R of a coordinate, and its transpose.
    Given(usize),
    Back(usize),
    /// A quarter of a turn about an axis, by the integers of its matrix.
    Quarter(usize),
}

/// A rigid body as particles at body points. Buoyancy is a particle with weight and no mass.
#[derive(Clone, Debug)]
pub struct Solid {
    pub inertia: Shape,
    pub has_center: bool,
    /// Body coordinates and mass.
    pub points: Vec<([f64; 3], f64)>,
    /// Mass and centre of the displaced fluid.
    pub displaced: Option<(f64, [f64; 3])>,
    /// In the order (u, ω), about O.
    pub added_mass: Option<[[f64; 6]; 6]>,
}

#[derive(Clone, Debug)]
pub enum MatterPlan {
    Nothing,
    Particle(f64),
    Solid(Box<Solid>),
}

#[derive(Clone, Debug)]
pub struct LinkPlan {
    pub parent: Option<usize>,
    pub place: JointPlace,
    pub turns: Vec<TurnPlan>,
    pub matter: MatterPlan,
}

#[derive(Clone, Debug)]
pub enum ConstraintPlan {
    /// A function of t, q and, for velocities, z.
    Function(ConstraintKind, Smooth),
    /// Between the origins of links, or from Ω: its square, less a constant.
    Distance(usize, Option<usize>),
    /// `a·v_O + b·ω + c = 0` of a link, with observer's components that depend on t and q.
    Velocity(usize, [Smooth; 3], [Smooth; 3], Smooth),
}

impl ConstraintPlan {
    pub fn is_on_positions(&self) -> bool {
        matches!(self, ConstraintPlan::Function(ConstraintKind::Position, _) | ConstraintPlan::Distance(..))
    }
}

/// A system. Functions have the variables t, the symbols of q, z, in this order.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    pub coordinates: Vec<PlannedKind>,
    pub speeds: usize,
    /// `ψ_r = drift_r + Σ_j bases_rj z_j`; what is missing is zero.
    pub bases: Vec<Vec<Option<Smooth>>>,
    pub drift: Vec<Option<Smooth>>,
    /// Particles after bodies and frames.
    pub links: Vec<LinkPlan>,
    pub potential: Option<Smooth>,
    pub gravity: Option<[f64; 3]>,
    pub constraints: Vec<ConstraintPlan>,
}

/// Choices of z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedChoice {
    /// The rates of the coordinates themselves.
    Rates,
    /// As many as rates, mixed.
    Own,
    /// Fewer.
    Fewer(usize),
}

impl Plan {
    /// Index of the first symbol of a coordinate among the variables.
    pub fn variable_of(&self, coordinate: usize) -> usize {
        1 + self.coordinates[..coordinate].iter().map(|kind| kind.symbols()).sum::<usize>()
    }

    pub fn symbol_count(&self) -> usize {
        self.coordinates.iter().map(|kind| kind.symbols()).sum()
    }

    pub fn rate_count(&self) -> usize {
        self.coordinates.iter().map(|kind| kind.rates()).sum()
    }

    fn add(&mut self, kind: PlannedKind) -> usize {
        self.coordinates.push(kind);
        self.variable_of(self.coordinates.len() - 1)
    }

    /// Variables that random functions of t and q take: of a rotation a single entry.
    pub fn arguments(&self) -> Vec<usize> {
        let of = |(k, kind): (usize, &PlannedKind)| {
            let first = self.variable_of(k);
            match kind {
                PlannedKind::Scalar => vec![first],
                PlannedKind::Rotation => vec![first + 1],
                PlannedKind::Pose { .. } => vec![first + 5, first + 9, first + 10],
            }
        };
        std::iter::once(0).chain(self.coordinates.iter().enumerate().flat_map(of)).collect()
    }

    pub fn speed_variables(&self) -> Vec<usize> {
        (1 + self.symbol_count()..1 + self.symbol_count() + self.speeds).collect()
    }

    /// ψ, and the rates of the symbols of q: Ṙ = R [ω]×, ḃ = R u or as it is given.
    pub fn rates<N: SmoothNumber>(&self, variables: &[N]) -> (Vec<N>, Vec<N>) {
        let zero = variables[0].fraction(0, 1);
        let z = &variables[1 + self.symbol_count()..];
        let rows = self.bases.iter().zip(&self.drift).map(|(row, drift)| {
            let drift = drift.as_ref().map_or(zero, |c| c.at(variables));
            let terms = row.iter().zip(z).filter_map(|(b, z)| b.as_ref().map(|b| b.at(variables) * *z));
            terms.fold(drift, |sum, term| sum + term)
        });
        let mut psi: Vec<N> = rows.collect();
        let mut rates = Vec::with_capacity(self.symbol_count());
        let (mut at, mut row) = (1, 0);
        for &kind in &self.coordinates {
            let own = &mut psi[row..row + kind.rates()];
            if kind == PlannedKind::Scalar {
                rates.push(own[0]);
            } else {
                let r = |i: usize, j: usize| variables[at + 3 * i + j];
                let first = kind.rates() - 3;
                let [w1, w2, w3] = [own[first], own[first + 1], own[first + 2]];
                for i in 0..3 {
                    rates.extend([
                        r(i, 1) * w3 - r(i, 2) * w2,
                        r(i, 2) * w1 - r(i, 0) * w3,
                        r(i, 0) * w2 - r(i, 1) * w1,
                    ]);
                }
                let given = [own[0], own[1], own[2]];
                let product = |f: &dyn Fn(usize) -> N| (0..3).fold(zero, |sum, k| sum + f(k) * given[k]);
                match kind {
                    PlannedKind::Pose { observed: true } => {
                        rates.extend(given);
                        (0..3).for_each(|j| own[j] = product(&|i| r(i, j)));
                    }
                    PlannedKind::Pose { observed: false } => rates.extend((0..3).map(|i| product(&|j| r(i, j)))),
                    _ => {}
                }
            }
            at += kind.symbols();
            row += kind.rates();
        }
        (psi, rates)
    }

    /// Draws ψ.
    fn choose_speeds(&mut self, random: &mut Random, choice: SpeedChoice) {
        let rows = self.rate_count();
        self.speeds = match choice {
            SpeedChoice::Rates | SpeedChoice::Own => rows,
            SpeedChoice::Fewer(count) => count,
        };
        let arguments = self.arguments();
        let mixed = choice != SpeedChoice::Rates;
        self.bases = vec![vec![None; self.speeds]; rows];
        for (r, row) in self.bases.iter_mut().enumerate() {
            // Beside the speed that each rate mostly is, about two others: more would leave few well conditioned
            // states.
            for entry in row.iter_mut().filter(|_| mixed) {
                if below(random, rows.max(6)) < 2 {
                    *entry = Some(Smooth::random(random, 1, &arguments));
                }
            }
            row[r % self.speeds] = Some(Smooth::one());
        }
        let drift = |random: &mut Random| Smooth::random(random, 1, &arguments);
        let with_drift = mixed && below(random, 2) == 0;
        self.drift = (0..rows).map(|_| (with_drift && below(random, 3) == 0).then(|| drift(random))).collect();
    }

    fn add_forces(&mut self, random: &mut Random) {
        if below(random, 4) > 0 {
            self.gravity = Some(std::array::from_fn(|_| 5.0 * random.next()));
        }
        if below(random, 2) == 0 {
            self.potential = Some(Smooth::random(random, 3, &self.arguments()));
        }
    }

    /// Particles whose Cartesian coordinates, or functions of them, are the coordinates.
    pub fn particles(random: &mut Random, count: usize, choice: SpeedChoice, constraints: usize) -> Self {
        let mut plan = Self::default();
        for _ in 0..count {
            let curved = below(random, 4) == 0;
            let own: [usize; 3] = std::array::from_fn(|_| plan.add(PlannedKind::Scalar));
            let component = |i: usize| {
                let straight = Smooth::variable(own[i]);
                // The square of another one keeps the coordinates regular.
                if curved { straight.plus_square(3, own[i + 1]) } else { straight }
            };
            let place = JointPlace::Offset([component(0), component(1), Smooth::variable(own[2])]);
            let matter = MatterPlan::Particle(1.5 + random.next());
            plan.links.push(LinkPlan { parent: None, place, turns: Vec::new(), matter });
        }
        plan.choose_speeds(random, choice);
        plan.add_forces(random);
        plan.constraints = (0..constraints).map(|_| plan.constraint(random, false)).collect();
        plan
    }

    /// One more constraint.
    fn constraint(&self, random: &mut Random, affine: bool) -> ConstraintPlan {
        let (arguments, speeds) = (self.arguments(), self.speed_variables());
        let last = self.links.len() - 1;
        let triple = |random: &mut Random| std::array::from_fn(|_| Smooth::random(random, 1, &arguments));
        match below(random, if affine { 4 } else { 5 }) {
            0 => {
                let link = below(random, last + 1);
                ConstraintPlan::Distance(link, (0..last).find(|&k| k != link && below(random, 2) == 0))
            }
            1 => {
                let own = arguments[1 + below(random, arguments.len() - 1)];
                let function = Smooth::random(random, 2, &arguments).plus_multiple(8, own);
                ConstraintPlan::Function(ConstraintKind::Position, function)
            }
            2 => {
                let mut function = Smooth::random(random, 1, &arguments);
                for _ in 0..3 {
                    let z = speeds[below(random, speeds.len())];
                    function = function.plus_product(random, z, &arguments);
                }
                ConstraintPlan::Function(ConstraintKind::Velocity, function)
            }
            3 => ConstraintPlan::Velocity(
                below(random, last + 1),
                triple(random),
                triple(random),
                Smooth::random(random, 1, &arguments),
            ),
            _ => {
                let all = [arguments, speeds.clone(), speeds.clone()].concat();
                let own = speeds[below(random, speeds.len())];
                let function = Smooth::random(random, 3, &all).plus_multiple(8, own).plus_square(2, own);
                ConstraintPlan::Function(ConstraintKind::Velocity, function)
            }
        }
    }

    /// The same system with so many constraints that are affine in z.
    pub fn with_affine_constraints(mut self, random: &mut Random, count: usize) -> Self {
        self.constraints = (0..count).map(|_| self.constraint(random, true)).collect();
        self
    }
}

/// Shape of a random tree.
#[derive(Clone, Copy, Debug)]
pub struct TreeShape {
    pub bodies: usize,
    /// Every turn is about one axis.
    pub planar: bool,
    /// Most rates that the coordinates may have.
    pub rates: usize,
    pub choice: SpeedChoice,
    pub constraints: usize,
}

impl Plan {
    /// Rigid bodies, frames and particles in a tree.
    pub fn tree(random: &mut Random, shape: TreeShape) -> Self {
        let mut plan = Self::default();
        let axis = below(random, 3);
        for k in 0..shape.bodies {
            let parent = (k > 0 && below(random, 8) > 0).then(|| below(random, k));
            let (place, turns) = match (parent, shape.planar) {
                (None, false) if shape.rates >= plan.rate_count() + 6 && below(random, 2) == 0 => {
                    plan.free_joint(random)
                }
                _ => plan.joint(random, shape.planar.then_some(axis), shape.rates),
            };
            let frame = k > 0 && turns.iter().all(|turn| matches!(turn, TurnPlan::Quarter(_))) && below(random, 3) == 0;
            // A frame that slides would be a coordinate that moves nothing unless something hangs on it.
            let still = matches!(&place, JointPlace::Offset(offset) if offset.iter().all(Smooth::is_constant));
            let matter =
                if frame && still { MatterPlan::Nothing } else { MatterPlan::Solid(Box::new(Solid::random(random))) };
            plan.links.push(LinkPlan { parent, place, turns, matter });
        }
        for _ in 0..below(random, 3) {
            let mut offset: [Smooth; 3] = std::array::from_fn(|_| Smooth::random_constant(random));
            if below(random, 2) == 0 && plan.rate_count() < shape.rates {
                let q = plan.add(PlannedKind::Scalar);
                let i = below(random, 3);
                offset[i] = offset[i].clone().plus_multiple(8, q);
            }
            let parent = Some(below(random, shape.bodies));
            let matter = MatterPlan::Particle(1.5 + random.next());
            plan.links.push(LinkPlan { parent, place: JointPlace::Offset(offset), turns: Vec::new(), matter });
        }
        let choice = match shape.choice {
            SpeedChoice::Fewer(count) => SpeedChoice::Fewer(count.min(plan.rate_count())),
            other => other,
        };
        plan.choose_speeds(random, choice);
        plan.add_forces(random);
        plan.constraints =
            (0..shape.constraints.min(plan.speeds - 1)).map(|_| plan.constraint(random, false)).collect();
        plan
    }

    /// Place and turns of a root that floats.
    fn free_joint(&mut self, random: &mut Random) -> (JointPlace, Vec<TurnPlan>) {
        let coordinate = self.coordinates.len();
        self.add(PlannedKind::Pose { observed: below(random, 2) == 0 });
        (JointPlace::Pose(coordinate), vec![TurnPlan::Given(coordinate)])
    }

    fn joint(&mut self, random: &mut Random, only: Option<usize>, most: usize) -> (JointPlace, Vec<TurnPlan>) {
        let mut offset: [Smooth; 3] = std::array::from_fn(|_| Smooth::random_constant(random));
        let axis = only.unwrap_or_else(|| below(random, 3));
        let earlier = self.arguments();
        let room = most.saturating_sub(self.rate_count());
        let about = TurnPlan::About;
        let angle = |plan: &mut Self| Smooth::variable(plan.add(PlannedKind::Scalar));
        let slide = |plan: &mut Self, offset: &mut [Smooth; 3], i: usize| {
            let q = plan.add(PlannedKind::Scalar);
            offset[i] = offset[i].clone().plus_multiple(8, q);
        };
        // The first link always moves.
        let kind = if self.coordinates.is_empty() { 1 + below(random, 6) } else { below(random, 10) };
        let turns = match kind {
            1 if room > 0 => vec![about(axis, angle(self))],
            // A hinge on a slide along any axis.
            2 if room > 1 => {
                slide(self, &mut offset, below(random, 3));
                vec![about(axis, angle(self))]
            }
            2 if room > 0 => vec![about(axis, angle(self))],
            // A screw.
            3 if room > 0 => {
                slide(self, &mut offset, axis);
                vec![about(axis, Smooth::variable(self.variable_of(self.coordinates.len() - 1)))]
            }
            // Driven by time, in two neighbouring turns about one axis.
            4 if room > 0 => {
                vec![about(axis, angle(self)), about(axis, Smooth::random(random, 1, &[0]))]
            }
            // A gear: turned by what turns others too.
            5 if room > 0 => {
                let other = earlier[below(random, earlier.len())];
                vec![about(axis, angle(self).plus_multiple(4, other))]
            }
            6 | 7 if room > 1 && only.is_none() => {
                let other = (axis + 1 + below(random, 2)) % 3;
                vec![about(axis, angle(self)), about(other, angle(self))]
            }
            8 if room > 2 && only.is_none() => {
                let coordinate = self.coordinates.len();
                self.add(PlannedKind::Rotation);
                let turn = if below(random, 3) == 0 { TurnPlan::Back } else { TurnPlan::Given };
                vec![turn(coordinate)]
            }
            9 if room > 0 => {
                slide(self, &mut offset, below(random, 3));
                if below(random, 2) == 0 && only.is_none() { vec![TurnPlan::Quarter(axis)] } else { Vec::new() }
            }
            _ if self.coordinates.is_empty() => vec![about(axis, angle(self))],
            _ if only.is_none() => vec![TurnPlan::Quarter(axis)],
            _ => Vec::new(),
        };
        (JointPlace::Offset(offset), turns)
    }
}

impl Solid {
    /// Particles with principal axes along e about O, or anywhere.
    fn random(random: &mut Random) -> Self {
        let inertia = [Shape::Scalar, Shape::Vector3, Shape::Matrix3][below(random, 3)];
        let mut length = || 0.7 + 0.4 * random.next();
        let radii = [length(), length(), length()];
        let (mass, height) = (length(), length());
        let pair = |axis: usize, radius: f64, height: f64| {
            [-1.0, 1.0].map(|sign| {
                let mut x = [0.0, 0.0, height];
                x[axis] += sign * radius;
                (x, mass)
            })
        };
        let centered = below(random, 2) == 0;
        let points = match inertia {
            Shape::Scalar => (0..3).flat_map(|axis| pair(axis, radii[0], 0.0)).collect(),
            Shape::Vector3 => {
                let height = if centered { 0.0 } else { height };
                (0..3).flat_map(|axis| pair(axis, radii[axis], height)).collect()
            }
            _ => (0..5).map(|_| (std::array::from_fn(|_| random.next()), 1.0 + 0.5 * random.next())).collect(),
        };
        let displaced = (below(random, 3) == 0).then(|| (1.0 + random.next(), std::array::from_fn(|_| random.next())));
        let has_center = inertia == Shape::Matrix3 || (inertia == Shape::Vector3 && !centered);
        let added_mass = (below(random, 6) == 0).then(|| {
            // BᵀB is an energy for every B.
            let b: [[f64; 6]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| 0.5 * random.next()));
            std::array::from_fn(|i| std::array::from_fn(|j| (0..6).map(|k| b[k][i] * b[k][j]).sum()))
        });
        Self { inertia, has_center, points, displaced, added_mass }
    }

    pub fn mass(&self) -> f64 {
        self.points.iter().map(|(_, m)| m).sum()
    }

    /// G − O.
    pub fn center(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.points.iter().map(|(x, m)| m * x[i]).sum::<f64>() / self.mass())
    }

    /// I_O.
    pub fn inertia(&self, i: usize, j: usize) -> f64 {
        let own = |(x, m): &([f64; 3], f64)| {
            let square: f64 = x.iter().map(|x| x * x).sum();
            m * (if i == j { square } else { 0.0 } - x[i] * x[j])
        };
        self.points.iter().map(own).sum()
    }
}
