//! Many rows at once: each has the bits that it has alone, in vectors of four and of eight, whatever its numbers are.
//!
//! Some scenes by default; `ALL_SCENES=1` takes every struct in the files of this project.

#![cfg_attr(not(target_arch = "x86_64"), allow(dead_code, unused_imports))]

#[allow(dead_code, reason = "the list of scenes is shared")]
#[path = "../../../gauss-codegen/tests/common/mod.rs"]
mod common;
#[allow(dead_code, reason = "names of scenes are for tables")]
#[path = "../../../gauss-codegen/tests/operations/sources.rs"]
mod sources;

use std::f64::consts::FRAC_PI_2;
use std::thread;

use common::Random;
use gauss_codegen::Derivation;
use gauss_codegen::program::{ArgumentKind, Instruction, Program};
use gauss_jit::{Backend, CallError, Cranelift, Effort, Interpreter, Kernel, Model, Tables};

/// Batches of each program.
const BATCHES: usize = 6;

/// Numbers of which programs make exceptions: none, infinite, angles that are reduced otherwise, and their neighbours.
const SPECIAL: [f64; 16] = [
    0.0,
    -0.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    FRAC_PI_2,
    -3.0 * FRAC_PI_2,
    FRAC_PI_2 + 1.0001e-4,
    FRAC_PI_2 - 0.9999e-4,
    102_943.0,
    102_945.0,
    -5.3e255,
    1e-310,
    -4.2e-9,
    1.0,
    7e4,
];

fn bits(numbers: &[f64]) -> Vec<u64> {
    // NaN is NaN.
    numbers.iter().map(|x| if x.is_nan() { f64::NAN } else { *x }.to_bits()).collect()
}

/// Numbers of so many rows: some of both signs, some zero, and one of the first rows with one of those above.
fn numbers(rows: usize, count: usize, random: &mut Random) -> Vec<f64> {
    let mut list: Vec<f64> = (0..rows * count).map(|_| random.number()).collect();
    let mut below = |count: usize| (random.number() * 4096.0) as usize % count.max(1);
    list.iter_mut().for_each(|x| match below(8) {
        0 => *x = 0.0,
        1..4 => *x = -*x,
        _ => {}
    });
    for row in 0..rows.min(3) {
        if count > 0 {
            list[row * count + below(count)] = SPECIAL[below(SPECIAL.len())];
        }
    }
    list
}

/// Rows that vectors computed, and among them those that were left to the code of one row.
#[derive(Default)]
struct Tally {
    programs: usize,
    rows: usize,
    alone: usize,
}

