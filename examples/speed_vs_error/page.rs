//! One page of HTML with everything in it: no script, no file beside it.

use std::fmt::Write;

use crate::chart::{Chart, escaped};
use crate::entry::{Entry, Setting, Side};
use crate::machine::Machine;
use crate::plots;
use crate::study::{Point, Study};
use crate::tables::LEVELS;

const STYLE: &str = "
body { font: 16px/1.5 sans-serif; color: #2d2d2d; max-width: 1180px; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { margin-top: 3rem; border-top: 1px solid #ccc; padding-top: 1.2rem; font-size: 1.35rem; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .88rem; font-variant-numeric: tabular-nums; }
td, th { padding: .22rem .6rem; text-align: right; border-bottom: 1px solid #e2e2e2; }
td:first-child, th:first-child, .text { text-align: left; }
.met { background: #cfe8dd; } .ahead { background: #eef4f1; } .behind { background: #f8ddc9; }
.dim { color: #6a6a6a; } svg { max-width: 100%; height: auto; display: block; margin: .6rem 0; }
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
    let Machine { processor, cores, compiler, target, load } = machine;
    let quick = if quick { "<p><b>A quick run: times are rough, and fewer settings were tried.</b></p>" } else { "" };
    format!(
        "<p>Every method of Gauss on every chart and in both forms, and what one would otherwise use, on scenes whose end \
         states are known to 36 digits (three of them to 16). The <b>error</b> is the largest difference of an entry of the \
         rotation matrix (rad, where it is small) or of a component of a position at the end of the motion, relative to the \
         largest component where that is above 1. The <b>time</b> is that of one thread, per simulated second: the median of \
         rounds in which all settings take turns, with quartiles.</p>\n\
         <p>Baselines run in the same rounds on equations written by hand in body-frame velocities and a quaternion (pendulums: \
         angles or Cartesian coordinates), with constants worked out in advance: DOP853 of <code>ode_solvers</code> and of \
         <code>differential-equations</code>, without dense output where that can be said; the method of Runge and Kutta with \
         normalised quaternions; and the semi-implicit step of game engines. Relative and absolute tolerances are \
         equal, for everybody.</p>\n{quick}\
         <p class=\"dim\">{} ({cores} cores, one used) · {} · {} · load averages at the start {}</p>\n",
        escaped(processor),
        escaped(compiler),
        escaped(target),
        escaped(load)
    )
}

fn superscript(error: f64) -> String {
    format!("10<sup>−{:.0}</sup>", -error.log10())
}

/// How many times as fast, scene by scene.
fn summary(studies: &[Study]) -> String {
    let mut html =
        "<h2>How many times as fast as the best baseline</h2>\n<table><tr><th>scene</th><th>target</th>".to_owned();
    for error in LEVELS {
        let _ = write!(html, "<th>{}</th>", superscript(error));
    }
    html += "</tr>\n";
    let (mut met, mut ahead, mut all) = (0, 0, 0);
    for study in studies {
        let target = study.scene.kind.target();
        let (name, title) = (study.scene.name, escaped(study.scene.title));
        let _ = write!(html, "<tr><td><a href=\"#{name}\">{title}</a></td><td>{target}</td>");
        for error in LEVELS {
            let Some(gain) = study.gain(error) else {
                let ours = study.fastest(error, |entry| entry.side == Side::Gauss).is_some();
                html += if ours { "<td class=\"met\">only Gauss</td>" } else { "<td class=\"dim\">–</td>" };
                continue;
            };
            all += 1;
            met += usize::from(gain >= target);
            ahead += usize::from(gain >= 1.0);
            let class = if gain >= target {
                "met"
            } else if gain >= 1.0 {
                "ahead"
            } else {
                "behind"
            };
            let _ = write!(html, "<td class=\"{class}\">{gain:.1}</td>");
        }
        html += "</tr>\n";
    }
    html += "</table>\n";
    html + &format!(
        "<p>Columns: error at the end. Green: the target of the project is met (5 times as fast for tops and bodies in fluid, 3 \
         times elsewhere); pale: faster; orange: slower; –: neither gets there. Of {all} pairs of scene and error \
         the target is met in {met}, and Gauss is faster in {ahead}.</p>\n"
    )
}

fn section(study: &Study) -> String {
    let scene = &study.scene;
    let mut html = format!(
        "<h2 id=\"{}\">{}</h2>\n<p>{} <span class=\"dim\">{} s of motion, {} runs.{}</span></p>\n",
        scene.name,
        escaped(scene.title),
        escaped(&scene.description),
        scene.duration,
        study.points.len(),
        match study.refused {
            0 => String::new(),
            n => format!(" {n} settings were refused: steps too long, or near a singularity of the coordinates."),
        }
    );
    html += &plots::work_precision(study).with_legend();
    html += &levels(study);
    let further: Vec<(&str, Chart)> = [
        ("Evaluations of the equations", Some(plots::evaluations(study))),
        ("Charts and forms", Some(plots::charts(study))),
        ("Energy over a long run", plots::drift(study)),
    ]
    .into_iter()
    .filter_map(|(name, chart)| Some((name, chart?)))
    .collect();
    for (name, chart) in further {
        let _ = write!(html, "<details><summary>{name}</summary>{}</details>\n", chart.with_legend());
    }
    html + &front(study)
}

fn setting(entry: &Entry, point: &Point) -> String {
    match entry.setting {
        Setting::Once => "one call".into(),
        Setting::Tolerance => format!("tolerance {:.0e}", point.setting),
        Setting::Step(_) => format!("h = {:.2e} s", point.setting),
    }
}

fn cells(study: &Study, point: Option<Point>) -> String {
    let Some(point) = point else { return "<td class=\"text dim\">none</td><td></td><td></td>".into() };
    let entry = &study.entries[point.entry];
    let [low, median, high] = point.time;
    format!(
        "<td class=\"text\">{}<br><span class=\"dim\">{}, {}, {}</span></td>\
         <td>{median:.3}<br><span class=\"dim\">{low:.3}–{high:.3}</span></td><td>{:.0}</td>",
        escaped(entry.method),
        escaped(entry.chart),
        entry.form,
        setting(entry, &point),
        point.evaluations as f64 / study.scene.duration
    )
}

/// The best of both sides at every level.
fn levels(study: &Study) -> String {
    let mut html = "<table><tr><th>error at most</th><th class=\"text\">fastest of Gauss</th><th>µs/s</th><th>evaluations/s</th>\
                    <th class=\"text\">fastest baseline</th><th>µs/s</th><th>evaluations/s</th><th>times as fast</th></tr>\n"
        .to_owned();
    for error in LEVELS {
        let of = |side| cells(study, study.fastest(error, |entry| entry.side == side));
        let gain = study.gain(error).map_or("–".to_owned(), |gain| format!("{gain:.1}"));
        let _ = writeln!(
            html,
            "<tr><td>{}</td>{}{}<td>{gain}</td></tr>",
            superscript(error),
            of(Side::Gauss),
            of(Side::Baseline)
        );
    }
    html + "</table>\n"
}

/// The runs that no other run beats.
fn front(study: &Study) -> String {
    let mut html = "<details><summary>Pareto front: the runs that none beats in both time and error</summary>\n<table>\
                    <tr><th>error</th><th class=\"text\">method</th><th>µs/s</th><th>evaluations/s</th></tr>\n"
        .to_owned();
    for point in study.front(|_| true) {
        let _ = writeln!(html, "<tr><td>{:.1e}</td>{}</tr>", point.error, cells(study, Some(point)));
    }
    html + "</table></details>\n"
}
