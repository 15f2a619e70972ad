//! Whatever is written in the place of a scene ends in code or in located mistakes; libFuzzer looks for what does not.
//!
//! The input is Rust as text. What no input may bring about, and the changes of trees of tokens, are those of the test
//! `mutations`; libFuzzer chooses what it changes further by the parts of the library that a scene has reached.

#![no_main]

#[path = "../shared.rs"]
mod shared;

use std::thread;

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target};
use proc_macro2::TokenStream;
use shared::mutate::{Tree, mutated};
use shared::random::Random;

/// Sanitizers make frames several times as large; the test has the stack that the library needs without them.
const STACK: usize = 256 << 20;

fuzz_target!(|data: &[u8]| -> Corpus {
    let Ok(text) = std::str::from_utf8(data).map(str::to_owned) else { return Corpus::Reject };
    let work = move || {
        let Ok(tokens) = text.parse::<TokenStream>() else { return Corpus::Reject };
        if let Some(fault) = shared::fault::fault(tokens) {
            panic!("{fault}");
        }
        Corpus::Keep
    };
    let worker = thread::Builder::new().stack_size(STACK).spawn(work).expect("a thread");
    worker.join().expect("a panic has ended the process")
});

fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    let tokens = std::str::from_utf8(&data[..size]).ok().and_then(|text| text.parse::<TokenStream>().ok());
    // Where nothing is left of a scene there is no tree to change.
    let Some(tokens) = tokens else { return libfuzzer_sys::fuzzer_mutate(data, size, most) };
    let mut random = Random::new(u64::from(seed));
    let trees = Tree::all(tokens);
    let text = Tree::tokens(&mutated(trees.clone(), &trees, &mut random)).to_string();
    if text.len() > most {
        return size;
    }
    data[..text.len()].copy_from_slice(text.as_bytes());
    text.len()
});
