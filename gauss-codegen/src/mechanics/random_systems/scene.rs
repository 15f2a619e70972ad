//! From a plan to the scene of a system, as the translation of an attribute does it.

use crate::algebra::{Expr, Graph, Map};
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::rotation::rotation_of_quaternion;
use crate::mechanics::kinematics::turn::Turn;
use crate::mechanics::kinematics::vector::{Axes, Triple, Vector, dot, subtract};
use crate::mechanics::links::link::{Matter, Placement};
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::{Action, Element};
use crate::mechanics::matter::body::{Body, BodyShape};
use crate::mechanics::name::Name;
use crate::mechanics::scene::SystemScene;
use crate::mechanics::scene::constraint::{Constraint, ConstraintKind};
use crate::terms::{Role, Shape};

use super::plan::{ConstraintPlan, JointPlace, LinkPlan, MatterPlan, Plan, PlannedKind, Solid, TurnPlan};

/// Everything that a plan names, as symbols.
pub struct PlanSymbols<'g> {
    graph: &'g Graph,
    pub time: Expr<'g>,
    /// Symbols of q, coordinate by coordinate.
    pub configuration: Vec<Expr<'g>>,
    pub speeds: Vec<Expr<'g>>,
    pub speed_rates: Vec<Expr<'g>>,
    pub momenta: Vec<Expr<'g>>,
    gravity: Option<Triple<'g>>,
    matter: Vec<MatterSymbols<'g>>,
    /// Values of the parameters.
    pub parameters: Map<u32, f64>,
    /// Components behind each rotation, and its entries in terms of them.
    pub quaternions: Vec<[Expr<'g>; 4]>,
    pub definitions: Map<u32, Expr<'g>>,
}

