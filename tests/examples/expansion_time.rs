//! How long the derive takes, as its users meet it: `cargo run --profile unoptimised --example expansion_time`.
//!
//! Cargo compiles macros without optimisation unless told otherwise, so the figures are taken on an unoptimised build of
//! the very sources of `gauss-derive`.

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

use std::time::{Duration, Instant};

const RUNS: usize = 15;

fn main() {
    let bodies = [
        ("principal axes at G", "", "#[gauss(mass)] m: f64, #[gauss(inertia)] i: Vector3<f64>"),
        (
            "full inertia, G off O, weight",
            "",
            "#[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>, \
             #[gauss(gravity)] g: f64",
        ),
        (
            "the same in a fluid, buoyancy",
            "",
            "#[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Matrix3<f64>, \
             #[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: Vector3<f64>, \
             #[gauss(displaced_mass)] d: f64, #[gauss(center_of_buoyancy)] h: Vector3<f64>",
        ),
        (
            "a vehicle: drag, lift, fins, stream",
            ", input(thrust, rudder), medium(velocity = s * sin(t)), define(v = body.relative_velocity), \
             drag(quadratic = e), force(lift, at = a, value = [0, k * v.x * v.y, k * v.x * v.z]), \
             force(fin, at = a, value = [thrust, l * v.x * v.x * rudder, 0])",
            "#[gauss(mass)] m: f64, #[gauss(center_of_mass)] c: Vector3<f64>, #[gauss(inertia)] i: Vector3<f64>, \
             #[gauss(added_mass)] x: Matrix6<f64>, #[gauss(gravity)] g: Vector3<f64>, \
             #[gauss(displaced_mass)] d: f64, s: Vector3<f64>, a: Vector3<f64>, k: f64, l: f64, e: Matrix6<f64>",
        ),
    ];
    let charts = ["left_invariant", "right_invariant", "hybrid", "jet(euler_zyx)", "jet(modified_rodrigues)"];
    let build = if cfg!(debug_assertions) { "unoptimised" } else { "optimised" };
    println!("expansion of one derive, {build} build, median of {RUNS} runs (fastest–slowest) in milliseconds\n");
    println!("{:<37}{:<26}{:>8}   spread", "body", "chart", "median");
    for (body, clauses, fields) in bodies {
        for chart in charts {
            let source = format!("#[gauss(chart = {chart}{clauses})] struct Body {{ {fields} }}");
            let input: syn::DeriveInput = syn::parse_str(&source).expect("the sources above are structs");
            let mut times: Vec<Duration> = (0..RUNS)
                .map(|_| {
                    let start = Instant::now();
                    let tokens = expand::expand(&input).expect("the sources above are bodies");
                    std::hint::black_box(tokens);
                    start.elapsed()
                })
                .collect();
            times.sort();
            let ms = |t: Duration| t.as_secs_f64() * 1e3;
            println!(
                "{body:<37}{chart:<26}{:>8.1}   {:.1}–{:.1}",
                ms(times[RUNS / 2]),
                ms(times[0]),
                ms(times[RUNS - 1])
            );
        }
    }
}
