//! What the derivatives of the equations by the state are taken along: a direction for each component of an increment of the
//! configuration, for each speed, for time and for each input.
//!
//! Increments are those of the runtime, seen from the body: along `q ∘ exp(σ)` the rate of R is R σ̂ and that of b is R σ_u, as
//! under a velocity V = σ. So the directions of the configuration are its rates with V a unit vector.

use crate::algebra::{Expr, Graph};
use crate::kernel::{ByParameters, Differentiated, Direction, Equation};

use super::chart::ConfigurationKind;
use super::formula::{Formula, Method};
use super::methods::Scene;
use super::rotation::poisson;
use super::system::{Coordinate, System};
use super::vector::Triple;

/// What is differentiated: V, component by component in the order of increments, then ż.
pub struct Linearization<'g> {
    /// Along the components of an increment, the speeds, time, and the inputs, in this order.
    pub differentiated: Differentiated<'g>,
    /// How many components an increment has.
    pub increments: usize,
    pub speeds: usize,
    pub inputs: usize,
    /// The components of an increment in the order of ψ.
    order: Vec<usize>,
    speed_rates: Vec<Expr<'g>>,
    momenta: Vec<Expr<'g>>,
    /// Accelerations are those that constraints admit.
    constrained: bool,
}

impl<'g> Linearization<'g> {
    /// The derivatives of the same functions by parameters. Without constraints accelerations solve ∂C/∂ż = 0, whose matrix A is
    /// the one that takes z to the momenta.
    pub fn by_parameters<'a>(&'a self, formulas: &[Formula<'g>], parameters: &'a [Expr<'g>]) -> ByParameters<'a, 'g> {
        let number = |method: Method| {
            let number = formulas.iter().position(|formula| formula.method == method);
            number.expect("every kernel has the methods of a system")
        };
        ByParameters {
            parameters,
            velocity: number(Method::Kinematics),
            order: &self.order,
            acceleration: number(Method::Acceleration),
            equation: (!self.constrained).then(|| Equation {
                residual: number(Method::GaussResidual),
                unknowns: &self.speed_rates,
                solution: number(Method::Velocity),
                loads: &self.momenta,
            }),
        }
    }

    /// Of one body in a chart.
    pub fn of_body(scene: &Scene<'g>, formulas: &[Formula<'g>]) -> Self {
        let kinematics = &scene.kinematics;
        let graph = kinematics.frame.graph;
        let symbols = &kinematics.configuration;
        let rotation = &kinematics.frame.rotation;
        let increments = match kinematics.kind {
            ConfigurationKind::Coordinates => symbols.iter().map(|&q| vec![(q, graph.one())]).collect(),
            ConfigurationKind::Pose => along_pose(graph, rotation, &kinematics.position),
            ConfigurationKind::Rotation => along_rotation(graph, rotation),
            ConfigurationKind::PlanePose => along_plane([symbols[0], symbols[1]], [symbols[2], symbols[3]]),
        };
        let defined = scene.defined();
        let (time, inputs) = match &scene.acting {
            Some(acting) => (vec![(acting.time, graph.one())], acting.inputs.as_slice()),
            None => (Vec::new(), [].as_slice()),
        };
        let order: Vec<usize> = (0..increments.len()).collect();
        let speeds = [&kinematics.speeds, &kinematics.speed_rates, &scene.momenta].map(Vec::as_slice);
        Self::new(graph, formulas, order, increments, defined, speeds, time, inputs)
    }

