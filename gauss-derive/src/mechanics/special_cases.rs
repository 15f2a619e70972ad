//! The charts of one body are special cases of a system: the very sums that systems are made from, over one link with the
//! ψ of the chart, agree identically with the definition, in every chart and motion.

use crate::algebra::Graph;

use super::gauss::stationarity;
use super::link::{Matter, Placement};
use super::methods::Scene;
use super::proof::{GENERAL, relations};
use super::tests::scenes;
use super::tree::{Inertia, Tree};
use super::turn::Turn;
use super::vector::Axes;

/// The scene's body as the only link of a tree.
fn system_of<'g>(graph: &'g Graph, scene: &Scene<'g>) -> Tree<'g> {
    let kinematics = &scene.kinematics;
    let omega = kinematics.frame.resolve(&kinematics.angular_velocity, Axes::Body);
    let placement = Placement {
        matter: Matter::Body(Box::new(scene.body.clone())),
        parent: None,
        position: kinematics.position,
        velocity_in_own_axes: None,
        turns: vec![Turn::given(kinematics.frame.rotation, omega)],
    };
    let (speeds, rates) = (kinematics.speeds.clone(), kinematics.rates.clone());
    let mut tree = Tree::new(graph, vec![placement], speeds, rates, scene.body.gravity);
    tree.settle();
    tree
}

#[test]
fn a_chart_is_a_system_of_one_link() {
    for (motion, chart) in scenes() {
        let graph = Graph::new();
        let scene = Scene::new(&graph, motion, chart, GENERAL);
        let tree = system_of(&graph, &scene);
        let relations = relations(&graph, &scene.kinematics);
        let along = scene.kinematics.rates_with_accelerations();
        let same = |what: &str, found: Vec<_>, expected: Vec<_>| {
            for (row, (a, b)) in found.into_iter().zip(expected).enumerate() {
                assert!(relations.annihilates(a - b), "row {row} of {what} in {motion:?} {chart:?}");
            }
        };
        let condition = stationarity(&scene.kinematics, &scene.body);
        for inertia in [Inertia::Tensor, Inertia::Field] {
            same("the residual", tree.residual(&along, inertia, &[]), condition.clone());
        }
        same("the momentum", tree.momentum(), scene.momentum());
        same("the forces", tree.weights(), scene.generalised_forces());
        let matrix = tree.mass_matrix();
        for (row, p) in matrix.into_iter().zip(scene.momentum()) {
            let expected = scene.kinematics.speeds.iter().map(|&z| p.partial(z)).collect();
            same("the mass matrix", row, expected);
        }
        // (3.4): d/dt p − bracket − forces is the residual.
        let rows = tree.momentum().into_iter().zip(tree.bracket()).zip(tree.weights());
        let by_momenta = rows.map(|((p, bracket), force)| p.derivative(&along) - bracket - force).collect();
        same("the condition (3.4)", by_momenta, condition);
        assert!(!graph.overflowed());
    }
}
