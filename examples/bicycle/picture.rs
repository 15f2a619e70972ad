//! Eigenvalues over the speed, three rides, and one of them as a page.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

use crate::model::{Bicycle, BicycleFrame, BicycleKernel, linear, published};

type Rides<'k> = [(f64, Trajectory<'k, BicycleKernel>)];

/// Draws everything.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(bicycle: &Bicycle, kernel: &BicycleKernel, rides: &Rides<'_>) -> Result<String, Box<dyn Error>> {
    let until = rides.iter().map(|(_, path)| path.last().t).fold(0.0, f64::max);
    let over_time = |title, y, ends, coordinate: usize| {
        let line = |((speed, path), colour): (&(f64, Trajectory<BicycleKernel>), _)| {
            let points = path.iter().map(|s| (s.t, s.q[coordinate].to_degrees()));
            Line::new(format!("{speed} m/s"), colour, points)
        };
        Plot::new(title, ("time, s", 0.0..until), (y, ends), rides.iter().zip(COLOURS).map(line).collect())
    };
    sheet(
        "A bicycle that nobody holds, pushed from the side",
        (1600, 1300),
        &[
            vec![eigenvalues(bicycle, kernel), paths(rides)],
            vec![
                over_time("It leans", "lean, °", -30.0..30.0, 3),
                over_time("It steers by itself", "steer, °", -30.0..30.0, 5),
            ],
        ],
    )
}

/// Real and imaginary parts, and dots of the published matrices.
fn eigenvalues(bicycle: &Bicycle, kernel: &BicycleKernel) -> Plot<'static> {
    let (mut real, mut imaginary) = (Vec::new(), Vec::new());
    for n in 0..=1000 {
        let speed = 0.01 * f64::from(n);
        for value in linear(bicycle, kernel, speed).complex_eigenvalues().iter() {
            real.push((speed, value.re));
            if value.im > 0.0 {
                imaginary.push((speed, value.im));
            }
        }
    }
    // The branches cross and meet: small squares in place of lines.
    let dots = |points: Vec<(f64, f64)>, colour| {
        points
            .into_iter()
            .filter(|(_, y)| y.abs() < 10.0)
            .map(move |(x, y)| Line::new("", colour, [(x, y), (x + 0.012, y)]))
    };
    let mut lines: Vec<Line> = dots(real, COLOURS[0]).chain(dots(imaginary, COLOURS[1])).collect();
    lines.push(Line::new("real part", COLOURS[0], []));
    lines.push(Line::new("imaginary part", COLOURS[1], []));
    let marks = (0..=10).flat_map(|speed| {
        let values = published(f64::from(speed), bicycle.g).complex_eigenvalues();
        values.iter().map(|v| (f64::from(speed), v.re, String::new())).collect::<Vec<_>>()
    });
    Plot::new("Eigenvalues (dots: the benchmark)", ("speed, m/s", 0.0..10.0), ("1/s", -10.0..10.0), lines)
        .marked(marks.filter(|(_, y, _)| y.abs() < 10.0).collect())
}

fn paths(rides: &Rides<'_>) -> Plot<'static> {
    let line = |((speed, path), colour): (&(f64, Trajectory<BicycleKernel>), _)| {
        Line::new(format!("{speed} m/s"), colour, path.iter().map(|s| (s.q[0], -s.q[1])))
    };
    let (x, y) = (("ahead, m", 0.0..130.0), ("to the left, m", -65.0..15.0));
    let lines = rides.iter().zip(COLOURS).map(line).collect();
    Plot::new("Where the rear wheel rolls, from above", x, y, lines).to_scale()
}

/// A ride as a page, with the forces of the floor.
///
/// # Errors
/// When the run cannot be read between its samples.
pub fn page(
    bicycle: &Bicycle,
    kernel: &BicycleKernel,
    path: &Trajectory<BicycleKernel>,
) -> Result<Playback<BicycleKernel>, Box<dyn Error>> {
    let Bicycle { wheelbase, trail, tilt, rear_radius, front_radius, .. } = *bicycle;
    // Spokes show how a wheel turns; its axis is e₂.
    let wheel = |radius: f64| {
        let turned = Isometry3::rotation(Vector3::x() * std::f64::consts::FRAC_PI_2);
        let tyre = Shape::cylinder(radius, 0.02).at(&turned);
        [tyre, Shape::rod([0.0, -0.05, 0.0], [0.0, 0.05, 0.0], 0.02).colour("#444444")]
    };
    // Along the steering axis from the floor up.
    let along = |height: f64| [-height * tilt.tan(), 0.0, -height];
    let saddle = [0.25, 0.0, -0.55];
    let [head, bars] = [along(0.75), along(1.0)];
    let in_frame = |[x, y, z]: [f64; 3]| [x + wheelbase + trail, y, z + rear_radius];
    // The rear wheel does not slip along its heading nor across it; its normal force is none of the multipliers, since
    // the coordinates let it touch. The front wheel is held upwards and in both directions of the floor.
    let grip = |s: &Sample<BicycleKernel>| {
        let along = kernel.multipliers(s.t, &s.q, &s.z, &());
        let heading = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), s.q[2]);
        (Vector3::new(s.q[0], s.q[1], 0.0), heading * Vector3::new(along[0], along[1], 0.0))
    };
    let front = |s: &Sample<BicycleKernel>| {
        let pose = kernel.pose_of(BicycleFrame::front_wheel, s.t, &s.q);
        let axle = pose.rotation * Vector3::y();
        let down = (Vector3::z() - axle * axle.z).normalize();
        let forces = kernel.multipliers(s.t, &s.q, &s.z, &());
        (pose.translation.vector + down * front_radius, Vector3::new(forces[3], forces[4], forces[2]))
    };
    let mut page = Playback::new("A bicycle that nobody holds, pushed from the side", path)?
        .si()
        .arrow("grip of the rear wheel", 5e-3, grip)
        .arrow("force of the floor on the front wheel", 1.5e-3, front)
        .up([0.0, 0.0, -1.0])
        .frames(kernel)
        .follow("frame")
        .trace("rear_wheel", [0.0; 3]);
    for shape in [
        Shape::rod([0.0; 3], saddle, 0.02),
        Shape::rod(saddle, in_frame(head), 0.02),
        Shape::rod([0.0; 3], in_frame(head), 0.02),
        Shape::ellipsoid([0.14, 0.17, 0.42]).at(&Isometry3::translation(0.28, 0.0, -0.85)),
    ] {
        page = page.shape("frame", shape);
    }
    for shape in [
        Shape::rod([-trail, 0.0, -front_radius], bars, 0.018),
        Shape::rod([bars[0], -0.25, bars[2]], [bars[0], 0.25, bars[2]], 0.014),
    ] {
        page = page.shape("fork", shape);
    }
    for (name, radius) in [("rear_wheel", rear_radius), ("front_wheel", front_radius)] {
        for shape in wheel(radius) {
            page = page.shape(name, shape);
        }
    }
    Ok(page
        .curve("angle / °", "lean", |s| s.q[3].to_degrees())
        .curve("angle / °", "steer", |s| s.q[5].to_degrees())
        .energy(kernel))
}
