//! Impacts of several contacts within one step: without friction and with one e none gives energy.

use gauss_contact::{ContactSteps, StepScheme};
use gauss_runtime::contact::Contact;
use gauss_runtime::nalgebra::SMatrix;
use gauss_runtime::prelude::*;

use crate::common::{Layout, Scene, V, numbers};

pub struct WallAndPair;
impl Layout for WallAndPair {
    const CONTACTS: &'static [Contact] = &[Contact::new("wall", 0, 0), Contact::new("pair", 1, 0)];
}

/// Masses at x above a wall and y above x; under a weight.
fn pair(m: [f64; 2], e: f64, g: f64) -> Scene<WallAndPair, 2, 2, 2> {
    let rows = SMatrix::<f64, 2, 2>::new(1.0, 0.0, -1.0, 1.0);
    Scene::linear(V::from(m), V::from([-m[0] * g, -m[1] * g]), V::zeros(), rows).restitution([e, e])
}

pub struct Row;
impl Layout for Row {
    const CONTACTS: &'static [Contact] = &[
        Contact::new("first", 0, 0),
        Contact::new("second", 1, 0),
        Contact::new("third", 2, 0),
        Contact::new("last", 3, 0),
    ];
}

/// Three masses between two walls, at 0 and 1.
fn row(m: [f64; 3], e: f64) -> Scene<Row, 3, 4, 4> {
    #[rustfmt::skip]
    let rows = SMatrix::<f64, 4, 3>::from_row_slice(&[
        1.0, 0.0, 0.0,
        -1.0, 1.0, 0.0,
        0.0, -1.0, 1.0,
        0.0, 0.0, -1.0,
    ]);
    Scene::linear(V::from(m), V::zeros(), V::from([0.0, 0.0, 0.0, 1.0]), rows).restitution([e; 4])
}

#[test]
fn a_gap_that_others_close_within_the_step_reflects_as_they_do() {
    // From the wall and towards it, within one step.
    for h in [1e-2, 1e-4] {
        for e in [1.0, 0.6, 0.0] {
            let kernel = pair([0.1, 1.0], e, 0.0);
            let run =
                ContactSteps::new(&kernel, h).run(V::from([0.2 * h, 0.4 * h]), V::from([1.0, -1.0]), 0.0..20.0 * h);
            let mut before = 0.55;
            for step in run.unwrap() {
                let energy = kernel.kinetic_energy(0.0, &step.state.q, &step.state.z);
                assert!(energy <= before * (1.0 + 1e-12), "{h} {e} {energy} {before}");
                assert!(e < 1.0 || (energy - 0.55).abs() < 1e-12, "{h} {energy}");
                assert!(step.state.q[0] >= -1e-15 && step.state.q[1] >= step.state.q[0] - 1e-15, "{h} {e}");
                before = energy;
            }
        }
    }
}

#[test]
fn masses_between_walls_never_gain() {
    let mut number = numbers(23);
    for n in 0..400 {
        let e = [1.0, 0.9, 0.5, 0.0][n % 4];
        let m = [0; 3].map(|_| 10.0_f64.powf(1.5 * number()));
        let kernel = row(m, e);
        let q = V::from([0.2, 0.5, 0.8]) + V::from([number(), number(), number()]) * 0.1;
        let z = V::from([number(), number(), number()]) * 5.0;
        let run = ContactSteps::new(&kernel, 5e-3).run(q, z, 0.0..3.0).unwrap();
        let mut before = kernel.kinetic_energy(0.0, &q, &z);
        for step in run {
            let energy = kernel.kinetic_energy(0.0, &step.state.q, &step.state.z);
            assert!(energy <= before * (1.0 + 1e-10), "{n} {e} {} {energy} {before}", step.state.t);
            before = energy;
        }
    }
}

#[test]
fn balls_that_are_dropped_on_one_another_gain_no_more_than_a_step_of_weight() {
    let (h, g) = (1e-3, 9.81);
    let mut number = numbers(29);
    for n in 0..200 {
        let e = [0.8, 1.0, 0.5][n % 3];
        let (q, z) = (V::from([0.5 + 0.4 * number(), 1.2 + 0.2 * number()]), V::zeros());
        let kernel = pair([0.1, 1.0], e, g);
        let run = ContactSteps::new(&kernel, h).run(q, z, 0.0..3.0).unwrap();
        let before = kernel.energy(0.0, &q, &z) + 9.81 * (0.1 * q[0] + q[1]);
        let mut least: f64 = before;
        for step in run {
            let weight = 9.81 * (0.1 * step.state.q[0] + step.state.q[1]);
            let energy = kernel.kinetic_energy(0.0, &step.state.q, &step.state.z) + weight;
            assert!(energy <= 1.02 * before, "{n} {e} {} {energy} {before}", step.state.t);
            least = least.min(energy);
        }
        assert!(least >= -1e-9, "{n}");
    }
}

/// A double pendulum with stops at its hip and its knee.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(hip, knee),
    particle(mass = 1, position = [sin(hip), 0, -cos(hip)]),
    particle(mass = 1, position = [sin(hip) + sin(hip + knee), 0, -cos(hip) - cos(hip + knee)]),
    range(hip_stop, along = hip, from = -0.5, to = 0.7, restitution = e),
    range(knee_stop, along = knee, from = 0, to = 1.5, restitution = e),
)]
struct Leg {
    e: f64,
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn a_leg_between_its_stops_gains_little() {
    let mut number = numbers(31);
    for n in 0..60 {
        let e = [1.0, 0.8, 0.3][n % 3];
        let kernel = Leg { e, g: 9.81 }.kernel().unwrap();
        let q = SVector::from([0.1 + 0.5 * number(), 0.7 + 0.6 * number()]);
        let z = SVector::from([3.0 * number(), 3.0 * number()]);
        for h in [1e-2, 1e-3] {
            for scheme in [StepScheme::Midpoint, StepScheme::MoreauJean] {
                let run = ContactSteps::new(&kernel, h).scheme(scheme).run(q, z, 0.0..5.0).unwrap();
                let before = kernel.energy(0.0, &q, &z);
                let most =
                    run.iter().map(|step| kernel.energy(0.0, &step.state.q, &step.state.z)).fold(before, f64::max);
                // Of the 40 J between its lowest and its highest place: impacts are known to a step, and weight works
                // in it.
                assert!(most - before < 0.3 + 150.0 * h, "{n} {e} {h} {scheme:?} {}", most - before);
            }
        }
    }
}
