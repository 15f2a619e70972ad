//! The REMUS 100 from its published table of coefficients: a straight run, a turning circle, a change of depth.
//!
//! `cargo run --release --example remus100 [-- FOLDER]` draws them into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_examples::plots;
use gauss_runtime::prelude::*;

mod fossen;
mod manoeuvres;
mod picture;
#[cfg(test)]
mod tests;
mod vehicle;

use fossen::Fossen;
use manoeuvres::{EVERY, Flight, Manoeuvre, distance, fly};
use vehicle::{Remus, RemusByAngles, RemusByAnglesKernel, RemusKernel, Table};

/// Steps of the equations by hand between two moments: 2.5 ms.
const STEPS: u32 = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let table = Table::published()?;
    let published = Remus::from_table(&table)?;
    // Neutrally buoyant.
    let neutral = Remus { displaced: published.mass, ..published }.kernel()?;
    let kernel = published.kernel()?;
    let by_angles = RemusByAngles::from_table(&table)?.kernel()?;

    println!("THE REMUS 100 FROM ITS TABLE OF COEFFICIENTS\n");
    println!(
        "Weight, buoyancy, added mass, drag, lift, fins and propeller (Prestero 2001); what acts, as derived in body axes:\n"
    );
    let forces = RemusKernel::EQUATIONS.text.split("\n\n").find(|part| part.starts_with("active forces"));
    println!("{}\n", forces.unwrap_or_default());
    println!("One evaluation: {} in body velocities,", RemusKernel::OPERATIONS.acceleration);
    println!("                {} in Euler angles.\n", RemusByAnglesKernel::OPERATIONS.acceleration);

    let manoeuvres = [Manoeuvre::straight(&table)?, Manoeuvre::turn(&table)?, Manoeuvre::dive(&table)?];
    let flights = [fly(&neutral, &manoeuvres[0])?, fly(&kernel, &manoeuvres[1])?, fly(&kernel, &manoeuvres[2])?];
    let [straight, turn, dive] = &flights;

    let closed = results(&table, published.mass, &manoeuvres, &flights)?;
    let apart = beside_fossen(&table, &manoeuvres, &flights)?;
    let other = fly(&by_angles, &manoeuvres[1])?;
    let poses = |flight: &Flight| flight.moments.iter().map(|m| m.pose).collect::<Vec<_>>();
    println!(
        "  the turn in Euler angles: {:.1e} m from that in body velocities",
        distance(&poses(&other), &poses(turn))
    );
    let svg = picture::draw(&picture::Shown { flights: [straight, turn, dive], apart, closed })?;
    plots::write("remus100", &svg)?;
    plots::write_page("remus100", &picture::page(&kernel, turn))
}

type Curve = Vec<(f64, f64)>;

/// What the manoeuvres come to; the speed of the straight run in closed form.
fn results(
    table: &Table,
    mass: f64,
    manoeuvres: &[Manoeuvre; 3],
    flights: &[Flight; 3],
) -> Result<Curve, Box<dyn Error>> {
    let [straight, turn, dive] = flights;
    println!("Power of each element at the end, W:\n");
    print!("{:16}", "");
    RemusKernel::ELEMENTS.iter().for_each(|element| print!("{:>11}", element.name));
    println!("{:>11}", "sum");
    for (manoeuvre, flight) in manoeuvres.iter().zip(flights) {
        let powers = &end(flight).powers;
        print!("{:16}", manoeuvre.name);
        powers.iter().for_each(|power| print!("{power:11.3}"));
        println!("{:11.3}", powers.iter().sum::<f64>());
    }

    let (thrust, drag) = (table.number("propeller/Xprop")?, -table.number("drag/Xuu")?);
    let terminal = (thrust / drag).sqrt();
    let surge = mass - table.number("added_mass_derivatives/Xudot")?;
    let closed = |t: f64| terminal * (t * (thrust * drag).sqrt() / surge).tanh();
    let off = straight.moments.iter().map(|m| (m.twist[0] - closed(m.t)).abs()).fold(0.0, f64::max);
    println!("\nstraight run    {:.6} m/s after a minute, √(X/|Xuu|) = {terminal:.6} m/s;", end(straight).twist[0]);
    println!(
        "                never further than {off:.1e} m/s from the closed form √(X/|Xuu|) tanh(t √(X|Xuu|)/(m − Xu̇))"
    );
    let last = end(turn);
    let speed = last.twist.fixed_rows::<3>(0).norm();
    let rate = (last.pose.rotation * Vector3::new(last.twist[3], last.twist[4], last.twist[5])).z;
    println!("turning circle  {:.2} m across, {:.1}°/s at {speed:.2} m/s", 2.0 * speed / rate, rate.to_degrees());
    let deepest = dive.moments.iter().map(|m| m.pose.translation.z).fold(0.0, f64::max);
    println!("depth change    at {:.3} m in the end, {deepest:.3} m at most", end(dive).pose.translation.z);

    Ok((0..=240).map(|n| EVERY * f64::from(n)).map(|t| (t, closed(t))).collect())
}

/// Distances from Fossen's equations, over time.
fn beside_fossen(
    table: &Table,
    manoeuvres: &[Manoeuvre; 3],
    flights: &[Flight; 3],
) -> Result<[Curve; 3], Box<dyn Error>> {
    println!("\nAgainst Fossen's equations, written by hand and integrated by their own Runge–Kutta method:");
    let (weight, buoyancy) = (table.number("weight_N")?, table.number("buoyancy_N")?);
    let mut apart = Vec::new();
    for ((manoeuvre, flight), buoyancy) in manoeuvres.iter().zip(flights).zip([weight, buoyancy, buoyancy]) {
        let by_hand = Fossen::new(table, buoyancy)?;
        let [poses, coarser] = [STEPS, STEPS / 2].map(|steps| by_hand.fly(manoeuvre, steps));
        println!(
            "  {:15} {:.1e} m apart; half as many steps move them by {:.1e} m; energy {:+.4} J = work {:+.4} J within {:.0e} J",
            manoeuvre.name,
            distance(flight.moments.iter().map(|m| &m.pose), &poses),
            distance(&coarser, &poses),
            flight.balance[0],
            flight.balance[1],
            (flight.balance[0] - flight.balance[1]).abs()
        );
        let metres = |(m, pose): (&manoeuvres::Moment, &Isometry3<f64>)| (m.t, distance([&m.pose], [pose]));
        apart.push(flight.moments.iter().zip(&poses).map(metres).collect::<Vec<_>>());
    }
    apart.try_into().map_err(|_| "three manoeuvres are drawn".into())
}

fn end(flight: &Flight) -> &manoeuvres::Moment {
    &flight.moments[flight.moments.len() - 1]
}
