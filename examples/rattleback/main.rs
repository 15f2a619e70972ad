//! A rattleback: spun one way it goes on, spun the other way it rattles, stops and turns back. First as a stone that
//! rolls, by constraints; then on a table with Coulomb's friction, which holds it or does not.
//!
//! `cargo run --release --example rattleback [-- FOLDER]` draws the picture and the page that plays into `FOLDER`, by
//! default `target/gauss`.

use gauss_contact::{EventKind, Mode};
use gauss_examples::plots::{write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::monitor::monitor;
use gauss_runtime::prelude::*;

mod picture;
mod stone;
mod table;
#[cfg(test)]
mod tests;

use stone::{AXES, PRODUCT, Rattleback, RattlebackKernel, stone};
use table::{OnTable, OnTableKernel, Run, obliquity, spun};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rattleback = Rattleback { stone: stone(PRODUCT), a: AXES.into(), g: 9.81 }.kernel()?;

    // A hand does not set it down perfectly flat.
    let tilted = UnitQuaternion::from_euler_angles(0.009, 0.009, 0.0);
    let start = (tilted, SVector::from([0.0, 0.0]));
    let run =
        |spin| Simulation::new(&rattleback).adaptive(1e-10, 1e-12).run(start, Vector3::new(0.0, 0.0, spin), 0.0..5.0);
    let (against, along) = (run(5.0)?, run(-5.0)?);

    println!("   t/s  spun against, rad/s (long axis)  spun along, rad/s");
    for n in 0..=10 {
        let t = 0.5 * f64::from(n);
        let [first, second] = [&against, &along].map(|path| path.at(t).expect("inside the run"));
        // How far the long axis is from level.
        let rattling = (first.q.0 * Vector3::x()).z.asin().to_degrees();
        println!("{t:6.2} {:14.3} ({rattling:+5.1}°) {:25.3}", vertical(&first), vertical(&second));
    }
    println!("{}", monitor(&rattleback, &against));

    println!("On a table with friction, spun against its way:");
    let kernel = |mu| OnTable { stone: stone(PRODUCT), a: AXES.into(), mu, g: 9.81 }.kernel();
    let (rough, worn, smooth) = (kernel(1.0)?, kernel(0.4)?, kernel(0.1)?);
    let held = spun(&rough, tilted, 5.0, 1e-11)?;
    let needed = held.iter().map(|s| obliquity(&held, s.t)).collect::<Result<Vec<_>, _>>()?;
    let apart = against.iter().map(|s| Ok(held.at(s.t)?.q.rotation.angle_to(&s.q.0)));
    let apart = apart.collect::<Result<Vec<_>, gauss_contact::ContactError>>()?;
    let largest = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
    println!("  μ = 1    sticks, with friction of up to {:.3} of the normal force;", largest(&needed));
    println!("           within {:.0e} rad of the stone that rolls by constraints", largest(&apart));
    let (slips, slides) = (spun(&worn, tilted, 5.0, 1e-7)?, spun(&smooth, tilted, 5.0, 1e-7)?);
    tell(&worn, 0.4, &slips)?;
    tell(&smooth, 0.1, &slides)?;

    write("rattleback", &picture::draw(&against, [&held, &slips, &slides])?)?;
    write_page("rattleback", &page(&worn, &slips)?)
}

fn vertical(sample: &Sample<RattlebackKernel>) -> f64 {
    (sample.q.0 * sample.z).z
}

fn tell(kernel: &OnTableKernel, mu: f64, run: &Run<'_>) -> Result<(), Box<dyn std::error::Error>> {
    let begins = run.events().iter().filter(|event| matches!(event.kind, EventKind::Slides(_))).count();
    let slides = |segment: &&gauss_contact::Segment<'_, OnTableKernel>| matches!(segment.modes()[0], Mode::Slides(_));
    let time = run.segments().iter().filter(slides).map(|s| s.trajectory().last().t - s.trajectory().first().t);
    let end = run.last().ok_or("no end")?;
    let energy = |s: &Sample<OnTableKernel>| kernel.energy(s.t, &s.q, &s.z);
    println!(
        "  μ = {mu}  slides {begins} times, {:.2} s in all; at {} s its spin is {:+.3} rad/s, and {:.1} mJ are lost",
        time.sum::<f64>(),
        end.t,
        table::vertical(&end),
        1e3 * (energy(&run.at(0.0)?) - energy(&end))
    );
    Ok(())
}

fn page(kernel: &OnTableKernel, run: &Run<'_>) -> Result<Playback<OnTableKernel>, Box<dyn std::error::Error>> {
    Ok(Playback::new("A rattleback on a table, spun against its way, μ = 0.4", run)?
        .si()
        .body("stone", |s| s.q, [Shape::ellipsoid(AXES)])
        .trace("stone", [AXES[0], 0.0, 0.0])
        .follow("stone")
        .contacts(kernel, 0.03, run)
        .curve("spin about the vertical / (rad/s)", "ω̂₃", table::vertical)
        .energy(kernel))
}
