//! A study that costs nothing, whose runs fail in every way.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;

use gauss_study::{Declaration, Study, list, normal, uniform};

pub type Outcome = Result<(), Box<dyn Error>>;

pub const RUNS: u64 = 1000;

pub fn declaration(seed: u64) -> Declaration {
    Declaration::new("waves", seed, RUNS).version("1").runs_per_part(70)
}

/// Waves of random length: run 13 panics, each 50th fails, each 90th has no number, each 100th no event.
pub fn waves<'a>(mut declaration: Declaration) -> Result<Study<'a>, gauss_study::DeclarationError> {
    let length = declaration.parameter("length", "m", uniform(1.0, 3.0));
    let height = declaration.parameter("height", "m", normal(0.2, 0.05));
    let kind = declaration.parameter("kind", "", list([1.0, 2.0, 4.0]));
    let speed = declaration.number("speed", "m/s");
    let event = declaration.number("breaks_at", "s");
    let count = declaration.integer("crests");
    let steep = declaration.flag("steep");
    let word = declaration.text("word");
    declaration.study(move |sample, row| {
        row.set(speed, (9.81 * sample[length]).sqrt() + sample.stream("noise").normal());
        row.set(count, (100.0 / sample[length]) as i64);
        row.set(steep, sample[height] > 0.25);
        row.set(word, if sample[kind] > 1.5 { "many" } else { "one" });
        if sample.run() % 100 != 0 {
            row.set(event, sample[height] * sample[kind]);
        }
        match sample.run() {
            13 => panic!("run {} is unlucky", sample.run()),
            run if run % 90 == 89 => row.set(speed, f64::NAN),
            run if run % 50 == 49 => return Err(format!("wave {run} is no wave")),
            _ => {}
        }
        Ok(())
    })
}

/// What [`waves`] fails at.
pub fn failures() -> usize {
    (0..RUNS).filter(|run| *run == 13 || run % 90 == 89 || run % 50 == 49).count()
}

/// The files of a folder and their contents.
pub fn contents(folder: &Path) -> std::io::Result<BTreeMap<String, Vec<u8>>> {
    let read = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry?;
        Ok((entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path())?))
    };
    fs::read_dir(folder)?.map(read).collect()
}
