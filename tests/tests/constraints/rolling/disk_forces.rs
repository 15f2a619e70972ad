//! The rolling disk: the force of the ground against closed forms, and long runs that stay on the constraints.

use gauss_runtime::prelude::*;

use super::disk::{ACROSS, ALONG, G, MASS, OnBothKernel, RADIUS, Rolling, on_both, on_velocities, own_speeds, start};

/// The force of the ground by both ways, observer's axes.
fn forces(state: &Rolling) -> [Vector3<f64>; 2] {
    let (pose, twist) = (state.pose(), state.twist());
    [on_velocities().multipliers(0.0, &pose, &twist, &()), on_both().multipliers(0.0, &pose, &twist, &())]
}

#[test]
fn a_disk_let_go_at_rest() {
    // It turns about the tangent at the contact: (A + m r²) θ̈ = −m g r cos θ, and the centre falls by r cos θ θ̈.
    for theta in [0.5, 1.1, 1.5, 2.0] {
        let (s, c) = f64::sin_cos(theta);
        let state = Rolling { q: SVector::from([0.3, -0.2, 0.0, theta, 0.7]), w: Vector3::zeros() };
        let rate = -MASS * G * RADIUS * c / (ACROSS + MASS * RADIUS * RADIUS);
        let found = own_speeds().acceleration(0.0, &state.q, &state.w, &());
        assert!((found - Vector3::new(rate, 0.0, 0.0)).amax() < 1e-13, "{found}");
        let expected = Vector3::new(0.0, -MASS * RADIUS * s * rate, MASS * (G + RADIUS * c * rate));
        for force in forces(&state) {
            assert!((force - expected).amax() < 1e-13, "{force} {expected}");
        }
    }
}

#[test]
fn a_disk_rolling_in_a_circle() {
    // φ̇ = Ω and θ are constant when (C + m r²) w₃ Ω sin θ − A Ω² sin θ cos θ + m g r cos θ = 0; the ground then
    // carries the weight and holds the centre on its circle, of radius r |w₃/Ω|.
    for (theta, rate) in [(1.2, 1.5), (1.9, -2.0), (0.6, 4.0), (std::f64::consts::FRAC_PI_2, 1.0)] {
        let (s, c) = f64::sin_cos(theta);
        let w3 = (ACROSS * rate * c - MASS * G * RADIUS * c / (rate * s)) / (ALONG + MASS * RADIUS * RADIUS);
        let state = Rolling { q: SVector::from([0.0, 0.0, 0.0, theta, 0.4]), w: Vector3::new(0.0, rate * s, w3) };
        let found = own_speeds().acceleration(0.0, &state.q, &state.w, &());
        assert!(found.amax() < 1e-12, "{found}");
        let expected = Vector3::new(0.0, -MASS * RADIUS * w3 * rate, MASS * G);
        for force in forces(&state) {
            assert!((force - expected).amax() < 1e-12, "{force} {expected}");
        }
    }
}

#[test]
fn a_hundred_thousand_steps_stay_on_the_constraints() {
    let (kernel, state) = (on_both(), start());
    let (q, z) = (state.pose(), state.twist());
    let energy = kernel.energy(0.0, &q, &z);
    let (mut off, mut slip, mut gain, mut steps) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
    let watch = |sample: &Sample<OnBothKernel>| {
        off = off.max(kernel.position_residual(sample.t, &sample.q).amax());
        slip = slip.max(kernel.velocity_residual(sample.t, &sample.q, &sample.z).amax());
        gain = gain.max((kernel.energy(sample.t, &sample.q, &sample.z) - energy).abs());
        steps += 1;
    };
    Simulation::new(&kernel).fixed_step(1e-3).observe(watch).run_to_end(q, z, 0.0..100.0).unwrap();
    assert_eq!(steps, 100_001);
    // Terms of half a metre, and of 3 m/s of which each is a sum of six: a few roundings, no more at the end than at
    // first.
    assert!(off <= 4.0 * f64::EPSILON * RADIUS, "{off:e}");
    assert!(slip <= 16.0 * f64::EPSILON * 3.0, "{slip:e}");
    // The method of order 4 commits errors near (ωh)⁵/120 of the motion a step, with ω = 6: 1e-8 in all if they add up.
    assert!(gain <= 1e-7 * energy, "{gain:e}");
}