#[derive(Clone)]
enum MatterSymbols<'g> {
    Nothing,
    Particle(Expr<'g>),
    Body(Box<Body<'g>>),
}

impl<'g> PlanSymbols<'g> {
    pub fn new(graph: &'g Graph, plan: &Plan) -> Self {
        let many = |letter: &str, count: usize, constant: bool| -> Vec<Expr<'g>> {
            (1..=count).map(|k| graph.symbol(format!("{letter}{k}"), format!("{letter}_{{{k}}}"), constant)).collect()
        };
        let mut symbols = Self {
            graph,
            time: graph.symbol("t", "t", false),
            configuration: many("q", plan.symbol_count(), false),
            speeds: many("z", plan.speeds, false),
            speed_rates: many("a", plan.speeds, false),
            momenta: many("p", plan.speeds, false),
            gravity: None,
            matter: Vec::new(),
            parameters: Map::default(),
            quaternions: Vec::new(),
            definitions: Map::default(),
        };
        symbols.gravity = plan.gravity.map(|g| {
            let own = many("g", 3, true);
            symbols.parameters.extend(own.iter().zip(g).map(|(s, x)| (s.key(), x)));
            [own[0], own[1], own[2]]
        });
        let matter = plan.links.iter().enumerate().map(|(k, link)| symbols.matter(k, &link.matter)).collect();
        symbols.matter = matter;
        for (k, _) in plan.coordinates.iter().enumerate().filter(|(_, kind)| **kind != PlannedKind::Scalar) {
            let quaternion = ["x", "y", "z", "w"].map(|name| graph.symbol(name, name, false));
            let entries = rotation_of_quaternion(graph, quaternion).into_iter().flatten().map(Expr::group);
            let first = plan.variable_of(k) - 1;
            symbols.definitions.extend(symbols.configuration[first..first + 9].iter().map(|s| s.key()).zip(entries));
            symbols.quaternions.push(quaternion);
        }
        symbols
    }

    fn matter(&mut self, link: usize, matter: &MatterPlan) -> MatterSymbols<'g> {
        match matter {
            MatterPlan::Nothing => MatterSymbols::Nothing,
            MatterPlan::Particle(mass) => {
                let symbol = self.graph.symbol(format!("m{link}"), format!("m_{{{link}}}"), true);
                self.parameters.insert(symbol.key(), *mass);
                MatterSymbols::Particle(symbol)
            }
            MatterPlan::Solid(solid) => {
                let shape = BodyShape {
                    inertia: solid.inertia,
                    central: false,
                    center_of_mass: solid.has_center,
                    added_mass: solid.added_mass.map(|_| Shape::Matrix6),
                    gravity: None,
                    displaced_mass: solid.displaced.is_some(),
                    center_of_buoyancy: solid.displaced.is_some(),
                };
                let name = format!("body{link}");
                let mut body = Body::named(self.graph, shape, 2, Name::new(&name, &name));
                body.gravity = self.gravity;
                for p in &body.parameters {
                    self.parameters.insert(p.symbol.key(), parameter(solid, p.quantity, p.row, p.column));
                }
                MatterSymbols::Body(Box::new(body))
            }
        }
    }

    /// The symbols of all parameters.
    pub fn all_parameters(&self) -> Vec<Expr<'g>> {
        let of_matter = |matter: &MatterSymbols<'g>| match matter {
            MatterSymbols::Nothing => Vec::new(),
            MatterSymbols::Particle(mass) => vec![*mass],
            MatterSymbols::Body(body) => body.parameters.iter().map(|parameter| parameter.symbol).collect(),
        };
        self.gravity.into_iter().flatten().chain(self.matter.iter().flat_map(of_matter)).collect()
    }

    /// The coordinates as the scene has them.
    fn coordinates(&self, plan: &Plan) -> Vec<Coordinate<'g>> {
        let of = |(k, kind): (usize, &PlannedKind)| {
            let own = &self.configuration[plan.variable_of(k) - 1..];
            let rotation = || std::array::from_fn(|i| std::array::from_fn(|j| own[3 * i + j]));
            match kind {
                PlannedKind::Scalar => Coordinate::Scalar(own[0]),
                PlannedKind::Rotation => Coordinate::Rotation(rotation()),
                PlannedKind::Pose { .. } => Coordinate::Pose(rotation(), [own[9], own[10], own[11]]),
            }
        };
        plan.coordinates.iter().enumerate().map(of).collect()
    }

    /// The scene whose speeds have the given values in terms of those that are kept; moments regrouped or as they are.
    pub fn scene(&self, plan: &Plan, values: &[Expr<'g>], kept: &[usize], regrouped: bool) -> SystemScene<'g> {
        let variables: Vec<Expr<'g>> =
            std::iter::once(self.time).chain(self.configuration.iter().chain(values).copied()).collect();
        let (kinematics, symbol_rates) = plan.rates(&variables);
        let mut rates: Map<u32, Expr<'g>> = Map::from_iter([(self.time.key(), self.graph.one())]);
        rates.extend(self.configuration.iter().map(|s| s.key()).zip(symbol_rates));
        let coordinates = self.coordinates(plan);
        let pick = |all: &[Expr<'g>]| -> Vec<Expr<'g>> { kept.iter().map(|&k| all[k]).collect() };
        let building = SceneBuilder {
            plan,
            coordinates: &coordinates,
            variables: &variables,
            kinematics: &kinematics,
            rates: &rates,
        };
        let placements = plan.links.iter().zip(&self.matter).map(|(link, matter)| building.placement(link, matter));
        let (bodies, particles): (Vec<_>, Vec<_>) =
            placements.partition(|placement| !matches!(placement.matter, Matter::Particle(_)));
        let mut tree = Tree::new(self.graph, bodies, pick(&self.speeds), rates.clone(), self.gravity);
        particles.into_iter().for_each(|placement| tree.hang(placement));
        let constraints = plan.constraints.iter().enumerate();
        let constraints =
            constraints.map(|(clause, constraint)| building.constraint(clause, constraint, &tree)).collect();
        if regrouped {
            tree.settle();
        } else {
            tree.settle_without_regrouping();
        }
        let names = |letter: &str, count: usize| -> Vec<Name> {
            (0..count).map(|k| Name::new(letter, letter).index(k)).collect()
        };
        SystemScene {
            graph: self.graph,
            time: self.time,
            matter_time: None,
            coordinate_names: names("q", coordinates.len()),
            states: 0..0,
            speeds: pick(&self.speeds),
            charted: None,
            momentum_names: names("p", kept.len()),
            force_names: names("F", kept.len()),
            speed_rates: pick(&self.speed_rates),
            momenta: pick(&self.momenta),
            coordinates,
            kinematics,
            rates,
            tree,
            constraints,
            redundant: false,
            contacts: Vec::new(),
            inputs: Vec::new(),
            elements: plan
                .potential
                .iter()
                .map(|potential| Element::new("potential".to_owned(), Action::Potential(potential.at(&variables))))
                .collect(),
        }
    }
}

/// The value of a parameter of a body.
fn parameter(solid: &Solid, quantity: Role, row: usize, column: usize) -> f64 {
    match quantity {
        Role::Mass => solid.mass(),
        Role::CenterOfMass => solid.center()[row],
        Role::Inertia | Role::CentralInertia => match solid.inertia {
            Shape::Matrix3 => solid.inertia(row, column),
            _ => solid.inertia(row, row),
        },
        Role::DisplacedMass => solid.displaced.map_or(0.0, |(mass, _)| mass),
        Role::CenterOfBuoyancy => solid.displaced.map_or(0.0, |(_, center)| center[row]),
        Role::AddedMass => solid.added_mass.map_or(0.0, |added| added[row][column]),
        Role::Gravity | Role::Body => 0.0,
    }
}

struct SceneBuilder<'a, 'g> {
    plan: &'a Plan,
    coordinates: &'a [Coordinate<'g>],
    variables: &'a [Expr<'g>],
    kinematics: &'a [Expr<'g>],
    rates: &'a Map<u32, Expr<'g>>,
}

