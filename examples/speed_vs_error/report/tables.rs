//! The figures as CSV, as JSON and on the console.

use std::error::Error;

use serde_json::{Value, json};

use crate::measure::comparison::{Fastest, LEVELS, Total, Verdict};
use crate::measure::entry::{Entry, Setting, Side};
use crate::measure::study::{Point, Study};

use super::machine::Machine;

fn kind(setting: Setting) -> &'static str {
    match setting {
        Setting::Step(_) | Setting::LongStep(_) => "step",
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
        "rounds",
    ])?;
    for study in studies {
        for point in &study.points {
            let Entry { method, chart, form, side: whose, setting, .. } = &study.entries[point.entry];
            let names = [study.scene.about.name, side(*whose), method, chart, form, kind(*setting)].map(str::to_owned);
            let numbers = [point.setting, point.error].map(|value| format!("{value:.4e}"));
            let times = point.time.map(|value| format!("{value:.4}"));
            let (evaluations, rounds) = (point.evaluations.to_string(), point.rounds.to_string());
            out.write_record(names.into_iter().chain(numbers).chain([evaluations]).chain(times).chain([rounds]))?;
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
            "evaluations": point.evaluations, "us_per_s": point.time, "rounds": point.rounds,
        })
    };
    let scene = |study: &Study| {
        let levels = LEVELS.map(|error| {
            let pair = study.pair(error);
            let side = |fastest: Option<Fastest>| {
                fastest.map(|fastest| {
                    let entry = &study.entries[fastest.run.entry];
                    json!({ "method": entry.method, "chart": entry.chart, "form": entry.form, "us_per_s": fastest.time })
                })
            };
            let gain = if let Verdict::Gain(gain) = pair.verdict() { Some(gain) } else { None };
            json!({ "error": error, "gauss": side(pair.ours), "baseline": side(pair.theirs), "times_as_fast": gain })
        });
        let front: Vec<Value> = study.front(|_| true).iter().map(|point| run(study, point)).collect();
        json!({
            "name": study.scene.about.name, "title": study.scene.about.title, "duration_s": study.scene.duration,
            "target": study.scene.about.kind.target(), "levels": levels, "front": front, "refused": study.refused,
            "runs": study.points.iter().map(|point| run(study, point)).collect::<Vec<_>>(),
        })
    };
    let Total { pairs, met, faster, geometric_mean } = Total::of(studies);
    json!({
        "machine": { "processor": machine.processor, "cores": machine.cores, "compiler": machine.compiler,
            "target": machine.target, "instructions": machine.instructions, "build": machine.build, "load": machine.load },
        "total": { "scenes_and_errors": pairs, "target_met": met, "faster": faster, "geometric_mean": geometric_mean },
        "scenes": studies.iter().map(scene).collect::<Vec<_>>(),
    })
}

/// A gain in a few letters.
pub fn short(verdict: Verdict) -> String {
    match verdict {
        Verdict::Gain(gain) if gain >= 99.5 => format!("{gain:.0}"),
        Verdict::Gain(gain) => format!("{gain:.1}"),
        Verdict::OnlyOurs => "only".into(),
        Verdict::OnlyTheirs => "not".into(),
        Verdict::Nobody => "–".into(),
    }
}

/// How many times as fast as the best baseline Gauss is, scene by scene.
pub fn console(studies: &[Study]) -> String {
    let line = |name: &str, cells: [String; LEVELS.len()]| {
        cells.iter().fold(format!("{name:<42}"), |line, cell| format!("{line}{cell:>7}")) + "\n"
    };
    let mut text = line("times as fast at an error of", LEVELS.map(|error| format!("{error:.0e}")));
    for study in studies {
        text += &line(study.scene.about.title, LEVELS.map(|error| short(study.pair(error).verdict())));
    }
    let Total { pairs, met, faster, geometric_mean } = Total::of(studies);
    text + &format!(
        "of {pairs} scenes and errors faster in {faster}, target met in {met}; geometric mean {geometric_mean:.2}\n\
         only: no baseline gets there; not: Gauss does not\n"
    )
}
