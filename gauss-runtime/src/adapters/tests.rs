//! Components of configurations and what they say of motion, against the group; products by differences against dual numbers.

use std::vec::Vec;

use nalgebra::{Isometry2, Isometry3, SVector, Translation2, Translation3, UnitComplex, UnitQuaternion, Vector3};

use super::*;
use crate::configuration::VectorSpace;
use crate::testing::FreeTop;
use crate::testing::dual::{Dual, dual};
use crate::testing::order::{NONE, TOP, start_by_velocity};

/// The components of a configuration, those of its rotation, which come first, times a length.
fn components<C: EmbeddedConfiguration<Scalar = f64>>(q: &C, rotation: usize, length: f64) -> Vec<f64> {
    let mut x = std::vec![0.0; C::COMPONENTS];
    q.components(|i, value| x[i] = value, 0);
    x[..rotation].iter_mut().for_each(|c| *c *= length);
    x
}

/// The components' rates against central differences along `q ∘ exp(s v)`, whatever the length of the rotation's components.
fn rates_are_those_of_the_group<C: EmbeddedConfiguration<Scalar = f64>>(q: &C, rotation: usize, velocity: &[f64]) {
    let mut v = C::Tangent::zero();
    velocity.iter().enumerate().for_each(|(i, &c)| v.set_component(i, c));
    for length in [1.0, 0.7] {
        let x = components(q, rotation, length);
        let again = C::from_components(|i| x[i], 0);
        assert!(q.difference(&again).max_norm() < 8.0 * f64::EPSILON, "{q:?} {again:?}");
        let mut found = std::vec![0.0; C::COMPONENTS];
        again.component_rates(&v, |i| x[i], |i, value| found[i] = value, 0);
        let h = 1e-5;
        let at = |s: f64| components(&q.retract(&v.scale(s)), rotation, length);
        for ((found, there), back) in found.iter().zip(at(h)).zip(at(-h)) {
            // h² of a third derivative of size 10, and roundings of numbers of size 4 over 2h.
            assert!((found - (there - back) / (2.0 * h)).abs() < 2e-9, "{found} {}", (there - back) / (2.0 * h));
        }
    }
}

#[test]
fn components_move_as_the_group_does() {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.1, 0.7));
    rates_are_those_of_the_group(&rotation, 4, &[0.3, -0.8, 1.2]);
    let pose = Isometry3::from_parts(Translation3::new(1.0, -2.0, 4.0), rotation);
    rates_are_those_of_the_group(&pose, 4, &[0.5, 1.0, -0.3, 0.3, -0.8, 1.2]);
    let plane = Isometry2::from_parts(Translation2::new(-1.0, 3.0), UnitComplex::new(2.0));
    rates_are_those_of_the_group(&plane, 2, &[0.5, 1.0, -0.9]);
    rates_are_those_of_the_group(&(rotation, SVector::from([2.0, -1.0])), 4, &[0.3, -0.8, 1.2, 0.1, 0.6]);
}

/// The slope of the differences against dual numbers through the same equations.
#[test]
fn differences_are_right_to_their_step() {
    let start = start_by_velocity();
    let system = FlatSystem::new(&TOP).input_from(NONE);
    let x: [f64; 7] = system.vector(0.0, &start.q, &start.y);
    let exact = FreeTop { inertia: TOP.inertia.map(|i| dual(i, 0.0)) };
    let exact = FlatSystem::new(&exact).input(|_: Dual, _: &_, _: &_| [dual(0.0, 0.0); 3]);
    let directions: [[f64; 7]; 3] = [
        [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        [0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 0.7],
        [1e6, 0.0, 0.0, 0.0, 0.0, 2e6, 0.0],
    ];
    for v in directions {
        let size = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        let mut found = [0.0; 7];
        Differences.product(&system, 0.0, &x, &v, &mut found);
        exact.rates_by(
            dual(0.0, 0.0),
            |i| dual(x[i], v[i]),
            // Rounding ε over a step of 1e-5; the equations are quadratic, but for the length of the quaternion.
            |i, value| assert!((found[i] - value.rate).abs() < 1e-9 * size, "{i}: {} {}", found[i], value.rate),
        );
    }
    let mut nothing = [1.0; 7];
    Differences.product(&system, 0.0, &x, &[0.0; 7], &mut nothing);
    assert_eq!(nothing, [0.0; 7]);

    let given = system.jacobian(|_, _: &[f64], v: &[f64], product: &mut [f64]| product.copy_from_slice(v));
    given.jacobian.product(&given, 0.0, &x, &directions[1], &mut nothing);
    assert_eq!(nothing, directions[1]);
}

/// Both forms describe one state, and vectors of any type hold it.
#[test]
fn states_come_back() {
    let start = start_by_velocity();
    let by_velocity = FlatSystem::new(&TOP).input_from(NONE);
    let by_momentum = by_velocity.momentum_form();
    let (v, p) = (by_velocity.to_vec(0.0, &start.q, &start.y), by_momentum.to_vec(0.0, &start.q, &start.y));
    let (v, p) = (by_velocity.sample(0.0, &v), by_momentum.sample(0.0, &p));
    let rounding = 4.0 * f64::EPSILON * start.y.amax();
    assert!((v.z - p.z).amax() < rounding && (v.p - p.p).amax() < rounding && (v.z - start.y).amax() == 0.0);
    assert!(v.q.angle_to(&start.q) < 1e-15 && p.q.angle_to(&start.q) < 1e-15);
    assert_eq!(by_velocity.system().inertia, TOP.inertia);
}
