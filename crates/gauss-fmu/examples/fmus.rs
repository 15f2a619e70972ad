//! Writes FMUs for other tools: a ball that bounces, of FMI 2.0, and a cart with a pendulum, of FMI 3.0.
//!
//! `cargo run -p gauss-fmu --example fmus`, then `fmpy simulate target/gauss/ball.fmu --show-plot`.

use gauss_fmu::{Fmu, FmuError, Version};

const BALL: &str = "/// A ball that bounces on a floor.
    #[gauss(coordinates(height), particle(mass = m, position = [0, 0, height]),
        contact(floor, gap = height, restitution = e), gravity = g)]
    struct Ball { #[gauss(unit = \"kg\")] m: f64, e: f64, #[gauss(unit = \"m/s^2\")] g: f64 }";

const CART: &str = "/// A cart on a rail, with a pendulum.
    #[gauss(coordinates(x, angle), input(push = \"N\"), drive(x = push), frames(bob), gravity = 9.81,
        particle(mass = m, position = [x, 0, 0]),
        body(bob, position = [x - l * sin(angle), 0, -l * cos(angle)], rotation = rotation_y(angle),
            mass = 0.2, inertia = 1e-4))]
    struct Cart { #[gauss(unit = \"kg\")] m: f64, #[gauss(unit = \"m\")] l: f64 }";

fn main() -> Result<(), FmuError> {
    let folder = gauss_files::output_folder_or_argument();
    let ball = Fmu::new(BALL, &[("m", &[0.1]), ("e", &[0.8]), ("g", &[9.81])])?.start(&[("height", 1.0)])?;
    let cart = Fmu::new(CART, &[("m", &[1.0]), ("l", &[0.5])])?.start(&[("angle", 0.3)])?;
    for (fmu, name, version) in [(ball, "ball.fmu", Version::Two), (cart, "cart.fmu", Version::Three)] {
        let file = folder.join(name);
        let written = fmu.version(version).write(&file)?;
        println!("{}: a binary for {}", file.display(), written.platform.unwrap_or("no platform, source code alone"));
    }
    Ok(())
}
