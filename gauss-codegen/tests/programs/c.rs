//! Programs in C, compiled and run beside the interpreter. Where there is no C compiler there is nothing to test.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{Random, SCENES, close, derivation, random_arguments};
use gauss_codegen::program::{ArgumentKind, Program, Scalar};
use gauss_codegen::targets::c::Precision;
use gauss_codegen::{Derivation, targets};

/// States at which every function is called.
const STATES: usize = 6;

/// A language that functions are written in, with the type of its numbers.
pub struct Language {
    pub compilers: &'static [&'static str],
    pub flags: &'static [&'static str],
    pub ending: &'static str,
    /// Between the name of the scene and that of a method.
    pub between: &'static str,
    pub number: &'static str,
}

/// All warnings are errors: users have stricter settings than the default. A promotion would be one as well.
const STRICT: [&str; 7] = ["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wconversion", "-Wdouble-promotion"];
const C: Language =
    Language { compilers: &["cc", "gcc", "clang"], flags: &["-std=c99"], ending: "c", between: "_", number: "double" };

impl Language {
    fn compiler(&self) -> Option<&'static str> {
        let found = self.compilers.iter().find(|name| Command::new(name).arg("--version").output().is_ok());
        if found.is_none() {
            println!("none of {:?} is there: nothing tested", self.compilers);
        }
        found.copied()
    }

    /// One call: a block that prints the results of the function, digits enough to read back the same numbers.
    fn call(&self, derivation: &Derivation, program: &Program, arguments: &[Vec<f64>]) -> String {
        let (mut out, number) = (String::from("    {\n"), self.number);
        let mut names = Vec::new();
        for (argument, values) in program.arguments.iter().zip(arguments).filter(|(_, values)| !values.is_empty()) {
            let list: Vec<String> = values.iter().map(|value| format!("({number}){value:?}")).collect();
            if argument.kind == ArgumentKind::Time {
                names.push(list[0].clone());
            } else {
                writeln!(out, "        const {number} {}[] = {{{}}};", argument.name, list.join(", ")).expect("it");
                names.push(argument.name.clone());
            }
        }
        let function = format!("{}{}{}", derivation.name().to_lowercase(), self.between, program.name);
        if matches!(program.results.as_slice(), [result] if result.is_scalar()) {
            writeln!(out, "        print({function}({}));\n    }}", names.join(", ")).expect("it");
            return out;
        }
        for (k, result) in program.results.iter().enumerate().filter(|(_, result)| result.len() > 0) {
            writeln!(out, "        {number} out{k}[{}];", result.len()).expect("it");
            names.push(format!("out{k}"));
        }
        writeln!(out, "        {function}({});", names.join(", ")).expect("it");
        for (k, result) in program.results.iter().enumerate().filter(|(_, result)| result.len() > 0) {
            writeln!(out, "        for (int i = 0; i < {}; i++) print(out{k}[i]);", result.len()).expect("it");
        }
        out.push_str("    }\n");
        out
    }

    /// The functions of the scene called at random states, and what the interpreter says in numbers of the same kind.
    fn calls<T: Number>(&self, derivation: &Derivation) -> (String, Vec<(String, f64)>) {
        let (mut random, mut expected) = (Random(11), Vec::new());
        let mut main = format!(
            "#include <stdio.h>\n\nstatic void print({} x)\n{{\n    printf(\"%.17g\\n\", (double)x);\n}}\n\n\
             int main(void)\n{{\n",
            self.number
        );
        for program in std::iter::once(derivation.constants()).chain(derivation.programs()) {
            for _ in 0..STATES {
                let arguments = random_arguments(derivation, program, &mut random);
                main.push_str(&self.call(derivation, program, &arguments));
                let typed = |list: &Vec<f64>| -> Vec<T> { list.iter().map(|value| T::number(*value)).collect() };
                let lists: Vec<Vec<T>> = arguments.iter().map(typed).collect();
                let lists: Vec<&[T]> = lists.iter().map(Vec::as_slice).collect();
                let outputs = program.run(&lists).expect("its arguments");
                expected.extend(outputs.into_iter().map(|value| (program.name.clone(), value.into())));
            }
        }
        main.push_str("    return 0;\n}\n");
        (main, expected)
    }

    pub fn compiled(&self, name: &str, source: &str) -> Option<PathBuf> {
        let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
        let binary = directory.join(format!("{name}_{}_{}", self.ending, self.number));
        let file = binary.with_extension(self.ending);
        std::fs::write(&file, source).expect("a file of the test");
        let mut command = Command::new(self.compiler()?);
        command.args(self.flags).args(STRICT).args([&file, Path::new("-o"), &binary]).arg("-lm");
        let output = command.output().expect("the compiler runs");
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        Some(binary)
    }

    /// Compiles the functions of all scenes, calls them, and holds them to the interpreter.
    pub fn agrees<T: Number>(&self, source: impl Fn(&Derivation) -> String, same: impl Fn(f64, f64) -> bool) {
        for (name, _) in SCENES {
            let derivation = derivation(name);
            let (main, expected) = self.calls::<T>(&derivation);
            let Some(binary) = self.compiled(name, &format!("{}\n{main}", source(&derivation))) else {
                return;
            };
            let output = Command::new(binary).output().expect("it runs");
            let found: Vec<f64> =
                String::from_utf8_lossy(&output.stdout).lines().map(|line| line.parse().expect("a number")).collect();
            assert_eq!(found.len(), expected.len(), "{name}");
            for (found, (method, expected)) in found.iter().zip(&expected) {
                let same = same(*found, *expected) || (found.is_nan() && expected.is_nan());
                assert!(same, "{name}, {method}: {found} in {}, {expected} here", self.ending);
            }
            let finite = expected.iter().filter(|(_, value)| value.is_finite()).count();
            assert!(finite * 10 > expected.len() * 9, "{name}");
        }
    }
}

