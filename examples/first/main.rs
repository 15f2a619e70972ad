//! The first program: a torpedo that turns its nose into the flow.
//!
//! `cargo run --release -p gauss-first [-- FOLDER]` writes a picture, a table and a page that plays into `FOLDER`, by
//! default `target/gauss`. The struct and the run are those of the README.

use gauss_playback::{Playback, Shape};
use {gauss_runtime::prelude::*, gauss_tables::Tabulate};

/// A torpedo as heavy as the water that it displaces, body axes: e₁ forward. Kirchhoff's equations.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, define(v = body.relative_velocity, w = body.body_angular_velocity),
    // A hull without fins turns broadside. Theirs are 0.8 m behind O, and push against the flow across them.
    force(fins, at = [-0.8, 0, 0], value = [0, -lift * v.x * (v.y - 0.8 * w.z), -lift * v.x * (v.z + 0.8 * w.y)]))]
struct Torpedo {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>, // from O
    #[gauss(inertia)]
    inertia: Vector3<f64>, // about O: principal moments
    #[gauss(added_mass)]
    added: Vector6<f64>, // leave it out: no fluid
    lift: f64, // of the fins, in kg/m; clauses name it
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let torpedo = Torpedo {
        mass: 30.0,
        center: Vector3::new(0.0, 0.0, -0.02),
        lift: 60.0,
        inertia: Vector3::new(0.2, 3.5, 3.5),
        added: Vector6::new(0.9, 35.0, 35.0, 0.07, 4.9, 4.9),
    };
    let kernel = torpedo.kernel()?; // parameters checked, constants computed once
    println!("{}", TorpedoKernel::EQUATIONS); // what was derived; OPERATIONS: what it costs
    // Where it is (rotation and position), and (u, ω): velocity of O and angular velocity, body axes.
    let (pose, twist) = (Isometry3::translation(0.0, 0.0, -5.0), Vector6::new(1.5, 0.0, 0.0, 0.5, 1.0, 1.5));
    let run = Simulation::new(&kernel).adaptive(1e-10, 1e-12).run(pose, twist, 0.0..10.0)?;
    println!("after 10 s at {:.3?}", run.last().q.translation.vector.as_slice());
    // A table that every program for plots reads: t, the pose, the speeds, the energies.
    let table = run.table_at((0..=1000).map(|n| 0.01 * f64::from(n)))?.state().energies(&kernel).si();

    let folder = gauss_files::output_folder_or_argument();
    let files = ["torpedo.csv", "torpedo.svg", "torpedo.html"].map(|name| folder.join(name));
    let [csv, svg, html] = &files;
    table.write_csv(csv)?;
    table.plot(svg)?;
    let hull = [
        Shape::ellipsoid([0.8, 0.1, 0.1]),
        Shape::cuboid([0.1, 0.4, 0.01]).at(&Isometry3::translation(-0.75, 0.0, 0.0)).colour("#444444"),
        Shape::cuboid([0.1, 0.01, 0.4]).at(&Isometry3::translation(-0.75, 0.0, 0.0)).colour("#444444"),
    ];
    Playback::new("A torpedo that turns its nose into the flow", &run)?
        .si()
        .up([0.0, 0.0, -1.0])
        .body("torpedo", |s| s.q, hull)
        .follow("torpedo")
        .trace("torpedo", [0.0; 3])
        .arrow("velocity", 0.5, |s| (s.q.translation.vector, s.q.rotation * Vector3::from(s.z.fixed_rows::<3>(0))))
        .energy(&kernel)
        .write(html)?;
    files.iter().for_each(|file| println!("written: {}", file.display()));
    Ok(())
}
