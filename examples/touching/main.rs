//! What touches, exactly: bounces that pile up to rest, stick and slip on a belt, a ball that slides until it rolls.
//!
//! `cargo run --release --example touching [-- FOLDER]` draws the picture, and the three motions as pages that play,
//! into `FOLDER`, by default `target/gauss`.

mod pages;
mod picture;
mod scenes;

use gauss_contact::{ContactRun, ContactTrajectory, EventKind};
use gauss_examples::plots::{write, write_page};
use gauss_runtime::prelude::*;

use scenes::{Ball, BallKernel, Belt, BeltKernel, Billiard, BilliardKernel, BilliardState};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ball = Ball { e: 0.9, g: 9.81 }.kernel()?;
    println!("{}\n", BallKernel::EQUATIONS);
    let bounces = ContactRun::new(&ball).adaptive(1e-10, 1e-10).run([1.0].into(), [0.0].into(), 0.0..10.0)?;
    let (impacts, rest) = (impacts(&bounces), bounces.events().last());
    if let Some(EventKind::Rests { height, remaining, .. }) = rest.map(|event| event.kind) {
        let at = rest.map_or(0.0, |event| event.time) + remaining;
        println!("A ball that keeps 0.9 of its speed: {impacts} impacts, then rest at {at:.12} s;");
        println!("  flights lower than {height:.0e} m are left out. √(2h/g)(1 + e)/(1 − e) = 8.578949178729 s.");
    }
    println!("  at 9 s its speed is {}, its gap {}.\n", bounces.at(9.0)?.z[0], bounces.at(9.0)?.q[0]);

    let belt = Belt { m: 1.0, k: 10.0, speed: 0.3, held: 0.5, sliding: 0.3, within: 0.05, g: 9.81 }.kernel()?;
    println!("{}\n", BeltKernel::EQUATIONS);
    let start = (SVector::from([0.0, 0.0]), SVector::from([0.3, 0.0]));
    let block = ContactRun::new(&belt).adaptive(1e-10, 1e-10).run(start.0, start.1, 0.0..12.0)?;
    println!("A block on a belt, held by a spring:");
    for event in block.events().iter().take(6) {
        println!("  {:9.6} s  {:?}", event.time, event.kind);
    }
    let stuck = block.iter().filter(|s| matches!(block.modes(s.t), Ok([gauss_contact::Mode::Sticks])));
    println!("  while it sticks it goes with the belt to {:e} m/s\n", stuck.map(off_the_belt).fold(0.0, f64::max));

    let table = Billiard { m: 0.17, r: 0.028, mu: 0.2, g: 9.81 }.kernel()?;
    let on_table = Isometry3::translation(0.0, 0.0, 0.028);
    let spun = BilliardState {
        pose: on_table,
        pose_u: Vector3::new(2.0, 0.0, 0.0),
        pose_omega: Vector3::new(-60.0, -40.0, 0.0),
    };
    let shot = ContactRun::new(&table).adaptive(1e-10, 1e-10).run(on_table, spun.z(), 0.0..1.5)?;
    let rolls = shot.events().iter().find(|event| event.kind == EventKind::Sticks).ok_or("it slides on")?;
    // The slip of the lowest point, v + ω × (−r k₃), falls under friction at 7/2 μg whatever its direction is.
    let slip = f64::hypot(2.0 + 40.0 * 0.028, -60.0 * 0.028);
    println!("A billiard ball with side spin: a parabola until {:.9} s, then straight on;", rolls.time);
    println!("  2|s|/(7μg) = {:.9} s. The motion with what its contact does takes", 2.0 * slip / (7.0 * 0.2 * 9.81));
    println!("  {}", BilliardKernel::OPERATIONS.impulse_dynamics);

    write("touching", &picture::draw(&bounces, &block, &shot)?)?;
    write_page("bouncing_ball", &pages::ball(&ball, &bounces)?)?;
    write_page("block_on_a_belt", &pages::block(&belt, &block)?)?;
    write_page("billiard_ball", &pages::billiard(&table, &shot)?)
}

fn impacts<K: ContactSystem<Scalar = f64>>(run: &ContactTrajectory<'_, K>) -> usize {
    run.events().iter().filter(|event| matches!(event.kind, EventKind::Impact(_))).count()
}

/// The slip of a block on the belt.
fn off_the_belt(s: Sample<BeltKernel>) -> f64 {
    (s.z[0] - 0.3).abs()
}
