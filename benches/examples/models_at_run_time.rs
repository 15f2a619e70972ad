//! `cargo run --release -p gauss-benches --example models_at_run_time --features robots`: robots that are read while
//! the program runs, beside the same ones compiled ahead, and beside C where there is a compiler.
//!
//! Ways take turns; medians of all rounds.

use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use gauss_benches::robots::{Anymal, Fingers};
use gauss_codegen::targets::c::Precision;
use gauss_codegen::{Derivation, targets};
use gauss_jit::{Cranelift, Effort, Interpreter, Model};
use gauss_runtime::prelude::*;

/// Times that each way takes its turn, and calls of a turn.
const ROUNDS: usize = 25;
const CALLS: u32 = 2000;

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Nanoseconds a call, one turn.
fn turn(call: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    (0..CALLS).for_each(|_| call());
    start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
}

/// A program of C that prints nanoseconds a call of the accelerations, turn by turn, and how long gcc took.
fn c(derivation: &Derivation, lists: &[Vec<f64>], constants: &[f64]) -> Option<(PathBuf, f64)> {
    let all: Vec<&[f64]> = [constants].into_iter().chain(lists.iter().map(Vec::as_slice)).collect();
    let mut source = targets::c::source(derivation.functions(), Precision::Double).ok()?;
    source += "#include <stdio.h>\n#include <time.h>\n#include <stdlib.h>\nint main(int n, char **v) {\n";
    let mut names = Vec::new();
    for (k, list) in all.iter().enumerate().filter(|(_, list)| !list.is_empty()) {
        let numbers: Vec<String> = list.iter().map(|x| format!("{x:?}")).collect();
        writeln!(source, "static double a{k}[] = {{{}}};", numbers.join(", ")).ok()?;
        names.push(if k == 1 { "a1[0]".to_owned() } else { format!("a{k}") });
    }
    let prefix = derivation.name().to_lowercase();
    write!(
        source,
        "static double out[64]; struct timespec s, e; (void)n; int calls = atoi(v[1]);
        clock_gettime(CLOCK_MONOTONIC, &s);
        for (int i = 0; i < calls; i++) {{ {prefix}_acceleration({}, out); __asm__ volatile(\"\" ::: \"memory\"); }}
        clock_gettime(CLOCK_MONOTONIC, &e);
        printf(\"%.17g\\n\", ((e.tv_sec - s.tv_sec) * 1e9 + (e.tv_nsec - s.tv_nsec)) / calls); return out[0] != out[0]; }}\n",
        names.join(", ")
    )
    .ok()?;
    let folder = std::env::temp_dir();
    let (file, program) = (folder.join(format!("{prefix}_time.c")), folder.join(format!("{prefix}_time")));
    std::fs::write(&file, source).ok()?;
    let start = Instant::now();
    let flags = ["-O2", "-march=native", "-ffp-contract=fast", "-D_GNU_SOURCE"];
    let done = Command::new("gcc").args(flags).args([&file, &PathBuf::from("-o"), &program]).arg("-lm").status();
    let time = start.elapsed().as_secs_f64() * 1e3;
    done.ok()?.success().then_some((program, time))
}

fn robot(
    name: &str,
    file: &str,
    clauses: &[&str],
    state: [Vec<f64>; 3],
    compiled: &mut dyn FnMut(),
) -> Result<(), Box<dyn Error>> {
    let path = format!("{}/../tests/robots/{file}", env!("CARGO_MANIFEST_DIR"));
    let [q, z, u] = state;
    let (mut derived, mut first) = (Vec::new(), Vec::new());
    for _ in 0..9 {
        let start = Instant::now();
        let model = Model::from_urdf(&path, clauses)?;
        derived.push(start.elapsed().as_secs_f64() * 1e3);
        black_box(model.kernel(&[])?.acceleration(0.0, &q, &z, &u)?);
        first.push(start.elapsed().as_secs_f64() * 1e3);
    }
    println!("{name}: derived in {:.0} ms, first acceleration after {:.0} ms", median(derived), median(first));
    let model = Model::from_urdf(&path, clauses)?;
    let quick = model.with_backend(Cranelift { effort: Effort::Quick });
    let thorough = model.with_backend(Cranelift { effort: Effort::Thorough });
    let interpreter = model.with_backend(Interpreter);
    let mut kernels = Vec::new();
    for (way, model) in [("Cranelift, quick", quick), ("Cranelift, thorough", thorough), ("interpreter", interpreter)] {
        let kernel = model.kernel(&[])?;
        let start = Instant::now();
        kernel.method("acceleration")?;
        kernels.push((way, start.elapsed().as_secs_f64() * 1e3, kernel));
    }
    let text = format!("#[gauss(urdf = {path:?}, {})] struct Robot;", clauses.join(", "));
    let derivation = Derivation::of_text(&text)?;
    let constants = derivation.constants().run::<f64>(&[&[]])?;
    let lists = [vec![0.0], q, z, u];
    let c = c(&derivation, &lists, &constants);
    let slices: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
    let mut times = vec![Vec::new(); kernels.len() + 2];
    for _ in 0..ROUNDS {
        for ((_, _, kernel), times) in kernels.iter().zip(&mut times) {
            let method = kernel.method("acceleration")?;
            let mut out = vec![0.0; method.outputs()];
            times.push(turn(&mut || method.call(black_box(&slices), black_box(&mut out)).unwrap_or_default()));
        }
        times[kernels.len()].push(turn(compiled));
        if let Some((program, _)) = &c {
            let output = Command::new(program).arg(CALLS.to_string()).output()?;
            times[kernels.len() + 1].push(String::from_utf8_lossy(&output.stdout).trim().parse()?);
        }
    }
    for ((way, made, _), times) in kernels.iter().zip(&times) {
        println!("  {way}: made in {made:.1} ms, {:.0} ns", median(times.clone()));
    }
    println!("  compiled ahead: {:.0} ns", median(times[kernels.len()].clone()));
    if let Some((_, made)) = c {
        println!("  C, gcc -O2: made in {made:.0} ms, {:.0} ns", median(times[kernels.len() + 1].clone()));
    }
    Ok(())
}

fn numbers(count: usize) -> Vec<f64> {
    (0..count).map(|k| 0.3 + 0.1 * k as f64).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let fingers = Fingers.kernel()?;
    let (q, z, u) = (SVector::from_vec(numbers(9)), SVector::from_vec(numbers(9)), SVector::from_vec(numbers(9)));
    robot("Panda", "panda.urdf", &["gravity = 9.81"], [numbers(9), numbers(9), numbers(9)], &mut || {
        black_box(fingers.acceleration(0.0, black_box(&q), black_box(&z), black_box(&u)));
    })?;
    let anymal = Anymal.kernel()?;
    let rotation = UnitQuaternion::from_euler_angles(0.3, -0.4, 1.1);
    let pose = Isometry3::from_parts(Vector3::new(0.1, 0.2, 0.3).into(), rotation);
    let state = (pose, SVector::from_vec(numbers(12)));
    let flat = [rotation.coords.as_slice(), &[0.1, 0.2, 0.3], &numbers(12)].concat();
    let (z, u) = (SVector::from_vec(numbers(18)), SVector::from_vec(numbers(12)));
    let clauses = ["gravity = 9.81", "base = floating"];
    robot("ANYmal", "anymal.urdf", &clauses, [flat, numbers(18), numbers(12)], &mut || {
        black_box(anymal.acceleration(0.0, black_box(&state), black_box(&z), black_box(&u)));
    })
}
