//! A run of the benchmarks, from its options to its tables.

use std::error::Error;

use crate::cases::Case;
use crate::measure::{Way, times};
use crate::peers;
use crate::report::{Row, table};

/// Times the cases that the arguments name, or all; prints tables and leaves them in `target/gauss/FILE`.
///
/// Arguments are names of scenes, `--rounds 2000`, and `--duration 0.0001` (seconds a measurement; much shorter than
/// what a busy machine gives a program at once).
///
/// # Errors
/// When an option wants a number, or the file cannot be written.
///
/// # Panics
/// When results differ.
pub fn run(cases: Vec<Case>, file: &str) -> Result<(), Box<dyn Error>> {
    let (mut rounds, mut duration, mut wanted) = (2000, 1e-4, Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a number"));
        match argument.as_str() {
            // Cargo adds it.
            "--bench" => {}
            "--rounds" => rounds = value()?.parse()?,
            "--duration" => duration = value()?.parse()?,
            _ => wanted.push(argument),
        }
    }
    let mut rows = Vec::new();
    for mut case in cases {
        if !wanted.is_empty() && !wanted.iter().any(|name| case.name.starts_with(name.as_str())) {
            continue;
        }
        for difference in &case.differences {
            assert!(*difference <= 1e-12, "{}: results differ by {difference:e}", case.name);
        }
        for (way, difference) in &case.peers {
            // Ten times what is allowed to code that knows the structure: simulators add up more terms.
            assert!(*difference <= 1e-11, "{}: results of {} differ by {difference:e}", case.name, way.name);
        }
        choose_peers(&mut case, duration);
        eprintln!("{} {} …", case.name, case.what);
        let times = times(&case.ways, rounds, duration);
        rows.push(Row { case, times });
    }
    let table = table(&rows);
    println!("{table}");
    gauss_files::write(gauss_files::output_folder().join(file), table)?;
    Ok(())
}

/// Times all ways of peers for a moment, and moves those of the faster compiler of each to the ways of the case.
fn choose_peers(case: &mut Case, duration: f64) {
    let (ways, differences): (Vec<Way>, Vec<f64>) = std::mem::take(&mut case.peers).into_iter().unzip();
    if ways.is_empty() {
        return;
    }
    // A moment is short, so what else the machine does may last all of it for one and not for the other: the least time
    // tells.
    let least: Vec<f64> = times(&ways, 200, duration).absolute.iter().map(|spread| spread.least).collect();
    let names: Vec<String> = ways.iter().map(|way| peers::peer(&way.name).to_owned()).collect();
    for (k, (way, difference)) in ways.into_iter().zip(differences).enumerate() {
        let slower = (0..names.len()).any(|j| names[j] == names[k] && (least[j], j) < (least[k], k));
        if !slower {
            case.ways.push(way);
            case.differences.push(difference);
        }
    }
}
