//! Every method of every scene: machine code of both kinds and the interpreter give the same bits, and what the
//! program gives in plain arithmetic up to a bound on the rounding of both.
//!
//! Some scenes by default; `ALL_SCENES=1` takes every struct in the files of this project.

mod bounded;
#[allow(dead_code, reason = "the list of scenes is shared")]
#[path = "../../../gauss-codegen/tests/common/mod.rs"]
mod common;
#[allow(dead_code, reason = "names of scenes are for tables")]
#[path = "../../../gauss-codegen/tests/operations/sources.rs"]
mod sources;

use std::collections::HashSet;

use common::Random;
use gauss_codegen::Derivation;
use gauss_codegen::program::{ArgumentKind, Instruction, Program};
use gauss_jit::{Backend, Compiled, Cranelift, Effort, Interpreter, Model, Tables};

/// States at which every method is called.
const STATES: usize = 6;

/// Numbers for all arguments: constants from random parameters, the others random.
fn arguments(derivation: &Derivation, program: &Program, random: &mut Random) -> Vec<Vec<f64>> {
    let mut arguments = common::random_arguments(derivation, program, random);
    // Of both signs, and some zeros.
    for (argument, list) in program.arguments.iter().zip(&mut arguments) {
        if !matches!(argument.kind, ArgumentKind::Parameters | ArgumentKind::Constants) {
            list.iter_mut().for_each(|x| match (random.number() * 1024.0) as u32 % 8 {
                0 => *x = 0.0,
                1..4 => *x = -*x,
                _ => {}
            });
        }
    }
    arguments
}

/// How many outputs were compared, and of how many a bound is known.
#[derive(Default)]
struct Tally {
    methods: usize,
    outputs: usize,
    bounded: usize,
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    // NaN is NaN.
    numbers.iter().map(|x| if x.is_nan() { f64::NAN } else { *x }.to_bits()).collect()
}

fn compare(name: &str, derivation: &Derivation, tally: &mut Tally) {
    let mut random = Random(11);
    let ways: [&dyn Backend; 3] =
        [&Interpreter, &Cranelift { effort: Effort::Quick }, &Cranelift { effort: Effort::Thorough }];
    for program in derivation.functions().programs() {
        let compiled: Vec<Box<dyn Compiled>> =
            ways.iter().map(|way| way.compile(program, &Tables::default()).expect("code")).collect();
        assert_eq!(compiled.each_way(), [false, true, true], "{name}, {}", program.name);
        tally.methods += 1;
        for _ in 0..STATES {
            let lists = arguments(derivation, program, &mut random);
            let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
            let results = compiled.iter().map(|way| {
                let mut outputs = vec![0.25; program.code.outputs.len()];
                way.run(&lists, &mut outputs);
                outputs
            });
            let results: Vec<Vec<f64>> = results.collect();
            for other in &results[1..] {
                assert_eq!(bits(&results[0]), bits(other), "{name}, {}", program.name);
            }
            for (found, (value, bound)) in results[0].iter().zip(bounded::outputs(program, &lists)) {
                tally.outputs += 1;
                tally.bounded += usize::from(bound.is_finite());
                // Both are within the bound of what exact arithmetic gives.
                let within = (found - value).abs() <= 2.0 * bound || !bound.is_finite();
                assert!(within, "{name}, {}: {found} and {value}, bound {bound}", program.name);
            }
        }
    }
}

trait EachWay {
    fn each_way(&self) -> Vec<bool>;
}

impl EachWay for Vec<Box<dyn Compiled>> {
    fn each_way(&self) -> Vec<bool> {
        self.iter().map(|way| way.is_machine_code()).collect()
    }
}

/// The functions that the equations call: whether each is a table. Those of Rust are not there at run time.
fn called(derivation: &Derivation) -> HashSet<bool> {
    let instructions = derivation.functions().programs().flat_map(|program| &program.code.instructions);
    let tables = &derivation.parameters().tables;
    let is_table = |instruction: &Instruction| match instruction {
        Instruction::Own(function, _) => Some(tables[usize::from(function.index)].is_some()),
        _ => None,
    };
    instructions.filter_map(is_table).collect()
}

#[test]
fn machine_code_is_what_the_interpreter_computes() {
    let mut tally = Tally::default();
    for (name, _) in common::SCENES {
        compare(name, &common::derivation(name), &mut tally);
    }
    let robots = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/robots/");
    for (file, clauses) in [
        ("panda.urdf", "urdf = \"FILE\", gravity = 9.81, linearize, frames(panda_joint7_link)"),
        ("quadruped.urdf", "urdf = \"FILE\", base = floating, gravity = 9.81, methods(nonlinear_effects)"),
        ("balls.xml", "mjcf = \"FILE\""),
    ] {
        let clauses = clauses.replace("FILE", &format!("{robots}{file}"));
        let derivation = Derivation::of_text(&format!("#[gauss({clauses})] struct Robot;"));
        compare(file, &derivation.unwrap_or_else(|error| panic!("{file}: {error}")), &mut tally);
    }
    println!("{} methods, {} outputs, {} with a bound", tally.methods, tally.outputs, tally.bounded);
    assert!(tally.bounded * 10 > tally.outputs * 9);
}

/// Every struct of this project's files; by default some short ones.
#[test]
fn scenes_of_all_files() {
    let all = std::env::var_os("ALL_SCENES").is_some();
    let places = ["../tests/tests", "../tests/src", "../examples", "../benches/src"];
    let mut scenes: Vec<_> = places.into_iter().flat_map(sources::of).collect();
    scenes.sort_by_key(|scene| scene.source.len());
    let mut known = HashSet::new();
    scenes.retain(|scene| known.insert(scene.source.clone()));
    assert!(scenes.len() > 300, "{} scenes", scenes.len());
    let (count, mut tally, mut refused) = (if all { scenes.len() } else { 40 }, Tally::default(), 0);
    for scene in scenes.iter().take(count) {
        // Files of robots are found from their packages alone, and some structs are there to be refused.
        let Ok(derivation) = Derivation::of_text(&scene.source) else {
            refused += 1;
            continue;
        };
        let called = called(&derivation);
        assert_eq!(called.contains(&false), Model::from_source(&scene.source).is_err(), "{}", scene.name);
        // Numbers of tables are constants in files, which are not read.
        if called.is_empty() {
            compare(&scene.name, &derivation, &mut tally);
        }
    }
    let Tally { methods, outputs, bounded } = tally;
    println!("{count} scenes, {refused} not derived, {methods} methods, {outputs} outputs, {bounded} with a bound");
    assert!(refused * 5 < count && methods > 10 * (count - refused));
}
