//! A crank that turns evenly drives a piston: the torque that this takes, beside that of the power balance in closed
//! form: `cargo run --release --example driven_crank`.

use gauss_runtime::prelude::*;

/// A crank, a light rod, and a piston along k₁.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(crank, rod),
    body(wheel, rotation = rotation_z(crank), mass = 2, inertia = [0.01, 0.01, 0.02]),
    frame(bar, parent = wheel, position = [r, 0, 0], rotation = rotation_z(rod)),
    point(pin, body = bar, at = [l, 0, 0]),
    particle(mass = m, position = pin),
    constraint(position = pin.y),
    motion(crank = w * t),
)]
struct Engine {
    #[gauss(unit = "m")]
    r: f64,
    #[gauss(unit = "m")]
    l: f64,
    #[gauss(unit = "kg")]
    m: f64,
    #[gauss(unit = "1/s")]
    w: f64,
}

/// Lean of the rod, x, ẋ and ẍ of the piston: l sin(lean) = −r sin(crank).
fn closed_form(engine: &Engine, t: f64) -> [f64; 5] {
    let &Engine { r, l, w, .. } = engine;
    let (sine, cosine) = (w * t).sin_cos();
    let lean = (-r * sine / l).asin();
    let rate = -r * w * cosine / (l * lean.cos());
    let second = (r * w * w * sine + l * rate * rate * lean.sin()) / (l * lean.cos());
    let v = -r * w * sine - l * rate * lean.sin();
    let a = -r * w * w * cosine - l * second * lean.sin() - l * rate * rate * lean.cos();
    [lean, rate, r * cosine + l * lean.cos(), v, a]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let engine = Engine { r: 0.05, l: 0.15, m: 0.8, w: 150.0 };
    let kernel = Engine { ..engine }.kernel()?;
    println!("crank/°   piston/mm   torque/N m   closed form   difference   power/W");
    let mut worst: f64 = 0.0;
    for n in 0..=12 {
        let t = core::f64::consts::TAU / engine.w * f64::from(n) / 12.0;
        let [lean, rate, x, v, a] = closed_form(&engine, t);
        // The rod is measured from the crank.
        let (q, z) = ([lean - engine.w * t].into(), [rate - engine.w].into());
        let drive = kernel.driving_forces(t, &q, &z, &())[EngineMotion::crank];
        let torque = engine.m * a * v / engine.w;
        worst = worst.max((drive.force - torque).abs());
        println!(
            "{:7} {:11.3} {:12.4} {torque:13.4} {:12.1e} {:9.1}",
            30 * n,
            1e3 * x,
            drive.force,
            drive.force - torque,
            drive.power
        );
    }
    assert!(worst < 1e-10, "{worst:e}");
    Ok(())
}
