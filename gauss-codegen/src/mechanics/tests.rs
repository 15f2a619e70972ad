//! Every formula of every chart, motion and body against the literal Gauss condition at random states.

use crate::algebra::{Evaluation, Expr, Graph, Map};
use crate::terms::{BodyChart, Chart, Motion, Role, RotationChart, Shape};

use crate::mechanics::arrangements::free_link::FreeLink;
use crate::mechanics::check::definition::gauss_condition;
use crate::mechanics::formula::Method;
use crate::mechanics::kinematics::chart::ChartedBody;
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::rotation::rotation_of_quaternion;
use crate::mechanics::links::link::Matter;
use crate::mechanics::links::tree::Tree;
use crate::mechanics::loads::forces::Element;
use crate::mechanics::matter::body::{Body, BodyShape};
use crate::mechanics::scene::{ChartedLink, SystemScene};
use crate::mechanics::system::System;

pub fn rotation_charts() -> Vec<RotationChart> {
    let mut charts = Vec::new();
    for a in 0..3 {
        for b in 0..3 {
            for c in 0..3 {
                if a != b && b != c {
                    charts.push(RotationChart::Euler([a, b, c]));
                }
            }
        }
    }
    charts.extend([RotationChart::Rodrigues, RotationChart::ModifiedRodrigues]);
    charts
}

pub fn scenes() -> Vec<(Motion, Chart)> {
    let group = [Chart::LeftInvariant, Chart::RightInvariant, Chart::Hybrid];
    let mut all = Vec::new();
    for motion in [Motion::Free, Motion::FixedPoint, Motion::Planar] {
        all.extend(group.iter().map(|&chart| (motion, chart)));
    }
    for motion in [Motion::Free, Motion::FixedPoint] {
        all.extend(rotation_charts().into_iter().map(|chart| (motion, Chart::Jet(chart))));
    }
    all.push((Motion::Planar, Chart::Jet(RotationChart::Angle)));
    all
}

pub fn shapes() -> Vec<BodyShape> {
    let principal = BodyShape {
        inertia: Shape::Vector3,
        central: false,
        center_of_mass: false,
        added_mass: None,
        gravity: None,
        displaced_mass: false,
        center_of_buoyancy: false,
    };
    let heavy = BodyShape { gravity: Some(Shape::Scalar), ..principal };
    let off_centre = BodyShape { center_of_mass: true, inertia: Shape::Matrix3, ..heavy };
    let fluid = BodyShape { added_mass: Some(Shape::Vector6), ..principal };
    let everything = BodyShape {
        added_mass: Some(Shape::Matrix6),
        gravity: Some(Shape::Vector3),
        displaced_mass: true,
        center_of_buoyancy: true,
        ..off_centre
    };
    vec![
        principal,
        BodyShape { inertia: Shape::Scalar, ..principal },
        heavy,
        BodyShape { gravity: None, ..off_centre },
        off_centre,
        BodyShape { central: true, ..off_centre },
        fluid,
        BodyShape { center_of_mass: true, displaced_mass: true, gravity: Some(Shape::Scalar), ..fluid },
        everything,
    ]
}

/// One body in a chart, as the system that it is.
pub struct ChartedSystem<'g> {
    pub chart: ChartedBody<'g>,
    pub body: Body<'g>,
    pub system: System<'g>,
}

impl<'g> ChartedSystem<'g> {
    pub fn new(graph: &'g Graph, motion: Motion, chart: Chart, shape: BodyShape) -> Self {
        Self::acted_upon(graph, motion, chart, shape, |_| Vec::new())
    }

