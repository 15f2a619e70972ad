//! Scenes that no one would write: random expressions, and scenes of this project changed at random. Whatever is
//! derived of them has the same bits as machine code and interpreted, and whatever is refused has a place.
//!
//! Some by default; `MUTATIONS=100000 FIRST=5000 cargo test --release -p gauss-jit --test mutants` more.

#[allow(dead_code, reason = "the library behind the macro has more ways to change scenes")]
#[path = "../../../gauss-codegen/tests/mutations/expressions.rs"]
mod expressions;
#[allow(dead_code, reason = "the library behind the macro has more ways to change scenes")]
#[path = "../../../gauss-codegen/tests/mutations/mutate.rs"]
mod mutate;
#[allow(dead_code, reason = "not every kind of number is needed")]
#[path = "../../../gauss-codegen/src/accuracy/random.rs"]
mod random;
#[allow(dead_code, reason = "names of scenes are for tables")]
#[path = "../../../gauss-codegen/tests/operations/sources.rs"]
mod sources;

use gauss_codegen::Derivation;
use gauss_codegen::program::{Instruction, Program};
use gauss_jit::{Backend, Cranelift, Effort, Interpreter, Model, Place, Tables};
use mutate::{Tree, mutated};
use proc_macro2::TokenStream;
use random::Random;

const MUTATIONS: u64 = 150;

fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok()?.parse().ok()
}

fn scene(scenes: &[Vec<Tree>], random: &mut Random, number: u64) -> String {
    if number.is_multiple_of(2) {
        return expressions::scene(random);
    }
    let pair = [0; 2].map(|_| random.below(scenes.len()));
    let shorter = pair.into_iter().min_by_key(|&k| Tree::count(&scenes[k])).unwrap_or(0);
    let other = &scenes[random.below(scenes.len())];
    Tree::tokens(&mutated(scenes[shorter].clone(), other, random)).to_string()
}

/// Not what a NaN is made of.
fn bits(numbers: Vec<f64>) -> Vec<u64> {
    numbers.into_iter().map(|x| if x.is_nan() { f64::NAN } else { x }.to_bits()).collect()
}

fn compare(program: &Program, random: &mut Random, source: &str) {
    if program.code.instructions.iter().any(|instruction| matches!(instruction, Instruction::Own(..))) {
        return;
    }
    let mut value = || if random.below(8) == 0 { 0.0 } else { random.signed(3.0) };
    let lists = program.arguments.iter().map(|argument| argument.components.iter().map(|_| value()).collect());
    let lists: Vec<Vec<f64>> = lists.collect();
    let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
    let run = |way: &dyn Backend| {
        let mut outputs = vec![0.0; program.code.outputs.len()];
        way.compile(program, &Tables::default())
            .unwrap_or_else(|| panic!("no code: {source}"))
            .run(&lists, &mut outputs);
        bits(outputs)
    };
    let expected = run(&Interpreter);
    for effort in [Effort::Quick, Effort::Thorough] {
        assert_eq!(run(&Cranelift { effort }), expected, "{effort:?}, {}: {source}", program.name);
    }
}

#[test]
fn mutants_have_the_same_bits_in_every_way() {
    let places = ["../tests/tests", "../tests/src", "../examples", "../benches/src"];
    let gathered = places.into_iter().flat_map(sources::of);
    let scenes = gathered.map(|scene| Tree::all(scene.source.parse::<TokenStream>().expect("tokens")));
    let scenes: Vec<Vec<Tree>> = scenes.collect();
    let (first, count) = (number("FIRST").unwrap_or(0), number("MUTATIONS").unwrap_or(MUTATIONS));
    let (mut derived, mut refused) = (0, 0);
    for number in first..first + count {
        let mut random = Random::new(number);
        let source = scene(&scenes, &mut random, number);
        match Derivation::of_text(&source) {
            Ok(derivation) => {
                derived += 1;
                derivation.functions().programs().for_each(|program| compare(program, &mut random, &source));
            }
            Err(_) => {
                refused += 1;
                let mistakes = Model::from_source(&source).expect_err("mistakes");
                let is_placed = |place: &Place| matches!(place, Place::Text { line: 1.., column: 1.. });
                assert!(mistakes.as_slice().iter().all(|mistake| is_placed(&mistake.place)), "{mistakes}: {source}");
            }
        }
    }
    println!("{derived} derived, {refused} refused");
    assert!(derived * 20 > count);
}
