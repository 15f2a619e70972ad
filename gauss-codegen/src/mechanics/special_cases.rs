//! The charts of one body are special cases of a system: the very sums that systems are made from, over one link with the
//! ψ of the chart, agree identically with the definition, in every chart and motion.

use crate::algebra::{Expr, Graph, Map};
use crate::model::{Chart, Motion};

use super::forces::{Action, Element, Force};
use super::gauss::stationarity;
use super::link::{Matter, Placement};
use super::methods::Scene;
use super::proof::{GENERAL, relations};
use super::tests::scenes;
use super::tree::{Inertia, Tree};
use super::turn::Turn;
use super::vector::{Axes, Frame, Triple, add, dot};
use super::wrench::{Acting, Observed};

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
        let scene = Scene::new(&graph, motion, chart, GENERAL, &[]);
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
        assert!(!graph.is_undefined());
    }
}

/// Three symbols.
fn triple<'g>(graph: &'g Graph, letter: &str, constant: bool) -> Triple<'g> {
    std::array::from_fn(|i| graph.symbol(format!("{letter}{}", i + 1), letter, constant))
}

/// A spring from Ω to a point of the body.
fn spring<'g>(position: &Triple<'g>, rotation: &[Triple<'g>; 3], at: &Triple<'g>) -> Expr<'g> {
    let arm = Frame { graph: at[0].graph(), rotation: *rotation }.to_space(at);
    dot(&add(position, &arm), &add(position, &arm)).half()
}

/// Friction in velocities of both frames.
fn friction<'g>(factors: &[Expr<'g>; 4], velocities: [&Triple<'g>; 4]) -> Expr<'g> {
    factors.iter().zip(velocities).map(|(factor, v)| *factor * dot(v, v)).sum()
}

fn compare_what_acts<'g>(graph: &'g Graph, motion: Motion, chart: Chart) {
    let scene = Scene::new(graph, motion, chart, GENERAL, &[]);
    let kinematics = &scene.kinematics;
    let rotation = std::array::from_fn(|i| triple(graph, &format!("E{}", i + 1), false));
    let observed = Observed::new(graph, graph.symbol("t", "t", false), rotation, triple(graph, "B", false));
    let [at, force, torque] = ["a", "F", "M"].map(|letter| triple(graph, letter, true));
    let on_link = |axes| Force::OnLink { link: 0, at, force, torque, axes };
    let factors = [force[0], force[1], torque[0], torque[1]];
    let by_name = |name: &str, action| Element { name: name.to_owned(), action };
    let elements = [
        by_name("spring", Action::Potential(spring(&observed.position, &observed.rotation, &at))),
        by_name("body", Action::Forces(vec![on_link(Axes::Body)])),
        by_name("space", Action::Forces(vec![on_link(Axes::Space)])),
        by_name(
            "friction",
            Action::Forces(vec![Force::Dissipation(friction(
                &factors,
                [
                    &observed.velocity,
                    &observed.body_velocity,
                    &observed.angular_velocity,
                    &observed.body_angular_velocity,
                ],
            ))]),
        ),
    ];
    let acting = Acting::new(&observed, kinematics, &Map::default(), &elements, Vec::new());
    let energy = spring(&kinematics.position, &kinematics.frame.rotation, &at).derivative(&kinematics.rates);
    let (v, w) = (&kinematics.velocity, &kinematics.angular_velocity);
    let [v, u, o, w] = [(v, Axes::Space), (v, Axes::Body), (w, Axes::Space), (w, Axes::Body)]
        .map(|(vector, axes)| kinematics.frame.resolve(vector, axes));
    let function = friction(&factors, [&v, &u, &o, &w]);
    let by_speed = |e: Expr<'g>| kinematics.speeds.iter().map(|&z| -e.partial(z)).collect::<Vec<_>>();
    let tree = system_of(graph, &scene);
    let expected =
        [by_speed(energy), tree.loads(&[on_link(Axes::Body)]), tree.loads(&[on_link(Axes::Space)]), by_speed(function)];
    let relations = relations(graph, kinematics);
    let definition = acting.by_definition(kinematics);
    let scene = scene.acted_upon(acting);
    let accounts = scene.accounts();
    // Weight and buoyancy have the first account.
    assert_eq!(accounts.len(), 1 + expected.len());
    for (account, rows) in accounts[1..].iter().zip(&expected) {
        for (row, (found, expected)) in account.forces.iter().zip(rows).enumerate() {
            let what = &account.name;
            assert!(relations.annihilates(*found - *expected), "row {row} of {what} in {motion:?} {chart:?}");
        }
    }
    for (row, sum) in definition.into_iter().enumerate() {
        let parts = accounts[1..].iter().map(|account| account.forces[row]).sum::<Expr<'_>>();
        assert!(relations.annihilates(sum - parts), "row {row} by definition in {motion:?} {chart:?}");
        let all = accounts.iter().map(|account| account.forces[row]).sum::<Expr<'_>>();
        let whole = scene.generalised_forces()[row];
        assert!(relations.annihilates(whole - all), "row {row} of all forces in {motion:?} {chart:?}");
    }
    assert!(!graph.is_undefined());
}

#[test]
fn what_acts_in_a_chart_acts_on_a_system_of_one_link() {
    for (motion, chart) in scenes() {
        compare_what_acts(&Graph::new(), motion, chart);
    }
}
