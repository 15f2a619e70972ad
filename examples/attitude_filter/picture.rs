//! The picture: errors within what the filter takes them for, and filters with other transition matrices.

use std::error::Error;

use gauss_charts::drawing::{COLOURS, INK};
use gauss_examples::plots::{Line, Plot, sheet};
use gauss_playback::{Playback, Shape};
use gauss_runtime::prelude::*;
use plotters::style::RGBColor;

use crate::filter::{Moment, Transition};
use crate::model::{ARCSECOND, STEP, STEPS, SpacecraftKernel, Truth, spacecraft};
use crate::study::{Followed, interval};

/// Other motions, behind the one that is drawn.
const FAINT: RGBColor = RGBColor(178, 205, 227);
/// How many of them.
const OTHERS: usize = 15;

/// Draws four panels.
///
/// # Errors
/// When they cannot be laid out.
pub fn draw(followed: &[Followed]) -> Result<String, Box<dyn Error>> {
    let look = STEP * STEPS as f64;
    let rows = [errors_within_bounds(followed, look), by_transition(followed, look)];
    sheet("A tumbling satellite, its star tracker every ten seconds, and no gyroscope", (1800, 1300), &rows)
}

/// Errors of single motions beside what the filter takes them for.
fn errors_within_bounds(followed: &[Followed], look: f64) -> Vec<Plot<'static>> {
    let span = 2.0 * look..32.0 * look;
    let within = |title, unit, component: usize, height: f64| {
        let runs = &followed[0].runs;
        // Times from the second look on, when the rate is known.
        let curve = |run: &[Moment], value: &dyn Fn(&Moment) -> f64| -> Vec<(f64, f64)> {
            let kept = run.iter().filter(|m| m.t > span.start && m.t <= span.end || m.t == span.start && m.updated);
            kept.map(|m| (m.t, (value(m) / ARCSECOND).clamp(-height, height))).collect()
        };
        let error = |m: &Moment| m.error[component];
        let mut lines: Vec<Line> =
            runs.iter().skip(1).take(OTHERS).map(|run| Line::new("", FAINT, curve(run, &error)).wide(2)).collect();
        lines.push(Line::new("one motion, others behind it", COLOURS[0], curve(&runs[0], &error)).wide(4));
        let bound = |sign: f64| curve(&runs[0], &|m: &Moment| sign * 3.0 * m.deviations[component]);
        lines.push(Line::new("±3σ of the filter", COLOURS[1], bound(1.0)).wide(3));
        lines.push(Line::new("", COLOURS[1], bound(-1.0)).wide(3));
        Plot::new(title, ("time, s", span.clone()), (unit, -height..height), lines)
    };
    let attitude = within("Error of the attitude about e₁", "arcseconds", 0, 240.0);
    let rate = within("Error of the rate about e₁", "arcseconds per second", 3, 36.0);
    vec![attitude, rate]
}

/// What the transition matrix does to the errors.
fn by_transition(followed: &[Followed], look: f64) -> Vec<Plot<'static>> {
    let short = |transition| match transition {
        Transition::Exact => "of the step, exact",
        Transition::FirstOrder => "1 + hF, 1 s",
        Transition::FirstOrderPerLook => "1 + TF, 10 s",
    };
    let colours = [COLOURS[0], COLOURS[2], COLOURS[1]];
    let (low, high) = interval(followed[0].runs.len());
    let end = followed[0].runs[0].last().map_or(0.0, |m| m.t);
    // What is larger is cut off, and written.
    let (bottom, top) = (3.5, 9.0);
    let mut lines = vec![
        Line::new("", INK, [(look, low), (end, low)]).dashed().wide(3),
        Line::new("", INK, [(look, high), (end, high)]).dashed().wide(3),
    ];
    for (all, colour) in followed.iter().zip(colours).rev() {
        let points = all.after_looks().into_iter().map(|look| (look.t, look.normalised.min(top)));
        lines.push(Line::new(short(all.transition), colour, points));
    }
    let worst = followed[followed.len() - 1].after_looks();
    let above = format!("{:.0} at 20 s, {:.0} at 30 s", worst[1].normalised, worst[2].normalised);
    let normalised = Plot::new(
        "eᵀP⁻¹e, mean of all motions: 95 % should lie between the dashes",
        ("time, s", look..end),
        ("normalised error squared", bottom..top + 0.4),
        lines,
    )
    .marked(vec![(worst[2].t, top, above)]);
    let beginning = 2.0 * look..12.0 * look;
    let mut lines = vec![];
    for (all, colour) in followed.iter().zip(colours).rev() {
        let seen = all.after_looks().into_iter().filter(|look| look.t >= beginning.start && look.t <= beginning.end);
        lines.push(Line::new(short(all.transition), colour, seen.map(|look| (look.t, look.rate.0 / ARCSECOND))));
    }
    let learnt = Plot::new(
        "Error of the rate, root mean square, by transition matrix",
        ("time, s", beginning.clone()),
        ("arcseconds per second", 0.0..150.0),
        lines,
    );
    vec![normalised, learnt]
}

/// One of the motions: the satellite, where the filter takes it to look, and how wrong that is.
pub fn page(kernel: &SpacecraftKernel, truth: &Truth, run: &[Moment]) -> Playback<SpacecraftKernel> {
    // After each step, before what the tracker sees then.
    let moments: Vec<&Moment> = run.iter().filter(|m| !m.updated).collect();
    let at = |s: &Sample<SpacecraftKernel>| moments[((s.t / STEP).round() as usize).min(moments.len() - 1)];
    let part = |v: &Vector6<f64>, from: usize| -> Vector3<f64> { v.fixed_rows::<3>(from).into() };
    let estimated = |s: &Sample<SpacecraftKernel>| s.q.retract(&-part(&at(s).error, 0));
    let log_arcseconds = |v: &Vector6<f64>, from: usize| (part(v, from).norm() / ARCSECOND).log10();
    Playback::of_samples("A filter follows a satellite", truth.samples.clone())
        .si()
        .body(
            "satellite",
            |s| Isometry3::from_parts(Translation3::identity(), s.q),
            [
                Shape::of_inertia(30.0, [0.0; 3], &spacecraft().inertia),
                Shape::cylinder(0.08, 0.2).at(&Isometry3::translation(0.0, 0.0, 0.35)).colour("#444444"),
            ],
        )
        .trace("satellite", [0.0, 0.0, 0.8])
        .arrow("where the tracker looks", 0.8, |s| (Vector3::zeros(), s.q * Vector3::z()))
        .arrow("where the filter takes it to look", 0.8, |s| (Vector3::zeros(), estimated(s) * Vector3::z()))
        .arrow("angular velocity", 10.0, |s| (Vector3::zeros(), s.q * s.z))
        .curve("attitude, log₁₀ of ″", "error", |s| log_arcseconds(&at(s).error, 0))
        .curve("attitude, log₁₀ of ″", "as the filter has it", |s| log_arcseconds(&at(s).deviations, 0))
        .curve("rate, log₁₀ of ″/s", "error", |s| log_arcseconds(&at(s).error, 3))
        .curve("rate, log₁₀ of ″/s", "as the filter has it", |s| log_arcseconds(&at(s).deviations, 3))
        .curve("energy / J", "of rotation", |s| kernel.kinetic_energy(s.t, &s.q, &s.z))
}
