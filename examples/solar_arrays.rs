//! A satellite with two solar arrays turns by 60°: what its arrays do, with a torque that jumps and with a smooth one.
//! The arrays are bodies with modes, from a file as finite elements give it.
//!
//! `cargo run --release --example solar_arrays [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

/// A sample: s, degrees, mm.
type Seen = (f64, f64, f64);

/// The hub is a box of 2 m; arrays of 6 m stand out along its e₁. Each bends out of its plane by two modes, and in it
/// by one. Frames along them are for the eye: what they are displaced by is `seen` times too large.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(craft: Pose, l1, l2, l3, r1, r2, r3),
    input(torque = "N m"),
    body(hub, pose = craft, mass = m, inertia = [j, j, j]),
    body(left, parent = hub, position = [1, 0, 0]),
    body(right, parent = hub, position = [-1, 0, 0], rotation = rotation_z(pi)),
    modes(left, coordinates = [l1, l2, l3], file = "../examples/data/array.json"),
    modes(right, coordinates = [r1, r2, r3], file = "../examples/data/array.json"),
    torque(wheels, body = hub, value = [0, torque, 0]),
    frame(left_middle, parent = left, position = [3, 0, seen * (0.175 * l1 + 0.369 * l2)]),
    frame(left_tip, parent = left, position = [6, 0, seen * (0.516 * l1 - 0.516 * l2)]),
    frame(right_middle, parent = right, position = [3, 0, seen * (0.175 * r1 + 0.369 * r2)]),
    frame(right_tip, parent = right, position = [6, 0, seen * (0.516 * r1 - 0.516 * r2)]),
    frames(hub, left, left_middle, left_tip, right, right_middle, right_tip),
)]
struct Satellite {
    /// Of the hub.
    #[gauss(unit = "kg")]
    m: f64,
    #[gauss(unit = "kg m^2")]
    j: f64,
    seen: f64,
}

const ANGLE: f64 = PI / 3.0;
/// The time of the slew, and until when its arrays are watched, s.
const SLEW: f64 = 30.0;
const END: f64 = 60.0;

/// θ̈ of a slew from rest to rest: full torque one way, then the other; or one turn of a sine.
fn jumping(t: f64) -> f64 {
    let full = 4.0 * ANGLE / SLEW.powi(2);
    if t < SLEW / 2.0 {
        full
    } else if t < SLEW {
        -full
    } else {
        0.0
    }
}

fn smooth(t: f64) -> f64 {
    if t < SLEW { ANGLE * TAU / SLEW.powi(2) * (TAU * t / SLEW).sin() } else { 0.0 }
}

/// The slew under the torque that a rigid satellite would need, in the pieces between which it jumps.
fn slew(kernel: &SatelliteKernel, wanted: fn(f64) -> f64) -> Result<Vec<Seen>, Box<dyn Error>> {
    let inertia = kernel.mass_matrix(0.0, &SatelliteState::default().q())[(4, 4)];
    let law = |t: f64, _: &_, _: &_| SatelliteInput { torque: inertia * wanted(t) }.input();
    let (mut q, mut z) = (SatelliteState::default().q(), SatelliteState::default().z());
    let mut seen = Vec::new();
    for piece in [0.0..SLEW / 2.0, SLEW / 2.0..SLEW, SLEW..END] {
        let run = Simulation::new(kernel).adaptive(1e-10, 1e-12).input(law).run(q, z, piece.clone())?;
        let steps = ((piece.end - piece.start) * 10.0) as usize;
        for n in 0..=steps {
            let t = (piece.start + 0.1 * n as f64).min(piece.end);
            let state = run.at(t)?;
            let turn = state.q.0.rotation;
            let angle = 2.0 * turn.j.atan2(turn.w);
            let tip = 0.516_398 * (state.q.1[0] - state.q.1[1]);
            seen.push((t, angle.to_degrees(), 1e3 * tip));
        }
        (q, z) = (run.last().q, run.last().z);
    }
    Ok(seen)
}