/// A number of the interpreter that a `double` holds.
pub trait Number: Scalar + Into<f64> {}

impl<T: Scalar + Into<f64>> Number for T {}

fn source(derivation: &Derivation) -> String {
    targets::c::source(derivation.functions(), Precision::Double).expect("a double holds all numbers")
}

#[test]
fn functions_in_c_compute_what_the_programs_say() {
    C.agrees::<f64>(source, close);
}

/// Without a promotion to `double`, and without fused products: to the last bit.
#[test]
fn functions_of_floats_have_the_bits_of_the_programs() {
    let single = |derivation: &Derivation| {
        targets::c::source(derivation.functions(), Precision::Single).expect("a float holds all numbers")
    };
    let floats = Language { number: "float", flags: &["-std=c99", "-ffp-contract=off"], ..C };
    floats.agrees::<f32>(single, |found, expected| found == expected);
}

/// A number that is zero or infinite as a `float` is refused, with its method.
#[test]
fn numbers_that_no_float_holds_are_refused() {
    let scene = |number: &str| {
        let clauses = format!("coordinates(x), particle(mass = m, position = [x, 0, 0]), drive(x = {number} * x)");
        Derivation::of_source(&format!("#[gauss({clauses})] struct Far {{ m: f64 }}"), "Far").expect("a scene")
    };
    for number in ["1e39", "1e-40"] {
        let error = targets::c::source(scene(number).functions(), Precision::Single).expect_err("beyond the range");
        // A number of literals alone is a constant.
        assert_eq!(error.method, "kernel");
        assert!(error.to_string().contains("which no `float` holds"), "{error}");
        source(&scene(number));
    }
    assert!(targets::c::source(scene("1e-37").functions(), Precision::Single).is_ok());
}

#[test]
fn a_function_in_c() {
    insta::assert_snapshot!(source(&derivation("Top")));
}

#[test]
fn a_header_in_c() {
    insta::assert_snapshot!(targets::c::header(derivation("Rod").functions(), Precision::Double));
}

/// Functions of the user's own are declared, and whoever links the code provides them.
#[test]
fn functions_to_be_provided() {
    let scene = "#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), potential = liftCurve(x), \
                  function(liftCurve = aero::lift, derivative = aero::slope))] struct Wing { m: f64 }";
    let wing = Derivation::of_source(scene, "Wing").expect("a scene");
    let code = source(&wing);
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
    let wells = "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), potential = well(x, y), \
                  table(well, axes = [X, Y], values = WELL, kind = cubic))] struct Wing { m: f64 }";
    let code = source(&Derivation::of_source(wells, "Wing").expect("a scene"));
    for declared in ["double well(double x, double y);", "double well_0_1(double x, double y);"] {
        assert!(code.contains(declared), "{code}");
    }
    assert!(code.contains("= well_1_0(q[0], q[1]);"), "{code}");
}

/// CasADi itself calls them in the tests of the command, in Python; here all that can be written must compile.
#[test]
fn functions_for_casadi_compile_without_a_warning() {
    // Without fields there are no parameters.
    let numbers =
        "#[gauss(coordinates(x), particle(mass = 2, position = [x, 0, 0]), drive(x = -3 * x))] struct Numbers {}";
    let numbers = Derivation::of_source(numbers, "Numbers").expect("a scene");
    for derivation in [derivation("Top"), derivation("Laws"), derivation("Arms"), numbers] {
        let name = derivation.name();
        let functions = derivation.functions().only(&["acceleration", "mass_matrix"].map(String::from));
        let source = targets::casadi::source(&functions.expect("both are there")).expect("of right shape");
        let main = "int main(void)\n{\n    return 0;\n}\n";
        C.compiled(&format!("{name}_casadi"), &format!("{source}\n{main}"));
    }
}
