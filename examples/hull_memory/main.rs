//! A hull whose waves remember how it moved, driven by a propeller that is late:
//! `cargo run --release --example hull_memory`.
//!
//! The memory is a convolution over the whole past, and in the equations a handful of states. Both are compared: the
//! forces by states at every second of a run with the integrals over the run before, and a heaving hull with Cummins'
//! equation marched over its history.

use std::error::Error;

use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape};
use gauss_runtime::integrate::Trajectory;
use gauss_runtime::prelude::*;

mod hull;
#[cfg(test)]
mod tests;

use hull::{Hull, HullKernel, HullState};

/// Lifted by the bow, and on its way as soon as the propeller follows.
fn run(kernel: &HullKernel) -> Result<Trajectory<'_, HullKernel>, IntegrationError> {
    let pose = Isometry3::new(Vector3::new(0.0, 0.0, 0.25), Vector3::new(0.0, -0.3, 0.0));
    let start = HullState { pose, ..Default::default() };
    let command = |t: f64, _: &_, _: &_| SVector::from([if t < 6.0 { 60.0 } else { -20.0 }]);
    Simulation::new(kernel).input(command).adaptive(1e-10, 1e-10).run(start.q(), start.z(), 0.0..12.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    let hull = Hull::boat();
    let kernel = hull.kernel()?;
    let run = run(&kernel)?;
    println!(
        "  t/s   heave/m   thrust/N   waves on heave/N: states     integral   on pitch/(N m): states     integral"
    );
    for second in 1..=12 {
        let t = f64::from(second);
        let sample = run.at(t)?;
        let state = HullState::of(&sample.q, &sample.z);
        let (states, integral) = (hull.by_states(&sample), hull.by_convolution(&run, t, 2000)?);
        println!(
            "{t:5.0} {:9.4} {:10.2} {:26.6} {:12.6} {:26.6} {:12.6}",
            state.pose.translation.z, state.thrust, states[0], integral[0], states[1], integral[1]
        );
        // The rule of quadrature over the interpolated run, of forces up to a few hundred.
        if (0..2).any(|k| (states[k] - integral[k]).abs() > 1e-5) {
            return Err("states and integrals disagree".into());
        }
    }

    let alone = Hull { k35: 0.0, ..hull };
    let kernel = alone.kernel()?;
    let start = HullState { pose: Isometry3::translation(0.0, 0.0, 0.1), ..Default::default() };
    let heaved = Simulation::new(&kernel).adaptive(1e-11, 1e-11);
    let heaved = heaved.input(|_, _: &_, _: &_| SVector::from([0.0])).run_to_end(start.q(), start.z(), 0.0..4.0)?;
    let heaved = HullState::of(&heaved.q, &heaved.z).pose.translation.z;
    println!("\nheave after 4 s: {heaved:.9} m by states; over its history, in steps of");
    for steps in [500, 1000, 2000] {
        let marched = alone.heave_by_history(0.1, 4.0 / steps as f64, steps)[steps];
        println!("{:8.0e} s: {marched:.9} m", 4.0 / steps as f64);
    }
    write_page("hull_memory", &page(&hull, &run)?)
}

/// The hull, and what its waves do to it.
fn page(hull: &Hull, run: &Trajectory<'_, HullKernel>) -> Result<Playback<HullKernel>, IntegrationError> {
    let page = Playback::new("A hull that feels the waves it made", run)?
        .body("hull", |s| s.q.0, [Shape::cuboid([3.0, 1.0, 0.5])])
        .trace("hull", [1.5, 0.0, 0.0])
        .curve("heave / m", "O", |s| s.q.0.translation.z)
        .curve("force / N", "waves on heave", |s| hull.by_states(s)[0])
        .curve("force / N", "thrust", |s| HullState::of(&s.q, &s.z).thrust);
    Ok(page)
}
