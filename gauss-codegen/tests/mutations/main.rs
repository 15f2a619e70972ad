//! Whatever is written in the place of a scene ends in code or in located mistakes: no panic, no abort, no blame on
//! this crate, no derivation above 10 s or 1 GB, no code that is no Rust.
//!
//! All scenes of this project are changed at random, token by token, and files of robots tag by tag; others are made of
//! random expressions. Each run derives some thousand of them;
//! `MUTATIONS=200000 cargo test -p gauss-codegen --test mutations` more, from `FIRST=5000000` on others, and
//! `MUTATION=17` shows the one with that number. They are derived in other processes, which may be killed.

#[path = "../common/computed.rs"]
mod computed;
mod corpus;
mod derive;
mod expressions;
mod fault;
mod files;
mod mutate;
#[allow(dead_code, reason = "the choices of samples are not made here")]
#[path = "../../src/accuracy/random.rs"]
mod random;
mod watch;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use corpus::Corpus;

/// How many by default: some seconds.
const MUTATIONS: u64 = 2_000;
/// How many one process derives: what is kept for the life of a process does not add up.
const TOGETHER: u64 = 1_000;
/// After how many that is said.
const PROGRESS: u64 = 50_000;

fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok()?.parse().ok()
}

#[test]
fn no_input_is_too_much() {
    // The other process, which `watch` starts and whose derivations it counts.
    if let (Some(from), Some(to)) = (number("MUTATIONS_FROM"), number("MUTATIONS_TO")) {
        return derive::all(from..to);
    }
    let corpus = Corpus::gathered();
    if let Some(one) = number("MUTATION") {
        println!("{}", corpus.mutation(one));
        return;
    }
    let (begin, count) = (number("FIRST").unwrap_or(0), number("MUTATIONS").unwrap_or(MUTATIONS));
    let end = begin.saturating_add(count);
    let (next, found) = (AtomicU64::new(begin), Mutex::new(Vec::new()));
    let work = || {
        loop {
            let first = next.fetch_add(TOGETHER, Ordering::Relaxed);
            if first >= end {
                return;
            }
            if first > begin && (first - begin).is_multiple_of(PROGRESS) {
                eprintln!("{} derived", first - begin);
            }
            let faults = watch::derive(first..(first + TOGETHER).min(end));
            // Told at once: a long run may not come to its end.
            faults.iter().for_each(|(number, fault)| eprintln!("{number}: {fault}"));
            found.lock().expect("no thread panics with it").extend(faults);
        }
    };
    thread::scope(|scope| {
        (0..thread::available_parallelism().map_or(1, usize::from)).for_each(|_| _ = scope.spawn(work))
    });
    let mut found = found.into_inner().expect("no thread panics with it");
    found.sort();
    let shown: Vec<String> =
        found.iter().map(|(k, fault)| format!("{k}: {fault}\n    {}", corpus.mutation(*k))).collect();
    assert!(shown.is_empty(), "{} of {count}:\n{}", shown.len(), shown.join("\n"));
}
