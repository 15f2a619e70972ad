//! The figures as CSV, as JSON and on the console.

use std::error::Error;
use std::fmt::Write;

use serde_json::{Value, json};

use crate::entry::{Entry, Setting, Side};
use crate::machine::Machine;
use crate::study::{Point, Study};

/// The errors at which methods are compared.
pub const LEVELS: [f64; 10] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

fn kind(setting: Setting) -> &'static str {
    match setting {
        Setting::Step(_) => "step",
        Setting::Tolerance => "tolerance",
        Setting::Once => "span",
    }
}

fn side(side: Side) -> &'static str {
    if side == Side::Gauss { "gauss" } else { "baseline" }
}

/// Every run, one a line.
///
/// # Errors
/// When a line cannot be written.
pub fn csv(studies: &[Study]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record([
        "scene",
        "side",
        "method",
        "chart",
        "form",
        "setting",
        "value",
        "error",
        "evaluations",
        "us_per_s_quartile_1",
        "us_per_s_median",
        "us_per_s_quartile_3",
    ])?;
    for study in studies {
        for point in &study.points {
            let Entry { method, chart, form, side: whose, setting, .. } = &study.entries[point.entry];
            let names = [study.scene.name, side(*whose), method, chart, form, kind(*setting)].map(str::to_owned);
            let numbers = [point.setting, point.error].map(|value| format!("{value:.4e}"));
            let times = point.time.map(|value| format!("{value:.4}"));
            out.write_record(names.into_iter().chain(numbers).chain([point.evaluations.to_string()]).chain(times))?;
        }
    }
    Ok(out.into_inner()?)
}

/// Machine, scenes, gains, fronts and every run.
pub fn json(studies: &[Study], machine: &Machine) -> Value {
    let run = |study: &Study, point: &Point| {
        let entry = &study.entries[point.entry];
        json!({
            "side": side(entry.side), "method": entry.method, "chart": entry.chart, "form": entry.form,
            "setting": kind(entry.setting), "value": point.setting, "error": point.error,
            "evaluations": point.evaluations, "us_per_s": point.time,
        })
    };
    let scene = |study: &Study| {
        let gains: Vec<Value> =
            LEVELS.iter().map(|&error| json!({ "error": error, "times_as_fast": study.gain(error) })).collect();
        let front: Vec<Value> = study.front(|_| true).iter().map(|point| run(study, point)).collect();
        json!({
            "name": study.scene.name, "title": study.scene.title, "duration_s": study.scene.duration,
            "target": study.scene.kind.target(), "gains": gains, "front": front, "refused": study.refused,
            "runs": study.points.iter().map(|point| run(study, point)).collect::<Vec<_>>(),
        })
    };
    json!({
        "machine": { "processor": machine.processor, "cores": machine.cores, "compiler": machine.compiler,
            "target": machine.target, "load": machine.load },
        "scenes": studies.iter().map(scene).collect::<Vec<_>>(),
    })
}

/// How many times as fast as the best baseline Gauss is, scene by scene.
pub fn console(studies: &[Study]) -> String {
    let mut text = format!("{:<42}", "times as fast at an error of");
    for error in LEVELS {
        let _ = write!(text, "{:>7}", format!("{error:.0e}"));
    }
    for study in studies {
        let _ = write!(text, "\n{:<42}", study.scene.title);
        for error in LEVELS {
            let gain = study.gain(error).map_or("–".to_owned(), |gain| format!("{gain:.1}"));
            let _ = write!(text, "{gain:>7}");
        }
    }
    text
}
