//! What chains of bodies cost, and how long the derive takes over them:
//! `cargo run --profile unoptimised --example chains`.
//!
//! Cargo compiles macros without optimisation unless told otherwise, so the times are taken on an unoptimised build of
//! `gauss-codegen`. Operations are those of one evaluation of `acceleration`.

mod structures;

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
    let tokens = gauss_codegen::expand(&input).expect("the sources below are systems");
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
