//! Programs in C, compiled and run beside the interpreter. Where there is no C compiler there is nothing to test.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{Random, SCENES, close, derivation, random_arguments};
use gauss_codegen::program::{ArgumentKind, Program};
use gauss_codegen::{Derivation, targets};

/// States at which every function is called.
const STATES: usize = 6;

fn compiler() -> Option<&'static str> {
    ["cc", "gcc", "clang"].into_iter().find(|name| Command::new(name).arg("--version").output().is_ok())
}

/// One call: a block that prints the results of the function, digits enough to read back the same numbers.
fn call(derivation: &Derivation, program: &Program, arguments: &[Vec<f64>]) -> String {
    let mut out = String::from("    {\n");
    let mut names = Vec::new();
    for (argument, values) in program.arguments.iter().zip(arguments).filter(|(_, values)| !values.is_empty()) {
        let list: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
        if argument.kind == ArgumentKind::Time {
            names.push(list[0].clone());
        } else {
            writeln!(out, "        const double {}[] = {{{}}};", argument.name, list.join(", ")).expect("a string");
            names.push(argument.name.clone());
        }
    }
    let function = format!("{}_{}", derivation.name().to_lowercase(), program.name);
    if matches!(program.results.as_slice(), [result] if result.is_scalar()) {
        writeln!(out, "        printf(\"%.17g\\n\", {function}({}));\n    }}", names.join(", ")).expect("a string");
        return out;
    }
    for (k, result) in program.results.iter().enumerate().filter(|(_, result)| result.len() > 0) {
        writeln!(out, "        double out{k}[{}];", result.len()).expect("a string");
        names.push(format!("out{k}"));
    }
    writeln!(out, "        {function}({});", names.join(", ")).expect("a string");
    for (k, result) in program.results.iter().enumerate().filter(|(_, result)| result.len() > 0) {
        let count = result.len();
        writeln!(out, "        for (int i = 0; i < {count}; i++) printf(\"%.17g\\n\", out{k}[i]);").expect("a string");
    }
    out.push_str("    }\n");
    out
}

/// The functions of the scene called at random states, and what the interpreter says.
fn calls(derivation: &Derivation) -> (String, Vec<(String, f64)>) {
    let mut random = Random(11);
    let (mut main, mut expected) = (String::from("#include <stdio.h>\n\nint main(void)\n{\n"), Vec::new());
    for program in std::iter::once(derivation.constants()).chain(derivation.programs()) {
        for _ in 0..STATES {
            let arguments = random_arguments(derivation, program, &mut random);
            main.push_str(&call(derivation, program, &arguments));
            let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
            let outputs = program.run(&lists).expect("its arguments");
            expected.extend(outputs.into_iter().map(|value| (program.name.clone(), value)));
        }
    }
    main.push_str("    return 0;\n}\n");
    (main, expected)
}

fn compiled(compiler: &str, directory: &Path, name: &str, source: &str) -> PathBuf {
    let (file, binary) = (directory.join(format!("{name}.c")), directory.join(name));
    std::fs::write(&file, source).expect("a file of the test");
    // All warnings are errors: users have stricter settings than the default.
    let strict = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];
    let output = Command::new(compiler).args(strict).args([&file, Path::new("-o"), &binary]).arg("-lm").output();
    let output = output.expect("the compiler runs");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    binary
}

#[test]
fn functions_in_c_compute_what_the_programs_say() {
    let Some(compiler) = compiler() else {
        println!("no C compiler: nothing tested");
        return;
    };
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    for (name, _) in SCENES {
        let derivation = derivation(name);
        let (main, expected) = calls(&derivation);
        let source = format!("{}\n{main}", targets::c::source(derivation.functions()));
        let output = Command::new(compiled(compiler, &directory, name, &source)).output().expect("it runs");
        let found: Vec<f64> =
            String::from_utf8_lossy(&output.stdout).lines().map(|line| line.parse().expect("a number")).collect();
        assert_eq!(found.len(), expected.len(), "{name}");
        for (found, (method, expected)) in found.iter().zip(&expected) {
            let same = close(*found, *expected) || (found.is_nan() && expected.is_nan());
            assert!(same, "{name}, {method}: {found} in C, {expected} here");
        }
        assert!(expected.iter().filter(|(_, value)| value.is_finite()).count() * 10 > expected.len() * 9, "{name}");
    }
}

#[test]
fn a_function_in_c() {
    insta::assert_snapshot!(targets::c::source(derivation("Top").functions()));
}

#[test]
fn a_header_in_c() {
    insta::assert_snapshot!(targets::c::declarations(derivation("Rod").functions()));
}

/// Functions of the user's own are declared, and whoever links the code provides them.
#[test]
fn functions_to_be_provided() {
    let source = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = liftCurve(x), \
                  function(liftCurve = aero::lift, derivative = aero::slope))] struct Wing { m: f64 }";
    let wing = Derivation::of_source(source, "Wing").expect("a scene");
    let code = targets::c::source(wing.functions());
    assert!(code.contains("double lift_curve(double x);\ndouble lift_curve_1(double x);\n"), "{code}");
    assert!(wing.program("acceleration").expect("it").to_string().contains("liftCurve'(x)"));
    // The interpreter does not know them.
    let energy = wing.program("potential_energy").expect("it");
    let arguments: Vec<Vec<f64>> = energy.arguments.iter().map(|a| vec![0.5; a.components.len()]).collect();
    let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
    assert!(energy.run(&lists).expect("its arguments")[0].is_nan());
}

/// A table of several numbers is a function of as many; the orders of a derivative follow its name.
#[test]
fn tables_to_be_provided() {
    let source = "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), potential = well(x, y), \
                  table(well, axes = [X, Y], values = WELL, kind = cubic))] struct Wing { m: f64 }";
    let code = targets::c::source(Derivation::of_source(source, "Wing").expect("a scene").functions());
    for declared in ["double well(double x, double y);", "double well_0_1(double x, double y);"] {
        assert!(code.contains(declared), "{code}");
    }
    assert!(code.contains("= well_1_0(q[0], q[1]);"), "{code}");
}

/// CasADi itself calls them in the tests of the command, in Python; here all that can be written must compile.
#[test]
fn functions_for_casadi_compile_without_a_warning() {
    let Some(compiler) = compiler() else {
        println!("no C compiler: nothing tested");
        return;
    };
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    // Without fields there are no parameters.
    let numbers =
        "#[gauss(coordinates(x), particle(mass = 2, position = [x, 0, 0]), drive(x = -3 * x))] struct Numbers {}";
    let numbers = Derivation::of_source(numbers, "Numbers").expect("a scene");
    for derivation in [derivation("Top"), derivation("Laws"), derivation("Arms"), numbers] {
        let name = derivation.name();
        let functions = derivation.functions().only(&["acceleration", "mass_matrix"].map(String::from));
        let source = targets::casadi::source(&functions.expect("both are there")).expect("of right shape");
        let main = "int main(void)\n{\n    return 0;\n}\n";
        compiled(compiler, &directory, &format!("{name}_casadi"), &format!("{source}\n{main}"));
    }
}
