//! A long pass in a crosswind: drag and Magnus force of the velocity against the air, buoyancy, added mass, gusts.
//!
//! `cargo run --release --example crosswind_ball [-- FOLDER]` draws the passes into `FOLDER`, by default
//! `target/gauss`.

mod model;
#[cfg(test)]
mod tests;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::power_balance;
use gauss_runtime::prelude::*;
use plotters::style::RGBColor;

use model::{Ball, BallKernel, fly, fly_by_hand};

/// A pass: 26 m/s at 35° above the ground.
fn kick() -> Vector3<f64> {
    let elevation = 35.0_f64.to_radians();
    Vector3::new(elevation.cos(), 0.0, elevation.sin()) * 26.0
}

/// The path in the air: points up to the ground, with its time there.
fn until_ground(path: &Trajectory<BallKernel>) -> (f64, Vec<Vector3<f64>>) {
    let place = |t: f64| path.at(t).expect("inside the run").q.translation.vector;
    // Bisection between the top and the end of the run, which lies below the ground.
    let (mut above, mut below) = (1.0, path.last().t);
    for _ in 0..60 {
        let middle = 0.5 * (above + below);
        if place(middle).z > 0.0 { above = middle } else { below = middle }
    }
    (above, (0..=200).map(|n| place(above * f64::from(n) / 200.0)).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let calm = Ball::football(Vector3::zeros());
    println!(
        "A football: {:.0} g, {:.1} g of air displaced, {:.1} g added",
        calm.mass * 1e3,
        calm.displaced_mass * 1e3,
        calm.added_mass[0] * 1e3
    );

    drop_it(&calm)?;
    let spin = straightening_spin()?;
    println!("a pass of 26 m/s at 35°        range/m  aside/m  time/s   from a mass point by hand/m");
    let (above, beside) = passes(spin)?;
    let along = ("along the kick, m", 0.0..46.0);
    let title = "From above: the wind blows to the left (up), the ball flies to the right";
    let above = Plot::new(title, along.clone(), ("aside, m", -1.0..7.0), above);
    let beside = Plot::new("From the side", along, ("height, m", 0.0..12.0), beside);
    write("crosswind_ball", &sheet("A long pass in gusty wind", (1600, 1300), &[vec![above], vec![beside]])?)?;
    page(spin)
}

/// The pass that comes back to its line, with the forces on the ball.
fn page(spin: f64) -> Result<(), Box<dyn std::error::Error>> {
    let ball = Ball::football(Vector3::new(0.0, 8.0, 0.0));
    let kernel = ball.kernel()?;
    let path = fly(&kernel, kick(), Vector3::z() * spin, 3.5)?;
    let (lands, _) = until_ground(&path);
    let path = path.at_times((0..600).map(|n| lands * f64::from(n) / 599.0))?;
    let place = |s: &Sample<BallKernel>| s.q.translation.vector;
    let radius = (1.5 * ball.inertia / ball.mass).sqrt();
    // A dark panel shows how it spins.
    let panel = Shape::cylinder(0.5 * radius, 0.02).at(&Isometry3::translation(0.95 * radius, 0.0, 0.0));
    let mut page = Playback::of_samples("A long pass in a crosswind, with sidespin", path)
        .si()
        .body("ball", |s| kernel.pose(s.t, &s.q), [Shape::ball(radius), panel.colour("#444444")])
        .follow("ball")
        .trace("ball", [0.0; 3])
        .arrow("wind", 0.05, |s| (place(s), ball.air(s.t).0));
    // The speeds are ḃ and ω: the first three of what acts on them are a force by the observer.
    for (k, element) in BallKernel::ELEMENTS.iter().enumerate().filter(|(_, e)| ["drag", "magnus"].contains(&e.name)) {
        let force = |s: &Sample<BallKernel>| -> Vector3<f64> {
            kernel.element_forces(s.t, &s.q, &s.z, &()).fixed_view::<3, 1>(0, k).into()
        };
        page = page
            .arrow(element.name, 0.25, |s| (place(s), force(s)))
            .curve("force / N", element.name, |s| force(s).norm());
    }
    write_page("crosswind_ball", &page.curve("aside / m", "y", |s| place(s).y).energy(&kernel))
}

fn drop_it(calm: &Ball) -> Result<(), Box<dyn std::error::Error>> {
    // Dropped in calm air: (m + m_a) v̇ = (m − m_d) g − c v² has the solution v∞ tanh(t/τ).
    let (terminal, tau) = (calm.terminal_speed(), calm.terminal_speed() * calm.total_mass() / calm.heaviness());
    let kernel = calm.kernel()?;
    let drop = fly(&kernel, Vector3::zeros(), Vector3::zeros(), 30.0)?;
    let error = drop.iter().map(|s| (s.z[2] + terminal * (s.t / tau).tanh()).abs()).fold(0.0, f64::max);
    println!(
        "dropped for 30 s: {:.6} m/s; closed form {:.6}, terminal {terminal:.6}",
        -drop.last().z[2],
        terminal * (30.0 / tau).tanh()
    );
    println!("  largest distance from v∞ tanh(t/τ): {error:.1e} m/s\n");

    Ok(())
}

/// The sidespin that brings the ball back to the line in 8 m/s of crosswind, by bisection.
fn straightening_spin() -> Result<f64, Box<dyn std::error::Error>> {
    let crosswind = Ball::football(Vector3::new(0.0, 8.0, 0.0)).kernel()?;
    let landing = |spin: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let path = fly(&crosswind, kick(), Vector3::z() * spin, 3.5)?;
        Ok(until_ground(&path).1[200].y)
    };
    let (mut low, mut high) = (-80.0, 0.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if landing(middle)? > 0.0 { high = middle } else { low = middle }
    }
    Ok(0.5 * (low + high))
}

