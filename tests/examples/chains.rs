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
#[path = "../../gauss-derive/src/translate/mod.rs"]
mod translate;

use std::time::Instant;

fn main() {
    let largest = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(14);
    let build = if cfg!(debug_assertions) { "unoptimised" } else { "optimised" };
    println!("one evaluation of `acceleration`, and the expansion of the whole derive ({build} build, one run)\n");
    println!("{:<44}{:>8}{:>8}{:>6}{:>8}{:>12}", "system", "add", "mul", "div", "sincos", "derive, s");
    report("arm of seven joints", &arm());
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

fn fields(n: usize) -> String {
    let bodies: String = (0..n).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, l{k}: f64, ")).collect();
    format!("struct Chain {{ {bodies} #[gauss(gravity)] g: f64 }}")
}

fn names(prefix: &str, n: usize) -> String {
    (0..n).map(|k| format!("{prefix}{k}")).collect::<Vec<_>>().join(", ")
}

/// Bars one on the other, turning about the second axis.
fn planar(n: usize, relative: bool) -> String {
    let mut clauses = format!("coordinates({}), body(b0, rotation = rotation_y(q0))", names("q", n));
    for k in 1..n {
        let before = k - 1;
        let angle = if relative { format!("q{k}") } else { format!("q{k} - q{before}") };
        clauses +=
            &format!(", body(b{k}, parent = b{before}, position = [0, 0, l{before}], rotation = rotation_y({angle}))");
    }
    format!("#[gauss({clauses}, limit = 1000000)] {}", fields(n))
}

/// Particles on rods, every position as a sum from Ω.
fn particles(n: usize) -> String {
    let sum = |k: usize, f: &str| (0..=k).map(|j| format!("l{j} * {f}(q{j})")).collect::<Vec<_>>().join(" + ");
    let clauses: String = (0..n)
        .map(|k| format!(", particle(mass = m{k}, position = [{}, 0, -({})])", sum(k, "sin"), sum(k, "cos")))
        .collect();
    let fields: String = (0..n).map(|k| format!("m{k}: f64, l{k}: f64, ")).collect();
    format!(
        "#[gauss(coordinates({}){clauses}, limit = 1000000)] struct Chain {{ {fields} #[gauss(gravity)] g: f64 }}",
        names("q", n)
    )
}

/// Bars one on the other in universal joints.
fn spatial(n: usize) -> String {
    let angles = (0..n).map(|k| format!("x{k}, y{k}")).collect::<Vec<_>>().join(", ");
    let mut clauses = format!("coordinates({angles}), body(b0, rotation = rotation_x(x0) * rotation_y(y0))");
    for k in 1..n {
        let before = k - 1;
        clauses += &format!(
            ", body(b{k}, parent = b{before}, position = [0, 0, l{before}], rotation = rotation_x(x{k}) * rotation_y(y{k}))"
        );
    }
    format!("#[gauss({clauses}, limit = 1000000)] {}", fields(n))
}

/// Joint origins and fixed turns of the Franka Emika Panda (public URDF description, example-robot-data 6.0).
fn arm() -> String {
    const JOINTS: [([&str; 3], &str); 7] = [
        (["0", "0", "0.333"], ""),
        (["0", "0", "0"], "rotation_x(-1.5707963267948966) * "),
        (["0", "-0.316", "0"], "rotation_x(1.5707963267948966) * "),
        (["0.0825", "0", "0"], "rotation_x(1.5707963267948966) * "),
        (["-0.0825", "0.384", "0"], "rotation_x(-1.5707963267948966) * "),
        (["0", "0", "0"], "rotation_x(1.5707963267948966) * "),
        (["0.088", "0", "0"], "rotation_x(1.5707963267948966) * "),
    ];
    let mut clauses = format!("coordinates({})", names("q", 7));
    for (k, ([x, y, z], turn)) in JOINTS.iter().enumerate() {
        let parent = if k > 0 { format!("parent = b{}, ", k - 1) } else { String::new() };
        clauses += &format!(", body(b{k}, {parent}position = [{x}, {y}, {z}], rotation = {turn}rotation_z(q{k}))");
    }
    let bodies: String = (0..7).map(|k| format!("#[gauss(body)] b{k}: RigidBody<f64>, ")).collect();
    format!("#[gauss({clauses})] struct Arm {{ {bodies} #[gauss(gravity)] g: f64 }}")
}