#[cfg(target_arch = "x86_64")]
fn compare(name: &str, derivation: &Derivation, tally: &mut Tally) {
    let mut random = Random(17);
    for program in derivation.functions().programs() {
        let single = Interpreter.compile(program, &Tables::default()).expect("an interpreter");
        let widths = [4, 8].map(|width| Cranelift::default().lanes(program, &Tables::default(), width));
        assert_eq!(widths[0].is_some(), is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"));
        assert_eq!(widths[1].is_some(), widths[0].is_some() && is_x86_feature_detected!("avx512f"), "{name}");
        tally.programs += 1;
        for lanes in widths.iter().flatten() {
            let (width, outputs) = (lanes.width(), program.code.outputs.len());
            for _ in 0..BATCHES {
                let (shared, rows) = arguments(derivation, program, width, &mut random);
                // Number i of row k is number i · width + k.
                let counts: Vec<usize> = rows.iter().map(|list| list.len() / width).collect();
                let in_lanes = rows.iter().zip(&counts).flat_map(|(list, count)| {
                    (0..*count).flat_map(move |i| (0..width).map(move |k| list[k * count + i]))
                });
                let in_lanes: Vec<f64> = in_lanes.collect();
                let (mut found, mut room) = (vec![0.25; outputs * width], vec![0.0; lanes.room()]);
                let alone = lanes.run(&shared, &in_lanes, &mut found, &mut room);
                for k in 0..width {
                    tally.rows += 1;
                    if alone >> k & 1 == 1 {
                        tally.alone += 1;
                        continue;
                    }
                    let own = rows.iter().zip(&counts).map(|(list, count)| &list[k * count..][..*count]);
                    let lists: Vec<&[f64]> = [&shared[..]].into_iter().chain(own).collect();
                    let mut expected = vec![0.0; outputs];
                    single.run(&lists, &mut expected);
                    let own: Vec<f64> = (0..outputs).map(|i| found[i * width + k]).collect();
                    let place = format!("{name}, {}, row {k} of {width}: {lists:?}", program.name);
                    assert_eq!(bits(&own), bits(&expected), "{place}");
                }
            }
        }
    }
}

/// The numbers that rows share, and those of the other arguments.
#[cfg(target_arch = "x86_64")]
fn arguments(
    derivation: &Derivation,
    program: &Program,
    rows: usize,
    random: &mut Random,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let shared = common::random_arguments(derivation, program, random).into_iter().next().unwrap_or_default();
    let kinds = program.arguments.iter().skip(1);
    assert!(kinds.clone().all(|argument| argument.kind != ArgumentKind::Constants));
    (shared, kinds.map(|argument| numbers(rows, argument.components.len(), random)).collect())
}

fn robot(file: &str, clauses: &str) -> String {
    let path = format!("{}/../../tests/robots/{file}", env!("CARGO_MANIFEST_DIR"));
    format!("#[gauss(urdf = {path:?}, {clauses})] struct Robot;")
}

#[cfg(target_arch = "x86_64")]
#[test]
fn each_row_of_every_method_has_the_bits_that_it_has_alone() {
    let mut tally = Tally::default();
    for (name, _) in common::SCENES {
        compare(name, &common::derivation(name), &mut tally);
    }
    for (file, clauses) in [
        ("panda.urdf", "gravity = 9.81, linearize, frames(panda_joint7_link)"),
        ("quadruped.urdf", "base = floating, gravity = 9.81, methods(nonlinear_effects)"),
    ] {
        compare(file, &Derivation::of_text(&robot(file, clauses)).expect("a robot"), &mut tally);
    }
    let all = std::env::var_os("ALL_SCENES").is_some();
    let places = ["../tests/tests", "../tests/src", "../examples", "../benches/src"];
    let mut scenes: Vec<_> = places.into_iter().flat_map(sources::of).collect();
    scenes.sort_by_key(|scene| scene.source.len());
    for scene in scenes.iter().take(if all { scenes.len() } else { 40 }) {
        let Ok(derivation) = Derivation::of_text(&scene.source) else { continue };
        let mut instructions = derivation.functions().programs().flat_map(|program| &program.code.instructions);
        if !instructions.any(|instruction| matches!(instruction, Instruction::Own(..))) {
            compare(&scene.name, &derivation, &mut tally);
        }
    }
    let Tally { programs, rows, alone } = tally;
    println!("{programs} programs, {rows} rows in vectors, {alone} of them left to the code of one row");
    assert!(programs > 300 && alone * 4 < rows && (alone > 0 || rows == 0));
}

/// Kernels by all ways, with the numbers of their parameters.
fn kernels() -> Vec<(&'static str, Kernel)> {
    let pendulum = "#[gauss(coordinates(angle), linearize,
            particle(mass = m, position = [l * sin(angle), 0, -l * cos(angle)]))]
        struct Pendulum { m: f64, l: f64, #[gauss(gravity)] g: f64 }";
    let glider = "#[gauss(coordinates(x, y), particle(mass = 2, position = [x, y, 0]), input(throttle), linearize,
            table(power, points = POWER, kind = cubic), table(lift, axes = [X, Y], values = LIFT),
            drive(x = throttle * power(rate(x)) + tanh(y)), drive(y = lift(x, y) * exp(-x)))] struct Glider {}";
    let tables = [
        ("POWER", &[3, 2][..], &[-1.0, 2.5, 0.0, 2.0, 3.0, 0.0][..]),
        ("X", &[2], &[-1.0, 1.0]),
        ("Y", &[2], &[-1.0, 1.5]),
        ("LIFT", &[2, 2], &[0.3, 0.1, -0.7, 1.2]),
    ];
    let model = |source: &str| Model::from_source(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let pendulum = model(pendulum);
    let panda = model(&robot("panda.urdf", "gravity = 9.81, linearize"));
    let glider = model(glider).with_tables(&tables).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut kernels = Vec::new();
    for (model, given) in
        [(pendulum, &[("m", &[0.7][..]), ("l", &[0.5]), ("g", &[9.81])][..]), (panda, &[]), (glider, &[])]
    {
        let quick = model.with_backend(Cranelift { effort: Effort::Quick });
        let interpreter = model.with_backend(Interpreter);
        for (way, model) in [("Cranelift", model), ("quick", quick), ("interpreter", interpreter)] {
            kernels.push((way, model.kernel(given).unwrap_or_else(|error| panic!("{error}"))));
        }
    }
    kernels
}

