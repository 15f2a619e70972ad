//! The example `underwater_manipulator`: its kernel against Newton's and Euler's laws written out body by body.

use gauss_runtime::prelude::*;

use crate::by_hand;
use crate::vehicle::{Place, Speeds, Vehicle, reach};

/// Numbers in −1 … 1 that look random, from a counter.
fn number(k: u32) -> f64 {
    2.0 * (f64::from(k).sin() * 43_758.545_3).fract().abs() - 1.0
}

fn states() -> impl Iterator<Item = (Place, Speeds)> {
    (0..200).map(|n| {
        let of = |k: u32| number(16 * n + k);
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(of(0), of(1), of(2)) * 3.0);
        let pose = Isometry3::from_parts(Vector3::new(of(3), of(4), of(5)).into(), turn);
        ((pose, SVector::from([3.0 * of(6), 3.0 * of(7)])), Speeds::from_fn(|i, _| of(8 + i as u32)))
    })
}

#[test]
fn accelerations_are_those_of_newton_and_euler() {
    let vehicle = Vehicle { current: Vector3::new(0.1, -0.3, 0.05), ..Vehicle::bluerov2() };
    for vehicle in [vehicle, vehicle.with_dry_arm()] {
        let kernel = vehicle.kernel().expect("a vehicle");
        for (q, z) in states() {
            let torques = SVector::from([0.3, -0.2]);
            let ours = kernel.acceleration(0.0, &q, &z, &torques);
            let theirs = by_hand::acceleration(&vehicle, &q, &z, &torques);
            // The smallest moment of the arm against the largest sum of forces: conditions of some 10³, a few hundred
            // roundings.
            let scale = theirs.amax().max(1.0);
            assert!((ours - theirs).amax() <= 1e-11 * scale, "{ours} {theirs}");
        }
    }
}

#[test]
fn the_current_carries_everything_along() {
    let still = Vehicle::bluerov2();
    let river = Vehicle { current: Vector3::new(0.05, 0.2, -0.1), ..still };
    let c = river.current;
    let place = (Isometry3::identity(), SVector::zeros());
    let end = |vehicle: &Vehicle, u: Vector3<f64>| {
        let kernel = vehicle.kernel().expect("a vehicle");
        let z = Speeds::from([u.x, u.y, u.z, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let run = Simulation::new(&kernel).input(reach).adaptive(1e-11, 1e-13).run_to_end(place, z, 0.0..3.0);
        run.expect("runs").q
    };
    let (moving, resting) = (end(&river, c), end(&still, Vector3::zeros()));
    // Tolerances of 1e-11 over some hundred steps.
    assert!((moving.0.translation.vector - c * 3.0 - resting.0.translation.vector).norm() < 1e-9);
    assert!((moving.1 - resting.1).amax() < 1e-9);
}
