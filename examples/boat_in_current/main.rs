//! A boat in a stream: adrift, in a tide, and crossing a river.
//!
//! `cargo run --release --example boat_in_current [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_examples::plots;
use gauss_runtime::prelude::*;

mod boat;
mod picture;
#[cfg(test)]
mod tests;

use boat::{Boat, BoatKernel, in_still_water, winding};
use picture::Crossing;

type Speeds = SVector<f64, 3>;

/// m/s: the stream of the river, to the east, and the boat's speed through the water.
const STREAM: f64 = 0.15;
const SPEED: f64 = 0.4;
/// From bank to bank, m.
const WIDTH: f64 = 30.0;

fn main() -> Result<(), Box<dyn Error>> {
    let still = Boat::cyber_ship();
    let river = Boat { stream: Vector3::new(0.0, STREAM, 0.0), ..still };
    println!("A BOAT IN A STREAM\n\nCyberShip II, 1.255 m and 23.8 kg, published added mass and drag.");
    let names: Vec<_> = BoatKernel::ELEMENTS.iter().map(|element| element.name).collect();
    println!("What acts: {}. One evaluation: {}.", names.join(", "), BoatKernel::OPERATIONS.acceleration);
    for warning in &still.warnings() {
        println!("Of the published coefficients: {warning}");
    }

    // Adrift.
    let kernel = river.kernel()?;
    let turned = Isometry2::rotation(0.7);
    let with_it = turned.rotation.inverse() * river.stream.xy();
    let afloat = Speeds::from([with_it.x, with_it.y, 0.0]);
    let off = run(&kernel, turned, afloat, 60.0, |_, _, _| [0.0; 2])?
        .iter()
        .map(|s| (s.q.translation.vector - river.drift(s.t).xy()).norm())
        .fold(0.0, f64::max);
    println!("\nadrift          released with the stream: {off:.1e} m from where the water goes in a minute");
    let from_rest = run(&kernel, Isometry2::identity(), Speeds::zeros(), 120.0, |_, _, _| [0.0; 2])?;

    let (tidal, afloat, sunken) = in_a_tide(&river, turned)?;
    beside_still_water([("steady stream", river), ("tide", tidal)])?;
    let crossings = ferry(&kernel, still.thrust(SPEED))?;
    let names = ["straight across", "crabbing", "for the landing"];
    let [straight, crabbed, pursuit] = &crossings;
    let svg = picture::draw(
        [Crossing::new(names[0], straight), Crossing::new(names[1], crabbed), Crossing::new(names[2], pursuit)],
        STREAM / SPEED,
        WIDTH,
        [&from_rest, &afloat, &sunken],
        (STREAM, &tidal),
    )?;
    plots::write("boat_in_current", &svg)?;
    let [.., pursuit] = crossings;
    plots::write_page("boat_in_current", &picture::page(&kernel, pursuit, river.stream))
}

type Path = Vec<Sample<BoatKernel>>;

/// The tide, and the ways of a boat as heavy as its water and of one twice as heavy.
fn in_a_tide(river: &Boat, turned: Isometry2<f64>) -> Result<(Boat, Path, Path), Box<dyn Error>> {
    // A tide carries what floats; what is heavier than the water it displaces lags behind.
    let tidal = Boat { tide: Vector3::new(0.1, 0.15, 0.0), frequency: 0.1, ..*river };
    let afloat = run(&tidal.kernel()?, turned, with_it_at(&tidal, turned), 120.0, |_, _, _| [0.0; 2])?;
    let off = afloat.iter().map(|s| (s.q.translation.vector - tidal.drift(s.t).xy()).norm()).fold(0.0, f64::max);
    println!("tide            afloat it stays with the water as well: {off:.1e} m, as ρV ċ at G is what m ċ takes");
    let heavy = Boat { mass: 2.0 * river.mass, inertia: 2.0 * river.inertia, ..tidal };
    let sunken = run(&heavy.kernel()?, turned, with_it_at(&heavy, turned), 120.0, |_, _, _| [0.0; 2])?;
    let lag = sunken.iter().map(|s| (s.q.translation.vector - heavy.drift(s.t).xy()).norm()).fold(0.0, f64::max);
    println!("                twice as heavy as its water, it is up to {lag:.2} m off");

    Ok((tidal, afloat, sunken))
}

