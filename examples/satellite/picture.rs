//! The picture of the librations and of the slew.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;

use crate::model::{
    OrbiterKernel, RADIUS, Slewer, SlewerKernel, libration_frequency, libration_period, mean_motion, pitch,
};

/// Draws librations about the upright attitude, the fall from the other one, and the slew.
pub fn draw(
    librations: &[(f64, Trajectory<OrbiterKernel>)],
    falling: &Trajectory<OrbiterKernel>,
    slewer: &Slewer,
    slew: &Trajectory<SlewerKernel>,
) -> Result<String, Box<dyn Error>> {
    let [blue, red, green, _] = COLOURS;
    let turn = std::f64::consts::TAU / mean_motion();
    let angle = |path: &Trajectory<OrbiterKernel>, t: f64| pitch(&path.at(t).expect("inside the run").q).to_degrees();

    let swing = |(degrees, path): &(f64, Trajectory<OrbiterKernel>), colour| {
        let points = times(4.0 * turn).map(|t| (t / turn, angle(path, t)));
        Line::new(format!("{degrees}°"), colour, points)
    };
    let stable = Plot::new(
        "Smallest moment upwards (dots: theory)",
        ("orbits", 0.0..4.0),
        ("long axis from the vertical, °", -50.0..50.0),
        librations.iter().rev().zip([blue, red, green]).map(|(one, colour)| swing(one, colour)).collect(),
    )
    .marked(
        librations
            .iter()
            .flat_map(|(degrees, _)| {
                let period = libration_period(degrees.to_radians()) / turn;
                (1..5).map(move |n| (f64::from(n) * period, *degrees, String::new()))
            })
            .filter(|mark| mark.0 < 4.0)
            .collect(),
    );
    let deviation = |t: f64| angle(falling, t) - 90.0;
    let unstable = Plot::new(
        "Long axis along the path: it falls over",
        ("orbits", 0.0..2.0),
        ("log₁₀ of the deviation in °", -5.0..3.0),
        vec![
            Line::new("run", red, times(2.0 * turn).map(|t| (t / turn, deviation(t).abs().log10()))).wide(5),
            Line::new(
                "theory: deviation · cosh(λt)",
                blue,
                times(1.75 * turn).map(|t| (t / turn, (deviation(0.0) * (libration_frequency() * t).cosh()).log10())),
            )
            .dashed(),
        ],
    );
    let title = "A CubeSat turned by the gradient of gravity, and by a wheel";
    sheet(title, (1700, 1300), &[vec![stable, unstable], by_the_wheel(slewer, slew)])
}

fn times(end: f64) -> impl Iterator<Item = f64> {
    (0..=500).map(move |n| end * f64::from(n) / 500.0)
}

/// The slew: angle of the hub, and who has how much of the angular momentum.
fn by_the_wheel(slewer: &Slewer, slew: &Trajectory<SlewerKernel>) -> Vec<Plot<'static>> {
    let ([blue, red, green, pink], end) = (COLOURS, slew.last().t);
    let at = |t: f64| slew.at(t).expect("inside the run");
    let hub = |t: f64| at(t).q.0.scaled_axis().z.to_degrees();
    let (hub_moment, about) = slewer.moments();
    let closed = |t: f64| -about / (hub_moment + about) * at(t).q.1[0].to_degrees();
    let angles = Plot::new(
        "A quarter turn by the reaction wheel",
        ("time, s", 0.0..end),
        ("angle of the hub, °", 0.0..100.0),
        vec![
            Line::new("run", red, times(end).map(|t| (t, hub(t)))).wide(7),
            Line::new("theory: −J_w/(J + J_w) · wheel", blue, times(end).map(|t| (t, closed(t)))).dashed(),
        ],
    );
    let momentum = |t: f64| (at(t).z[2] * hub_moment * 1e3, (at(t).z[2] + at(t).z[3]) * about * 1e3);
    let shares = Plot::new(
        "Angular momentum about e₃ goes to the wheel",
        ("time, s", 0.0..end),
        ("10⁻³ N m s", -6.0..6.0),
        vec![
            Line::new("hub", red, times(end).map(|t| (t, momentum(t).0))),
            Line::new("wheel", green, times(end).map(|t| (t, momentum(t).1))),
            Line::new("sum", pink, times(end).map(|t| (t, momentum(t).0 + momentum(t).1))),
        ],
    );
    vec![angles, shares]
}

/// The satellite on its orbit as a page: the orbit two metres wide, for the satellite to be seen.
///
/// # Errors
/// When the run cannot be read between its samples.
pub fn page(
    kernel: &OrbiterKernel,
    path: &Trajectory<OrbiterKernel>,
) -> Result<Playback<OrbiterKernel>, IntegrationError> {
    let near = |s: &Sample<OrbiterKernel>| {
        Isometry3::from_parts((s.q.translation.vector * (1.0 / RADIUS)).into(), s.q.rotation)
    };
    let earth = 0.5 * 6371e3 / RADIUS;
    Ok(Playback::with_pictures("A CubeSat swings in the gradient of gravity; its orbit is drawn small", path, 1500)?
        .si()
        .body("CubeSat", near, [Shape::cuboid([0.366, 0.2263, 0.1])])
        .body("the Earth, smaller still", |_| Isometry3::identity(), [Shape::ball(earth)])
        .trace("CubeSat", [0.0; 3])
        .trace("CubeSat", [0.183, 0.0, 0.0])
        .arrow("to the Earth", 0.4, move |s| {
            let place = near(s).translation.vector;
            (place, -place.normalize())
        })
        .curve("long axis from the vertical / °", "pitch", |s| pitch(&s.q).to_degrees())
        .curve("energy of rotation / 10⁻⁹ J", "½ ω · I ω", |s| {
            let momentum = kernel.momentum(s.t, &s.q, &s.z);
            0.5e9 * s.z.fixed_rows::<3>(3).dot(&momentum.fixed_rows::<3>(3))
        }))
}
