//! Programs as functions of Rust that stand alone, compiled and run beside the interpreter.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

use crate::common::{Random, SCENES, close, derivation, random_arguments};
use gauss_codegen::program::{ArgumentKind, Program, Results};
use gauss_codegen::{Derivation, targets};
use proc_macro2::TokenStream;

/// States at which every function is called.
const STATES: usize = 6;

fn pretty(code: TokenStream) -> String {
    prettyplease::unparse(&syn::parse2(code).expect("a file"))
}

/// Statements that print one result, row by row.
fn printed(result: &Results, value: &str) -> String {
    let Results { rows, columns, .. } = result;
    match (result.is_scalar(), columns) {
        (true, _) => format!("println!(\"{{:?}}\", {value});"),
        (_, 1) => format!("let values: [f64; {rows}] = {value}; for x in values {{ println!(\"{{x:?}}\"); }}"),
        _ => format!(
            "let rows: [[f64; {columns}]; {rows}] = {value}; for x in rows.into_iter().flatten() {{ println!(\"{{x:?}}\"); }}"
        ),
    }
}

/// One call: a block that prints what the function gives, digits enough to read back the same numbers.
fn call(program: &Program, arguments: &[Vec<f64>]) -> String {
    let handed = program.arguments.iter().zip(arguments).filter(|(_, values)| !values.is_empty());
    let handed = handed.map(|(argument, values)| match argument.kind {
        ArgumentKind::Time => format!("{:?}", values[0]),
        _ => format!("&{values:?}"),
    });
    let arguments = handed.collect::<Vec<_>>().join(", ");
    let mut out = format!("    {{ let given = scene::{}({arguments});", program.name);
    let results: Vec<&Results> = program.results.iter().filter(|result| result.len() > 0).collect();
    for (k, result) in results.iter().enumerate() {
        let part = if results.len() == 1 { "given".to_owned() } else { format!("given.{k}") };
        write!(out, " {}", printed(result, &part)).expect("a string");
    }
    out + " }\n"
}

/// The functions of the scene called at random states, and what the interpreter says.
fn calls(derivation: &Derivation) -> (String, Vec<(String, f64)>) {
    let mut random = Random(13);
    let (mut main, mut expected) = (String::from("fn main() {\n"), Vec::new());
    for program in std::iter::once(derivation.constants()).chain(derivation.programs()) {
        for _ in 0..STATES {
            let arguments = random_arguments(derivation, program, &mut random);
            main.push_str(&call(program, &arguments));
            let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
            let outputs = program.run(&lists).expect("its arguments");
            expected.extend(outputs.into_iter().map(|value| (program.name.clone(), value)));
        }
    }
    (main + "}\n", expected)
}

/// Warnings are errors: the code is handed to people who read it.
#[test]
fn functions_compute_what_the_programs_say() {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    for (name, _) in SCENES {
        let derivation = derivation(name);
        let (main, expected) = calls(&derivation);
        let (file, binary) =
            (directory.join(format!("functions_of_{name}.rs")), directory.join(format!("rust_{name}")));
        let module = pretty(targets::rust::source(derivation.functions()));
        std::fs::write(directory.join(format!("scene_{name}.rs")), module).expect("a file of the test");
        let source = format!("#[path = \"scene_{name}.rs\"]\nmod scene;\n{main}");
        std::fs::write(&file, source).expect("a file of the test");
        let mut rustc = Command::new(option_env!("RUSTC").unwrap_or("rustc"));
        rustc.args(["--edition=2024", "-Dwarnings", "-Adead_code"]).arg(&file).arg("-o").arg(&binary);
        let compiled = rustc.output().expect("the compiler runs");
        assert!(compiled.status.success(), "{name}: {}", String::from_utf8_lossy(&compiled.stderr));
        let output = Command::new(binary).output().expect("it runs");
        let lines = String::from_utf8_lossy(&output.stdout).into_owned();
        let found: Vec<f64> = lines.lines().map(|line| line.parse().expect("a number")).collect();
        assert_eq!(found.len(), expected.len(), "{name}");
        for (found, (method, expected)) in found.iter().zip(&expected) {
            let same = close(*found, *expected) || (found.is_nan() && expected.is_nan());
            assert!(same, "{name}, {method}: {found} in Rust, {expected} here");
        }
    }
}

#[test]
fn a_file_of_functions() {
    insta::assert_snapshot!(pretty(targets::rust::source(derivation("Top").functions())));
}

/// Functions of the user's own are looked for in the module above.
#[test]
fn functions_to_be_provided() {
    let source = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = liftCurve(x), \
                  function(liftCurve = aero::lift, derivative = aero::slope))] struct Wing { m: f64 }";
    let code = pretty(targets::rust::source(Derivation::of_source(source, "Wing").expect("a scene").functions()));
    assert!(code.contains("use super::{lift_curve, lift_curve_1};"), "{code}");
}

/// A table of several numbers is a function of as many.
#[test]
fn tables_to_be_provided() {
    let source = "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), potential = well(x, y), \
                  table(well, axes = [X, Y], values = WELL, kind = cubic))] struct Wing { m: f64 }";
    let code = pretty(targets::rust::source(Derivation::of_source(source, "Wing").expect("a scene").functions()));
    assert!(code.contains("use super::{well, well_0_1, well_1_0};"), "{code}");
    assert!(code.contains("well_1_0(q[0], q[1])"), "{code}");
}