/// The largest deflection of a tip, and of that the part that is left when the slew is over, mm; how far the hub then
/// swings about its aim, degrees.
fn judged(seen: &[Seen]) -> [f64; 3] {
    let most = |from: f64, of: &dyn Fn(&Seen) -> f64| {
        seen.iter().filter(|(t, ..)| *t >= from).map(|point| of(point).abs()).fold(0.0, f64::max)
    };
    [most(0.0, &|p| p.2), most(SLEW + 0.05, &|p| p.2), most(SLEW + 0.05, &|p| p.1 - ANGLE.to_degrees())]
}

fn main() -> Result<(), Box<dyn Error>> {
    let satellite = Satellite { m: 200.0, j: 80.0, seen: 1.0 };
    let kernel = satellite.kernel()?;
    println!("accelerations of a hub with six modes: {}\n", SatelliteKernel::OPERATIONS.acceleration);
    let both = [slew(&kernel, jumping)?, slew(&kernel, smooth)?];
    println!("60° in {SLEW} s   tip/mm   left over/mm   hub swings/°");
    let judged = both.each_ref().map(|seen| judged(seen));
    for (name, [tip, left, swing]) in ["jumping", "smooth"].into_iter().zip(judged) {
        println!("{name:11} {tip:9.2} {left:14.4} {swing:14.5}");
    }
    write("solar_arrays", &sheet("A satellite turns, and its arrays", (1100, 900), &pictures(&both))?)?;
    let shown = Satellite { seen: 20.0, ..satellite }.kernel()?;
    write_page("solar_arrays", &page(&shown)?)?;
    // A torque that begins as a sine leaves a swing of the ratio of the two frequencies, 1/18, when it begins and again
    // when it ends; one that jumps leaves as much as it bends.
    let [[_, jumped, _], [bent, left, _]] = judged;
    if left < bent / 9.0 && left < jumped / 4.0 {
        Ok(())
    } else {
        Err("the smooth slew leaves the arrays swinging".into())
    }
}

fn pictures(both: &[Vec<Seen>; 2]) -> Vec<Vec<Plot<'static>>> {
    let names = ["torque that jumps", "smooth torque"];
    let lines = |of: fn(&Seen) -> f64| {
        let line = |k: usize| {
            let points = both[k].iter().map(|point| (point.0, of(point))).collect::<Vec<_>>();
            Line::new(names[k], COLOURS[k], points)
        };
        vec![line(0), line(1)]
    };
    let most = both[0].iter().map(|point| point.2.abs()).fold(0.0, f64::max) * 1.1;
    vec![
        vec![Plot::new("the hub has turned", ("time, s", 0.0..END), ("degrees", 0.0..65.0), lines(|p| p.1))],
        vec![Plot::new("tip of an array", ("time, s", 0.0..END), ("mm", -most..most), lines(|p| p.2))],
    ]
}

/// The slew with jumps.
fn page(kernel: &SatelliteKernel) -> Result<Playback<SatelliteKernel>, Box<dyn Error>> {
    let start = SatelliteState::default();
    let inertia = kernel.mass_matrix(0.0, &start.q())[(4, 4)];
    let law = |t: f64, _: &_, _: &_| SatelliteInput { torque: inertia * jumping(t) }.input();
    let run = Simulation::new(kernel).input(law).fixed_step(0.02).run(start.q(), start.z(), 0.0..END)?;
    let page = Playback::new("A satellite turns, its arrays bend (20 times as far)", &run)?.si().frames(kernel);
    let arrays = [["left", "left_middle", "left_tip"], ["right", "right_middle", "right_tip"]];
    let rods = |page: Playback<SatelliteKernel>, [root, middle, tip]: [&str; 3]| {
        page.rod(root, middle, 0.1).rod(middle, tip, 0.1)
    };
    Ok(arrays.into_iter().fold(page, rods).shape("hub", Shape::cuboid([2.0, 1.6, 1.6])))
}
