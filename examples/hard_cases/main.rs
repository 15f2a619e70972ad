//! A suite of hard cases: where rigid-body programs lose digits, blow up, or say nothing, measured.
//!
//! `cargo run --release --example hard_cases [-- NAME…] [--full]`: all cases, or those named; `--full` makes the
//! long runs as long as 1e8 steps (some minutes). The table is printed, and written with a picture into
//! `target/gauss`.
//!
//! Every figure is the better the smaller it is. It stands beside its target and beside what a naive program gets,
//! whose formulas are right. Truth is a reference solution to 36 digits, or a closed form, or the same motion by
//! equations typed in `suite/truth.rs` to 30 digits: never a derived kernel.

mod picture;
mod report;

use std::env;

use gauss_charts::drawing::png;
use gauss_comparisons::suite;
use suite::{CASES, Effort, Verdict};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = env::args().skip(1).collect();
    let (flags, names): (Vec<_>, Vec<_>) = words.iter().partition(|word| word.starts_with("--"));
    let effort = if flags.iter().any(|flag| *flag == "--full") { Effort::Full } else { Effort::Usual };
    let unknown = |name: &&&String| !CASES.iter().any(|case| case.name == name.as_str());
    if let Some(name) = names.iter().find(unknown) {
        let known: Vec<&str> = CASES.iter().map(|case| case.name).collect();
        return Err(format!("there is no case {name}; there are {}", known.join(", ")).into());
    }

    let mut results = Vec::new();
    for case in CASES.iter().filter(|case| names.is_empty() || names.iter().any(|name| *name == case.name)) {
        let measures = (case.run)(effort)?;
        report::print(case, &measures);
        results.push((case, measures));
    }
    let all: Vec<_> = results.iter().flat_map(|(_, measures)| measures).collect();
    let passed = all.iter().filter(|measure| measure.verdict() == Verdict::Pass).count();
    println!("{passed} of {} targets reached in {} cases", all.len(), results.len());

    let folder = gauss_files::output_folder();
    let svg = picture::draw(&results)?;
    for (name, contents) in [
        ("hard_cases.csv", report::csv(&results)?),
        ("hard_cases.json", report::json(&results)?),
        ("hard_cases.png", png(&svg)?),
        ("hard_cases.svg", svg.into_bytes()),
    ] {
        gauss_files::write(folder.join(name), contents)?;
        println!("written: {}", folder.join(name).display());
    }
    Ok(())
}
