//! The picture: six panels.

use std::error::Error;

use gauss_examples::figure::{Area, COLOURS, INK, text_style};
use gauss_examples::lines::{Axis, Line, Panel};
use plotters::prelude::*;

use crate::manoeuvres::{Flight, Moment};

/// Width and height in pixels.
const SIZE: (u32, u32) = (1640, 1760);

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

fn line(points: Vec<(f64, f64)>, colour: RGBColor, name: (&'static str, f64, f64)) -> Line {
    Line { points, colour, width: 4, dashed: false, name }
}

fn time(end: f64) -> Axis {
    Axis::linear("time, s", 0.0..end)
}

/// Draws everything.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn draw(shown: &Shown<'_>) -> Result<String, Box<dyn Error>> {
    let [straight, turn, dive] = shown.flights;
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let title = "REMUS 100: three manoeuvres from the published coefficients";
        root.draw(&Text::new(title, (30, 22), text_style(36, INK)))?;
        let (_, body) = root.split_vertically(80);
        let panels = body.split_evenly((3, 2));

        straight_run(&panels[0], straight, &shown.closed)?;
        turning_circle(&panels[1], turn)?;
        depth(&panels[2], dive)?;
        pitch(&panels[3], dive)?;
        powers(&panels[4], turn)?;
        distances(&panels[5], &shown.apart)?;
        root.present()?;
    }
    Ok(svg)
}

type Drawn = Result<(), Box<dyn Error>>;

fn straight_run(area: &Area<'_>, straight: &Flight, closed: &[(f64, f64)]) -> Drawn {
    let [blue, orange, ..] = COLOURS;
    let sparse = closed.iter().copied().step_by(8);
    Panel {
        title: "Straight run from rest, ballasted to neutral buoyancy".into(),
        x: time(60.0),
        y: Axis::linear("speed, m/s", 0.0..1.8),
        equal: false,
    }
    .draw(
        area,
        &[
            line(series(straight, |m| m.twist[0]), blue, ("derived equations", 22.0, 1.30)),
            Line { dashed: true, ..line(sparse.collect(), orange, ("√(X/|Xᵤᵤ|) tanh t/τ", 22.0, 1.12)) },
        ],
    )
}

fn turning_circle(area: &Area<'_>, turn: &Flight) -> Drawn {
    let position = |m: &Moment| (m.pose.translation.vector.y, m.pose.translation.vector.x);
    Panel {
        title: "Turning circle: rudder 10° to starboard after 10 s".into(),
        x: Axis::linear("east, m", -1.0..14.0),
        y: Axis::linear("north, m", -1.0..25.0),
        equal: true,
    }
    .draw(area, &[line(turn.moments.iter().map(position).collect(), COLOURS[0], ("start", 0.7, 0.0))])
}

fn depth(area: &Area<'_>, dive: &Flight) -> Drawn {
    let [blue, orange, ..] = COLOURS;
    let ordered = vec![(0.0, 2.0), (10.0, 2.0), (10.0, 6.0), (60.0, 6.0)];
    Panel { title: "Depth change".into(), x: time(60.0), y: Axis::linear("depth, m", 7.0..1.0), equal: false }.draw(
        area,
        &[
            Line { dashed: true, ..line(ordered, orange, ("ordered", 12.0, 5.6)) },
            line(series(dive, |m| m.pose.translation.vector.z), blue, ("depth of O", 22.0, 4.0)),
        ],
    )
}

fn pitch(area: &Area<'_>, dive: &Flight) -> Drawn {
    let [blue, _, green, _] = COLOURS;
    Panel {
        title: "Depth change: pitch and stern plane".into(),
        x: time(60.0),
        y: Axis::linear("angle, °", -25.0..10.0),
        equal: false,
    }
    .draw(
        area,
        &[
            line(series(dive, |m| m.pose.rotation.euler_angles().1.to_degrees()), blue, ("pitch", 17.0, -19.0)),
            line(series(dive, |m| m.inputs[1].to_degrees()), green, ("stern plane", 12.5, 4.0)),
        ],
    )
}

fn powers(area: &Area<'_>, turn: &Flight) -> Drawn {
    let [blue, orange, green, pink] = COLOURS;
    let power = |element: usize| series(turn, move |m| m.powers[element]);
    Panel {
        title: "Turning circle: what each element delivers".into(),
        x: time(50.0),
        y: Axis::linear("power, W", -7.0..7.0),
        equal: false,
    }
    .draw(
        area,
        &[
            line(power(4), green, ("propeller", 36.0, 4.1)),
            line(power(1), blue, ("drag", 36.0, -2.8)),
            line(power(2), orange, ("lift of the hull", 36.0, -1.42)),
            line(power(3), pink, ("fins", 36.0, 0.4)),
        ],
    )
}

fn distances(area: &Area<'_>, apart: &[Vec<(f64, f64)>; 3]) -> Drawn {
    let [blue, orange, green, _] = COLOURS;
    let [far_straight, far_turn, far_dive] = apart;
    // The first moments are equal: no logarithm.
    let logarithm = |points: &[(f64, f64)]| {
        points.iter().filter(|p| p.1 > 0.0).map(|&(t, metres)| (t, metres.log10())).collect::<Vec<_>>()
    };
    Panel {
        title: "Distance from the equations written by hand".into(),
        x: time(60.0),
        y: Axis { decades: true, ..Axis::linear("distance, m", -16.0..-6.0) },
        equal: false,
    }
    .draw(
        area,
        &[
            line(logarithm(far_straight), orange, ("straight run", 36.0, -13.2)),
            line(logarithm(far_turn), blue, ("turning circle", 20.0, -9.3)),
            line(logarithm(far_dive), green, ("depth change", 36.0, -10.55)),
        ],
    )
}
