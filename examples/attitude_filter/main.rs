//! An extended Kalman filter for a satellite that a star tracker sees every ten seconds and that has no gyroscope: from
//! one look to the next its rates follow from Euler's equations alone. With the exact derivatives of its steps the
//! filter knows how wrong it is; with 1 + hF in their place it does not.
//!
//! `cargo run --release --example attitude_filter [-- FOLDER]` draws the picture into `FOLDER`, by default
//! `target/gauss`; `RUNS=20` before it: fewer motions.

mod filter;
mod model;
mod picture;
mod study;
#[cfg(test)]
mod tests;

use std::error::Error;

use gauss_charts::statistics::Random;
use gauss_examples::plots;

use filter::Transition;
use model::{ARCSECOND, DISTURBANCE, FIRST, LOOKS, STEP, STEPS, TRACKER, happens, nominal, spacecraft};
use study::{Followed, interval};

/// How many motions the filters are tried on.
const MOTIONS: usize = 200;

/// What a transition matrix is called.
fn name(transition: Transition) -> &'static str {
    match transition {
        Transition::Exact => "derivatives of the step",
        Transition::FirstOrder => "1 + hF, every second",
        Transition::FirstOrderPerLook => "1 + TF, every ten seconds",
    }
}

/// What is simulated, in words.
fn introduce(count: usize) {
    println!("A satellite that turns by {:.1} °/s; its wheels push, and so does a torque that nobody knows,", {
        nominal().1.norm().to_degrees()
    });
    println!(
        "white noise of {DISTURBANCE:.0e} N m √s. A star tracker sees its attitude every {} s, to {:.0}″, {:.0}″ and {:.0}″",
        STEP * STEPS as f64,
        TRACKER[0] / ARCSECOND,
        TRACKER[1] / ARCSECOND,
        TRACKER[2] / ARCSECOND
    );
    println!(
        "about e₁, e₂, e₃. At first it is known to {:.0}° and {:.1} °/s. {count} motions of {:.0} s.\n",
        FIRST.0.to_degrees(),
        FIRST.1.to_degrees(),
        STEP * (STEPS * LOOKS) as f64
    );
}

fn main() -> Result<(), Box<dyn Error>> {
    let kernel = spacecraft().kernel()?;
    let count = gauss_examples::runs(MOTIONS);
    introduce(count);
    let mut random = Random(1);
    let motions = (0..count).map(|_| happens(&kernel, &mut random)).collect::<Result<Vec<_>, _>>()?;
    let followed = [Transition::Exact, Transition::FirstOrder, Transition::FirstOrderPerLook]
        .into_iter()
        .map(|transition| Followed::new(&kernel, &motions, transition))
        .collect::<Result<Vec<_>, _>>()?;

    println!(
        "With the derivatives of the step; root mean squares over all motions, and what the filter takes them for:"
    );
    println!("   t/s   attitude/″          rate/(″/s)        normalised error squared, 6 expected");
    let looks = followed[0].after_looks();
    for look in [0, 1, 2, 3, 9, 29, 59].map(|n| looks[n]) {
        println!(
            "{:6.0} {:8.1} ({:6.1}) {:9.2} ({:7.2}) {:9.2}",
            look.t,
            look.attitude.0 / ARCSECOND,
            look.attitude.1 / ARCSECOND,
            look.rate.0 / ARCSECOND,
            look.rate.1 / ARCSECOND,
            look.normalised
        );
    }

    let (low, high) = interval(count);
    println!(
        "\nNormalised error squared by transition matrix. If a filter knows how wrong it is, the mean over {count} motions"
    );
    println!("is 6, and between {low:.2} and {high:.2} after 95 % of the looks:");
    println!("transition matrix            20 s     30 s     40 s    settled           within   rate at 20 s/(″/s)");
    let mut within = vec![];
    for all in &followed {
        let (looks, (mean, error)) = (all.after_looks(), all.settled());
        let inside = looks.iter().filter(|look| (low..high).contains(&look.normalised)).count();
        println!(
            "{:26} {:6.2}   {:6.2}   {:6.2}    {mean:.2} ± {error:.2}    {inside:2} of {LOOKS}   {:8.2} ({:.2})",
            name(all.transition),
            looks[1].normalised,
            looks[2].normalised,
            looks[3].normalised,
            looks[1].rate.0 / ARCSECOND,
            looks[1].rate.1 / ARCSECOND
        );
        within.push(inside);
    }
    println!();
    plots::write("attitude_filter", &picture::draw(&followed)?)?;
    plots::write_page("attitude_filter", &picture::page(&kernel, &motions[0], &followed[0].runs[0]))?;

    let (mean, error) = followed[0].settled();
    // Of 60 looks 57 are expected inside, ±1.7 if they were independent; neighbours are not quite.
    if within[0] < 51 || (mean - study::DIMENSION).abs() > 3.5 * error {
        return Err("the filter does not know how wrong it is".into());
    }
    Ok(())
}
