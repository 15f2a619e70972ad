//! Flat vectors against states; products by differences against dual numbers.

// Modules that the included ones know as those of their crate.
use gauss_runtime::{chart, configuration, constraint, description, forces, integrate, real, system};

#[path = "../../../gauss-runtime/src/testing/mod.rs"]
#[allow(dead_code, reason = "tests of the runtime need more")]
mod testing;
#[path = "../../../gauss-runtime/src/triple.rs"]
#[allow(dead_code, reason = "the runtime needs more")]
mod triple;

use gauss_adapters::{Differences, FlatSystem, JacobianFunction, JacobianProduct};

use crate::testing::FreeTop;
use crate::testing::dual::{TestDual, dual};
use crate::testing::order::{NONE, TOP, start_by_velocity};

/// A quaternion of another length turns as fast, and the velocities do not see its length.
#[test]
fn the_length_of_a_quaternion_does_not_count() {
    let start = start_by_velocity();
    let system = FlatSystem::new(&TOP).input_from(NONE);
    let x: [f64; 7] = system.vector(0.0, &start.q, &start.y);
    let (mut unit, mut shorter) = ([0.0; 7], [0.0; 7]);
    system.rates(0.0, &x, &mut unit);
    let scaled = core::array::from_fn::<f64, 7, _>(|i| if i < 4 { 0.7 * x[i] } else { x[i] });
    system.rates(0.0, &scaled, &mut shorter);
    for i in 0..7 {
        let expected = if i < 4 { 0.7 * unit[i] } else { unit[i] };
        assert!((shorter[i] - expected).abs() <= 8.0 * f64::EPSILON * start.y.amax(), "{i}: {} {expected}", shorter[i]);
    }
    assert!(system.sample(0.0, &scaled).q.angle_to(&start.q) < 4.0 * f64::EPSILON);
}

/// The slope of the differences against dual numbers through the same equations.
#[test]
fn differences_are_right_to_their_step() {
    let start = start_by_velocity();
    let system = FlatSystem::new(&TOP).input_from(NONE);
    let x: [f64; 7] = system.vector(0.0, &start.q, &start.y);
    let exact = FreeTop { inertia: TOP.inertia.map(|i| dual(i, 0.0)) };
    let exact = FlatSystem::new(&exact).input(|_: TestDual, _: &_, _: &_| [dual(0.0, 0.0); 3]);
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

    let copy = |_: f64, _: &[f64], v: &[f64], product: &mut [f64]| product.copy_from_slice(v);
    let given = system.jacobian(copy);
    JacobianFunction(copy).product(&given, 0.0, &x, &directions[1], &mut nothing);
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
