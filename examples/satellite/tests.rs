//! The physics of the example `satellite`.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::model::{
    FromTheCentre, MU, RADIUS, Slewer, cubesat, libration_frequency, libration_period, mean_motion, measured_period,
    orbit, orbiter, pitch, slew, slew_torque, start, tumble_by_hand,
};
use gauss_runtime::prelude::*;

/// An error of 10⁻¹² in each step is an error of phase of as much over the amplitude, and the steps of at most 20 s are
/// some 300 an orbit. The interpolation between samples is of fourth order: (20 s · 10⁻³/s)⁴/384 of the amplitude.
fn phase_error(orbits: f64, amplitude: f64) -> f64 {
    1e-12 * 300.0 * orbits / amplitude + 0.02_f64.powi(4) / 384.0
}

#[test]
fn upright_it_librates_with_the_period_of_a_pendulum() {
    let (kernel, orbits) = (orbiter().unwrap(), 2.0);
    for amplitude in [0.02, 0.7] {
        let path = orbit(&kernel, start(amplitude, 0.0), orbits * TAU / mean_motion()).unwrap();
        let (measured, exact) = (measured_period(&path), libration_period(amplitude));
        assert!((measured / exact - 1.0).abs() <= phase_error(orbits, amplitude), "{measured} s, {exact} s");
    }
    // Small angles have the period of the textbook, up to amplitude²/16 and the next term.
    let small = TAU / libration_frequency();
    assert!((libration_period(0.02) / small - 1.0 - 0.02_f64.powi(2) / 4.0).abs() < 0.02_f64.powi(4));
}

#[test]
fn lying_along_its_path_it_falls_over_at_the_rate_of_the_theory() {
    let (kernel, deviation) = (orbiter().unwrap(), 1e-5);
    let path = orbit(&kernel, start(FRAC_PI_2 + deviation, 0.0), TAU / mean_motion()).unwrap();
    for s in path.iter() {
        let theory = deviation * (libration_frequency() * s.t).cosh();
        let found = pitch(&s.q) - FRAC_PI_2;
        // Errors grow as the deviation does. Beyond the linear equation: δ³ against δ; 10⁻¹⁶·π/2 is the rounding of
        // angles.
        let relative = 1e-12 * 300.0 / deviation + theory * theory;
        assert!((found - theory).abs() <= relative * theory + 1e-15, "{found:e} against {theory:e} at {} s", s.t);
    }
    assert!(pitch(&path.last().q) - FRAC_PI_2 > 500.0 * deviation);
}

/// b, v, R and ω by hand: Kepler and Euler with the torque of the gradient, 3 μ/r³ û × I û, classical Runge–Kutta.
fn by_hand(pitch: f64, lean: f64, h: f64, steps: usize) -> (Vector3<f64>, Matrix3<f64>, Vector3<f64>) {
    let ((q, z), inertia) = (start(pitch, lean), cubesat().1);
    let mut state = (
        q.translation.vector,
        z.fixed_rows::<3>(0).into_owned(),
        q.rotation.to_rotation_matrix().into_inner(),
        z.fixed_rows::<3>(3).into_owned(),
    );
    type State = (Vector3<f64>, Vector3<f64>, Matrix3<f64>, Vector3<f64>);
    let rates = |(b, v, r, w): &State| -> State {
        let cube = MU / b.norm().powi(3);
        let up = r.transpose() * b.normalize();
        let torque = up.cross(&inertia.component_mul(&up)) * (3.0 * cube) - w.cross(&inertia.component_mul(w));
        (*v, b * -cube, r * w.cross_matrix(), torque.component_div(&inertia))
    };
    let add = |s: &State, h: f64, k: &State| (s.0 + k.0 * h, s.1 + k.1 * h, s.2 + k.2 * h, s.3 + k.3 * h);
    for _ in 0..steps {
        let k1 = rates(&state);
        let k2 = rates(&add(&state, 0.5 * h, &k1));
        let k3 = rates(&add(&state, 0.5 * h, &k2));
        let k4 = rates(&add(&state, h, &k3));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = add(&state, weight * h / 6.0, &k);
        }
    }
    (state.0, state.2, state.3)
}