/// A pass in several winds, from above and from the side.
fn passes(spin: f64) -> Result<(Vec<Line>, Vec<Line>), Box<dyn std::error::Error>> {
    let [blue, red, green, pink] = COLOURS;
    let grey = RGBColor(110, 110, 110);
    let passes = [
        ("calm", grey, Vector3::zeros(), 0.0),
        ("4 m/s across", blue, Vector3::new(0.0, 4.0, 0.0), 0.0),
        ("8 m/s across", red, Vector3::new(0.0, 8.0, 0.0), 0.0),
        ("the same, with sidespin", pink, Vector3::new(0.0, 8.0, 0.0), spin),
        ("8 m/s against", green, Vector3::new(-8.0, 0.0, 0.0), 0.0),
    ];
    let (mut above, mut beside) = (vec![], vec![]);
    for (name, colour, wind, spin) in passes {
        let ball = Ball::football(wind);
        let kernel = ball.kernel()?;
        let path = fly(&kernel, kick(), Vector3::z() * spin, 3.5)?;
        let hand = fly_by_hand(&ball, kick(), Vector3::z() * spin, 1e-3, 3500);
        let apart = hand.iter().enumerate().map(|(n, (x, _))| {
            let sample = path.at((n as f64 * 1e-3).min(3.5)).expect("inside the run");
            (sample.q.translation.vector - x).norm()
        });
        let (time, points) = until_ground(&path);
        let end = points[200];
        println!("{name:28} {:9.3} {:8.3} {time:7.3}   {:.1e}", end.x, end.y, apart.fold(0.0, f64::max));
        above.push(Line::new(name, colour, points.iter().map(|p| (p.x, p.y))));
        beside.push(Line::new("", colour, points.iter().map(|p| (p.x, p.z))));
        if spin != 0.0 {
            println!(
                "  {:.2} turns a second; {}",
                spin.abs() / std::f64::consts::TAU,
                power_balance(&kernel, &path, |_, _, _| ())
            );
            let s = path.at(1.0).expect("inside the run");
            for (element, power) in BallKernel::ELEMENTS.iter().zip(kernel.powers(s.t, &s.q, &s.z, &()).iter()) {
                println!("  after 1 s {:8} {power:9.4} W", element.name);
            }
        }
    }
    Ok((above, beside))
}
