//! Gain of each pass over programs: instructions of some scenes with all of them, and with one left out.

#[path = "../../examples/structures/mod.rs"]
mod structures;

use std::fmt::Write;

use crate::algebra::Graph;
use crate::derivation::Derivation;
use crate::emit::Derived;
use crate::formulation::Formulation;
use crate::kernel::{Pass, Passes};
use crate::lowering::lower;
use crate::model::{parse, struct_in};
use crate::program::Instruction;
use crate::translate::translate;

/// A scene, and the methods that are counted.
struct CountedScene {
    label: &'static str,
    name: &'static str,
    source: String,
    methods: &'static [&'static str],
}

fn scenes() -> Vec<CountedScene> {
    let scene = |label, name, source, methods| CountedScene { label, name, source, methods };
    vec![
        scene("free body", "FreeBody", structures::free_body(", linearize"), &["acceleration", "linearize"]),
        scene("torpedo", "Torpedo", structures::torpedo(", linearize"), &["acceleration", "linearize"]),
        scene("heavy top, Euler angles", "Top", structures::top(", linearize"), &["acceleration", "linearize"]),
        scene("four links in the plane", "Chain", structures::planar(4, false), &["acceleration", "momentum_rate"]),
        scene("four links in space", "Chain", structures::spatial(4), &["acceleration", "momentum_rate"]),
        scene("arm", "Arm", structures::arm(", linearize"), &["acceleration", "momentum_rate", "linearize"]),
    ]
}

/// Robots from their files, which take seconds: where they are asked for by `ROBOTS=1`, with the feature `urdf`.
fn robots() -> Vec<CountedScene> {
    if !cfg!(feature = "urdf") || std::env::var("ROBOTS").is_err() {
        return Vec::new();
    }
    let robot = |label, file| {
        let path = format!("{}/../tests/robots/{file}", env!("CARGO_MANIFEST_DIR"));
        let source = format!("#[gauss(urdf = {path:?}, base = floating, gravity = 9.81)] struct Robot;");
        CountedScene { label, name: "Robot", source, methods: &["acceleration", "momentum_rate"] }
    };
    vec![robot("ANYmal", "anymal.urdf"), robot("Talos", "talos.urdf")]
}

const PASSES: [Pass; 7] =
    [Pass::Factors, Pass::Products, Pass::Sums, Pass::Fusing, Pass::Signs, Pass::ProductsInSums, Pass::Beginnings];

fn derived(source: &str, name: &str, passes: Passes) -> Derivation {
    let model = struct_in(source, name).and_then(|item| parse(&item)).unwrap_or_else(|error| panic!("{error}"));
    let graph = Graph::new();
    let formulation = translate(&graph, &model).and_then(Formulation::of).expect("equations");
    let lowered = lower(formulation, passes).expect("a kernel");
    Derivation::of(&Derived::new(&lowered), false).expect("programs")
}

/// Instructions of the methods: a multiply-add is one, sine and cosine of an angle are one.
fn instructions(scene: &CountedScene, left_out: Option<Pass>) -> Vec<usize> {
    let derivation = derived(&scene.source, scene.name, left_out.map_or_else(Passes::default, Passes::without));
    let count = |method: &&str| {
        let program = derivation.program(method).unwrap_or_else(|| panic!("{}: no {method}", scene.name));
        program.code.instructions.len()
    };
    scene.methods.iter().map(count).collect()
}

/// Every pass saves more than it costs, over these scenes; the table is printed for docs/benchmarks/expansion.md.
#[test]
fn every_pass_gains() {
    let names: Vec<String> = PASSES.iter().map(|pass| format!("{pass:?}")).collect();
    let mut table =
        format!("| scene | method | all | {} |\n|---|---|---|{}", names.join(" | "), "---|".repeat(PASSES.len()));
    let (mut sum, mut without) = (0, [0; PASSES.len()]);
    for scene in scenes().into_iter().chain(robots()) {
        let all = instructions(&scene, None);
        let each = PASSES.map(|pass| instructions(&scene, Some(pass)));
        for (k, method) in scene.methods.iter().enumerate() {
            let gain = |count: usize| format!("{:+.1} %", 100.0 * (count as f64 / all[k] as f64 - 1.0));
            let gains: Vec<String> = each.iter().map(|counts| gain(counts[k])).collect();
            write!(table, "\n| {} | `{method}` | {} | {} |", scene.label, all[k], gains.join(" | ")).unwrap();
            sum += all[k];
            without.iter_mut().zip(&each).for_each(|(sum, counts)| *sum += counts[k]);
        }
    }
    println!("{table}");
    for (pass, without) in PASSES.iter().zip(without) {
        assert!(without > sum, "without {pass:?}: {without} instructions, with it {sum}");
    }
}

/// Products that only sums read are formed in each of them, and those that something else reads too are not.
#[test]
fn products_go_into_sums() {
    let source = structures::top("");
    let all = derived(&source, "Top", Passes::default());
    let apart = derived(&source, "Top", Passes::without(Pass::ProductsInSums));
    let products = |derivation: &Derivation| {
        let program = derivation.program("acceleration").expect("of every kernel");
        program.code.instructions.iter().filter(|i| matches!(i, Instruction::Multiply(..))).count()
    };
    assert!(products(&all) < products(&apart));
    let state: [&[f64]; 2] = [&[0.3, 0.7, -0.2], &[1.1, -0.4, 2.3]];
    let constants = all.constants().run(&[&[1.2, 0.01, -0.02, 0.4, 0.8, 0.7, 0.2, 9.81]]);
    let constants = constants.expect("as many as it reads");
    let results = [&all, &apart].map(|derivation| {
        let program = derivation.program("acceleration").expect("of every kernel");
        program.run(&[&constants, &[0.0], state[0], state[1], &[]]).expect("as many as it reads")
    });
    // The interpreter rounds a product and a sum each: the same bits.
    assert_eq!(results[0], results[1]);
}
