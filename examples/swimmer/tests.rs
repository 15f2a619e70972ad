//! The example `swimmer`: from rest the impulse of fish and water stays zero, so its rate is a function of its shape
//! alone.

use gauss_runtime::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};

use crate::fish::{Fish, start};

#[test]
fn it_goes_where_its_impulse_says() {
    let fish = Fish::new(1.0, FRAC_PI_2);
    let kernel = fish.kernel().expect("a fish");
    let (q, z) = start(&fish);
    // The impulse that the connection makes zero is that of the kernel: rounding of masses up to 5 and arms up to 2.
    assert!(kernel.momentum(0.0, &q, &z).amax() < 1e-14);
    let end = Simulation::new(&kernel).adaptive(1e-12, 1e-13).run_to_end(q, z, 0.0..TAU).expect("swims");
    let hand = fish.by_hand(TAU, 20_000);
    // The step of 3e-4 to the fourth power is 1e-14; tolerances of 1e-12 over some hundred steps.
    assert!((end.q.translation.vector - hand.translation.vector).norm() < 1e-10);
    assert!((end.q.rotation.inverse() * hand.rotation).angle().abs() < 1e-10);
    // It swims.
    assert!(end.q.translation.vector.norm() > 0.1);
}

#[test]
fn a_scallop_goes_nowhere() {
    let fish = Fish::new(1.0, 0.0);
    let kernel = fish.kernel().expect("a fish");
    let (q, z) = start(&fish);
    let end = Simulation::new(&kernel).adaptive(1e-12, 1e-13).run_to_end(q, z, 0.0..TAU).expect("moves");
    assert!(end.q.translation.vector.norm() < 1e-10);
}
