//! A CubeSat turned by the gradient of gravity, and by a reaction wheel.
//!
//! `cargo run --release --example satellite [-- FOLDER]` draws its angles into `FOLDER`, by default `target/gauss`.

mod model;
mod picture;
#[cfg(test)]
mod tests;

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, TAU};

use gauss_examples::plots;
use gauss_runtime::monitor::{monitor_body, power_balance};
use gauss_runtime::prelude::*;

use model::{
    FromTheCentre, MU, OrbiterKernel, Slewer, SlewerKernel, cubesat, libration_frequency, libration_period,
    mean_motion, measured_period, orbit, orbiter, pitch, slew, slew_torque, start, tumble_by_hand,
};

/// The slew: a quarter turn in 120 s.
const SLEW: f64 = 120.0;

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, inertia) = cubesat();
    let period = TAU / mean_motion();
    println!("A 6U CubeSat, {mass} kg, moments {:.4}, {:.4}, {:.4} kg m²", inertia.x, inertia.y, inertia.z);
    println!("on a circular orbit of 7000 km radius, {:.1} min a turn\n", period / 60.0);
    chart()?;

    println!("e₁, with the smallest moment, upwards: librations in the plane of the orbit");
    println!("amplitude/°  period/s  4K(sin θ₀)/ω/s  relative difference   ω = n√(3(I₂ − I₁)/I₃)");
    let kernel = orbiter()?;
    let mut librations = vec![];
    for degrees in [1.0_f64, 10.0, 40.0] {
        let amplitude = degrees.to_radians();
        let path = orbit(&kernel, start(amplitude, 0.0), 4.0 * period)?;
        let (measured, exact) = (measured_period(&path), libration_period(amplitude));
        println!("{degrees:11} {measured:9.3} {exact:15.3} {:20.1e}", (measured - exact).abs() / exact);
        librations.push((degrees, path));
    }

    let falling = fall_over(&kernel, period)?;
    let watched = monitor_body(&kernel, &librations[1].1);
    let kept = |relative: Option<f64>| relative.unwrap_or(f64::NAN);
    println!(
        "over four orbits: energy kept to {:.0e}, angular momentum about the Earth's centre to {:.0e}\n",
        kept(watched.energy.relative()),
        kept(watched.angular_momentum.relative())
    );

    let slewer = Slewer::cubesat();
    let wheel = slewer.kernel()?;
    let calm = quarter_turn(&slewer, &wheel)?;
    println!(
        "multiplications for the accelerations: in orbit {}, with the wheel {}\n",
        OrbiterKernel::OPERATIONS.acceleration.multiplications,
        SlewerKernel::OPERATIONS.acceleration.multiplications
    );

    plots::write("satellite", &picture::draw(&librations, &falling, &slewer, &calm)?)?;
    plots::write_page("satellite", &picture::page(&kernel, &librations[2].1)?)
}

/// From the attitude that is not stable.
fn fall_over(kernel: &OrbiterKernel, period: f64) -> Result<Trajectory<'_, OrbiterKernel>, Box<dyn Error>> {
    println!("\ne₁ along the path, where I₂ > I₁ is upright: it falls over at the rate n√(3(I₂ − I₁)/I₃)");
    let deviation = 1e-4_f64.to_radians();
    let falling = orbit(kernel, start(FRAC_PI_2 + deviation, 0.0), 2.0 * period)?;
    let angle = |t: f64| pitch(&falling.at(t).expect("inside the run").q) - FRAC_PI_2;
    let (early, late) = (0.6 * period, 1.2 * period);
    let rate = (angle(late) / angle(early)).ln() / (late - early);
    let grown = |t: f64| (libration_frequency() * t).cosh();
    let theory = (grown(late) / grown(early)).ln() / (late - early);
    println!(
        "rate from 0.6 to 1.2 orbits {rate:.9e} /s, theory {theory:.9e} /s, relative difference {:.1e} (a deviation of {:.2}° is not quite small)",
        (rate / theory - 1.0).abs(),
        angle(late).to_degrees()
    );
    Ok(falling)
}

