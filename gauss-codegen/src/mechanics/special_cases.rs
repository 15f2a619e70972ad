//! The charts of one body are special cases of a system: the very sums that systems are made from, over one link with
//! the ψ of the chart, agree identically with the definition and with the arrangement in body axes, in every chart and
//! motion.

use crate::algebra::{Expr, Graph};
use crate::terms::{Chart, Motion};

use crate::mechanics::check::definition::stationarity;
use crate::mechanics::kinematics::motion::Kinematics;
use crate::mechanics::kinematics::vector::{Axes, Frame, Triple, add, dot};
use crate::mechanics::links::inertia::Inertia;
use crate::mechanics::loads::forces::{Action, Element, Force, ForceField, Loads};
use crate::mechanics::loads::motion_symbols::MotionSymbols;
use crate::mechanics::proof::{GENERAL, relations};
use crate::mechanics::tests::{ChartedSystem, scenes};

#[test]
fn a_chart_is_a_system_of_one_link() {
    for (motion, chart) in scenes() {
        let graph = Graph::new();
        let scene = ChartedSystem::new(&graph, motion, chart, GENERAL);
        let (tree, body) = (&scene.system.scene.tree, scene.free());
        let relations = relations(&graph, &scene.system);
        let along = scene.chart.kinematics.rates_with_accelerations();
        let same = |what: &str, found: Vec<_>, expected: Vec<_>| {
            for (row, (a, b)) in found.into_iter().zip(expected).enumerate() {
                assert!(relations.annihilates(a - b), "row {row} of {what} in {motion:?} {chart:?}");
            }
        };
        let condition = stationarity(&scene.chart.kinematics, &scene.body);
        for inertia in [Inertia::Tensor, Inertia::Field] {
            same("the residual", tree.residual(&along, inertia, &Loads::default()), condition.clone());
        }
        same("the momentum", tree.momentum(), body.momentum());
        same("the forces", tree.weights(), body.generalised_forces());
        let matrix = tree.mass_matrix();
        for (row, p) in matrix.into_iter().zip(body.momentum()) {
            let expected = scene.chart.kinematics.speeds.iter().map(|&z| p.partial(z)).collect();
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
fn triple<'g>(graph: &'g Graph, letter: &str) -> Triple<'g> {
    std::array::from_fn(|i| graph.symbol(format!("{letter}{}", i + 1), letter, true))
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

/// A spring, a force on the body in either axes, and friction.
fn elements<'g>(graph: &'g Graph, kinematics: &Kinematics<'g>) -> Vec<Element<'g>> {
    let observed = MotionSymbols::new(graph, graph.symbol("t", "t", false));
    let [at, force, torque] = ["a", "F", "M"].map(|letter| triple(graph, letter));
    let on_link = |axes| Force::OnLink { link: 0, at, force, torque, axes };
    let factors = [force[0], force[1], torque[0], torque[1]];
    let velocities =
        [&observed.velocity, &observed.body_velocity, &observed.angular_velocity, &observed.body_angular_velocity];
    let by_name = |name: &str, action| Element::new(name.to_owned(), action);
    let elements = [
        by_name("spring", Action::Potential(spring(&observed.position, &observed.rotation, &at))),
        by_name("body", Action::Forces(vec![on_link(Axes::Body)])),
        by_name("space", Action::Forces(vec![on_link(Axes::Space)])),
        by_name("friction", Action::Forces(vec![Force::Dissipation(friction(&factors, velocities))])),
    ];
    elements.iter().map(|element| observed.in_motion(kinematics, element)).collect()
}

/// The wrench of each element on the free link against what its definition says in the speeds of the chart.
fn compare_loads(graph: &Graph, motion: Motion, chart: Chart) {
    let scene = ChartedSystem::acted_upon(graph, motion, chart, GENERAL, |kinematics| elements(graph, kinematics));
    let (system, relations) = (&scene.system, relations(graph, &scene.system));
    let kinematics = &scene.chart.kinematics;
    let accounts = system.accounts();
    // Weight and buoyancy have the first account; potentials come before the rest.
    assert_eq!(accounts.len(), 1 + system.scene.elements.len());
    for element in &system.scene.elements {
        let expected: Vec<Expr<'_>> = match &element.action {
            Action::Potential(potential) | Action::Field(ForceField { potential, .. }) => {
                system.potential_forces(*potential)
            }
            Action::Forces(forces) => {
                match forces[0].generalised(&system.scene.tree.links, &kinematics.speeds, &kinematics.rates) {
                    Some(rows) => rows,
                    None => system.scene.tree.loads(&Loads::of_forces(forces)),
                }
            }
        };
        let account = accounts.iter().find(|account| account.name == element.name).expect("an account each");
        for (row, (found, expected)) in account.forces.iter().zip(&expected).enumerate() {
            let what = &account.name;
            assert!(relations.annihilates(*found - *expected), "row {row} of {what} in {motion:?} {chart:?}");
        }
    }
    let (in_body, in_general) = (scene.free().generalised_forces(), system.generalised_forces());
    for (row, (found, expected)) in in_body.into_iter().zip(in_general).enumerate() {
        assert!(relations.annihilates(found - expected), "row {row} of all forces in {motion:?} {chart:?}");
        let all = accounts.iter().map(|account| account.forces[row]).sum::<Expr<'_>>();
        assert!(relations.annihilates(found - all), "row {row} of all accounts in {motion:?} {chart:?}");
    }
    assert!(!graph.is_undefined());
}

#[test]
fn loads_in_a_chart_are_loads_on_a_system_of_one_link() {
    for (motion, chart) in scenes() {
        compare_loads(&Graph::new(), motion, chart);
    }
}
