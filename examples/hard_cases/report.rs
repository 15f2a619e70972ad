//! The results as a table for people, and as CSV and JSON.

use std::error::Error;

use serde_json::json;

use crate::suite::{Case, Measure, Verdict};

/// A case and its measurements.
pub type Results<'a> = (&'a Case, Vec<Measure>);

/// A figure in seven characters.
pub fn figure(value: f64) -> String {
    if value == 0.0 {
        "0".into()
    } else if value.is_infinite() {
        "∞".into()
    } else if (0.01..1000.0).contains(&value) {
        let digits = if value < 1.0 { 2 } else { 1 };
        format!("{value:.digits$}").trim_end_matches('0').trim_end_matches('.').into()
    } else {
        format!("{value:.1e}")
    }
}

/// What is said of a verdict.
pub fn words(measure: &Measure) -> String {
    match measure.verdict() {
        Verdict::Pass => "PASS".into(),
        Verdict::Short if measure.reached.is_finite() && measure.target > 0.0 => {
            format!("SHORT of target by a factor of {}", figure(measure.reached / measure.target))
        }
        Verdict::Short => "SHORT of target".into(),
    }
}

/// Prints a case.
pub fn print(case: &Case, measures: &[Measure]) {
    println!("{} — {}", case.name, case.about);
    let widest = |cell: fn(&Measure) -> &str| measures.iter().map(|m| cell(m).chars().count()).max().unwrap_or(0);
    let (what, method) = (widest(|m| &m.what), widest(|m| &m.method));
    println!("  {:what$}  {:method$}  {:>8}  {:>8}  {:>8}", "", "", "reached", "target", "naive");
    for m in measures {
        let (reached, target) = (figure(m.reached), figure(m.target));
        let naive = m.naive.as_ref().map_or(String::new(), |(_, value)| figure(*value));
        println!("  {:what$}  {:method$}  {reached:>8}  {target:>8}  {naive:>8}  {}", m.what, m.method, words(m));
    }
    let mut said = Vec::new();
    let mut notes: Vec<&str> = measures.iter().map(|m| m.note.as_str()).filter(|note| !note.is_empty()).collect();
    notes.dedup();
    let several = notes.len() > 1;
    for m in measures {
        let labelled = |label: &str, text: &str| (!text.is_empty()).then(|| format!("{label}: {text}"));
        let naive = m.naive.as_ref().and_then(|(how, _)| labelled("naive", how));
        let note = labelled(if several { &m.method } else { "note" }, &m.note);
        for line in [labelled("target", &m.reason), naive, note].into_iter().flatten() {
            if !said.contains(&line) {
                println!("    {line}");
                said.push(line);
            }
        }
    }
    println!();
}

/// One measurement a row.
pub fn csv(results: &[Results<'_>]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut rows = csv::Writer::from_writer(Vec::new());
    rows.write_record([
        "case",
        "what",
        "method",
        "reached",
        "target",
        "verdict",
        "naive",
        "naive method",
        "reason",
        "note",
    ])?;
    for (case, measures) in results {
        for m in measures {
            let (how, naive) =
                m.naive.as_ref().map_or((String::new(), String::new()), |(h, v)| (h.clone(), format!("{v:e}")));
            let verdict = if m.verdict() == Verdict::Pass { "pass" } else { "short" };
            let (reached, target) = (format!("{:e}", m.reached), format!("{:e}", m.target));
            rows.write_record([
                case.name, &m.what, &m.method, &reached, &target, verdict, &naive, &how, &m.reason, &m.note,
            ])?;
        }
    }
    Ok(rows.into_inner()?)
}

/// The same for programs; what is infinite is null.
pub fn json(results: &[Results<'_>]) -> Result<Vec<u8>, Box<dyn Error>> {
    let measure = |m: &Measure| {
        let naive = m.naive.as_ref().map(|(how, value)| json!({ "method": how, "figure": value }));
        json!({
            "what": m.what, "method": m.method, "reached": m.reached, "target": m.target,
            "pass": m.verdict() == Verdict::Pass, "naive": naive, "reason": m.reason, "note": m.note,
        })
    };
    let cases: Vec<_> = results
        .iter()
        .map(|(case, measures)| {
            let measures: Vec<_> = measures.iter().map(measure).collect();
            json!({ "case": case.name, "about": case.about, "measures": measures })
        })
        .collect();
    Ok(serde_json::to_vec_pretty(&cases)?)
}