/// Galilei, against equations in still water written by hand.
fn beside_still_water(boats: [(&str, Boat); 2]) -> Result<(), Box<dyn Error>> {
    let by_hand = in_still_water(0.3, winding, 120, 100);
    for (name, boat) in boats {
        let start = Isometry2::rotation(0.3);
        let path =
            run(&boat.kernel()?, start, with_it_at(&boat, start), 120.0, |t, q, _| winding(t, q.rotation.angle()))?;
        let apart = |(s, hand): (&Sample<BoatKernel>, &[f64; 6])| {
            let place = s.q.translation.vector - boat.drift(s.t).xy();
            (place.x - hand[0]).hypot(place.y - hand[1])
        };
        let apart = path.iter().zip(&by_hand).map(apart).fold(0.0, f64::max);
        println!(
            "Galilei         {name}: {apart:.1e} m from still water, by hand, plus ∫c dt; a winding course of two minutes"
        );
    }

    Ok(())
}

/// Across the river: straight, crabbing, steering for the landing.
fn ferry(kernel: &BoatKernel, thrust: f64) -> Result<[Path; 3], Box<dyn Error>> {
    let crab = -(STREAM / SPEED).asin();
    let steer = |wanted: f64, q: &Isometry2<f64>, z: &Speeds| {
        let off = (UnitComplex::new(wanted).inverse() * q.rotation).angle();
        [thrust, -4.0 * off - 4.0 * z[2]]
    };
    let landing = |q: &Isometry2<f64>| (-q.translation.vector.y).atan2(WIDTH - q.translation.vector.x);
    let across = crossing(kernel, 0.0, |_, q, z| steer(0.0, q, z))?;
    let crabbed = crossing(kernel, crab, |_, q, z| steer(crab, q, z))?;
    let pursuit = crossing(kernel, 0.0, |_, q, z| steer(landing(q), q, z))?;
    println!("\nferry           {WIDTH} m at {SPEED} m/s through water that runs at {STREAM} m/s:");
    for (name, path, time) in [
        ("straight across", &across, WIDTH / SPEED),
        ("crabbing", &crabbed, WIDTH / (SPEED * crab.cos())),
        ("steering for the landing", &pursuit, WIDTH * SPEED / (SPEED * SPEED - STREAM * STREAM)),
    ] {
        // Between the last two seconds the way is straight enough.
        let [before, after] = [&path[path.len() - 2], &path[path.len() - 1]];
        let [from, to] = [before, after].map(|sample| sample.q.translation.vector);
        let part = (WIDTH - from.x) / (to.x - from.x);
        let (t, east) = (before.t + part * (after.t - before.t), from.y + part * (to.y - from.y));
        println!("  {name:24} {t:6.2} s, without inertia {time:6.2} s; lands {east:+7.3} m to the east");
    }
    println!("  where it turns it slips sideways, which the heading does not make up for");
    Ok([across, crabbed, pursuit])
}

/// Speeds of a boat that moves with the water at t = 0.
fn with_it_at(boat: &Boat, q: Isometry2<f64>) -> Speeds {
    let c = q.rotation.inverse() * boat.stream.xy();
    Speeds::from([c.x, c.y, 0.0])
}

/// The states at every whole second.
fn run(
    kernel: &BoatKernel,
    q: Isometry2<f64>,
    z: Speeds,
    seconds: f64,
    input: impl Fn(f64, &Isometry2<f64>, &Speeds) -> [f64; 2],
) -> Result<Vec<Sample<BoatKernel>>, IntegrationError> {
    let mut samples = vec![Sample { t: 0.0, q, z, p: kernel.momentum(0.0, &q, &z) }];
    for n in 0..seconds as u32 {
        let last = samples[samples.len() - 1];
        let interval = f64::from(n)..f64::from(n + 1);
        let way = Simulation::new(kernel).input(|t, q, z| SVector::from(input(t, q, z))).adaptive(1e-11, 1e-12);
        samples.push(way.run_to_end(last.q, last.z, interval)?.sample);
    }
    Ok(samples)
}

/// From one bank, at full speed through the water on a heading, until the first whole second on the other bank.
fn crossing(
    kernel: &BoatKernel,
    heading: f64,
    input: impl Fn(f64, &Isometry2<f64>, &Speeds) -> [f64; 2],
) -> Result<Vec<Sample<BoatKernel>>, IntegrationError> {
    let q = Isometry2::rotation(heading);
    let c = q.rotation.inverse() * Vector3::new(0.0, STREAM, 0.0).xy();
    let mut path = run(kernel, q, Speeds::from([SPEED + c.x, c.y, 0.0]), 110.0, input)?;
    let there = path.iter().position(|s| s.q.translation.vector.x >= WIDTH).unwrap_or(path.len() - 1);
    path.truncate(there + 1);
    Ok(path)
}