impl<'g> SceneBuilder<'_, 'g> {
    fn graph(&self) -> &'g Graph {
        self.variables[0].graph()
    }

    fn placement(&self, link: &LinkPlan, matter: &MatterSymbols<'g>) -> Placement<'g> {
        let (position, velocity) = match &link.place {
            JointPlace::Offset(offset) => (self.triple(offset), None),
            JointPlace::Pose(k) => match (&self.coordinates[*k], self.plan.coordinates[*k]) {
                (Coordinate::Pose(_, position), PlannedKind::Pose { observed }) => {
                    let rate = self.rate_of(*k);
                    (*position, (!observed).then(|| [rate[0], rate[1], rate[2]]))
                }
                _ => unreachable!("a pose is a coordinate of that kind"),
            },
        };
        Placement {
            matter: match matter {
                MatterSymbols::Nothing => Matter::Nothing,
                MatterSymbols::Particle(mass) => Matter::Particle(*mass),
                MatterSymbols::Body(body) => Matter::Body(body.clone()),
            },
            parent: link.parent,
            position,
            velocity: velocity.map(|body| Vector { body, space: [self.graph().zero(); 3] }),
            angular_velocity: None,
            turns: link.turns.iter().map(|turn| self.turn(turn)).collect(),
        }
    }

    fn triple(&self, components: &[super::numbers::Smooth; 3]) -> Triple<'g> {
        [0, 1, 2].map(|i| components[i].at(self.variables))
    }

    fn rate_of(&self, coordinate: usize) -> &[Expr<'g>] {
        let kinds = &self.plan.coordinates;
        let first: usize = kinds[..coordinate].iter().map(|kind| kind.rates()).sum();
        &self.kinematics[first..first + kinds[coordinate].rates()]
    }

    fn turn(&self, turn: &TurnPlan) -> Turn<'g> {
        let graph = self.graph();
        let given = |k: usize| {
            let rate = self.rate_of(k);
            let [.., w1, w2, w3] = rate else { unreachable!("rotations have three rates") };
            let rotation = self.coordinates[k].rotation().expect("a coordinate with a rotation");
            Turn::given(*rotation, [*w1, *w2, *w3])
        };
        match turn {
            TurnPlan::About(axis, angle) => Turn::about(graph, *axis, angle.at(self.variables), self.rates),
            TurnPlan::Given(k) => given(*k),
            TurnPlan::Back(k) => given(*k).inverse(),
            TurnPlan::Quarter(axis) => {
                let integers = super::witness::quarter_turn(*axis);
                Turn::given(integers.map(|row| row.map(|e| graph.integer(e))), [graph.zero(); 3])
            }
        }
    }

    fn constraint(&self, clause: usize, constraint: &ConstraintPlan, tree: &Tree<'g>) -> Constraint<'g> {
        let (kind, value) = match constraint {
            ConstraintPlan::Function(kind, function) => (*kind, function.at(self.variables)),
            ConstraintPlan::Distance(a, b) => {
                let from = b.map_or([self.graph().zero(); 3], |b| tree.links[b].position);
                let arm = subtract(&tree.links[*a].position, &from);
                (ConstraintKind::Position, dot(&arm, &arm) - self.graph().one())
            }
            ConstraintPlan::Velocity(k, a, b, c) => {
                let link = &tree.links[*k];
                let velocity = link.frame.resolve(&link.velocity, Axes::Space);
                let omega = link.frame.to_space(&link.angular_velocity).map(Expr::group);
                let value = dot(&self.triple(a), &velocity) + dot(&self.triple(b), &omega) + c.at(self.variables);
                (ConstraintKind::Velocity, value)
            }
        };
        Constraint { kind, value, clause }
    }
}
