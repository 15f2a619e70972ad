//! A load on a rope below a craft that flies somewhere else: the force of the rope, and a flight that leaves no swing.
//!
//! `cargo run --release --example slung_load [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// Craft and load in the plane of k₁ and k₃, k₃ up, and a rope that stays taut. The rotors carry both; `push`, in N
/// along k₁, is what they give besides.
#[derive(Clone, Copy, Debug, GaussDynamics)]
#[gauss(
    coordinates(x, z, load_x, load_z),
    body(craft, position = [x, 0, z], mass = m, inertia = 0.1),
    particle(mass = m_load, position = [load_x, 0, load_z]),
    constraint(position = hypot(load_x - x, load_z - z) - rope),
    gravity = g,
    input(push),
    force(rotors, body = craft, value = [push, 0, (m + m_load) * g]),
)]
struct Slung {
    m: f64,
    m_load: f64,
    rope: f64,
    g: f64,
}

/// Seen from the craft the load is a pendulum, whatever its angle: a craft under a constant force F falls freely but
/// for F/m, and the force of the rope accelerates both ends. So its gravity is g (m + m_load)/m, and it swings at
/// this rate.
fn rate(slung: &Slung) -> f64 {
    (slung.g * (1.0 + slung.m_load / slung.m) / slung.rope).sqrt()
}

/// The period of a pendulum that swings to an angle: 4 K(sin(θ/2))/ω, by the arithmetic-geometric mean.
fn period(slung: &Slung, angle: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (0.5 * angle).cos());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    TAU / a / rate(slung)
}

fn hanging(slung: &Slung, angle: f64) -> SVector<f64, 4> {
    SVector::from([0.0, 0.0, slung.rope * angle.sin(), -slung.rope * angle.cos()])
}

/// The angle of the rope from the vertical.
fn swing(s: &Sample<SlungKernel>) -> f64 {
    (s.q[2] - s.q[0]).atan2(s.q[1] - s.q[3])
}

fn main() -> Result<(), Box<dyn Error>> {
    let slung = Slung { m: 9.0, m_load: 4.0, rope: 6.0, g: 9.81 };
    let kernel = slung.kernel()?;
    println!("A LOAD ON A ROPE\n");
    println!("One evaluation of the acceleration: {}\n", SlungKernel::OPERATIONS.acceleration);
    swings_as_long_as_it_must(&slung, &kernel)?;

    // Within one period the swing that a push brings has come back to rest.
    let once = TAU / rate(&slung);
    let (calm, swaying) = (fly(&slung, &kernel, once)?, fly(&slung, &kernel, 1.5 * once)?);
    println!("\nfrom place to place, by a push, a glide, and a push back:");
    for (words, pushed, path) in [("one period", once, &calm), ("one and a half", 1.5 * once, &swaying)] {
        let last = &path[path.len() - 1];
        let left = path.iter().filter(|s| s.t > 2.0 * pushed + GLIDE).map(|s| swing(s).abs()).fold(0.0, f64::max);
        let total = slung.m + slung.m_load;
        let centre = (slung.m * last.q[0] + slung.m_load * last.q[2]) / total;
        // The rope is inside: the centre of mass goes as the pushes say.
        let hand = IMPULSE / total * (pushed + GLIDE);
        println!("  each as long as {words:<15} goes {centre:7.3} m, swings on by {:6.3}°", left.to_degrees());
        if (centre - hand).abs() > 1e-9 * hand {
            return Err(format!("the centre of mass should be at {hand}").into());
        }
    }
    write("slung_load", &draw(&calm, &swaying)?)?;
    write_page("slung_load", &page(&slung, &kernel, 1.5 * once, swaying))
}

/// Runs from rest at large angles against the pendulum that they are, and the rope at its lowest point.
fn swings_as_long_as_it_must(slung: &Slung, kernel: &SlungKernel) -> Result<(), Box<dyn Error>> {
    println!("angle/°   period/s   4K(sin(θ/2))/ω   relative difference");
    for degrees in [1.0_f64, 30.0, 80.0] {
        let angle = degrees.to_radians();
        let lowest = |_: f64, q: &SVector<f64, 4>, _: &SVector<f64, 4>| q[2] - q[0];
        let run = Simulation::new(kernel).input(|_: f64, _: &_, _: &_| SVector::from([0.0])).adaptive(1e-12, 1e-12);
        let expected = period(slung, angle);
        let path =
            run.event(Crossing::Any, lowest).run(hanging(slung, angle), SVector::zeros(), 0.0..3.2 * expected)?;
        let times: Vec<f64> = path.events().iter().map(|event| event.sample.t).collect();
        let measured = times[4] - times[2];
        let apart = (measured / expected - 1.0).abs();
        println!("{degrees:7}  {measured:9.6}  {expected:15.6}   {apart:.1e}");
        // Each step is off by 1e-12 of lengths of some metres.
        if apart > 1e-9 {
            return Err("this is not the pendulum it should be".into());
        }
    }
    Ok(())
}