#[test]
fn leaning_out_of_the_plane_it_moves_as_euler_and_kepler_say() {
    let (steps, h) = (2048, TAU / mean_motion() / 2048.0);
    let end = *orbit(&orbiter().unwrap(), start(0.3, 0.2), 2048.0 * h).unwrap().last();
    let (coarse, fine) = (by_hand(0.3, 0.2, h, steps), by_hand(0.3, 0.2, 0.5 * h, 2 * steps));
    let omega = end.z.fixed_rows::<3>(3).into_owned();
    let rotation = end.q.rotation.to_rotation_matrix().into_inner();
    // A fifteenth of what halving changes is the finer one's error, of fourth order; twice that. 10⁻¹² a step for the
    // run, which grows as far as a libration and the drift along the orbit do: by 6π in one.
    let run = 1e-12 * 300.0 * 6.0 * std::f64::consts::PI;
    let within = |halved: f64| 2.0 * halved / 15.0 + run;
    assert!((end.q.translation.vector - fine.0).norm() / RADIUS <= within((coarse.0 - fine.0).norm() / RADIUS));
    assert!((rotation - fine.1).norm() <= within((coarse.1 - fine.1).norm()));
    assert!((omega - fine.2).norm() / mean_motion() <= within((coarse.2 - fine.2).norm() / mean_motion()));
    // It did lean and turn, so that all three equations were at work.
    assert!(fine.2.x.abs().min(fine.2.y.abs()) > 1e-2 * mean_motion(), "{}", fine.2);
}

#[test]
fn momenta_about_the_centre_of_the_earth_do_not_know_the_spin() {
    let ((mass, inertia), (q, z)) = (cubesat(), start(0.3, 0.2));
    let kernel = FromTheCentre { mass, inertia, mu: MU }.kernel().unwrap();
    let turning = q.rotation * z.fixed_rows::<3>(3).into_owned();
    let xi = z.fixed_rows::<3>(0) - turning.cross(&q.translation.vector);
    let far = SVector::from([xi.x, xi.y, xi.z, turning.x, turning.y, turning.z]);
    let back = kernel.velocity(0.0, &q, &kernel.momentum(0.0, &q, &far)).fixed_rows::<3>(3).into_owned();
    // m r v against I n: half a rounding of the one is most of the other.
    assert!((back - turning).norm() > 1e-3 * turning.norm());
    let near = orbiter().unwrap();
    let back = near.velocity(0.0, &q, &near.momentum(0.0, &q, &z));
    assert!((back - z).norm() <= 8.0 * f64::EPSILON * z.norm());
}

#[test]
fn the_wheel_turns_the_hub_and_keeps_angular_momentum() {
    let (slewer, seconds) = (Slewer::cubesat(), 40.0);
    let (hub, wheel) = slewer.moments();
    let kernel = slewer.kernel().unwrap();
    let path = slew(&kernel, &slewer, FRAC_PI_2, seconds, 0.0).unwrap();
    for s in path.iter() {
        // Tolerances of 10⁻¹² of an angle of up to 10⁴ rad of the wheel, whose share is J_w/J, and of 1 rad of the hub.
        let off = s.q.0.scaled_axis().z + wheel / (hub + wheel) * s.q.1[0];
        assert!(off.abs() <= 1e-12 * path.len() as f64 * (1.0 + 1e4 * wheel / hub), "{off:e} rad at {} s", s.t);
    }
    let reached = path.last().q.0.scaled_axis().z;
    assert!((reached - FRAC_PI_2).abs() <= 1e-12 * path.len() as f64, "{reached} rad");

    let tumbling = slew(&kernel, &slewer, FRAC_PI_2, seconds, 0.05).unwrap();
    let first = slewer.angular_momentum(&tumbling.first().q.0, &tumbling.first().z);
    // The wheel carries up to this much: tolerances are relative to it.
    let carried = tumbling.iter().map(|s| wheel * s.z[3].abs()).fold(first.norm(), f64::max);
    for s in tumbling.iter() {
        let lost = (slewer.angular_momentum(&s.q.0, &s.z) - first).norm();
        assert!(lost <= 1e-12 * tumbling.len() as f64 * carried, "{lost:e} of {carried:e} at {} s", s.t);
    }

    let torque = |t| slew_torque(&slewer, FRAC_PI_2, seconds, t);
    let coarse = tumble_by_hand(&slewer, 0.05, torque, 0.02, 2000);
    let fine = tumble_by_hand(&slewer, 0.05, torque, 0.01, 4000);
    let (z, size) = (tumbling.last().z, carried / wheel);
    // Speeds of the hub, then of the wheel: a fifteenth of what halving changes, twice, and the run's tolerance.
    for (rows, scale) in [(0..3, 0.1), (3..4, size)] {
        for i in rows {
            let within = 2.0 * (coarse[i] - fine[i]).abs() / 15.0 + 1e-12 * tumbling.len() as f64 * scale;
            assert!((z[i] - fine[i]).abs() <= within, "speed {i}: {:e} against {within:e}", z[i] - fine[i]);
        }
    }
    assert!(z[1].abs() > 1e-3, "it did not tumble: {z}");
}
