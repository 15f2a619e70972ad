//! The same craft from a textbook, typed by hand: Newton's and Euler's equations, and the classical Runge–Kutta method
//! on twelve plus six plain numbers. Nothing here knows the derive.

use gauss_runtime::prelude::*;

use crate::model::{Quadrotor, Seen, pilot};

/// Rates of change of what is seen: of the rotation Ṙ = R [ω]×.
fn rates(craft: &Quadrotor, t: f64, seen: &Seen) -> Seen {
    let Seen { velocity, rotation, omega, .. } = *seen;
    let n = pilot(craft, t, seen);
    let lift = n.map(|n| craft.k * n * n);

    let wind = craft.gust * (-((t - craft.gust_time) / craft.gust_length).powi(2)).exp();
    let air = rotation.transpose() * (velocity - wind);
    let turns: f64 = n.iter().sum();
    let blades = Vector3::new(craft.blade_xy, craft.blade_xy, craft.blade_z) * -turns;
    let frame = Vector3::new(craft.frame_xy, craft.frame_xy, craft.frame_z);
    let drag = blades.component_mul(&air) - frame.component_mul(&air.component_mul(&air.abs()));
    let force = rotation * (Vector3::z() * lift.iter().sum::<f64>() + drag) - Vector3::z() * (craft.mass * craft.g);

    let torque = Vector3::new(
        craft.a * (lift[2] + lift[3] - lift[0] - lift[1]),
        craft.a * (lift[1] + lift[2] - lift[0] - lift[3]),
        craft.torque_ratio * (lift[1] + lift[3] - lift[0] - lift[2]),
    );
    let momentum = craft.inertia.component_mul(&omega);
    let turn = (torque - omega.cross(&momentum)).component_div(&craft.inertia);
    Seen { position: velocity, velocity: force / craft.mass, rotation: rotation * omega.cross_matrix(), omega: turn }
}

fn add(seen: &Seen, h: f64, rates: &Seen) -> Seen {
    Seen {
        position: seen.position + rates.position * h,
        velocity: seen.velocity + rates.velocity * h,
        rotation: seen.rotation + rates.rotation * h,
        omega: seen.omega + rates.omega * h,
    }
}

/// Flies from rest at the origin for whole steps of length `h`, s: what is seen after each.
pub fn fly(craft: &Quadrotor, h: f64, steps: usize) -> Vec<Seen> {
    let (rest, level) = (Vector3::zeros(), Matrix3::identity());
    let mut seen = Seen { position: rest, velocity: rest, rotation: level, omega: rest };
    let mut all = vec![seen];
    for n in 0..steps {
        let t = n as f64 * h;
        let k1 = rates(craft, t, &seen);
        let k2 = rates(craft, t + 0.5 * h, &add(&seen, 0.5 * h, &k1));
        let k3 = rates(craft, t + 0.5 * h, &add(&seen, 0.5 * h, &k2));
        let k4 = rates(craft, t + h, &add(&seen, h, &k3));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            seen = add(&seen, weight * h / 6.0, &k);
        }
        all.push(seen);
    }
    all
}
