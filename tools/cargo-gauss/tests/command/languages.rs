//! The guide's programs in C and C++ run, and the one for a small processor. A test without its compiler says so.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::printed;

const GUIDE: &str = include_str!("../../../../guide/src/c.md");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The block of the guide in this language, and what the guide says that it prints.
fn program(language: &str) -> (&'static str, &'static str) {
    let (_, rest) = GUIDE.split_once(&format!("```{language}\n")).expect("a block");
    let (code, rest) = rest.split_once("```").expect("its end");
    let (_, rest) = rest.split_once("prints `").expect("what it prints");
    (code, rest.split('`').next().expect("a text"))
}

/// Writes what the guide's commands write, compiles the program and runs it.
fn prints_what_the_guide_says(language: &str, [compiler, standard]: [&str; 2], files: &[(&str, &str)], flags: &[&str]) {
    if Command::new(compiler).arg("--version").output().is_err() {
        println!("{compiler} is missing: nothing tested");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("guide_{language}"));
    fs::create_dir_all(&folder).expect("a folder of the test");
    let scene = root().join("examples/cart_pole.rs");
    for (form, file) in files {
        let output = folder.join(file);
        let [scene, output] = [&scene, &output].map(|path| path.to_str().expect("UTF-8"));
        printed(&["show", scene, "CartPole", "--as", form, "--output", output]);
    }
    let (code, expected) = program(language);
    let main = folder.join(format!("main.{language}"));
    fs::write(&main, code).expect("a folder that can be written");
    let binary = folder.join("main");
    let mut command = Command::new(compiler);
    command.current_dir(&folder).args([standard, "-Wall", "-Wextra", "-Werror"]).args(flags).arg(&main);
    let sources = files.iter().map(|(_, file)| file).filter(|file| file.ends_with(".c"));
    let output = command.args(sources).args(["-lm", "-o"]).arg(&binary).output().expect("the compiler runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let output = Command::new(binary).output().expect("it runs");
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), expected);
}

#[test]
fn the_guides_program_in_c() {
    let files = [("c", "cart_pole.c"), ("header", "cart_pole.h")];
    prints_what_the_guide_says("c", ["cc", "-std=c99"], &files, &[]);
}

#[test]
fn the_guides_program_in_cpp() {
    let eigen = "/usr/include/eigen3";
    if !Path::new(eigen).is_dir() {
        println!("Eigen is missing: nothing tested");
        return;
    }
    prints_what_the_guide_says("cpp", ["c++", "-std=c++17"], &[("cpp", "cart_pole.hpp")], &["-isystem", eigen]);
}

/// One rule of MISRA C that cppcheck knows is not kept, as the guide says: no declaration stands before a function.
#[test]
fn rules_for_safety_that_functions_in_c_keep() {
    if Command::new("cppcheck").arg("--version").output().is_err() {
        println!("cppcheck is missing: nothing tested");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [scene, file] = [root().join("examples/first/main.rs"), folder.join("torpedo_rules.c")];
    let [scene, file] = [&scene, &file].map(|path| path.to_str().expect("UTF-8"));
    printed(&["show", scene, "Torpedo", "--as", "c", "--output", file]);
    let mut check = Command::new("cppcheck");
    let output = check.args(["--addon=misra", "--std=c99", "--quiet", "--template={id}", file]).output();
    let said = String::from_utf8_lossy(&output.expect("it runs").stderr).into_owned();
    let functions = fs::read_to_string(file).expect("it was written").matches("\n{\n").count();
    let found: Vec<&str> = said.lines().collect();
    assert!(found.iter().all(|rule| *rule == "misra-c2012-8.4"), "{said}");
    assert_eq!(found.len(), functions, "{said}");
}

/// The speeds of the torpedo in single precision are those in double precision, here and on a Cortex-M4 where QEMU is.
#[test]
fn the_torpedo_on_a_small_processor() {
    if Command::new("bash").arg("--version").output().is_err() || Command::new("cc").arg("--version").output().is_err()
    {
        println!("bash or a C compiler is missing: nothing tested");
        return;
    }
    let mut run = Command::new("bash");
    run.arg(root().join("examples/cortex_m/run")).env("CARGO_GAUSS", env!("CARGO_BIN_EXE_cargo-gauss"));
    let output = run.env("OUT", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cortex_m")).output().expect("it runs");
    let [said, mistakes] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(output.status.success(), "{said}{mistakes}");
    assert!(said.contains("1509552"), "{said}");
}
