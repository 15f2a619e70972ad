//! A vehicle with an arm of two joints in a current: how far it turns when the arm reaches out, and what the water that
//! the arm carries along has to do with it.
//!
//! `cargo run --release --example underwater_manipulator [-- FOLDER]` draws into `FOLDER`, by default `target/gauss`.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, PALE};
use gauss_examples::plots::{Line, Plot, sheet, write, write_page};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

mod by_hand;
#[cfg(test)]
mod tests;
mod vehicle;

use vehicle::{LINK, Place, SHOULDER, Speeds, Vehicle, VehicleKernel, reach};

/// m/s to the east.
const CURRENT: f64 = 0.2;
/// Tenths of a second that are looked at.
const TENTHS: u32 = 80;

fn main() -> Result<(), Box<dyn Error>> {
    let still = Vehicle::bluerov2();
    let river = Vehicle { current: Vector3::new(0.0, CURRENT, 0.0), ..still };
    println!("A VEHICLE WITH AN ARM IN A CURRENT\n");
    println!("BlueROV2 Heavy, published coefficients; two links of {LINK} m. All three bodies carry water along.");
    let names: Vec<_> = VehicleKernel::ELEMENTS.iter().map(|element| element.name).collect();
    println!("What acts: {}. One evaluation: {}.", names.join(", "), VehicleKernel::OPERATIONS.acceleration);

    // Released with the current, level, the arm stretched forward.
    let start = |vehicle: &Vehicle| -> (Place, Speeds) {
        let c = vehicle.current;
        ((Isometry3::identity(), SVector::zeros()), Speeds::from([c.x, c.y, c.z, 0.0, 0.0, 0.0, 0.0, 0.0]))
    };
    let wet = run(&river, start(&river))?;
    let hand = by_hand::run(&river, start(&river), TENTHS, 100, reach);
    let apart =
        wet.iter().zip(&hand).map(|(s, (place, _))| (s.q.0.translation.vector - place.0.translation.vector).norm());
    let apart = apart.fold(0.0, f64::max);
    println!("\nby hand         Newton and Euler, body by body: paths are {apart:.1e} m apart after {} s", TENTHS / 10);

    // Galilei: in still water the same, but for where the water goes.
    let resting = run(&still, start(&still))?;
    let moved = |t: f64| river.current * t;
    let galilei = wet.iter().zip(&resting);
    let galilei = galilei.map(|(a, b)| (a.q.0.translation.vector - moved(a.t) - b.q.0.translation.vector).norm());
    println!("Galilei         in still water the path is the same to {:.1e} m", galilei.fold(0.0, f64::max));

    // What the elements say of the energy.
    let kernel = river.kernel()?;
    let (now, h) = (&wet[20], 1e-4);
    let energy = |s: &Sample<VehicleKernel>| kernel.energy(s.t, &s.q, &s.z);
    let around: [Sample<VehicleKernel>; 2] = [step(&river, now, -h)?, step(&river, now, h)?];
    let (slope, supplied) = (
        (energy(&around[1]) - energy(&around[0])) / (2.0 * h),
        kernel.supplied_power(now.t, &now.q, &now.z, &reach(now.t, &now.q, &now.z)),
    );
    println!("energy          at 2 s it changes by {slope:.6} W, and the elements say {supplied:.6} W");

    let dry = run(&river.with_dry_arm(), start(&river))?;
    let yaw = |s: &Sample<VehicleKernel>| s.q.0.rotation.euler_angles().2.to_degrees();
    let most = |path: &[Sample<VehicleKernel>]| path.iter().map(|s| yaw(s).abs()).fold(0.0, f64::max);
    println!(
        "\nthe arm reaches out, and the hull turns by up to {:.2}°; without the water of its links {:.2}° would be expected",
        most(&wet),
        most(&dry)
    );
    let svg = draw(&wet, &dry, &hand)?;
    write("underwater_manipulator", &svg)?;
    write_page("underwater_manipulator", &page(wet, &kernel))
}

/// The states at every tenth of a second, while the arm reaches out.
fn run(vehicle: &Vehicle, (q, z): (Place, Speeds)) -> Result<Vec<Sample<VehicleKernel>>, Box<dyn Error>> {
    let kernel = vehicle.kernel()?;
    let mut samples = vec![Sample { t: 0.0, q, z, p: kernel.momentum(0.0, &q, &z) }];
    for n in 0..TENTHS {
        let last = samples[samples.len() - 1];
        let interval = 0.1 * f64::from(n)..0.1 * f64::from(n + 1);
        let way = Simulation::new(&kernel).input(reach).adaptive(1e-11, 1e-13);
        samples.push(way.run_to_end(last.q, last.z, interval)?.sample);
    }
    Ok(samples)
}

/// The state a little later or earlier.
fn step(vehicle: &Vehicle, from: &Sample<VehicleKernel>, h: f64) -> Result<Sample<VehicleKernel>, Box<dyn Error>> {
    let kernel = vehicle.kernel()?;
    Ok(Simulation::new(&kernel)
        .input(reach)
        .adaptive(1e-12, 1e-14)
        .run_to_end(from.q, from.z, from.t..from.t + h)?
        .sample)
}

/// Shoulder, elbow and tip of the arm, m, observer's axes.
fn arm(q: &Place) -> [Vector3<f64>; 3] {
    let yaw = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.1[0]);
    let pitch = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), q.1[1]);
    let (shoulder, along) = (Vector3::from(vehicle::SHOULDER), Vector3::new(LINK, 0.0, 0.0));
    let points = [shoulder, shoulder + yaw * along, shoulder + yaw * (along + pitch * along)];
    points.map(|point| q.0.translation.vector + q.0.rotation * point)
}

