//! The picture: six panels.

use std::error::Error;

use gauss_charts::drawing::COLOURS;
use gauss_charts::figure::torpedo;
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::Playback;
use gauss_runtime::prelude::*;

use crate::manoeuvres::{Flight, Moment};
use crate::vehicle::RemusKernel;

/// What the panels show.
pub struct Shown<'a> {
    /// Straight run, turning circle, depth change.
    pub flights: [&'a Flight; 3],
    /// Distance (m) from the equations written by hand, over time.
    pub apart: [Vec<(f64, f64)>; 3],
    /// Speed (m/s) over time of the straight run in closed form.
    pub closed: Vec<(f64, f64)>,
}

fn series(flight: &Flight, value: impl Fn(&Moment) -> f64) -> Vec<(f64, f64)> {
    flight.moments.iter().map(|moment| (moment.t, value(moment))).collect()
}

/// Curves over time.
fn over_time<'a>(title: &'a str, end: f64, y: (&'a str, std::ops::Range<f64>), lines: Vec<Line>) -> Plot<'a> {
    Plot::new(title, ("time, s", 0.0..end), y, lines)
}

/// Draws everything.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(shown: &Shown<'_>) -> Result<String, Box<dyn Error>> {
    let [straight, turn, dive] = shown.flights;
    let rows = [
        vec![straight_run(straight, &shown.closed), turning_circle(turn)],
        vec![depth(dive), pitch(dive)],
        vec![powers(turn), distances(&shown.apart)],
    ];
    sheet("REMUS 100: three manoeuvres from the published coefficients", (1700, 1900), &rows)
}

fn straight_run(flight: &Flight, closed: &[(f64, f64)]) -> Plot<'static> {
    let lines = vec![
        Line::new("derived equations", COLOURS[0], series(flight, |m| m.twist[0])),
        Line::new("√(X/|Xᵤᵤ|) tanh t/τ", COLOURS[1], closed.iter().copied().step_by(8)).dashed(),
    ];
    over_time("Straight run from rest, ballasted to neutral buoyancy", 60.0, ("speed, m/s", 0.0..1.8), lines)
}

fn turning_circle(flight: &Flight) -> Plot<'static> {
    let position = |m: &Moment| (m.pose.translation.vector.y, m.pose.translation.vector.x);
    let path = Line::new("", COLOURS[0], flight.moments.iter().map(position));
    let (x, y) = (("east, m", -1.0..14.0), ("north, m", -1.0..25.0));
    Plot::new("Turning circle: rudder 10° to starboard after 10 s", x, y, vec![path]).to_scale().marked(vec![(
        0.0,
        0.0,
        "start".into(),
    )])
}

fn depth(flight: &Flight) -> Plot<'static> {
    let ordered = [(0.0, 2.0), (10.0, 2.0), (10.0, 6.0), (60.0, 6.0)];
    let lines = vec![
        Line::new("ordered", COLOURS[1], ordered).dashed(),
        Line::new("depth of O", COLOURS[0], series(flight, |m| m.pose.translation.vector.z)),
    ];
    over_time("Depth change", 60.0, ("depth, m", 7.0..1.0), lines)
}

fn pitch(flight: &Flight) -> Plot<'static> {
    let pitch = series(flight, |m| m.pose.rotation.euler_angles().1.to_degrees());
    let lines = vec![
        Line::new("pitch", COLOURS[0], pitch),
        Line::new("stern plane", COLOURS[2], series(flight, |m| m.inputs[1].to_degrees())),
    ];
    over_time("Depth change: pitch and stern plane", 60.0, ("angle, °", -25.0..10.0), lines)
}

fn powers(flight: &Flight) -> Plot<'static> {
    let [blue, orange, green, pink] = COLOURS;
    let power = |name: &str, colour, element: usize| Line::new(name, colour, series(flight, |m| m.powers[element]));
    let lines = vec![
        power("propeller", green, 4),
        power("drag", blue, 1),
        power("lift of the hull", orange, 2),
        power("fins", pink, 3),
    ];
    over_time("Turning circle: what each element delivers", 50.0, ("power, W", -7.0..7.0), lines)
}

fn distances(apart: &[Vec<(f64, f64)>; 3]) -> Plot<'static> {
    let lines = [("straight run", 1), ("turning circle", 0), ("depth change", 2)].into_iter().zip(apart);
    let lines = lines.map(|((name, colour), points)| {
        // The first moments are equal: no logarithm.
        let apart = points.iter().filter(|p| p.1 > 0.0).map(|&(t, metres)| (t, metres.log10()));
        Line::new(name, COLOURS[colour], apart)
    });
    let title = "Distance from the equations written by hand";
    over_time(title, 60.0, ("log₁₀ of the distance in m", -16.0..-6.0), lines.collect())
}

/// A flight as a page.
pub fn page(kernel: &RemusKernel, flight: &Flight) -> Playback<RemusKernel> {
    let sample = |m: &Moment| Sample { t: m.t, q: m.pose, z: m.twist, p: kernel.momentum(m.t, &m.pose, &m.twist) };
    let velocity = |s: &Sample<RemusKernel>| (s.q.translation.vector, s.q.rotation * s.z.fixed_rows::<3>(0));
    let mut page = Playback::of_samples("The REMUS 100 turns", flight.moments.iter().map(sample).collect())
        .si()
        .up([0.0, 0.0, -1.0])
        .body("REMUS 100", |s| s.q, torpedo())
        .follow("REMUS 100")
        .trace("REMUS 100", [0.0; 3])
        .arrow("velocity", 0.6, velocity)
        .curve("velocity in its axes / (m/s)", "ahead", |s| s.z[0])
        .curve("velocity in its axes / (m/s)", "to starboard", |s| s.z[1]);
    for (k, name) in ["roll", "pitch"].into_iter().enumerate() {
        let angle = move |s: &Sample<RemusKernel>| {
            let (roll, pitch, _) = s.q.rotation.euler_angles();
            [roll, pitch][k].to_degrees()
        };
        page = page.curve("angle / °", name, angle);
    }
    page.energy(kernel)
}
