//! A hand of sixteen joints holds a ball by friction, in steps of half a millisecond: once it has settled, the ball
//! does not move by a bit. Where friction is less than the weight needs, it slides out.
//!
//! `cargo run --release --example held_ball [-- FOLDER]` writes the motion as a page into `FOLDER`, by default
//! `target/gauss`.

mod hand;
#[cfg(test)]
mod tests;

use std::error::Error;

use gauss_contact::Mode;
use gauss_examples::plots::write_page;
use gauss_playback::{Playback, Shape, Touch};
use gauss_runtime::prelude::*;

use hand::{Hand, HandKernel, STEP, hold};

/// s: how long it holds, and from when on the ball should not move.
const LENGTH: f64 = 8.0;
const SETTLED: f64 = 5.0;

fn main() -> Result<(), Box<dyn Error>> {
    let hand = Hand::around_a_ball(0.8);
    let kernel = hand.kernel()?;
    let mut settled = None;
    let (mut creep, mut residual, mut lowest, mut needed) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    let steps = (LENGTH / STEP).round() as usize;
    hold(&hand, &kernel, steps, |stepper| {
        let report = stepper.report().residual;
        residual = residual.max(report.signorini).max(report.coulomb).max(report.dissipation);
        lowest = lowest.min(kernel.gaps(0.0, stepper.configuration()).min());
        if stepper.time() > SETTLED {
            let place = stepper.configuration().0.translation.vector;
            creep = creep.max((place - *settled.get_or_insert(place)).norm());
            let rows = stepper.impulses();
            needed = rows[1].hypot(rows[2]) / rows[0];
        }
    })?;
    println!("Held for {LENGTH} s in {steps} steps. From {SETTLED} s on the ball moves by {creep} m.");
    println!("Residuals of the laws up to {residual:.0e} m/s, gaps down to {lowest:.0e} m.");
    println!("Each finger needs a coefficient of friction of {needed:.4}.");
    assert_eq!(creep, 0.0, "a held ball does not creep");
    // The weight comes at once at the start, and loads what bends under it by up to twice as much.
    for friction in [2.5 * needed, 0.9 * needed] {
        let hand = Hand::around_a_ball(friction);
        let mut height = 0.0;
        let ended = hold(&hand, &hand.kernel()?, (1.0 / STEP) as usize, |s| height = s.configuration().0.translation.z);
        // Where the ball has fallen out, fingers meet where it was: nothing is told of these.
        println!(
            "  with {friction:.4} it is {:.1} mm lower after 1 s{}",
            -1e3 * height,
            if ended.is_err() { ", or before" } else { "" }
        );
    }
    write_page("held_ball", &page(&hand, &kernel)?)
}

/// The hand, with the forces at the tips.
fn page(hand: &Hand, kernel: &HandKernel) -> Result<Playback<HandKernel>, Box<dyn Error>> {
    let (mut samples, mut tips) = (Vec::new(), Vec::new());
    hold(hand, kernel, (1.0 / STEP) as usize, |stepper| {
        let (t, q, z) = (stepper.time(), *stepper.configuration(), *stepper.speeds());
        samples.push(Sample { t, q, z, p: kernel.momentum(t, &q, &z) });
        tips.push((stepper.modes().to_vec(), *stepper.impulses()));
    })?;
    let times: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
    let picture = |s: &Sample<HandKernel>| times.partition_point(|t| *t < s.t).min(times.len() - 1);
    let palm = Shape::cylinder(0.085, 0.012).at(&Isometry3::translation(0.0, 0.0, hand.up + 0.012)).colour("#8d8a83");
    let mut page = Playback::of_samples("A hand holds a ball", samples)
        .si()
        .frames(kernel)
        .shape("ball", Shape::ball(hand.r).colour("#e69f00"))
        .body("palm", |_| Isometry3::identity(), [palm]);
    for finger in 1..=4 {
        for (link, length) in [("near", hand.l1), ("mid", hand.l2), ("far", hand.l3)] {
            page = page.shape(&format!("{link}{finger}"), Shape::rod([0.0; 3], [0.0, 0.0, -length], 0.006));
        }
        let tip = Shape::ball(hand.w).at(&Isometry3::translation(0.0, 0.0, -hand.l3));
        page = page.shape(&format!("far{finger}"), tip);
    }
    for (i, contact) in HandKernel::CONTACTS.iter().enumerate() {
        page = page.contact(contact.name, 0.02, |s| {
            let (modes, impulses) = &tips[picture(s)];
            let touch = match modes[i] {
                Mode::Open => Touch::Open,
                Mode::Closed => Touch::Closed,
                Mode::Sticks => Touch::Sticks,
                Mode::Slides(_) => Touch::Slides,
            };
            let rows: Vec<f64> = contact.rows().map(|row| impulses[row] / STEP).collect();
            let frame = kernel.contact_frame(i, s.t, &s.q);
            frame.map_or((touch, Vector3::zeros(), Vector3::zeros()), |frame| (touch, frame.point, frame.force(&rows)))
        });
    }
    Ok(page.curve("height of the ball / mm", "ball", |s| 1e3 * s.q.0.translation.z))
}