    /// A body under elements, in terms of the kinematics.
    pub fn acted_upon(
        graph: &'g Graph,
        motion: Motion,
        chart: Chart,
        shape: BodyShape,
        elements: impl Fn(&Kinematics<'g>) -> Vec<Element<'g>>,
    ) -> Self {
        let body = Body::new(graph, shape, if motion == Motion::Planar { 1 } else { 2 });
        let time = graph.symbol("t", "t", false);
        let own = BodyChart { chart, motion };
        let chart = ChartedBody::new(graph, motion, chart);
        let kinematics = &chart.kinematics;
        let placement = chart.placement(Matter::Body(Box::new(body.clone())), true);
        let mut rates = kinematics.rates.clone();
        rates.insert(time.key(), graph.one());
        let speeds = kinematics.speeds.clone();
        let mut tree = Tree::new(graph, vec![placement], speeds.clone(), rates.clone(), body.gravity);
        tree.settle();
        let momenta = chart.momentum_names.iter();
        let scene = SystemScene {
            graph,
            time,
            matter_time: None,
            coordinates: chart.coordinates.clone(),
            coordinate_names: chart.coordinate_names.clone(),
            states: 0..0,
            speeds,
            charted: Some(ChartedLink { link: 0, own, alone: true }),
            momentum_names: chart.momentum_names.clone(),
            force_names: chart.force_names.clone(),
            speed_rates: kinematics.speed_rates.clone(),
            momenta: momenta.map(|name| graph.symbol(name.text.clone(), name.latex.clone(), false)).collect(),
            kinematics: chart.coordinate_rates(),
            rates,
            tree,
            constraints: Vec::new(),
            redundant: false,
            contacts: Vec::new(),
            inputs: Vec::new(),
            elements: elements(kinematics),
        };
        let system = System::new(scene);
        Self { chart, body, system }
    }

    /// The body as a free link.
    pub fn free(&self) -> &FreeLink<'g> {
        self.system.balance_of_all().expect("a body in a chart is free")
    }
}

/// A reproducible sequence of numbers in (−1, 1).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Random values for every symbol of a scene; rotations are rotations and inertias positive definite.
pub fn random_point(scene: &ChartedSystem<'_>, random: &mut Random) -> Map<u32, f64> {
    let kinematics = &scene.chart.kinematics;
    let mut values = Map::default();
    for p in &scene.body.parameters {
        // Diagonals dominate, so every kinetic matrix is positive definite.
        let value = match p.quantity {
            Role::Mass | Role::DisplacedMass => 2.0 + random.next(),
            Role::Inertia | Role::CentralInertia | Role::AddedMass if is_diagonal(scene, p.symbol) => {
                3.0 + random.next()
            }
            _ => 0.3 * random.next(),
        };
        values.insert(p.symbol.key(), value);
    }
    let mut others: Vec<Expr<'_>> = Vec::new();
    for coordinate in &scene.system.scene.coordinates {
        if let Some(rotation) = coordinate.rotation() {
            let graph = Graph::new();
            let axis = [random.next(), random.next(), random.next(), random.next()];
            let norm = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
            let quaternion = axis.map(|_| graph.symbol("q", "q", false));
            let at: Map<u32, f64> = quaternion.iter().zip(axis).map(|(s, a)| (s.key(), a / norm)).collect();
            let mut evaluation = Evaluation::new(&at);
            for (symbol, e) in
                rotation.iter().flatten().zip(rotation_of_quaternion(&graph, quaternion).iter().flatten())
            {
                values.insert(symbol.key(), evaluation.value(*e));
            }
        }
        match coordinate {
            Coordinate::Pose(_, position) => others.extend(position),
            Coordinate::Plane { turn: [cosine, sine], position } => {
                let angle = 3.0 * random.next();
                values.insert(cosine.key(), angle.cos());
                values.insert(sine.key(), angle.sin());
                others.extend(position);
            }
            Coordinate::Scalar(q) => others.push(*q),
            Coordinate::Rotation(_) => {}
        }
    }
    let free = scene.free();
    let formal = kinematics.speeds.iter().chain(&kinematics.speed_rates).chain(&free.momenta).chain(&free.twist);
    for symbol in others.iter().chain(formal) {
        values.insert(symbol.key(), random.next());
    }
    values
}

fn is_diagonal(scene: &ChartedSystem<'_>, symbol: Expr<'_>) -> bool {
    let inertia = (0..3).any(|i| scene.body.inertia[i][i] == symbol);
    inertia || scene.body.added_mass.as_ref().is_some_and(|m| (0..6).any(|i| m[i][i] == symbol))
}

