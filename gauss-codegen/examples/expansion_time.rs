//! How long the derive takes, as its users meet it:
//! `cargo run --profile unoptimised --example expansion_time [-- RUNS]`.
//!
//! With `RUSTFLAGS=-Ctarget-cpu=native` methods are written with vectors as well, as the derive then does.
//!
//! First every size of structure beside what is aimed at, then one body in every chart. Cargo compiles macros without
//! optimisation unless told otherwise, so the figures are taken on an unoptimised build of `gauss-codegen`.
//!
//! With a name (`body`, `torpedo`, `top`, `arm`, `quadruped`, `standing`, `spatial`, `planar`, or a file that describes
//! a robot that floats, for which the feature `urdf` is needed) one expansion, for a profiler: where a machine is
//! shared, instructions are counted (`valgrind --tool=callgrind`).

mod structures;

use std::time::{Duration, Instant};

/// Runs of each unless another number is given, fewer where they would take longer than this.
const RUNS: usize = 15;
const PATIENCE: Duration = Duration::from_secs(3);

/// Feet of a quadruped on a floor, with friction.
const FEET: &str = ", point(p0, body = b2, at = [0.1, 0, -0.32]), contact(foot0, point = p0, friction = 0.6), \
                    point(p1, body = b5, at = [0.1, 0, -0.32]), contact(foot1, point = p1, friction = 0.6), \
                    point(p2, body = b8, at = [-0.1, 0, -0.32]), contact(foot2, point = p2, friction = 0.6), \
                    point(p3, body = b11, at = [-0.1, 0, -0.32]), contact(foot3, point = p3, friction = 0.6)";

fn runs() -> usize {
    std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(RUNS)
}

/// How long this thread has computed, whatever else runs on the machine; where the system does not say, what has
/// passed.
fn computed(begun: Instant) -> Duration {
    let scheduled = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = scheduled.and_then(|text| text.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| begun.elapsed(), Duration::from_nanos)
}

/// What the derive does, which is compiled with the flags of this program.
fn expand(input: &syn::DeriveInput) -> proc_macro2::TokenStream {
    let vectors = cfg!(all(target_feature = "avx", target_feature = "fma"));
    let expanded = if vectors { gauss_codegen::expand(input) } else { gauss_codegen::expand_without_vectors(input) };
    std::hint::black_box(expanded.expect("the sources are systems"))
}

/// Median, fastest and slowest expansion in milliseconds.
fn expansion(source: &str) -> [f64; 3] {
    let input: syn::DeriveInput = syn::parse_str(source).expect("the sources are structs");
    let begun = Instant::now();
    expand(&input);
    // Systems count in steps of some milliseconds: short ones are timed several at once.
    let together = (100.0 / (begun.elapsed().as_secs_f64() * 1e3)).ceil().min(20.0);
    let mut times = Vec::new();
    while times.len() < runs() && (times.len() < 3 || begun.elapsed() < PATIENCE) {
        let start = computed(begun);
        for _ in 0..together as usize {
            expand(&input);
        }
        times.push((computed(begun) - start).as_secs_f64() * 1e3 / together);
    }
    times.sort_unstable_by(f64::total_cmp);
    [times[times.len() / 2], times[0], times[times.len() - 1]]
}

/// One structure, by its name or file.
fn named(name: &str) -> String {
    match name {
        "body" => structures::free_body(""),
        "torpedo" => structures::torpedo(""),
        "top" => structures::top(""),
        "arm" => structures::arm(""),
        "quadruped" => structures::quadruped(true, ""),
        "standing" => structures::quadruped(true, FEET),
        "spatial" => structures::spatial(8),
        "planar" => structures::planar(16, true),
        file => {
            let path = std::path::absolute(file).expect("a path");
            format!("#[gauss(urdf = {path:?}, base = floating, gravity = 9.81)] struct Robot;")
        }
    }
}

fn main() {
    if let Some(name) = std::env::args().nth(1).filter(|word| word.parse::<usize>().is_err()) {
        let input = syn::parse_str(&named(&name)).expect("the sources are structs");
        expand(&input);
        return;
    }
    let build = if cfg!(debug_assertions) { "unoptimised" } else { "optimised" };
    println!(
        "expansion of one derive, {build} build, median of {} runs or fewer (fastest–slowest) in milliseconds\n",
        runs()
    );
    sizes();
    charts();
}

/// Structures by size, and what is aimed at for two of them.
fn sizes() {
    println!("{:<52}{:>10}{:>18}   aim", "structure", "median", "spread");
    let report = |name: &str, source: &str, aim: &str| {
        let [median, fastest, slowest] = expansion(source);
        println!("{name:<52}{median:>10.1}{:>18}   {aim}", format!("{fastest:.1}–{slowest:.1}"));
    };
    for (clauses, with) in [("", ""), (", linearize", " with linearize"), (", taylor", " with taylor")] {
        let (small, large) = if clauses.is_empty() { ("12", "250") } else { ("", "") };
        report(&format!("free body{with}"), &structures::free_body(clauses), small);
        report(&format!("torpedo{with}"), &structures::torpedo(clauses), "");
        report(&format!("heavy top, Euler angles{with}"), &structures::top(clauses), "");
        report(&format!("arm of seven joints{with}"), &structures::arm(clauses), large);
    }
    for n in [2, 4, 8, 16] {
        report(&format!("chain of {n} links in the plane"), &structures::planar(n, true), "");
    }
    for n in [2, 4, 8] {
        report(&format!("chain of {n} links in space, two angles each"), &structures::spatial(n), "");
    }
    report("quadruped", &structures::quadruped(true, ""), "");
    report("quadruped, four feet with friction", &structures::quadruped(true, FEET), "");
    println!();
}

/// One body in every chart.
fn charts() {
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
    println!("{:<37}{:<26}{:>8}   spread", "body", "chart", "median");
    for (body, clauses, fields) in bodies {
        for chart in charts {
            let source = format!("#[gauss(chart = {chart}{clauses})] struct Body {{ {fields} }}");
            let [median, fastest, slowest] = expansion(&source);
            println!("{body:<37}{chart:<26}{median:>8.1}   {fastest:.1}–{slowest:.1}");
        }
    }
}
