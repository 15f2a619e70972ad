//! The claims of the example `thrown_robot`: momentum as of a falling body, spin kept, energy accounted.

use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use crate::model::{G, Quadruped, Whole, thrown};

/// A tolerance of 1e-10 a step, some hundred steps: momenta are no part of the state, but smooth functions of it.
#[test]
fn a_thrown_robot_keeps_its_spin() {
    let kernel = Quadruped { k: 60.0, c: 1.0 }.kernel().unwrap();
    let start = thrown();
    let path = Simulation::new(&kernel).adaptive(1e-10, 1e-11).run(start.q(), start.z(), 0.0..0.5).unwrap();
    let [first, last] = [path.first(), path.last()].map(|sample| Whole::of(&kernel, sample));
    let fallen = first.momentum - Vector3::z() * (G * first.mass * 0.5);
    assert!((last.momentum - fallen).norm() < 1e-8 * first.momentum.norm());
    assert!((last.spin - first.spin).norm() < 1e-8 * first.spin.norm());
    let flown = first.center + first.momentum * (0.5 / first.mass) - Vector3::z() * (G * 0.125);
    assert!((last.center - flown).norm() < 1e-8);
    let balance = power_balance(&kernel, &path, |_, _, _| ());
    assert!(balance.last().work < -0.1 && balance.largest_residual() < 1e-3, "{:?}", balance.last());
}
