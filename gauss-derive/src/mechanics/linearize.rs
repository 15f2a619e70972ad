//! What the derivatives of the equations by the state are taken along: a direction for each component of an increment of the
//! configuration, for each speed, for time and for each input.
//!
//! Increments are those of the runtime, seen from the body: along `q ∘ exp(σ)` the rate of R is R σ̂ and that of b is R σ_u, as
//! under a velocity V = σ. So the directions of the configuration are its rates with V a unit vector.

use crate::algebra::{Expr, Graph};
use crate::kernel::{Differentiated, Direction};

use super::chart::ConfigurationKind;
use super::methods::{Formula, Method, Scene};
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
}

impl<'g> Linearization<'g> {
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
            ConfigurationKind::PlanePose => {
                // (cos θ, sin θ) and b₁ b₂ under (u₁, u₂, ω).
                let (cosine, sine, b1, b2) = (symbols[0], symbols[1], symbols[2], symbols[3]);
                vec![
                    vec![(b1, cosine), (b2, sine)],
                    vec![(b1, -sine), (b2, cosine)],
                    vec![(cosine, -sine), (sine, cosine)],
                ]
            }
        };
        let defined = match kinematics.kind {
            ConfigurationKind::Pose | ConfigurationKind::Rotation => symbols[..9].to_vec(),
            _ => Vec::new(),
        };
        let (time, inputs) = match &scene.acting {
            Some(acting) => (vec![(acting.time, graph.one())], acting.inputs.as_slice()),
            None => (Vec::new(), [].as_slice()),
        };
        let order: Vec<usize> = (0..increments.len()).collect();
        Self::new(graph, formulas, &order, increments, defined, &kinematics.speeds, time, inputs)
    }

    /// Of a system.
    pub fn of_system(system: &System<'g>, formulas: &[Formula<'g>]) -> Self {
        let scene = &system.scene;
        let graph = scene.graph;
        let mut defined = Vec::new();
        let (mut groups, mut scalars) = (Vec::new(), Vec::new());
        // Elements of groups come first in an increment, then all scalars; ψ is in the order of the coordinates.
        let (mut of_groups, mut of_scalars) = (Vec::new(), Vec::new());
        let mut component = 0;
        for coordinate in &scene.coordinates {
            let own = component..component + coordinate.size();
            component = own.end;
            defined.extend(coordinate.rotation().into_iter().flatten().flatten().copied());
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
            }
        }
        groups.extend(scalars);
        of_groups.extend(of_scalars);
        let time = vec![(scene.time, graph.one())];
        Self::new(graph, formulas, &of_groups, groups, defined, &scene.speeds, time, &scene.inputs)
    }

    #[expect(clippy::too_many_arguments, reason = "all that a scene is, once from each kind of scene")]
    fn new(
        graph: &'g Graph,
        formulas: &[Formula<'g>],
        order: &[usize],
        increments: Vec<Direction<'g>>,
        defined: Vec<Expr<'g>>,
        speeds: &[Expr<'g>],
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
        }
    }
}

/// (R, b) under u and then ω, each a unit vector in body axes: ḃ = R u, Ṙ = R [ω]×.
fn along_pose<'g>(graph: &'g Graph, rotation: &[Triple<'g>; 3], position: &Triple<'g>) -> Vec<Direction<'g>> {
    let translations = (0..3).map(|k| (0..3).map(|i| (position[i], rotation[i][k])).collect());
    translations.chain(along_rotation(graph, rotation)).collect()
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