/// s: between the pushes.
const GLIDE: f64 = 3.0;
/// N s: what a push gives, however long it lasts.
const IMPULSE: f64 = 60.0;

/// Ends and strengths of a push, a glide, a push back, and as long as both at the end.
fn parts(pushed: f64) -> [(f64, f64); 4] {
    let (force, there) = (IMPULSE / pushed, pushed + GLIDE);
    [(pushed, force), (there, 0.0), (there + pushed, -force), (there + 3.0 * pushed, 0.0)]
}

/// The push at a time; where it jumps the one before.
fn push_at(pushed: f64, t: f64) -> f64 {
    parts(pushed).into_iter().find(|(end, _)| t <= *end).map_or(0.0, |(_, push)| push)
}

/// Flies so, with pushes of this length.
fn fly(slung: &Slung, kernel: &SlungKernel, pushed: f64) -> Result<Vec<Sample<SlungKernel>>, Box<dyn Error>> {
    let mut samples: Vec<Sample<SlungKernel>> = Vec::new();
    let (mut t, mut q, mut z) = (0.0, hanging(slung, 0.0), SVector::zeros());
    for (end, push) in parts(pushed) {
        // The input jumps: a run for each part.
        let run =
            Simulation::new(kernel).input(move |_: f64, _: &_, _: &_| SVector::from([push])).adaptive(1e-11, 1e-11);
        let path = run.largest_step(0.05).run(q, z, t..end)?;
        let last = *path.last();
        (t, q, z) = (last.t, last.q, last.z);
        // The last one of a part is the first one of the next.
        samples.truncate(samples.len().saturating_sub(1));
        samples.extend(path.iter().copied());
    }
    Ok(samples)
}

fn draw(calm: &[Sample<SlungKernel>], swaying: &[Sample<SlungKernel>]) -> Result<String, Box<dyn Error>> {
    let until = swaying[swaying.len() - 1].t;
    let over_time = |title, y, ends, value: &dyn Fn(&Sample<SlungKernel>) -> f64| {
        let paths = [("pushes of one period", calm), ("of one and a half", swaying)];
        let line = |((name, path), colour): ((&str, &[Sample<SlungKernel>]), _)| {
            Line::new(name, colour, path.iter().map(|s| (s.t, value(s))))
        };
        Plot::new(title, ("time, s", 0.0..until), (y, ends), paths.into_iter().zip(COLOURS).map(line).collect())
    };
    sheet(
        "A load below a craft: pushed as long as one swing takes, it arrives at rest",
        (1600, 700),
        &[vec![
            over_time("The rope", "angle from the vertical, °", -20.0..20.0, &|s| swing(s).to_degrees()),
            over_time("The craft", "way, m", 0.0..50.0, &|s| s.q[0]),
        ]],
    )
}

fn page(slung: &Slung, kernel: &SlungKernel, pushed: f64, path: Vec<Sample<SlungKernel>>) -> Playback<SlungKernel> {
    let rope = slung.rope;
    let at = |x: f64, z: f64| Isometry3::translation(x, 0.0, z);
    let arm = |angle: f64| Shape::rod([0.0; 3], [0.8 * angle.cos(), 0.8 * angle.sin(), 0.0], 0.04).colour("#444444");
    let rotor = |angle: f64| {
        Shape::cylinder(0.42, 0.03).at(&Isometry3::translation(0.8 * angle.cos(), 0.8 * angle.sin(), 0.08))
    };
    let corners = [0.25 * PI, 0.75 * PI, 1.25 * PI, 1.75 * PI];
    let body = [Shape::cuboid([0.6, 0.4, 0.25])];
    let frame = body.into_iter().chain(corners.map(arm)).chain(corners.map(rotor));
    let weight = slung.m_load * slung.g;
    // On the load, along the rope.
    let pull = move |s: &Sample<SlungKernel>| {
        let along = Vector3::new(s.q[0] - s.q[2], 0.0, s.q[1] - s.q[3]) / rope;
        // The multiplier is the force that makes the rope longer.
        -along * kernel.multipliers(s.t, &s.q, &s.z, &SVector::from([push_at(pushed, s.t)]))[0]
    };
    Playback::of_samples("A load on a rope, set down swinging", path)
        .si()
        .from_the_side()
        .body("craft", move |s| at(s.q[0], s.q[1]), frame)
        .body("load", move |s| at(s.q[2], s.q[3]), [Shape::cuboid([0.7, 0.7, 0.7])])
        .rod("craft", "load", 0.02)
        .trace("load", [0.0; 3])
        .arrow("force of the rope on the load", 2.0 / weight, move |s| (Vector3::new(s.q[2], 0.0, s.q[3]), pull(s)))
        .arrow("weight of the load", 2.0 / weight, move |s| {
            (Vector3::new(s.q[2], 0.0, s.q[3]), Vector3::new(0.0, 0.0, -weight))
        })
        .curve("rope from the vertical / °", "swing", |s| swing(s).to_degrees())
        .curve("force of the rope / N", "tension", move |s| pull(s).norm())
        .energy(kernel)
}
