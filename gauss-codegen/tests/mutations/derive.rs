//! What the other process does: it says which mutation comes next, derives it, and says what is wrong.

use std::io::Write;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use proc_macro2::TokenStream;

use super::computed::computed;
use super::corpus::{Corpus, Mutation};
use super::fault::fault;
use super::files::Robot;

/// Half of what the compiler has for a macro.
const STACK: usize = 4 << 20;
/// One derivation may take so long in an optimised build; in one for tests, beside other programs, three times as long.
const LONGEST: Duration = Duration::from_secs(if cfg!(debug_assertions) { 30 } else { 10 });

/// Lines for the process that watches: the number that comes next, and what is wrong with it.
pub const NEXT: &str = "mutation ";
pub const FAULT: &str = "fault ";

pub fn all(numbers: Range<u64>) {
    let work = || {
        let corpus = Corpus::gathered();
        numbers.for_each(|number| one(&corpus, number));
    };
    let worker = thread::Builder::new().stack_size(STACK).spawn(work).expect("a thread");
    worker.join().expect("panics are caught");
    for format in ["urdf", "mjcf"] {
        // It may be that there was none.
        let _ = std::fs::remove_file(file(format));
    }
}

fn one(corpus: &Corpus, number: u64) {
    say(&format!("{NEXT}{number}"));
    let tokens = scene_of(corpus.mutation(number));
    let begun = Instant::now();
    let before = computed(begun);
    match catch_unwind(AssertUnwindSafe(|| fault(tokens))) {
        Ok(None) => {}
        Ok(Some(fault)) => say(&format!("{FAULT}{fault}")),
        Err(_) => say(&format!("{FAULT}panic")),
    }
    let took = computed(begun).saturating_sub(before);
    if took > LONGEST {
        say(&format!("{FAULT}{took:?}"));
    }
}

fn file(format: &str) -> PathBuf {
    std::env::temp_dir().join(format!("gauss-mutation-{}.{format}", std::process::id()))
}

/// A robot is read from a file, which the next one of this process replaces.
fn scene_of(mutation: Mutation) -> TokenStream {
    let Robot { format, text } = match mutation {
        Mutation::Scene(tokens) => return tokens,
        Mutation::Robot(robot) => robot,
    };
    let path = file(format);
    // A ground that nothing touches is a mistake, and the rest of the file is not seen.
    let touches = text.contains("<collision") || text.contains("conaffinity");
    let ground = if touches { ", ground(friction = 0.5)" } else { "" };
    std::fs::write(&path, text).expect("a folder for files that do not stay");
    format!("#[gauss({format} = {path:?}, gravity = 9.81{ground})] struct Robot;").parse().expect("tokens")
}

/// At the start of a line, whatever the test harness has written before.
fn say(line: &str) {
    let mut out = std::io::stdout().lock();
    writeln!(out, "\n{line}").and_then(|()| out.flush()).expect("somebody listens");
}
