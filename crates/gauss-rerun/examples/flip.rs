//! A racket thrown about its middle axis, for Rerun: `cargo run --example flip [-- FILE.rrd]`.

use std::error::Error;

use gauss_rerun::Recorder;
use gauss_runtime::prelude::*;
use rerun::{Boxes3D, RecordingStreamBuilder};

/// Moments in the order that makes the second axis unstable.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant)]
struct Racket {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    gravity: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "flip.rrd".into());
    let racket = Racket { mass: 0.3, inertia: Vector3::new(2e-3, 1.5e-2, 1.6e-2), gravity: 9.81 }.kernel()?;
    let throw = Vector6::new(0.5, 0.0, 10.0, 0.01, 12.0, 0.01);
    let path = Simulation::new(&racket).adaptive(1e-9, 1e-9).run(Isometry3::identity(), throw, 0.0..2.0)?;
    let stream = RecordingStreamBuilder::new("racket").save(&file)?;
    Recorder::new(&stream, &path)?
        .body("racket", |s| racket.pose(s.t, &s.q))?
        .shape("racket", &Boxes3D::from_sizes([[0.2, 0.6, 0.03]]))?
        .trace("racket", "tip", [0.0, 0.3, 0.0])?
        .arrow("angular velocity", 0.05, |s| {
            let pose = racket.pose(s.t, &s.q);
            (pose.translation.vector, pose.rotation * s.z.fixed_rows::<3>(3).into_owned())
        })?
        .energy(&racket)?;
    stream.flush_blocking()?;
    println!("written: {file}; open it with `rerun {file}`");
    Ok(())
}