/// By the wheel, from rest and while it tumbles; the way from rest.
fn quarter_turn<'k>(
    slewer: &'k Slewer,
    wheel: &'k SlewerKernel,
) -> Result<Trajectory<'k, SlewerKernel>, Box<dyn Error>> {
    let by = |roll: f64| slew(wheel, slewer, FRAC_PI_2, SLEW, roll);
    let (calm, tumbling) = (by(0.0)?, by(0.01)?);
    let (hub, about) = slewer.moments();
    println!("a quarter turn in {SLEW} s by a wheel of {about:.2e} kg m² about e₃");
    let (mut closed, mut lost) = (0.0_f64, 0.0_f64);
    for s in calm.iter() {
        closed = closed.max((s.q.0.scaled_axis().z + about / (hub + about) * s.q.1[0]).abs());
    }
    let first = slewer.angular_momentum(&tumbling.first().q.0, &tumbling.first().z);
    for s in tumbling.iter() {
        lost = lost.max((slewer.angular_momentum(&s.q.0, &s.z) - first).norm() / first.norm());
    }
    let fastest = calm.iter().map(|s| s.z[3].abs()).fold(0.0, f64::max) * 60.0 / TAU;
    println!(
        "  reached {:.9}°; the wheel turns {:.1} times, with {fastest:.0} rpm at most",
        calm.last().q.0.scaled_axis().z.to_degrees(),
        calm.last().q.1[0].abs() / TAU
    );
    println!("  hub + J_w/(J + J_w) · wheel: {closed:.1e} rad at most");
    println!("  the same while it tumbles with 0.01 rad/s: angular momentum kept to {lost:.1e} of its size");
    let by_hand = tumble_by_hand(slewer, 0.01, |t| slew_torque(slewer, FRAC_PI_2, SLEW, t), 0.01, 12_000);
    println!(
        "  and its speeds against a gyrostat by hand: {:.1e} of the wheel's",
        (tumbling.last().z - by_hand).norm() / tumbling.iter().map(|s| s.z.norm()).fold(0.0, f64::max)
    );
    let motor = |t: f64, _: &_, _: &_| SVector::from([slew_torque(slewer, FRAC_PI_2, SLEW, t)]);
    println!("  balance: {}", power_balance(wheel, &tumbling, motor));
    Ok(calm)
}

/// What is lost in a chart with its pole in the centre of the Earth.
fn chart() -> Result<(), Box<dyn Error>> {
    let (mass, inertia) = cubesat();
    let (q, z) = start(0.3, 0.2);
    let (omega, far_away) = (z.fixed_rows::<3>(3).into_owned(), FromTheCentre { mass, inertia, mu: MU }.kernel()?);
    // ξ = v_O + ω × (Ω − O) and ω, observer axes.
    let turning = q.rotation * omega;
    let xi = z.fixed_rows::<3>(0) - turning.cross(&q.translation.vector);
    let far = SVector::from([xi.x, xi.y, xi.z, turning.x, turning.y, turning.z]);

    let near_by = orbiter()?;
    let near_back = near_by.velocity(0.0, &q, &near_by.momentum(0.0, &q, &z)).fixed_rows::<3>(3).into_owned();
    let far_back = far_away.velocity(0.0, &q, &far_away.momentum(0.0, &q, &far)).fixed_rows::<3>(3).into_owned();
    let (near_lost, far_lost) = ((near_back - omega).norm(), (far_back - turning).norm());
    println!(
        "what momenta keep of ω: hybrid chart, lost {:.0e} of it; right-invariant chart, pole at the",
        near_lost / omega.norm()
    );
    println!("centre of the Earth, lost {:.0e} of it: hence hybrid\n", far_lost / omega.norm());
    Ok(())
}
