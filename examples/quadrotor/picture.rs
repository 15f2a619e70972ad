//! The picture of the flight.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use plotters::style::RGBColor;

use crate::model::{Quadrotor, QuadrotorKernel, wanted};

const GREY: RGBColor = RGBColor(120, 120, 120);

/// Draws the path from above, height and distance from the wanted path, speeds of the rotors, powers.
pub fn draw(
    craft: &Quadrotor,
    kernel: &QuadrotorKernel,
    path: &Trajectory<QuadrotorKernel>,
    control: impl Fn(f64, &Isometry3<f64>, &SVector<f64, 6>) -> SVector<f64, 4>,
) -> Result<String, Box<dyn Error>> {
    let end = path.last().t;
    let at = |t: f64| path.at(t).expect("inside the run");
    let place = |t: f64| at(t).q.translation.vector;
    let input = |t: f64| control(t, &at(t).q, &at(t).z);
    let [blue, red, ..] = COLOURS;

    let gust = [-1.0, 0.0, 1.0].map(|n| craft.gust_time + n * craft.gust_length);
    let blown = times(end).filter(|t| (gust[0]..gust[2]).contains(t));
    let above = Plot::new(
        "The path from above",
        ("k₁, m", -1.9..1.9),
        ("k₂, m", -1.1..1.1),
        vec![
            Line::new("wanted", GREY, times(end).map(wanted).map(|w| (w.position.x, w.position.y))).dashed(),
            Line::new("flown", blue, times(end).map(place).map(|b| (b.x, b.y))),
            Line::new("in the gust", red, blown.map(place).map(|b| (b.x, b.y))).wide(7),
        ],
    )
    .to_scale();
    let distance = Plot::new(
        "Distance from the wanted path; the gust",
        ("time, s", 0.0..end),
        ("cm, m/s", 0.0..16.0),
        vec![
            Line::new(
                "gust, m/s",
                red,
                times(end).map(|t| (t, craft.gust.y * (-((t - craft.gust_time) / craft.gust_length).powi(2)).exp())),
            ),
            Line::new("distance, cm", blue, times(end).map(|t| (t, 100.0 * (place(t) - wanted(t).position).norm()))),
        ],
    );
    let rows = [vec![above, distance], vec![rotors(path, &input, craft.hover_speed()), powers(kernel, path, &input)]];
    sheet("A Crazyflie flies eights and meets a gust", (1700, 1300), &rows)
}

fn times(end: f64) -> impl Iterator<Item = f64> {
    (0..=700).map(move |n| f64::from(n) * end / 700.0)
}

fn rotors(path: &Trajectory<QuadrotorKernel>, input: &dyn Fn(f64) -> SVector<f64, 4>, hover: f64) -> Plot<'static> {
    let ([blue, red, green, pink], end) = (COLOURS, path.last().t);
    let rotor = |n: usize, name: &str, colour| Line::new(name, colour, times(end).map(|t| (t, input(t)[n]))).wide(3);
    Plot::new(
        "Speeds of the rotors (dashed: hovering)",
        ("time, s", 0.0..end),
        ("rad/s", 1700.0..2100.0),
        vec![
            rotor(0, "front right", blue),
            rotor(1, "back right", red),
            rotor(2, "back left", green),
            rotor(3, "front left", pink),
            Line::new("", GREY, [(0.0, hover), (end, hover)]).dashed(),
        ],
    )
}

fn powers(
    kernel: &QuadrotorKernel,
    path: &Trajectory<QuadrotorKernel>,
    input: &dyn Fn(f64) -> SVector<f64, 4>,
) -> Plot<'static> {
    let ([blue, red, green, _], end) = (COLOURS, path.last().t);
    let at = |t: f64| path.at(t).expect("inside the run");
    let powers = |t: f64| kernel.powers(t, &at(t).q, &at(t).z, &input(t));
    let named = |names: &'static [&'static str]| {
        let indices: Vec<usize> = (0..QuadrotorKernel::ELEMENTS.len())
            .filter(|&e| names.contains(&QuadrotorKernel::ELEMENTS[e].name))
            .collect();
        move |t: f64| (t, indices.iter().map(|&e| powers(t)[e]).sum::<f64>())
    };
    Plot::new(
        "Powers of what acts",
        ("time, s", 0.0..end),
        ("W", -0.3..0.3),
        vec![
            Line::new("weight", GREY, times(end).map(named(&["gravity"]))),
            Line::new("lift", blue, times(end).map(named(&["front_right", "back_right", "back_left", "front_left"]))),
            Line::new("blade drag", green, times(end).map(named(&["blade_drag"]))),
            Line::new("frame drag", red, times(end).map(named(&["airframe"]))),
        ],
    )
}

/// The flight as a page: lift of each rotor as an arrow, and the rotors' speeds below.
pub fn page(
    craft: &Quadrotor,
    kernel: &QuadrotorKernel,
    path: &Trajectory<QuadrotorKernel>,
    control: impl Fn(f64, &Isometry3<f64>, &SVector<f64, 6>) -> SVector<f64, 4>,
) -> Result<Playback<QuadrotorKernel>, Box<dyn Error>> {
    let a = craft.a;
    let hubs = [[a, -a], [-a, -a], [-a, a], [a, a]].map(|[x, y]| Vector3::new(x, y, 0.0));
    let names = ["front right", "back right", "back left", "front left"];
    let arms = [0, 1].map(|k| Shape::rod(hubs[k].into(), hubs[k + 2].into(), 0.08 * a).colour("#44494f"));
    let rotor =
        |hub: &Vector3<f64>| Shape::cylinder(0.6 * a, 0.05 * a).at(&Isometry3::translation(hub.x, hub.y, 0.1 * a));
    let shapes = arms.into_iter().chain(hubs.iter().map(rotor)).chain([Shape::cuboid([0.7 * a, 0.7 * a, 0.3 * a])]);
    let mut page = Playback::new("A quadrotor in a gust", path)?
        .si()
        .body("craft", |s| kernel.pose(s.t, &s.q), shapes)
        .follow("craft")
        .trace("craft", [0.0; 3]);
    for (k, (name, hub)) in names.into_iter().zip(hubs).enumerate() {
        let speed = |s: &Sample<QuadrotorKernel>| control(s.t, &s.q, &s.z)[k];
        // As long as the arms at hover.
        let scale = 4.0 * 1.5 * a / (craft.mass * craft.g);
        page = page
            .arrow(name, scale, |s| {
                (
                    s.q.translation.vector + s.q.rotation * hub,
                    s.q.rotation * Vector3::z() * (craft.k * speed(s).powi(2)),
                )
            })
            .curve("rotors / (rad/s)", name, speed);
    }
    Ok(page)
}