fn values(at: &Map<u32, f64>, outputs: &[Expr<'_>]) -> Vec<f64> {
    let mut evaluation = Evaluation::new(at);
    outputs.iter().map(|e| evaluation.value(*e)).collect()
}

#[track_caller]
fn assert_close(what: &str, a: &[f64], b: &[f64]) {
    // Values of order 1 … 100 from a few hundred roundings; a wrong term would show at order 1.
    let scale = a.iter().chain(b).fold(1.0f64, |m, x| m.max(x.abs()));
    for (k, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= 1e-10 * scale, "{what}[{k}]: {x} against {y}");
    }
}

#[test]
fn every_formula_satisfies_the_gauss_condition() {
    let mut random = Random(1);
    for (motion, chart) in scenes() {
        for shape in shapes() {
            let graph = Graph::new();
            let scene = ChartedSystem::new(&graph, motion, chart, shape);
            let formulas = scene.system.formulas();
            let kinematics = &scene.chart.kinematics;
            let condition = gauss_condition(kinematics, &scene.body);
            let along = kinematics.rates_with_accelerations();
            let what = |m: &str| format!("{m} in {motion:?} {chart:?} {shape:?}");
            let outputs = |method: Method| formulas.get(method).expect("a body in a chart has it");

            let mut at = random_point(&scene, &mut random);
            // The residual in every arrangement is the condition.
            let expected = values(&at, &condition);
            for residual in outputs(Method::GaussResidual) {
                assert_close(&what("residual"), &values(&at, residual), &expected);
            }
            // C has it as its gradient.
            for c in outputs(Method::ConstraintFunction) {
                let gradient: Vec<Expr<'_>> = kinematics.speed_rates.iter().map(|&dz| c[0].partial(dz)).collect();
                assert_close(&what("gradient"), &values(&at, &gradient), &expected);
            }
            // ∂T/∂z is the momentum, ∂p/∂z the mass matrix.
            let energy = outputs(Method::KineticEnergy)[0][0];
            let momentum = &outputs(Method::Momentum)[0];
            let gradient: Vec<Expr<'_>> = kinematics.speeds.iter().map(|&z| energy.partial(z)).collect();
            assert_close(&what("momentum"), &values(&at, momentum), &values(&at, &gradient));
            let hessian: Vec<Expr<'_>> =
                gradient.iter().flat_map(|p| kinematics.speeds.iter().map(|&z| p.partial(z))).collect();
            assert_close(&what("mass matrix"), &values(&at, &outputs(Method::MassMatrix)[0]), &values(&at, &hessian));
            // Velocity inverts momentum; the twist and z are inverse to one another.
            let p = values(&at, momentum);
            at.extend(scene.free().momenta.iter().zip(&p).map(|(s, p)| (s.key(), *p)));
            let z: Vec<f64> = kinematics.speeds.iter().map(|s| at[&s.key()]).collect();
            assert_close(&what("velocity"), &values(&at, &outputs(Method::Velocity)[0]), &z);
            let twist = values(&at, &outputs(Method::BodyTwist)[0]);
            at.extend(scene.free().twist.iter().zip(&twist).map(|(s, p)| (s.key(), *p)));
            assert_close(&what("speeds"), &values(&at, &outputs(Method::Speeds)[0]), &z);
            // At the acceleration the condition vanishes, and dp/dt is the momentum rate.
            let momentum_rate: Vec<Expr<'_>> = momentum.iter().map(|p| p.derivative(&along)).collect();
            for acceleration in outputs(Method::Acceleration) {
                let rates = values(&at, acceleration);
                at.extend(kinematics.speed_rates.iter().zip(&rates).map(|(s, a)| (s.key(), *a)));
                assert_close(&what("acceleration"), &values(&at, &condition), &vec![0.0; rates.len()]);
                let rate = values(&at, &outputs(Method::MomentumRate)[0]);
                assert_close(&what("momentum rate"), &values(&at, &momentum_rate), &rate);
            }
            // The potential gives the forces: dU/dt = −Σ force·z.
            let potential = outputs(Method::PotentialEnergy)[0][0].derivative(&kinematics.rates);
            let power: f64 = values(&at, &scene.free().generalised_forces()).iter().zip(&z).map(|(f, z)| f * z).sum();
            assert_close(&what("power"), &values(&at, &[potential]), &[-power]);
        }
    }
}
