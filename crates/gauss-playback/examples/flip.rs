//! The page of a racket that is thrown spinning about its middle axis: `cargo run --example flip -- target/flip.html`.

use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = free)]
struct Racket {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let racket = Racket { mass: 0.3, inertia: Vector3::new(1.2e-3, 1.5e-2, 1.62e-2), g: 9.81 }.kernel()?;
    // Thrown upwards: e₁ is the handle.
    let start = Vector6::new(0.0, 0.0, 9.0, 0.05, 14.0, 0.0);
    let path = Simulation::new(&racket).adaptive(1e-10, 1e-10).run(Isometry3::identity(), start, 0.0..1.8)?;
    let given = std::env::args_os().nth(1).map(std::path::PathBuf::from);
    let file = given.unwrap_or_else(|| gauss_files::output_folder().join("flip.html"));
    let spatial = |s: &Sample<_>| racket.space_momentum(s.t, &s.q, &s.z);
    Playback::new("A racket thrown about its middle axis", &path)?
        .si()
        .body(
            "racket",
            |s| racket.pose(s.t, &s.q),
            [
                Shape::rod([-0.34, 0.0, 0.0], [-0.02, 0.0, 0.0], 0.016).colour("#7f4f24"),
                Shape::ellipsoid([0.17, 0.12, 0.012]).at(&Isometry3::translation(0.13, 0.0, 0.0)),
            ],
        )
        .follow("racket")
        .trace("racket", [0.3, 0.0, 0.0])
        .arrow("angular momentum about G", 1.6, |s| {
            let (at, m) = (s.q.translation.vector, spatial(s));
            let [p, l] = [m.fixed_rows::<3>(0).into_owned(), m.fixed_rows::<3>(3).into_owned()];
            (at, l - at.cross(&p))
        })
        .curve("angular velocity in the racket's axes / (rad/s)", "ω₁", |s| s.z[3])
        .curve("angular velocity in the racket's axes / (rad/s)", "ω₂", |s| s.z[4])
        .curve("angular velocity in the racket's axes / (rad/s)", "ω₃", |s| s.z[5])
        .energy(&racket)
        .write(&file)?;
    println!("written: {}", file.display());
    Ok(())
}
