//! The claims of the example `trotting`: it trots by the laws, its feet carry its weight, and recorded torques give the
//! same bits.

use std::error::Error;

use crate::robot;
use crate::robot::{Anymal, AnymalKernel, STEP, STRIDE, run, start, trot};
use gauss_runtime::prelude::*;

const FILE: &str = include_str!("../../tests/robots/anymal.urdf");

#[test]
fn it_trots_and_recorded_torques_give_the_same_bits() -> Result<(), Box<dyn Error>> {
    let kernel = Anymal { mu: 0.8 }.kernel()?;
    let stride = (STRIDE / STEP).round() as usize;
    let steps = 8 * stride;
    let (mut torques, mut ends, mut pressed) = (Vec::new(), Vec::new(), Vec::new());
    let controller = |n: usize, q: &robot::Place, z: &robot::Speeds| {
        torques.push(trot(n as f64 * STEP, q, z, 0.3));
        torques[n]
    };
    run(&kernel, start(&kernel), steps, controller, |stepper| {
        let (residual, q) = (stepper.report().residual, stepper.configuration());
        // Laws are solved until a solution is within 1e-12 of the largest rate, some m/s; gaps are rounded at the size
        // of coordinates, a metre, a few times for each joint of a leg.
        let worst = residual.signorini.max(residual.coulomb).max(residual.dissipation);
        assert!(worst < 1e-11 && kernel.gaps(0.0, q).min() > -1e-14, "{worst} m/s at {} s", stepper.time());
        let (roll, pitch, _) = q.0.rotation.euler_angles();
        assert!(roll.abs() < 0.1 && pitch.abs() < 0.1, "it leans at {} s", stepper.time());
        let normals = AnymalKernel::CONTACTS.iter().map(|contact| stepper.impulses()[contact.normal]);
        pressed.push(normals.sum::<f64>());
        ends.push((*q, *stepper.speeds()));
    })?;
    let way = ends[steps - 1].0.0.translation.x - ends[steps - 1 - 4 * stride].0.0.translation.x;
    let speed = way / (4.0 * STRIDE);
    assert!((0.2..0.4).contains(&speed), "{speed} m/s of 0.3");

    // Over whole strides the feet carry the weight of the masses in the file: 2 s of it, but for what its middle is
    // faster upward after them than before, which is below 0.04 m/s.
    let masses = FILE.split("<mass value=\"").skip(1).filter_map(|rest| rest.split('"').next()?.parse::<f64>().ok());
    let (weight, time) = (9.81 * masses.sum::<f64>(), 4.0 * STRIDE);
    let carried: f64 = pressed[steps - 4 * stride..].iter().sum();
    assert!((carried / (weight * time) - 1.0).abs() < 2e-3, "{carried} N s for {} N s", weight * time);

    // Without the controller, by the torques alone.
    let mut n = 0;
    run(
        &kernel,
        start(&kernel),
        steps,
        |n, _, _| torques[n],
        |stepper| {
            assert!((*stepper.configuration(), *stepper.speeds()) == ends[n], "another motion at {} s", stepper.time());
            n += 1;
        },
    )?;
    assert_eq!(n, steps);
    Ok(())
}