/// Whole vectors, what is left behind them, and one row alone; arguments of each row and for all.
#[test]
fn methods_of_rows_are_methods_row_by_row() {
    let mut random = Random(5);
    for (way, kernel) in kernels() {
        let names: Vec<String> = kernel.model().methods().map(str::to_owned).collect();
        for name in names {
            let method = kernel.method(&name).expect("a method");
            assert!(if way == "interpreter" { method.width() == 1 } else { [1, 4, 8].contains(&method.width()) });
            let counts: Vec<usize> = method.arguments().iter().map(|argument| argument.components.len()).collect();
            // More than become vectors together, of one method of each kernel.
            let many: &[usize] = if name == "acceleration" { &[129, 133, 256] } else { &[] };
            for &rows in [0, 1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 30].iter().chain(many) {
                let is_own: Vec<bool> = counts.iter().map(|_| random.number() < 1.2).collect();
                let lists = counts
                    .iter()
                    .zip(&is_own)
                    .map(|(count, is_own)| numbers(if *is_own { rows } else { 1 }, *count, &mut random));
                let lists: Vec<Vec<f64>> = lists.collect();
                let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
                let mut found = vec![0.25; rows * method.outputs()];
                method.call_rows(rows, &lists, &mut found).unwrap_or_else(|error| panic!("{name}: {error}"));
                for row in 0..rows {
                    let own = lists.iter().zip(&counts).zip(&is_own);
                    let own: Vec<&[f64]> =
                        own.map(|((list, n), is_own)| if *is_own { &list[row * n..][..*n] } else { *list }).collect();
                    let mut expected = vec![0.0; method.outputs()];
                    method.call(&own, &mut expected).unwrap_or_else(|error| panic!("{name}: {error}"));
                    let found = &found[row * method.outputs()..][..method.outputs()];
                    assert_eq!(bits(found), bits(&expected), "{way}, {name}, row {row} of {rows}: {own:?}");
                }
            }
        }
    }
}

#[test]
fn lists_of_other_lengths_are_refused() {
    let (_, kernel) = kernels().into_iter().next().expect("a kernel");
    let method = kernel.method("acceleration").expect("a method");
    let (t, q, z) = ([0.0], [0.1; 9], [0.0; 9]);
    let mut results = [7.0; 9];
    let count = |name: &str, expected, found| {
        Err(CallError::Count { method: "acceleration".to_owned(), name: name.to_owned(), expected, found })
    };
    assert_eq!(method.call_rows(9, &[&t, &q[..8], &z, &[]], &mut results), count("q", 9, 8));
    assert_eq!(method.call_rows(9, &[&t, &q, &z, &[1.0]], &mut results), count("input", 0, 1));
    assert_eq!(method.call_rows(9, &[&t, &q, &z, &[]], &mut results[..8]), count("results", 9, 8));
    assert_eq!(method.call_rows(usize::MAX, &[&t, &q, &z, &[]], &mut results), count("q", usize::MAX, 9));
    let error = method.call_rows(9, &[&t, &q, &z], &mut results).expect_err("a list too few");
    assert!(matches!(error, CallError::Lists { found: 3, .. }), "{error}");
    assert_eq!(results, [7.0; 9], "nothing is written");
    assert_eq!(method.call_rows(9, &[&t, &q, &z, &[]], &mut results), Ok(()));
}

#[test]
fn threads_share_code_in_lanes() {
    for (way, kernel) in kernels().into_iter().skip(3).take(3) {
        let (q, z) = (vec![0.3; 20 * 9], vec![0.1; 20 * 9]);
        let batch = || {
            let method = kernel.method("acceleration").expect("a method");
            let mut results = vec![0.0; 20 * 9];
            method.call_rows(20, &[&[0.0], &q, &z, &[0.0; 9]], &mut results).expect("rows");
            bits(&results)
        };
        let all: Vec<Vec<u64>> = thread::scope(|scope| {
            let started: Vec<_> = (0..4).map(|_| scope.spawn(batch)).collect();
            started.into_iter().map(|thread| thread.join().expect("no panic")).collect()
        });
        let alone = kernel.acceleration(0.0, &q[..9], &z[..9], &[0.0; 9]).expect("a row");
        assert!(all.iter().all(|found| found.chunks(9).all(|row| row == bits(&alone))), "{way}");
    }
}
