//! A robot is set down on a slope and holds itself there: from its file to a table of what its feet feel, and to a page
//! with its contacts, from event to event and in steps by the same words.
//!
//! `cargo run --release --example set_down [-- FOLDER]` writes `set_down.csv` and `set_down.html` into `FOLDER`, by
//! default `target/gauss`.

use std::error::Error;

use gauss_contact::{ContactError, ContactRecord, WithContacts};
use gauss_examples::plots::write_page;
use gauss_playback::Playback;
use gauss_runtime::prelude::*;
use gauss_tables::{RunTable, Tabulate};

/// A quadruped over a slope.
#[derive(GaussDynamics)]
#[gauss(
    urdf = "../tests/robots/quadruped.urdf",
    base = floating,
    gravity = 9.81,
    ground(links = [lf_foot, rf_foot, lh_foot, rh_foot], plane = [rise, 0, 1], along = [1, 0, 0],
           friction = mu),
    frames(
        trunk, lf_thigh, lf_shank, lf_foot, rf_thigh, rf_shank, rf_foot, lh_thigh, lh_shank, lh_foot, rh_thigh,
        rh_shank, rh_foot,
    ),
)]
struct Quadruped {
    mu: f64,
    /// The tangent of the angle of the slope.
    rise: f64,
}

type Configuration = (Isometry3<f64>, SVector<f64, 8>);
type Speeds = SVector<f64, 14>;

/// 6° down along k₁.
const SLOPE: f64 = 0.105;
/// kg: of all links.
const MASS: f64 = 11.6;
/// s: the length of a step.
const STEP: f64 = 1e-3;

/// Crouched, its feet 1 cm above the slope, which is under them as it is turned.
fn start() -> Configuration {
    let legs = SVector::from_fn(|k, _| if k % 2 == 0 { 0.5 } else { -1.0 });
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), SLOPE);
    // Hips are 0.4 cos 0.5 above feet, which are balls of 2 cm.
    let above = turn * Vector3::new(0.0, 0.0, 0.4 * 0.5_f64.cos() + 0.03);
    (Isometry3::from_parts(above.into(), turn), legs)
}

/// Holds the legs as they are at the start.
fn hold(_: f64, (_, legs): &Configuration, z: &Speeds) -> SVector<f64, 8> {
    (start().1 - legs) * 400.0 - z.fixed_rows::<8>(6) * 12.0
}

/// The forces of the feet over time, whatever the run was made by.
fn table<'k>(
    kernel: &QuadrupedKernel,
    run: &impl ContactRecord<'k, QuadrupedKernel>,
) -> Result<RunTable<QuadrupedKernel>, ContactError> {
    let times = (0..=150).map(|n| 0.01 * f64::from(n));
    Ok(run.table_at(times)?.contacts(kernel, |s| Some(*run.forces(s.t).ok()?)).energies(kernel))
}

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = Quadruped { mu: 0.7, rise: SLOPE.tan() }.kernel()?;
    let simulation = || Simulation::new(&kernel).input(hold);
    let steps = simulation().contact_steps(STEP).run(start(), Speeds::zeros(), 0.0..1.5)?;
    let exact = simulation().adaptive(1e-8, 1e-8).contact_events().run(start(), Speeds::zeros(), 0.0..1.5)?;

    println!("A quadruped of {MASS} kg, set down on a slope of 6°:");
    println!("  its feet land at {:.4} s by events, in the step around {:.4} s", exact.jumps()[0], steps.jumps()[0]);
    let forces = (exact.forces(1.5)?, steps.forces(1.5)?);
    for (a, b) in forces.0.vectors().iter().zip(forces.1.vectors()) {
        let name = QuadrupedKernel::CONTACTS[a.contact].name;
        println!("  {name:<8} {:7.3} N by events, {:7.3} N in steps", a.force.norm(), b.force.norm());
    }
    for (name, forces) in [("events", &forces.0), ("steps", &forces.1)] {
        let sum: Vector3<f64> = forces.vectors().iter().map(|foot| foot.force).sum();
        if (sum - Vector3::new(0.0, 0.0, MASS * 9.81)).amax() > 1e-3 {
            return Err(format!("by {name} the feet do not bear the weight: {sum:?}").into());
        }
    }
    let file = gauss_files::output_folder_or_argument().join("set_down.csv");
    table(&kernel, &steps)?.write_csv(&file)?;
    println!("written: {}", file.display());
    let heights =
        [table(&kernel, &exact)?, table(&kernel, &steps)?].map(|table| table.samples()[150].q.0.translation.z);
    println!("  at the end its trunk is at {:.5} m by events, at {:.5} m in steps", heights[0], heights[1]);

    let mut page = Playback::new("A quadruped, set down on a slope", &steps)?
        .si()
        .frames(&kernel)
        .shapes_of_urdf(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/robots/quadruped.urdf"))
        .contacts(&kernel, 5e-3, &steps)
        .curve("speed of the trunk / (m/s)", "down", |s| -s.z[2])
        .energy(&kernel);
    for leg in ["lf", "rf", "lh", "rh"] {
        let link = |name: &str| format!("{leg}_{name}");
        page = page.rod(&link("thigh"), &link("shank"), 0.015).rod(&link("shank"), &link("foot"), 0.01);
    }
    write_page("set_down", &page)
}