/// The outline of the hull from above, 0.46 by 0.58 m.
fn hull(q: &Place) -> impl Iterator<Item = Vector3<f64>> {
    let corners = [(0.23, 0.29), (-0.23, 0.29), (-0.23, -0.29), (0.23, -0.29), (0.23, 0.29)];
    corners.map(|(x, y)| q.0.translation.vector + q.0.rotation * Vector3::new(x, y, 0.0)).into_iter()
}

fn draw(
    wet: &[Sample<VehicleKernel>],
    dry: &[Sample<VehicleKernel>],
    hand: &[(Place, Speeds)],
) -> Result<String, Box<dyn Error>> {
    let [blue, orange, green] = [COLOURS[0], COLOURS[1], COLOURS[2]];
    // What the current does to everything is left out of the picture.
    let east = |s: &Sample<VehicleKernel>, p: Vector3<f64>| (p.y - CURRENT * s.t, p.x);
    let path = |samples: &[Sample<VehicleKernel>], of: &dyn Fn(&Sample<VehicleKernel>) -> Vector3<f64>| {
        samples.iter().map(|s| east(s, of(s))).collect::<Vec<_>>()
    };
    let over_time = |of: &dyn Fn(&Sample<VehicleKernel>) -> f64, samples: &[Sample<VehicleKernel>]| {
        samples.iter().map(|s| (s.t, of(s))).collect::<Vec<_>>()
    };
    let angles = |s: &Sample<VehicleKernel>| s.q.0.rotation.euler_angles();
    let plan =
        Plot::new("from above, carried along by the current", ("east, m", -0.4..0.6), ("north, m", -0.4..0.95), {
            let [first, last] = [&wet[0], &wet[wet.len() - 1]];
            let outline = |s: &Sample<VehicleKernel>, colour| {
                let links = Line::new("", colour, arm(&s.q).map(|p| east(s, p))).wide(7);
                [Line::new("", colour, hull(&s.q).map(|p| east(s, p))), links]
            };
            let tip = |s: &Sample<VehicleKernel>| arm(&s.q)[2];
            let mut lines: Vec<Line> = outline(first, PALE).into_iter().chain(outline(last, green)).collect();
            lines.push(Line::new("tip of the arm", blue, path(wet, &tip)));
            lines.push(Line::new("with a dry arm", orange, path(dry, &tip)).dashed());
            lines
        })
        .to_scale();
    let lowest = |line: &[(f64, f64)]| line.iter().map(|p| p.1).fold(0.0, f64::min);
    let highest = |line: &[(f64, f64)]| line.iter().map(|p| p.1).fold(0.0, f64::max);
    let pair = |title: &'static str, unit: &'static str, of: &dyn Fn(&Sample<VehicleKernel>) -> f64| {
        let (a, b) = (over_time(of, wet), over_time(of, dry));
        let (low, high) = (lowest(&a).min(lowest(&b)), highest(&a).max(highest(&b)));
        let air = 0.1 * (high - low);
        Plot::new(
            title,
            ("time, s", 0.0..f64::from(TENTHS) / 10.0),
            (unit, low - air..high + air),
            vec![Line::new("all bodies in water", blue, a), Line::new("a dry arm", orange, b).dashed()],
        )
    };
    let errors: Vec<(f64, f64)> = wet
        .iter()
        .zip(hand)
        .map(|(s, (place, _))| (s.t, 1e12 * (s.q.0.translation.vector - place.0.translation.vector).norm()))
        .collect();
    let check = Plot::new(
        "between the kernel and equations by hand",
        ("time, s", 0.0..f64::from(TENTHS) / 10.0),
        ("distance, 10⁻¹² m", 0.0..1.15 * highest(&errors).max(1e-3)),
        vec![Line::new("", green, errors.iter().copied())],
    );
    let yaw = pair("the hull yaws as the arm swings out", "yaw, °", &|s| angles(s).2.to_degrees());
    let pitch = pair("and pitches as the elbow bends", "pitch, °", &|s| angles(s).1.to_degrees());
    sheet("A vehicle with an arm of two joints in a current", (1600, 1280), &[vec![plan, yaw], vec![pitch, check]])
}

/// Hull and arm in the current, as a page; k₃ points down.
fn page(path: Vec<Sample<VehicleKernel>>, kernel: &VehicleKernel) -> Playback<VehicleKernel> {
    let turret = |s: &Sample<VehicleKernel>| {
        let (hull, joints) = &s.q;
        hull * Isometry3::new(SHOULDER.into(), Vector3::z() * joints[0])
    };
    let fore = |s: &Sample<VehicleKernel>| turret(s) * Isometry3::new(Vector3::x() * LINK, Vector3::y() * s.q.1[1]);
    let link = || [Shape::rod([0.0; 3], [LINK, 0.0, 0.0], 0.03)];
    Playback::of_samples("A vehicle with an arm in a current", path)
        .si()
        .up([0.0, 0.0, -1.0])
        .body("hull", |s| s.q.0, [Shape::cuboid([0.46, 0.34, 0.25])])
        .body("upper arm", turret, link())
        .body("forearm", fore, link())
        .follow("hull")
        .trace("forearm", [LINK, 0.0, 0.0])
        .arrow("velocity of the hull", 1.0, |s| {
            (s.q.0.translation.vector, s.q.0.rotation * Vector3::from(s.z.fixed_rows::<3>(0)))
        })
        .arrow("current", 1.0, |s| (s.q.0.translation.vector, Vector3::y() * CURRENT))
        .curve("joints / rad", "shoulder", |s| s.q.1[0])
        .curve("joints / rad", "elbow", |s| s.q.1[1])
        .energy(kernel)
}
