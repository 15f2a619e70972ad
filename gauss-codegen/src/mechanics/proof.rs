//! The two derivations agree identically: (3.4) as a polynomial in x integrated by moments, and (3.4) through (Q, Γ_O),
//! as symbolic expressions, in every chart and motion, for the most general body.

use crate::algebra::ideal::Ideal;
use crate::algebra::{Expr, Graph};
use crate::terms::{Chart, Motion, Shape};

use crate::mechanics::check::definition::{gauss_condition, pairing, stationarity, velocity_field};
use crate::mechanics::kinematics::coordinate::Coordinate;
use crate::mechanics::kinematics::vector::{Axes, Triple, add, cross, scale};
use crate::mechanics::matter::body::{AffineField, Body, BodyShape, integrate_product};
use crate::mechanics::system::System;
use crate::mechanics::tests::{ChartedSystem, scenes};

/// Full inertia, O ≠ G, weight in any direction, buoyancy. The fluid's impulse enters both derivations alike.
pub const GENERAL: BodyShape = BodyShape {
    inertia: Shape::Matrix3,
    central: false,
    center_of_mass: true,
    added_mass: None,
    gravity: Some(Shape::Vector3),
    displaced_mass: true,
    center_of_buoyancy: true,
};

/// Relations that the symbols of the configuration satisfy.
pub fn relations<'g>(graph: &'g Graph, system: &System<'g>) -> Ideal<'g> {
    match &system.scene.coordinates[0] {
        Coordinate::Pose(rotation, _) | Coordinate::Rotation(rotation) => Ideal::of_rotation(graph, rotation),
        Coordinate::Plane { turn: [cos, sin], .. } => {
            Ideal::generated_by(vec![*cos * *cos + *sin * *sin - graph.one()])
        }
        // Sines, cosines and denominators are reduced by the normal form itself.
        Coordinate::Scalar(_) => Ideal::generated_by(Vec::new()),
    }
}

/// Q = m (u + ω × c) and Γ_O = m c × u + I_O ω, body axes: the momentum of a rigid body as textbooks have it.
fn rigid_momentum<'g>(body: &Body<'g>, u: &Triple<'g>, omega: &Triple<'g>) -> (Triple<'g>, Triple<'g>) {
    let first = body.first_moment();
    let spin: Triple<'g> = std::array::from_fn(|i| (0..3).map(|j| body.inertia[i][j] * omega[j]).sum());
    (add(&scale(body.mass, u), &cross(omega, &first)), add(&cross(&first, u), &spin))
}

#[test]
fn moments_and_momenta_give_the_same_condition_identically() {
    for (motion, chart) in scenes() {
        let graph = Graph::new();
        let scene = ChartedSystem::new(&graph, motion, chart, GENERAL);
        let (kinematics, body) = (&scene.chart.kinematics, &scene.body);
        let relations = relations(&graph, &scene.system);
        let along = kinematics.rates_with_accelerations();
        let u = kinematics.frame.resolve(&kinematics.velocity, Axes::Body);
        let omega = kinematics.frame.resolve(&kinematics.angular_velocity, Axes::Body);
        let (q, gamma) = rigid_momentum(body, &u, &omega);
        let (q, gamma) = (kinematics.frame.body_vector(q), kinematics.frame.body_vector(gamma));
        let forces = scene.free().generalised_forces();
        let conditions = gauss_condition(kinematics, body).into_iter().zip(stationarity(kinematics, body));
        for ((&z, (by_moments, by_principle)), force) in kinematics.speeds.iter().zip(conditions).zip(forces) {
            assert!(
                relations.annihilates(by_moments - by_principle),
                "(3.4) is not the stationarity of (3.1) in {motion:?} {chart:?}, row {z:?}"
            );
            let by_momenta = pairing(&kinematics.motion(), &q, &gamma, z, &along) - force;
            assert!(
                relations.annihilates(by_moments - by_momenta),
                "the two derivations differ in {motion:?} {chart:?}, row {z:?}"
            );
        }
        assert!(!graph.is_undefined());
    }
}

#[test]
fn a_wrong_term_would_be_seen() {
    // Rates of the components of Q alone, with ω × Q left out, are not what the condition says.
    let graph = Graph::new();
    let scene = ChartedSystem::new(&graph, Motion::Free, Chart::LeftInvariant, GENERAL);
    let kinematics = &scene.chart.kinematics;
    let u = kinematics.frame.resolve(&kinematics.velocity, Axes::Body);
    let omega = kinematics.frame.resolve(&kinematics.angular_velocity, Axes::Body);
    let (q, _) = rigid_momentum(&scene.body, &u, &omega);
    let wrong = q[0].derivative(&kinematics.rates_with_accelerations()) - scene.free().generalised_forces()[0];
    let condition = gauss_condition(kinematics, &scene.body);
    assert!(!relations(&graph, &scene.system).annihilates(condition[0] - wrong));
}

#[test]
fn the_moments_of_the_velocity_field_are_the_momenta() {
    // ∂T/∂z of T = ½∫v_P² dm against Q·a_α + Γ_O·o_α, in every chart and motion.
    for (motion, chart) in scenes() {
        let graph = Graph::new();
        let scene = ChartedSystem::new(&graph, motion, chart, GENERAL);
        let kinematics = &scene.chart.kinematics;
        let relations = relations(&graph, &scene.system);
        let x: Triple<'_> = std::array::from_fn(|_| graph.symbol("x", "x", false));
        let field = AffineField::of(&velocity_field(kinematics, &x), &x);
        let energy = integrate_product(&scene.body, &field, &field).half();
        for (&z, p) in kinematics.speeds.iter().zip(scene.free().momentum()) {
            let difference: Expr<'_> = energy.partial(z) - p;
            assert!(relations.annihilates(difference), "momentum of {z:?} in {motion:?} {chart:?}");
        }
    }
}