    /// Of a system.
    pub fn of_system(system: &System<'g>, formulas: &[Formula<'g>]) -> Self {
        let scene = &system.scene;
        let graph = scene.graph;
        let defined = system.defined();
        let (mut groups, mut scalars) = (Vec::new(), Vec::new());
        // Elements of groups come first in an increment, then all scalars; ψ is in the order of the coordinates.
        let (mut of_groups, mut of_scalars) = (Vec::new(), Vec::new());
        let mut component = 0;
        for coordinate in &scene.coordinates {
            let own = component..component + coordinate.size();
            component = own.end;
            match coordinate {
                Coordinate::Scalar(q) => {
                    scalars.push(vec![(*q, graph.one())]);
                    of_scalars.extend(own);
                }
                Coordinate::Rotation(rotation) => {
                    groups.extend(along_rotation(graph, rotation));
                    of_groups.extend(own);
                }
                Coordinate::Pose(rotation, position) => {
                    groups.extend(along_pose(graph, rotation, position));
                    of_groups.extend(own);
                }
                Coordinate::Plane { turn, position } => {
                    groups.extend(along_plane(*turn, *position));
                    of_groups.extend(own);
                }
            }
        }
        groups.extend(scalars);
        of_groups.extend(of_scalars);
        let time = vec![(scene.time, graph.one())];
        let speeds = [&scene.speeds, &scene.speed_rates, &scene.momenta].map(Vec::as_slice);
        let whole = Self::new(graph, formulas, of_groups, groups, defined, speeds, time, &scene.inputs);
        Self { constrained: !system.constraints.is_empty(), ..whole }
    }

    #[expect(clippy::too_many_arguments, reason = "all that a scene is, once from each kind of scene")]
    fn new(
        graph: &'g Graph,
        formulas: &[Formula<'g>],
        order: Vec<usize>,
        increments: Vec<Direction<'g>>,
        defined: Vec<Expr<'g>>,
        [speeds, speed_rates, momenta]: [&[Expr<'g>]; 3],
        time: Direction<'g>,
        inputs: &[Expr<'g>],
    ) -> Self {
        let arrangements_of = |method: Method| -> &[Vec<Expr<'g>>] {
            let formula = formulas.iter().find(|formula| formula.method == method);
            &formula.expect("every kernel has kinematics and accelerations").arrangements
        };
        let kinematics = &arrangements_of(Method::Kinematics)[0];
        let velocity: Vec<Expr<'g>> = order.iter().map(|&k| kinematics[k]).collect();
        let arrangements = arrangements_of(Method::Acceleration).iter();
        let arrangements = arrangements.map(|outputs| velocity.iter().chain(outputs).copied().collect()).collect();
        let alone = |symbols: &[Expr<'g>]| -> Vec<Direction<'g>> {
            symbols.iter().map(|&symbol| vec![(symbol, graph.one())]).collect()
        };
        let count = increments.len();
        let mut directions = increments;
        directions.extend(alone(speeds));
        directions.push(time);
        directions.extend(alone(inputs));
        Self {
            differentiated: Differentiated { arrangements, defined, directions },
            increments: count,
            speeds: speeds.len(),
            inputs: inputs.len(),
            order,
            speed_rates: speed_rates.to_vec(),
            momenta: momenta.to_vec(),
            constrained: false,
        }
    }
}

impl<'g> Scene<'g> {
    /// Entries of R that stand for expressions of a quaternion.
    pub fn defined(&self) -> Vec<Expr<'g>> {
        match self.kinematics.kind {
            ConfigurationKind::Pose | ConfigurationKind::Rotation => self.kinematics.configuration[..9].to_vec(),
            _ => Vec::new(),
        }
    }
}

impl<'g> System<'g> {
    /// Entries of rotations that stand for expressions of quaternions.
    pub fn defined(&self) -> Vec<Expr<'g>> {
        let rotations = self.scene.coordinates.iter().filter_map(Coordinate::rotation);
        rotations.flatten().flatten().copied().collect()
    }
}

/// (R, b) under u and then ω, each a unit vector in body axes: ḃ = R u, Ṙ = R [ω]×.
fn along_pose<'g>(graph: &'g Graph, rotation: &[Triple<'g>; 3], position: &Triple<'g>) -> Vec<Direction<'g>> {
    let translations = (0..3).map(|k| (0..3).map(|i| (position[i], rotation[i][k])).collect());
    translations.chain(along_rotation(graph, rotation)).collect()
}

/// (cos θ, sin θ) and b₁ b₂ under (u₁, u₂, ω).
fn along_plane<'g>([cosine, sine]: [Expr<'g>; 2], [b1, b2]: [Expr<'g>; 2]) -> Vec<Direction<'g>> {
    vec![vec![(b1, cosine), (b2, sine)], vec![(b1, -sine), (b2, cosine)], vec![(cosine, -sine), (sine, cosine)]]
}

/// R under a unit vector ω in body axes.
fn along_rotation<'g>(graph: &'g Graph, rotation: &[Triple<'g>; 3]) -> Vec<Direction<'g>> {
    let entries: Vec<Expr<'g>> = rotation.iter().flatten().copied().collect();
    let about = |k: usize| {
        let axis: Triple<'g> = std::array::from_fn(|i| if i == k { graph.one() } else { graph.zero() });
        let rates = poisson(rotation, &axis);
        entries.iter().copied().zip(rates.map(|(_, rate)| rate)).collect()
    };
    (0..3).map(about).collect()
}
