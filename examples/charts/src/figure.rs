//! The picture: what is where on it; the motion as a page.

use std::error::Error;

use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use plotters::prelude::*;

use crate::drawing::{Area, COLOURS, INK, text_style};
use crate::measure::{Comparison, EVERYDAY_STEP, PRECISE_RATE, differences, energy_drift, momentum_drift};
use crate::panels::{Curve, LogPanel, Note, View, bars, path};
use crate::timing::Timing;
use crate::vehicle::KirchhoffKernel;

/// Width and height in pixels.
const SIZE: (u32, u32) = (1600, 1300);

/// Draws everything.
///
/// # Errors
/// When a panel cannot be laid out.
pub fn svg(comparison: &Comparison, timings: &[Timing]) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(108);
        header(&head, comparison)?;
        let (main, bottom) = body.split_vertically(780);
        let (left, right) = main.split_horizontally(720);
        let view = View { seconds: 8.0, vehicle_every: 4, grid: 1.0, strokes: [12, 8, 5, 2] };
        path(&left, &comparison.precise, "The first 8 s of the path; the vehicle every 0.4 s, in its size", view)?;
        let (upper, lower) = right.split_vertically(390);
        disagreement(&upper, comparison)?;
        energy(&lower, comparison)?;
        let (left, right) = bottom.split_horizontally(800);
        momentum(&left, comparison)?;
        bars(&right, timings)?;
        root.present()?;
    }
    Ok(svg)
}

fn header(area: &Area<'_>, comparison: &Comparison) -> Result<(), Box<dyn Error>> {
    let title = "One vehicle, one motion, four sets of derived equations";
    area.draw(&Text::new(title, (40, 18), text_style(36, INK)))?;
    let mut x = 42;
    for (run, colour) in comparison.precise.iter().zip(COLOURS) {
        area.draw(&Rectangle::new([(x, 76), (x + 34, 84)], colour.filled()))?;
        area.draw(&Text::new(run.name, (x + 44, 69), text_style(21, INK)))?;
        x += 80 + 12 * run.name.chars().count() as i32;
    }
    let about = "REMUS 100 in an ideal fluid, motor off, parameters of Prestero (2001)";
    area.draw(&Text::new(about, (x + 30, 69), text_style(21, RGBColor(110, 110, 110))))?;
    Ok(())
}

fn curves(runs: &[crate::simulate::Run], series: impl Fn(&crate::simulate::Run) -> Vec<(f64, f64)>) -> Vec<Curve> {
    let curve = |(run, colour)| Curve { points: series(run), colour, width: 2, dashed: false };
    runs.iter().zip(COLOURS).map(curve).collect()
}

fn disagreement(area: &Area<'_>, comparison: &Comparison) -> Result<(), Box<dyn Error>> {
    let distance =
        |run: &_| differences(run, &comparison.reference).iter().map(|&(t, metres, _)| (t, metres)).collect();
    let mut all = curves(&comparison.everyday, distance);
    all.extend(curves(&comparison.precise, distance));
    LogPanel {
        title: "Distance from the reference path, m",
        decades: -16.0..0.0,
        notes: vec![
            Note::new(20.5, -6.3, format!("order 4, {:.0} steps a second", 1.0 / EVERYDAY_STEP)),
            Note::new(20.5, -9.9, format!("order 8, {PRECISE_RATE} steps a second")),
        ],
    }
    .draw(area, &all)
}

fn energy(area: &Area<'_>, comparison: &Comparison) -> Result<(), Box<dyn Error>> {
    let mut all = curves(&comparison.everyday, energy_drift);
    all.extend(curves(&comparison.precise, energy_drift));
    LogPanel {
        title: "Drift of the energy, relative to the largest kinetic energy",
        decades: -18.0..-2.0,
        notes: vec![
            Note::new(20.5, -6.9, format!("order 4, {:.0} steps a second", 1.0 / EVERYDAY_STEP)),
            Note::new(20.5, -11.7, format!("order 8, {PRECISE_RATE} steps a second")),
        ],
    }
    .draw(area, &all)
}

fn momentum(area: &Area<'_>, comparison: &Comparison) -> Result<(), Box<dyn Error>> {
    let [k, _, n_velocity, n_momentum] = comparison.weightless.as_slice() else {
        return Err("four weightless runs are drawn".into());
    };
    // Of the last one the momenta that are integrated, not their copies recomputed from pose and twist.
    let first = n_momentum.moments[0].p;
    let exact = n_momentum.moments.iter().map(|m| (m.t, (m.p - first).norm() / first.norm())).collect();
    let all = [
        Curve { points: momentum_drift(k), colour: COLOURS[0], width: 2, dashed: false },
        Curve { points: momentum_drift(n_velocity), colour: COLOURS[1], width: 2, dashed: false },
        Curve { points: exact, colour: COLOURS[1], width: 4, dashed: true },
    ];
    LogPanel {
        title: "Without gravity: drift of the six space momenta, relative",
        decades: -18.0..-2.0,
        notes: vec![
            Note::new(9.0, -10.6, format!("velocity form, order 4, {:.0} steps a second", 1.0 / EVERYDAY_STEP)),
            Note::new(9.0, -16.4, "Newton–Euler in momentum form: exactly 0, every bit kept".into()),
        ],
    }
    .draw(area, &all)
}

/// The motion, with its momenta in space, which gravity along k₃ changes along k₃ only, and how far each chart is from
/// the reference at an everyday step.
#[must_use]
pub fn page(kernel: &KirchhoffKernel, comparison: &Comparison) -> Playback<KirchhoffKernel> {
    let moments = &comparison.reference.moments;
    let samples = moments.iter().map(|m| Sample { t: m.t, q: m.pose, z: m.twist, p: m.p }).collect();
    let place = |s: &Sample<KirchhoffKernel>| s.q.translation.vector;
    let momentum = |s: &Sample<KirchhoffKernel>| kernel.space_momentum(s.t, &s.q, &s.z);
    let mut page = Playback::of_samples("One vehicle, the motor off, in four charts", samples)
        .si()
        .up([0.0, 0.0, -1.0])
        .body("REMUS 100", |s| kernel.pose(s.t, &s.q), torpedo())
        .follow("REMUS 100")
        .trace("REMUS 100", [0.0; 3])
        .arrow("momentum", 0.01, |s| (place(s), momentum(s).fixed_rows::<3>(0).into()))
        .arrow("velocity", 0.5, |s| (place(s), s.q.rotation * Vector3::from(s.z.fixed_rows::<3>(0))))
        .energy(kernel);
    for run in &comparison.everyday {
        let apart = differences(run, &comparison.reference);
        let last = apart.len() - 1;
        let metres = |s: &Sample<KirchhoffKernel>| apart[apart.partition_point(|d| d.0 < s.t).min(last)].1;
        page = page.curve("distance from the reference, log₁₀ of m", run.name, |s| metres(s).max(1e-16).log10());
    }
    page
}

/// The torpedo of the REMUS 100 and its fins, body axes from the middle: e₁ forward.
#[must_use]
pub fn torpedo() -> [Shape; 3] {
    let fin = |edges: [f64; 3]| Shape::cuboid(edges).at(&Isometry3::translation(-0.63, 0.0, 0.0)).colour("#444444");
    [Shape::ellipsoid([0.665, 0.095, 0.095]), fin([0.09, 0.31, 0.01]), fin([0.09, 0.01, 0.31])]
}
