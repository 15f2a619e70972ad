//! A Crazyflie flies figures of eight under a geometric controller, and meets a gust: four rotors, wind, two kinds of
//! drag.
//!
//! `cargo run --release --example quadrotor [-- FOLDER]` draws the flight into `FOLDER`, by default `target/gauss`.

mod model;
mod newton_euler;
mod picture;
#[cfg(test)]
mod tests;

use gauss_examples::plots;
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;

use model::{Quadrotor, QuadrotorKernel, Seen, pilot, wanted};

/// s.
const FLIGHT: f64 = 14.0;

/// What the pilot sees of a state: in the hybrid chart z is (ḃ, ω).
fn seen(q: &Isometry3<f64>, z: &SVector<f64, 6>) -> Seen {
    let rotation = q.rotation.to_rotation_matrix().into_inner();
    Seen {
        position: q.translation.vector,
        velocity: Vector3::new(z[0], z[1], z[2]),
        rotation,
        omega: Vector3::new(z[3], z[4], z[5]),
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let craft = Quadrotor::crazyflie();
    let kernel = craft.kernel()?;
    println!(
        "Crazyflie 2.0: {:.0} g, rotors {:.1} mm from the centre",
        craft.mass * 1e3,
        craft.a * 2e3 / 2.0_f64.sqrt()
    );
    println!("lift {:.3e} N s²/rad² · n²\n", craft.k);

    let hover = craft.hover_speed();
    let (level, rest) = (Isometry3::identity(), SVector::zeros());
    let still = kernel.acceleration(0.0, &level, &rest, &SVector::from([hover; 4]));
    println!(
        "hover: n = √(mg/4k) = {hover:.2} rad/s; acceleration of the generated equations there {:.1e} m/s²",
        still.norm()
    );

    let control = |t: f64, q: &Isometry3<f64>, z: &SVector<f64, 6>| SVector::from(pilot(&craft, t, &seen(q, z)));
    let path = Simulation::new(&kernel).adaptive(1e-10, 1e-12).input(control).largest_step(0.01).run(
        level,
        rest,
        0.0..FLIGHT,
    )?;
    println!("flight of {FLIGHT} s in {} steps of an adaptive method of order 5", path.len() - 1);

    beside_newton_euler(&craft, &path);
    let (mut error, mut most) = (0.0_f64, 0.0_f64);
    for sample in path.iter() {
        error = error.max((sample.q.translation.vector - wanted(sample.t).position).norm());
        most = most.max(control(sample.t, &sample.q, &sample.z).max());
    }
    println!(
        "the pilot is {error:.3} m off at most; the fastest rotor turns {:.2} times as fast as at hover\n",
        most / hover
    );
    powers(&kernel, &path, control);
    println!("balance: {}", power_balance(&kernel, &path, control));
    let count = QuadrotorKernel::OPERATIONS.acceleration;
    println!(
        "one evaluation of the accelerations: {} additions, {} multiplications, {} exponential\n",
        count.additions, count.multiplications, count.transcendentals
    );

    plots::write("quadrotor", &picture::draw(&craft, &kernel, &path, control)?)?;
    plots::write_page("quadrotor", &picture::page(&craft, &kernel, &path, control)?)
}

/// The same flight by hand, by another method.
fn beside_newton_euler(craft: &Quadrotor, path: &Trajectory<QuadrotorKernel>) {
    let (h, mut apart) = (1e-3, (0.0_f64, 0.0_f64));
    let steps = (FLIGHT / h).round() as usize;
    for (n, hand) in newton_euler::fly(craft, h, steps).iter().enumerate().step_by(10) {
        let sample = path.at((n as f64 * h).min(FLIGHT)).expect("inside the run");
        let ours = seen(&sample.q, &sample.z);
        apart.0 = apart.0.max((ours.position - hand.position).norm());
        apart.1 = apart.1.max((ours.rotation - hand.rotation).norm());
    }
    println!(
        "against Newton–Euler by hand with 1000 classical steps a second: {:.1e} m, rotation {:.1e}",
        apart.0, apart.1
    );
}

fn powers(
    kernel: &QuadrotorKernel,
    path: &Trajectory<QuadrotorKernel>,
    control: impl Fn(f64, &Isometry3<f64>, &SVector<f64, 6>) -> SVector<f64, 4>,
) {
    println!("element         mean power/W   least/W   most/W   over the flight");
    let times = || (0..=2800).map(|n| f64::from(n) * FLIGHT / 2800.0);
    for (e, element) in QuadrotorKernel::ELEMENTS.iter().enumerate() {
        let power = |t| {
            let s = path.at(t).expect("inside the run");
            kernel.powers(t, &s.q, &s.z, &control(t, &s.q, &s.z))[e]
        };
        let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        for p in times().map(power) {
            (sum, low, high) = (sum + p, low.min(p), high.max(p));
        }
        println!("{:14} {:13.5} {low:9.4} {high:8.4}", element.name, sum / 2801.0);
    }
}
