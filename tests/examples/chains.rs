//! What chains of bodies cost, and how long the derive takes over them:
//! `cargo run --profile unoptimised --example chains`.
//!
//! Cargo compiles macros without optimisation unless told otherwise, so the times are taken on an unoptimised build of the
//! very sources of `gauss-derive`. Operations are those of one evaluation of `acceleration`.

// Only the pipeline is used here, not everything that the macro's modules offer.
#![allow(dead_code, unused_imports)]

#[path = "../../gauss-derive/src/algebra/mod.rs"]
mod algebra;
#[path = "../../gauss-derive/src/emit/mod.rs"]
mod emit;
#[path = "../../gauss-derive/src/expand.rs"]
mod expand;
#[path = "../../gauss-derive/src/kernel/mod.rs"]
mod kernel;
#[path = "../../gauss-derive/src/mechanics/mod.rs"]
mod mechanics;
#[path = "../../gauss-derive/src/mistakes.rs"]
mod mistakes;
#[path = "../../gauss-derive/src/model/mod.rs"]
mod model;
mod structures;
#[path = "../../gauss-derive/src/translate/mod.rs"]
mod translate;

use std::time::Instant;

use structures::{arm, particles, planar, spatial};

fn main() {
    let largest = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(14);
    let build = if cfg!(debug_assertions) { "unoptimised" } else { "optimised" };
    println!("one evaluation of `acceleration`, and the expansion of the whole derive ({build} build, one run)\n");
    println!("{:<44}{:>8}{:>8}{:>6}{:>8}{:>12}", "system", "add", "mul", "div", "sincos", "derive, s");
    report("arm of seven joints", &arm(""));
    for n in sizes(largest) {
        report(&format!("{n} links in the plane, relative angles"), &planar(n, true));
    }
    for n in sizes(largest) {
        report(&format!("{n} links in the plane, absolute angles"), &planar(n, false));
    }
    for n in sizes(largest) {
        report(&format!("{n} particles in the plane, positions written out"), &particles(n));
    }
    for n in sizes(largest) {
        report(&format!("{n} links in space, two angles each"), &spatial(n));
    }
}

/// n = 2 … 30, denser where chains are short.
fn sizes(largest: usize) -> impl Iterator<Item = usize> {
    [2, 3, 4, 5, 6, 8, 10, 14, 20, 30].into_iter().filter(move |&n| n <= largest)
}

fn report(name: &str, source: &str) {
    let input: syn::DeriveInput = syn::parse_str(source).expect("the sources below are structs");
    let start = Instant::now();
    let tokens = expand::expand(&input).expect("the sources below are systems");
    let seconds = start.elapsed().as_secs_f64();
    let text = tokens.to_string();
    // The rustdoc of the kernel has a row for each method.
    let row = text.split("`acceleration` | ").nth(1).and_then(|rest| rest.split('|').next()).unwrap_or_default();
    let count = |what: &str| {
        let part = row.split(", ").find_map(|part| part.trim().strip_suffix(what));
        part.and_then(|n| n.trim().parse::<u32>().ok()).unwrap_or(0)
    };
    let (add, mul, div, calls) = (count("add"), count("mul"), count("div"), count("transcendental"));
    println!("{name:<44}{add:>8}{mul:>8}{div:>6}{:>8}{seconds:>12.3}", calls / 2);
}
