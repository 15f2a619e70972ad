//! Times of `acceleration` in every chart and motion, of several shapes, and of systems: free, where calls overlap, and
//! chained, where the state of a call waits for the result of the one before.
//!
//! `cargo run --release -p gauss-benches --example gate_times [-- --rounds 2000] [--write new.csv] [--against old.csv]
//! [part of a name …]`. All are timed in turn, and beside a top written by hand: its time over theirs is what may be
//! compared between runs and between busy machines.

mod scenes;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use gauss_benches::measure::{Spread, Way, times};
use gauss_benches::{by_hand, entries, states};

const HEAD: &str = "scene,calls,ns,lower,upper,least,of the reference";

/// Figures of one row.
#[derive(Clone, Copy)]
struct Figures {
    ns: Spread,
    /// In times of the reference: the median of neighbours in time.
    relative: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut rounds, mut duration, mut wanted) = (1000, 1e-4, Vec::new());
    let (mut write, mut against) = (None, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--rounds" => rounds = value()?.parse()?,
            "--duration" => duration = value()?.parse()?,
            "--write" => write = Some(value()?),
            "--against" => against = Some(value()?),
            _ => wanted.push(argument),
        }
    }
    let reference = Way::new("by hand", by_hand::Top::new(), states::of_the_top(), entries::s4_by_hand);
    let mut ways = scenes::all()?;
    ways.retain(|way| wanted.is_empty() || wanted.iter().any(|part| way.name.contains(part.as_str())));
    ways.insert(0, reference);
    eprintln!("{} rows, {rounds} rounds …", ways.len());
    let times = times(&ways, rounds, duration);
    let figures =
        times.absolute.iter().zip(&times.ratios).map(|(&ns, ratio)| Figures { ns, relative: 1.0 / ratio.median });
    let rows: Vec<(String, Figures)> = ways.iter().map(|way| way.name.clone()).zip(figures).collect();
    let before = against.map(|file| Ok::<_, Box<dyn Error>>(read(&fs::read_to_string(file)?))).transpose()?;
    print!("{}", table(&rows, before.as_ref()));
    if let Some(file) = write {
        gauss_files::write(file, csv(&rows))?;
    }
    Ok(())
}

/// Names are the scene, a comma, and how it is called.
fn csv(rows: &[(String, Figures)]) -> String {
    let mut out = format!("{HEAD}\n");
    for (name, Figures { ns: Spread { lower, median, upper, least }, relative }) in rows {
        let name = if name.contains(',') { name.clone() } else { format!("{name},free") };
        writeln!(out, "{name},{median:.2},{lower:.2},{upper:.2},{least:.2},{relative:.4}").expect("a string");
    }
    out
}

/// Median and relative time by name.
fn read(csv: &str) -> BTreeMap<String, [f64; 3]> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let [scene, calls, ns, _, _, least, relative] = cells[..] else { return None };
        let figures = [ns.parse().ok()?, least.parse().ok()?, relative.parse().ok()?];
        Some((format!("{scene},{calls}"), figures))
    };
    csv.lines().skip(1).filter_map(row).collect()
}

fn table(rows: &[(String, Figures)], before: Option<&BTreeMap<String, [f64; 3]>>) -> String {
    let mut out = format!("{:<64}{:>9}{:>18}{:>9}{:>9}", "scene, calls", "ns", "middle half", "least", "/ ref.");
    out += if before.is_some() { "    now / before: median, least, / ref.\n" } else { "\n" };
    let mut ratios: [Vec<f64>; 3] = Default::default();
    for (name, Figures { ns: Spread { lower, median, upper, least }, relative }) in rows {
        let spread = format!("{lower:.1}–{upper:.1}");
        let _ = write!(out, "{name:<64}{median:>9.2}{spread:>18}{least:>9.2}{relative:>9.3}");
        if let Some(known) = before.and_then(|before| before.get(name)) {
            let now = [*median, *least, *relative];
            let quotients: [f64; 3] = std::array::from_fn(|k| now[k] / known[k]);
            for (ratios, quotient) in ratios.iter_mut().zip(quotients) {
                ratios.push(quotient);
            }
            let _ = write!(out, "    {:.3} {:.3} {:.3}", quotients[0], quotients[1], quotients[2]);
            // Of all three, lest a busy moment is taken for slow code.
            if quotients.iter().all(|quotient| *quotient > 1.05) {
                out += "  slower";
            } else if quotients.iter().all(|quotient| *quotient < 0.95) {
                out += "  faster";
            }
        }
        out.push('\n');
    }
    let mean = |ratios: &[f64]| (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp();
    if !ratios[0].is_empty() {
        let [median, least, relative] = ratios.each_ref().map(|ratios| mean(ratios));
        let _ = writeln!(out, "geometric means: {median:.3} {least:.3} {relative:.3}");
    }
    out
}
