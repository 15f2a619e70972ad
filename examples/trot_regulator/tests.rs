//! The claims of the example `trot_regulator`: derivatives of steps say what becomes of a small push through
//! touchdowns, torques alone let the robot fall after a push, and gains bring it back to its gait.

use gauss_runtime::prelude::*;

use crate::gait::{BACK, Gains, Gait, LEAST, PUSHED, Ways, largest, pushed};
use crate::robot::{Deviation, Robot, STEP};
use crate::{page, picture};

#[test]
fn gains_from_derivatives_of_steps_hold_a_trot() {
    let robot = Robot::new().unwrap();
    let gait = Gait::record(&robot, 500).unwrap();
    // The laws are solved within 1e-12 of the largest rate, some m/s. It trots: each pair of feet lands twice.
    assert!(gait.residual < 1e-11 && gait.landings >= 8, "{} {}", gait.residual, gait.landings);
    let linear = gait.linearized(&robot).unwrap();
    assert_eq!((linear.steps.len(), linear.none), (500, 0));
    let gains = Gains::of(&linear.steps);

    // A small push, sideways and forward: what follows is the product of the derivatives, with gains.
    let push = Vector3::new(1e-6, 1e-6, 0.0);
    let run = pushed(&robot, &gait, &push, Ways::Regulated(&gains));
    let first = (PUSHED / STEP).round() as usize;
    let mut expected = Deviation::zeros();
    let along = gait.states[first].0.0.rotation.inverse() * push;
    expected.fixed_rows_mut::<3>(18).copy_from(&along);
    for n in first..500 {
        let off = (gait.off(n, &run.states[n]) - expected).amax();
        // What is left out is of second order: deviations of 3e-6 squared, by second derivatives of steps, which
        // impacts make as large as 1/h = 500 at most.
        assert!(off < 5e-9, "step {n}: {off}");
        let (a, b) = &linear.steps[n];
        expected = a * expected - b * (gains.0[n] * expected);
    }

    let aside = Vector3::y();
    let [replayed, springs, regulated] =
        [Ways::Replayed, Ways::Springs, Ways::Regulated(&gains)].map(|way| pushed(&robot, &gait, &(aside * 0.4), way));
    assert!(replayed.fell.is_some() && regulated.fell.is_none() && regulated.off < BACK, "{}", regulated.off);
    assert!(largest(&robot, &gait, &aside, Ways::Replayed) < LEAST);
    let rows = [(0.4, [replayed.off, springs.off, regulated.off])];
    assert!(page::page(&robot.plain, &regulated, 0.4).unwrap().html().unwrap().starts_with("<!DOCTYPE html>"));
    assert!(picture::draw(&gait, 0.4, &[replayed, springs, regulated], &rows).unwrap().contains("Sideways"));
}
