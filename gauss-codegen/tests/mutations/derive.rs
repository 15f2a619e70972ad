//! What the other process does: it says which mutation comes next, derives it, and says what is wrong.

use std::io::Write;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;
use std::time::{Duration, Instant};

use super::corpus::Corpus;
use super::fault::fault;

/// Half of what the compiler has for a macro.
const STACK: usize = 4 << 20;
/// One derivation may take so long.
const LONGEST: Duration = Duration::from_secs(10);

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
}

fn one(corpus: &Corpus, number: u64) {
    say(&format!("{NEXT}{number}"));
    let tokens = corpus.mutation(number);
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

/// How long this thread has computed, whatever else runs on the machine; where the system does not say, what has passed.
fn computed(begun: Instant) -> Duration {
    let scheduled = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = scheduled.and_then(|text| text.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| begun.elapsed(), Duration::from_nanos)
}

/// At the start of a line, whatever the test harness has written before.
fn say(line: &str) {
    let mut out = std::io::stdout().lock();
    writeln!(out, "\n{line}").and_then(|()| out.flush()).expect("somebody listens");
}
