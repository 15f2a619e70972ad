//! A heavy top, from a struct of parameters to a trajectory: `cargo run --release --example hello_top`.

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::monitor;
use gauss_runtime::prelude::*;

/// A symmetric top on a fixed tip.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let center = Vector3::new(0.0, 0.0, 0.04);
    let top = Top { mass: 0.1, center, inertia: Vector3::new(2e-4, 2e-4, 5e-5), g: 9.81 }.kernel()?;
    println!("{}\n", TopKernel::EQUATIONS);

    // Leaning by half a radian, spinning at 300 rad/s.
    let (q, z) = (UnitQuaternion::from_euler_angles(0.5, 0.0, 0.0), Vector3::new(0.0, 0.0, 300.0));
    let path = Simulation::new(&top).adaptive(1e-10, 1e-10).run(q, z, 0.0..2.0)?;

    println!("   t/s      x/mm      y/mm      z/mm   of the centre of mass");
    for n in 0..=10 {
        let sample = path.at(0.2 * f64::from(n)).expect("inside the run");
        let g = sample.q * center * 1e3;
        println!("{:6.1} {:9.4} {:9.4} {:9.4}", sample.t, g.x, g.y, g.z);
    }
    println!("\n{}", monitor(&top, &path));

    // The same as a page that plays, in `target/gauss`.
    let page = Playback::with_pictures("A heavy top", &path, 2000)?
        .si()
        .body(
            "top",
            |s| Isometry3::from_parts(Translation3::identity(), s.q),
            [
                Shape::cylinder(0.032, 0.012).at(&Isometry3::translation(0.0, 0.0, 0.04)),
                Shape::rod([0.0; 3], [0.0, 0.0, 0.08], 0.003).colour("#444444"),
            ],
        )
        .trace("top", [0.0, 0.0, 0.08])
        .arrow("angular momentum", 2.0, |s| (Vector3::zeros(), s.q * s.p))
        .curve("from the vertical / °", "angle", |s| (s.q * Vector3::z()).angle(&Vector3::z()).to_degrees())
        .energy(&top);
    write_page("hello_top", &page)
}
