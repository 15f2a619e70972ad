//! Directions of the derivatives of the equations by the state: one for each component of an increment of the
//! configuration, for each speed, for time and for each input.
//!
//! Increments are those of the runtime, seen from the body: along `q ∘ exp(σ)` the rate of R is R σ̂ and that of b is R
//! σ_u, as under a velocity V = σ. So the directions of the configuration are its rates with V a unit vector.

use crate::algebra::{Expr, Graph};
use crate::derivatives::{Columns, DerivativeForm, Direction, DirectionalDerivatives, Equation, ParametricDerivatives};

use crate::mechanics::derivatives::implicit::AccelerationsWithDerivatives;
use crate::mechanics::derivatives::rigid::Rates;
use crate::mechanics::formula::Formulas;
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::rotation::poisson;
use crate::mechanics::kinematics::vector::Triple;
use crate::mechanics::scene::SystemScene;
use crate::mechanics::system::System;

/// Derivatives of V, component by component in the order of increments, then of ż.
pub struct Linearization<'g> {
    /// Along the components of an increment, the speeds, time, and the inputs, in this order.
    pub differentiated: DirectionalDerivatives<'g>,
    /// Numbers of components of an increment, and of speeds.
    increments: usize,
    speeds: usize,
    /// The components of an increment in the order of ψ.
    order: Vec<usize>,
}

/// The components of an increment of the configuration: elements of groups come first, then all scalars.
pub struct Increments<'g> {
    /// Directions in which the configuration is moved, component by component.
    pub directions: Vec<Direction<'g>>,
    /// Place of each of them in ψ, which is in the order of the coordinates.
    pub order: Vec<usize>,
}

impl<'g> Increments<'g> {
    pub fn of(scene: &SystemScene<'g>) -> Self {
        let graph = scene.graph;
        let (mut groups, mut scalars) = (Vec::new(), Vec::new());
        let (mut of_groups, mut of_scalars) = (Vec::new(), Vec::new());
        let mut component = 0;
        for coordinate in &scene.coordinates {
            let own = component..component + coordinate.size();
            component = own.end;
            let directions = along(graph, coordinate);
            match coordinate {
                Coordinate::Scalar(_) => {
                    scalars.extend(directions);
                    of_scalars.extend(own);
                }
                _ => {
                    groups.extend(directions);
                    of_groups.extend(own);
                }
            }
        }
        groups.extend(scalars);
        of_groups.extend(of_scalars);
        Self { directions: groups, order: of_groups }
    }
}

/// One coordinate along each component of its increment.
fn along<'g>(graph: &'g Graph, coordinate: &Coordinate<'g>) -> Vec<Direction<'g>> {
    match coordinate {
        Coordinate::Scalar(q) => vec![vec![(*q, graph.one())]],
        Coordinate::Rotation(rotation) => along_rotation(graph, rotation),
        Coordinate::Pose(rotation, position) => along_pose(graph, rotation, position),
        Coordinate::Plane { turn: [cosine, sine], position: [b1, b2] } => vec![
            vec![(*b1, *cosine), (*b2, *sine)],
            vec![(*b1, -*sine), (*b2, *cosine)],
            vec![(*cosine, -*sine), (*sine, *cosine)],
        ],
    }
}

