//! One run in every format: `cargo run -p gauss-tables --features parquet --example formats [-- FOLDER]`, by default
//! into `target/gauss`.

use std::error::Error;

use gauss_runtime::prelude::*;
use gauss_tables::Tabulate;

/// A heavy top.
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
    gravity: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = gauss_files::output_folder_or_argument();
    let (center, inertia) = (Vector3::new(0.0, 0.0, 0.1), Vector3::new(0.02, 0.02, 0.01));
    let kernel = Top { mass: 1.0, center, inertia, gravity: 9.81 }.kernel()?;
    let start = UnitQuaternion::from_euler_angles(0.5, 0.0, 0.0);
    let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(start, Vector3::new(0.0, 0.0, 40.0), 0.0..2.0)?;
    let table = run.table_at((0..=1000).map(|n| 0.002 * f64::from(n)))?.state().energies(&kernel).si();

    table.write_csv(folder.join("top.csv"))?;
    #[cfg(feature = "plot")]
    table.plot(folder.join("top.svg"))?;
    #[cfg(feature = "arrow")]
    table.write_arrow(folder.join("top.arrow"))?;
    #[cfg(feature = "parquet")]
    table.write_parquet(folder.join("top.parquet"))?;
    println!("written: {}", folder.join("top.*").display());
    Ok(())
}
