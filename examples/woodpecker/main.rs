//! A woodpecker toy pecks its way down a pole: a sleeve with play jams, slips and flies, its bird swings on a spring.
//! R. I. Leine, Ch. Glocker & D. H. van Campen, *Nonlinear dynamics of the woodpecker toy*, DETC2001/VIB-21608 (2001).
//!
//! `cargo run --release --example woodpecker [-- FOLDER]` draws the picture and the page that plays into `FOLDER`, by
//! default `target/gauss`.

mod picture;
mod toy;

use gauss_contact::{ContactRun, ContactTrajectory, EventKind};
use gauss_examples::plots::{write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::contact::ContactFrame;
use gauss_runtime::prelude::*;

use toy::{TOY, WoodpeckerKernel};

/// Length of the run, s.
const END: f64 = 1.5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = TOY.kernel()?;
    // The sleeve leans on its lower edge, the bird is pulled back.
    let start = SVector::from([0.0, -(TOY.rm - TOY.r) / TOY.hm, -0.5295]);
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10).run(start, SVector::zeros(), 0.0..END)?;
    println!("A woodpecker toy, {} events in {END} s; those of a period:", run.events().len());
    let pecks: Vec<f64> = run.events().iter().filter(|event| event.contact == 0).map(|event| event.time).collect();
    for event in run.events().iter().filter(|event| event.time >= pecks[0] && event.time <= pecks[1]) {
        let what = if let EventKind::Impact(hit) = event.kind {
            format!("strikes, {:.2} µJ lost", 1e6 * hit.energy_lost)
        } else {
            format!("{:?}", event.kind)
        };
        println!("  {:.6} s  {:<5} {what}", event.time, event.name);
    }
    println!("  period {:.6} s (published: 0.1452 s for parameters of two digits)", pecks[1] - pecks[0]);
    println!("  {}", run.energy_balance()?);
    write("woodpecker", &picture::draw(&run)?)?;
    write_page("woodpecker", &page(&kernel, &run)?)
}

/// The page shows centimetres.
const CENTIMETRES: f64 = 100.0;

fn page(
    kernel: &WoodpeckerKernel,
    run: &ContactTrajectory<'_, WoodpeckerKernel>,
) -> Result<Playback<WoodpeckerKernel>, Box<dyn std::error::Error>> {
    let long = |x: f64| CENTIMETRES * x;
    let sleeve = |s: &Sample<WoodpeckerKernel>| turned([0.0, long(s.q[0])], s.q[1]);
    let bird = |s: &Sample<WoodpeckerKernel>| {
        let height = s.q[0] + TOY.lm * s.q[1] + TOY.lg * s.q[2];
        turned([long(TOY.lm + TOY.lg), long(height)], s.q[2])
    };
    let still = |_: &Sample<WoodpeckerKernel>| Isometry3::identity();
    let pole = Shape::cylinder(long(TOY.r), 16.0).at(&Isometry3::translation(0.0, 0.0, -3.0)).colour("#b08d57");
    let wall = |x: f64| Shape::cuboid([0.1, 0.9, long(2.0 * TOY.hm)]).at(&Isometry3::translation(x, 0.0, 0.0));
    let beak = Shape::rod([-0.8, 0.0, 1.4], [-long(TOY.ls), 0.0, long(TOY.hs)], 0.12).colour("#d55e00");
    let head = Shape::ball(0.5).at(&Isometry3::translation(-0.8, 0.0, 1.4));
    let page = Playback::new("A woodpecker toy", run)?
        .body("pole", still, [pole])
        .body("sleeve", sleeve, [1.0, -1.0].map(|side| wall(side * (long(TOY.rm) + 0.05)).colour("#666666")))
        .body("bird", bird, [Shape::ellipsoid([0.7, 0.6, 1.5]).colour("#0072b2"), head.colour("#0072b2"), beak])
        .from_the_side();
    // Gaps are linear in the angles: where beak and edges are on the pole the scene does not say.
    let touches = |contact: usize, s: &Sample<WoodpeckerKernel>| {
        let height = match contact {
            0 => s.q[0] + TOY.lm * s.q[1] + (TOY.lg - TOY.ls) * s.q[2] + TOY.hs,
            1 => s.q[0] + TOY.rm * s.q[1] - TOY.hm,
            _ => s.q[0] + TOY.rm * s.q[1] + TOY.hm,
        };
        Some(ContactFrame::new(Vector3::new(long(TOY.r), 0.0, long(height)), Vector3::x(), &[Vector3::z()]))
    };
    let page = page.follow("bird").contacts_at(kernel, 8.0, run, touches);
    Ok(page.curve("angle / rad", "sleeve", |s| s.q[1]).curve("angle / rad", "bird", |s| s.q[2]).energy(kernel))
}

/// A place in the plane of the toy, turned so that what is on the right goes up.
fn turned([x, z]: [f64; 2], angle: f64) -> Isometry3<f64> {
    Isometry3::new(Vector3::new(x, 0.0, z), Vector3::new(0.0, -angle, 0.0))
}
