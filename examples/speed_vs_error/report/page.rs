//! One page of HTML with everything in it: no script, no file beside it.

use crate::measure::about::Kind;
use crate::measure::comparison::{Fastest, LEVELS, Total, Verdict};
use crate::measure::entry::{Entry, Setting, Side};
use crate::measure::scene::{Figure, Published};
use crate::measure::study::{Point, Study};

use super::chart::escaped;
use super::machine::Machine;
use super::plots;
use super::tables::short;

const STYLE: &str = "
body { font: 16px/1.5 sans-serif; color: #2d2d2d; max-width: 1380px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { margin-top: 3rem; border-top: 1px solid #ccc; padding-top: 1.2rem; font-size: 1.35rem; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .88rem; font-variant-numeric: tabular-nums; }
td, th { padding: .22rem .6rem; text-align: right; border-bottom: 1px solid #e2e2e2; }
td:first-child, th:first-child, .text { text-align: left; }
.met { background: #cfe8dd; } .ahead { background: #eef4f1; } .behind { background: #f8ddc9; }
.dim { color: #6a6a6a; } 
.small { font-size: .72rem; white-space: normal; display: inline-block; width: 5rem; line-height: 1.25; }
svg { max-width: 100%; height: auto; display: block; margin: .6rem 0; }
td { white-space: nowrap; } .text { white-space: normal; }
summary { cursor: pointer; color: #0072b2; }
";

/// The page.
pub fn page(studies: &[Study], machine: &Machine, quick: bool) -> String {
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Gauss: speed against error</title>\
         <meta name=\"viewport\" content=\"width=device-width\"><style>{STYLE}</style></head><body>\n\
         <h1>Gauss: speed against error</h1>\n"
    );
    html += &introduction(machine, quick);
    html += &summary(studies);
    for study in studies {
        html += &section(study);
    }
    html + "</body></html>\n"
}

fn introduction(machine: &Machine, quick: bool) -> String {
    let Machine { processor, cores, compiler, target, instructions, build, load } = machine;
    let quick = if quick { "<p><b>A quick run: times are rough, and fewer settings were tried.</b></p>" } else { "" };
    format!(
        "<p>Every method of Gauss on every chart and in both forms, and what one would otherwise use, on scenes \
         whose end states are known to 36 digits (trajectories A, B and C to 13). The <b>error</b> is that of the \
         final attitude, rad, or of the final position where that is larger, relative to its largest component where \
         that is above 1. The <b>time</b> is that of one thread, per simulated second: the median, with quartiles, \
         of rounds in which all runs take turns, each for a millisecond or more. Runs that are several times slower \
         than one that is as accurate are timed twice, and the smaller time is given. An <b>evaluation</b> is one of \
         the accelerations or of the rates of momentum; of Taylor's method it is a series with all its orders, and \
         of what moves free bodies without looking at forces a free motion.</p>\n\
         <p>Baselines run in the same rounds on equations written by hand, flat, in the variables that suit them \
         best (body-frame velocities or momenta and a quaternion; angles or Cartesian coordinates for systems on \
         scalars), with constants worked out in advance: DOP853 of <code>ode_solvers</code> and of \
         <code>differential-equations</code>, without dense output where that can be said; the method of Runge and \
         Kutta with normalised quaternions; and the semi-implicit step of game engines. Relative and absolute \
         tolerances are equal, for everybody.</p>\n{quick}\
         <p class=\"dim\">{} ({cores} cores, one used) · {} · {} · {build}, compiled for {}; \
         the same for Gauss and the baselines · load averages at the start {}</p>\n",
        escaped(processor),
        escaped(compiler),
        escaped(target),
        escaped(instructions),
        escaped(load)
    )
}

fn superscript(error: f64) -> String {
    format!("10<sup>−{:.0}</sup>", -error.log10())
}

/// How many times as fast, scene by scene.
fn summary(studies: &[Study]) -> String {
    let head: String = LEVELS.iter().map(|&error| format!("<th>{}</th>", superscript(error))).collect();
    let rows: String = studies.iter().map(summary_row).collect();
    let kinds = [("tops", Kind::Top), ("bodies in fluid", Kind::Fluid), ("the others", Kind::Other)];
    let means: Vec<String> = kinds
        .into_iter()
        .map(|(name, kind)| {
            let total = Total::of(studies.iter().filter(|study| study.scene.about.kind == kind));
            format!("{name}: {:.2} ({} of {} met)", total.geometric_mean, total.met, total.pairs)
        })
        .collect();
    let Total { pairs, met, faster, geometric_mean } = Total::of(studies);
    format!(
        "<h2>How many times as fast as the best baseline</h2>\n\
         <table><tr><th>scene</th><th>target</th>{head}</tr>\n{rows}</table>\n\
         <p>Columns: error at the end; times are read on straight lines between the runs of one method, on \
         logarithmic scales. Under each gain the method of Gauss. Green: the target of the project is met (5 times \
         as fast for tops and bodies in fluid, 3 times elsewhere); pale: faster; orange: slower; only: no baseline \
         gets there; not: Gauss does not; –: neither.</p>\n\
         <p>Of {pairs} pairs of scene and error the target is met in <b>{met}</b>, and Gauss is faster in \
         <b>{faster}</b>. Geometric mean of the gains: <b>{geometric_mean:.2}</b>; {}.</p>\n",
        means.join("; ")
    )
}

fn summary_row(study: &Study) -> String {
    let about = study.scene.about;
    let target = about.kind.target();
    let cell = |error| {
        let pair = study.pair(error);
        let verdict = pair.verdict();
        let class = match verdict {
            Verdict::OnlyOurs => "met",
            Verdict::Gain(gain) if gain >= target => "met",
            Verdict::Gain(gain) if gain >= 1.0 => "ahead",
            Verdict::Gain(_) | Verdict::OnlyTheirs => "behind",
            Verdict::Nobody => "dim",
        };
        let method = pair.ours.map_or("", |ours| study.entries[ours.run.entry].method);
        format!("<td class=\"{class}\">{}<br><span class=\"dim small\">{}</span></td>", short(verdict), escaped(method))
    };
    let cells: String = LEVELS.into_iter().map(cell).collect();
    format!("<tr><td><a href=\"#{}\">{}</a></td><td>{target}</td>{cells}</tr>\n", about.name, escaped(about.title))
}

fn section(study: &Study) -> String {
    let scene = &study.scene;
    let refused = match study.refused {
        0 => String::new(),
        n => format!(" {n} settings were refused: steps too long, or near a singularity of the coordinates."),
    };
    let floor = scene.sensitivity.map_or(String::new(), |change| {
        format!(" One rounding of the start changes the end by {:.0e}.", change * 0.5 * f64::EPSILON)
    });
    let mut html = format!(
        "<h2 id=\"{}\">{}</h2>\n<p>{} <span class=\"dim\">{} s of motion, {} runs.{floor}{refused}</span></p>\n",
        scene.about.name,
        escaped(scene.about.title),
        escaped(&scene.description),
        scene.duration,
        study.points.len(),
    );
    html += &plots::work_precision(study).with_legend();
    html += &levels(study);
    html += &scene.published.as_ref().map(|published| others(study, published)).unwrap_or_default();
    let further = [
        ("Evaluations of the equations", Some(plots::evaluations(study))),
        ("Charts and forms", Some(plots::charts(study))),
        ("Energy over a long run", plots::drift(study)),
    ];
    for (name, chart) in further {
        if let Some(chart) = chart {
            html += &format!("<details><summary>{name}</summary>{}</details>\n", chart.with_legend());
        }
    }
    html + &pareto(study)
}

fn setting(entry: &Entry, point: &Point) -> String {
    match entry.setting {
        Setting::Once => "one call".into(),
        Setting::Tolerance => format!("tolerance {:.0e}", point.setting),
        Setting::Step(_) | Setting::LongStep(_) => format!("h = {:.2e} s", point.setting),
    }
}

fn name_and_setting(study: &Study, point: &Point) -> String {
    let entry = &study.entries[point.entry];
    format!(
        "<td class=\"text\">{}<br><span class=\"dim\">{}, {}, {}</span></td>",
        escaped(entry.method),
        escaped(entry.chart),
        entry.form,
        setting(entry, point)
    )
}

fn evaluations(study: &Study, point: &Point) -> f64 {
    point.evaluations as f64 / study.scene.duration
}

/// A number with three digits.
fn three(value: f64) -> String {
    let after = (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
    format!("{value:.after$}")
}

/// The best of both sides at every level.
fn levels(study: &Study) -> String {
    let side = |fastest: Option<Fastest>| match fastest {
        None => "<td class=\"text dim\">none</td><td></td><td></td>".into(),
        Some(Fastest { time, run }) => format!(
            "{}<td>{}<br><span class=\"dim\">±{:.0} %</span></td><td>{}</td>",
            name_and_setting(study, &run),
            three(time),
            50.0 * (run.time[2] - run.time[0]) / run.median(),
            three(evaluations(study, &run))
        ),
    };
    let row = |error| {
        let pair = study.pair(error);
        let (ours, theirs, gain) = (side(pair.ours), side(pair.theirs), short(pair.verdict()));
        format!("<tr><td>{}</td>{ours}{theirs}<td>{gain}</td></tr>\n", superscript(error))
    };
    let rows: String = LEVELS.into_iter().map(row).collect();
    format!(
        "<table><tr><th>error</th><th class=\"text\">fastest of Gauss</th><th>µs/s</th><th>evaluations/s</th>\
         <th class=\"text\">fastest baseline</th><th>µs/s</th><th>evaluations/s</th><th>times as fast</th></tr>\n{rows}</table>\n\
         <p class=\"dim\">Times at the error, ± half the distance of the quartiles; setting and evaluations are \
         those of the run with the next smaller error.</p>\n"
    )
}

/// What others published of the same motion, beside what was measured here at the same error.
fn others(study: &Study, published: &Published) -> String {
    let here = |side, error| {
        let fastest = study.fastest(error, side);
        fastest.map_or("–".into(), |fastest| three(fastest.time))
    };
    let row = |figure: &Figure| {
        format!(
            "<tr><td>{}</td><td class=\"text\">{}</td><td>{:.1e}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&figure.system),
            escaped(&figure.setting),
            figure.error,
            figure.time,
            here(Side::Gauss, figure.error),
            here(Side::Baseline, figure.error),
        )
    };
    let rows: String = published.figures.iter().map(row).collect();
    let reached = study.fastest(1e-11, Side::Gauss);
    let verdict = match reached {
        None => "not reached".into(),
        Some(fastest) => {
            let met = if fastest.time < published.goal { "met" } else { "not met" };
            format!(
                "{} µs per simulated second by {}: {met}",
                three(fastest.time),
                study.entries[fastest.run.entry].method
            )
        }
    };
    format!(
        "<h3>Published figures of the same motion</h3>\n<p class=\"dim\">{}</p>\n\
         <table><tr><th>program</th><th class=\"text\">setting</th><th>error, rad</th><th>µs/s, published</th>\
         <th>Gauss here, same error</th><th>best baseline here</th></tr>\n{rows}</table>\n\
         <p>Target: an error of 1e-11 in less than {} µs per simulated second on a machine like that. Here: \
         {verdict}.</p>\n",
        escaped(&published.about),
        published.goal
    )
}

/// The runs that no other run beats.
fn pareto(study: &Study) -> String {
    let row = |point: &Point| {
        let [low, median, high] = point.time.map(three);
        format!(
            "<tr><td>{:.1e}</td>{}<td>{median}<br><span class=\"dim\">{low}–{high}</span></td><td>{}</td></tr>\n",
            point.error,
            name_and_setting(study, point),
            three(evaluations(study, point))
        )
    };
    let rows: String = study.front(|_| true).iter().map(row).collect();
    format!(
        "<details><summary>Pareto front: the runs that none beats in both time and error</summary>\n<table>\
         <tr><th>error</th><th class=\"text\">method</th><th>µs/s</th><th>evaluations/s</th></tr>\n{rows}</table></details>\n"
    )
}