/// Symbols, each by itself.
pub fn alone<'g>(graph: &'g Graph, symbols: &[Expr<'g>]) -> Vec<Direction<'g>> {
    symbols.iter().map(|&symbol| vec![(symbol, graph.one())]).collect()
}

impl<'g> Linearization<'g> {
    /// The derivatives of V and ż by parameters, one after the other, in forms of their own.
    pub fn derived_by_parameters(&self, system: &System<'g>, parameters: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
        let velocity = &self.differentiated.arrangements[0][..self.increments];
        let one = system.scene.graph.one();
        let directions: Vec<Rates<'g>> = parameters.iter().map(|p| Rates::from_iter([(p.key(), one)])).collect();
        let beside = |accelerations: Vec<Expr<'g>>| {
            let accelerations = accelerations.chunks(self.speeds).zip(&directions);
            let both = accelerations.flat_map(|(rates, direction)| {
                velocity.iter().map(|v| v.derivative(direction)).chain(rates.iter().copied())
            });
            both.collect()
        };
        system.accelerations_by_parameters(&directions).into_iter().map(beside).collect()
    }

    /// The derivatives of the same functions by parameters. Without constraints accelerations solve ∂C/∂ż = 0, whose
    /// matrix A is the one that takes z to the momenta.
    pub fn by_parameters(&self, system: &System<'g>, parameters: Vec<Expr<'g>>) -> ParametricDerivatives<'g> {
        let equation = || Equation { unknowns: system.scene.speed_rates.clone(), loads: system.scene.momenta.clone() };
        ParametricDerivatives {
            derived: self.derived_by_parameters(system, &parameters),
            parameters,
            order: self.order.clone(),
            equation: system.constraints.is_empty().then(equation),
        }
    }

    pub fn new(system: &System<'g>, formulas: &Formulas<'g>) -> Self {
        let scene = &system.scene;
        let graph = scene.graph;
        let Increments { mut directions, order } = Increments::of(scene);
        let increments = directions.len();
        let velocity: Vec<Expr<'g>> = order.iter().map(|&k| scene.kinematics[k]).collect();
        directions.extend(alone(graph, &scene.speeds));
        directions.push(scene.along_time());
        directions.extend(alone(graph, &scene.inputs));
        // Forms of their own know masses that stay.
        let derived = if scene.matter_time.is_some() { Vec::new() } else { derived(system, &velocity, &directions) };
        // Derivatives with a form of their own solve for all columns without wrenches: where accelerations keep digits
        // because these are gathered first, that would be asked of columns that cost half as much.
        let gathered = if derived.is_empty() { Vec::new() } else { system.gathered_accelerations() };
        let all = &formulas.acceleration;
        let others: Vec<&Vec<Expr<'g>>> = all.iter().filter(|outputs| !gathered.contains(outputs)).collect();
        // Where every arrangement is one of these, as of particles that hang on nothing, they stay.
        let arrangements = if others.is_empty() { all.iter().collect() } else { others };
        let arrangements =
            arrangements.into_iter().map(|outputs| velocity.iter().chain(outputs).copied().collect()).collect();
        Self {
            differentiated: DirectionalDerivatives { arrangements, defined: system.defined(), directions, derived },
            increments,
            speeds: scene.speeds.len(),
            order,
        }
    }
}

/// V and ż, and then their derivatives along each of the directions, where these have forms of their own.
fn derived<'g>(system: &System<'g>, velocity: &[Expr<'g>], directions: &[Direction<'g>]) -> Vec<DerivativeForm<'g>> {
    let rates = |direction: &Direction<'g>| direction.iter().map(|(symbol, rate)| (symbol.key(), *rate)).collect();
    let directions: Vec<Rates<'g>> = directions.iter().map(rates).collect();
    let of_velocity = |direction: &Rates<'g>| velocity.iter().map(|v| v.derivative(direction)).collect();
    let velocities: Vec<Vec<Expr<'g>>> =
        std::iter::once(velocity.to_vec()).chain(directions.iter().map(of_velocity)).collect();
    let beside = |ways: &[Vec<Expr<'g>>], velocities: &[Vec<Expr<'g>>]| -> Vec<Expr<'g>> {
        velocities.iter().zip(ways).flat_map(|(v, a)| v.iter().chain(a)).copied().collect()
    };
    let way = |way: AccelerationsWithDerivatives<'g>| {
        let unsolved = way.unsolved.map(|unsolved| {
            let values = beside(&way.outputs[..1], &velocities);
            let added = beside(&unsolved.added, &velocities[1..]);
            Columns::new(values, added, velocity.len(), unsolved.factors, unsolved.rights)
        });
        DerivativeForm { outputs: beside(&way.outputs, &velocities), columns: unsolved }
    };
    system.accelerations_with_derivatives(&directions, None).into_iter().map(way).collect()
}

impl<'g> System<'g> {
    /// Entries of rotations that stand for expressions of quaternions; the instant of mass data, which is the time.
    pub fn defined(&self) -> Vec<Expr<'g>> {
        let rotations = self.scene.coordinates.iter().filter_map(Coordinate::rotation);
        rotations.flatten().flatten().copied().chain(self.scene.matter_time).collect()
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
