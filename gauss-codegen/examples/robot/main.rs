//! What a robot costs, from its file: `cargo run --release --example robot -- path/to.urdf [CLAUSE…] [--write
//! FILE.rs|FOLDER]`.
//!
//! Clauses are those that stand beside the file in `#[gauss(…)]`, such as `base=floating gravity=9.81 linearize`. With
//! `--write arm.rs` the struct and what the derive makes of it become a source file, with `--write arm` a crate; both
//! need gauss-runtime and no macro. With `--values` states are read, and what every method gives is written
//! (`values.rs`).

mod values;

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use gauss_codegen::Derivation;
use quote::{format_ident, quote};

const USAGE: &str =
    "robot FILE [CLAUSE…] [--write FILE.rs|FOLDER], such as: robot arm.urdf gravity=9.81 --write arm.rs";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let (file, rest) = arguments.split_first().ok_or(USAGE)?;
    let (clauses, target, answers) = match rest {
        [clauses @ .., flag, target] if flag == "--write" => (clauses, Some(target), false),
        [clauses @ .., flag] if flag == "--values" => (clauses, None, true),
        clauses => (clauses, None, false),
    };
    if clauses.iter().any(|clause| clause.starts_with('-')) {
        return Err(USAGE.to_owned());
    }
    let word = if file.ends_with(".xml") || file.ends_with(".mjcf") { "mjcf" } else { "urdf" };
    let path = std::path::absolute(file).map_err(|error| format!("{file}: {error}"))?;
    let name = name(&path);
    let clauses: String = clauses.iter().map(|clause| format!(", {clause}")).collect();
    let source = format!("#[gauss({word} = {path:?}{clauses})] pub struct {name};");
    let start = Instant::now();
    let item = syn::parse_str(&source).map_err(|error| format!("{error}\n{USAGE}"))?;
    // The path from the folder of a package means nothing here; the one that was given does.
    let shown = |text: String| text.replace(&*path.to_string_lossy(), file);
    let derivation = Derivation::new(&item).map_err(|mistakes| shown(said(&mistakes)))?;
    let seconds = start.elapsed().as_secs_f64();
    if answers {
        values::answer(&derivation, seconds, std::io::stdin().lock(), std::io::stdout().lock())?;
        return Ok(String::new());
    }
    let mut out = shown(table(&derivation, seconds));
    if let Some(target) = target {
        let place = write(&derivation, file, Path::new(target)).map_err(|error| format!("{target}: {error}"))?;
        let _ = writeln!(out, "\nThe kernel is in {place}.");
    }
    Ok(out)
}

/// A source file, or in a folder a crate.
fn write(derivation: &Derivation, file: &str, target: &Path) -> Result<String, String> {
    let text = written(derivation, file)?;
    let save = |path: &Path, text: &str| std::fs::write(path, text).map_err(|error| error.to_string());
    if target.extension().is_some_and(|end| end == "rs") {
        save(target, &text)?;
        return Ok(target.display().to_string());
    }
    let source = target.join("src");
    std::fs::create_dir_all(&source).map_err(|error| error.to_string())?;
    save(&target.join("Cargo.toml"), &manifest(derivation.name()))?;
    save(&source.join("lib.rs"), &text)?;
    Ok(source.join("lib.rs").display().to_string())
}

/// A package of its own, with the runtime that its code is made for: a path, which a version alone can replace.
fn manifest(name: &str) -> String {
    let name = name.to_lowercase();
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("gauss-runtime");
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\n\
         gauss-runtime = {{ version = \"={version}\", path = {runtime:?}, default-features = false, features = [\"std\"] \
         }}\n\n[workspace]\n"
    )
}

/// `TwoFingers` from `two-fingers.urdf`.
fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let words = stem.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let name: String = words.map(|word| word[..1].to_uppercase() + &word[1..]).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("Robot{name}") }
}

fn said(mistakes: &syn::Error) -> String {
    mistakes.into_iter().map(|mistake| mistake.to_string()).collect::<Vec<_>>().join("\n")
}

fn table(derivation: &Derivation, seconds: f64) -> String {
    let mut out = format!("{}: ", derivation.name());
    if let Some(acceleration) = derivation.program("acceleration") {
        let _ = writeln!(out, "{} degrees of freedom, derived in {seconds:.1} s\n", acceleration.code.outputs.len());
    }
    for remark in derivation.remarks() {
        let _ = writeln!(out, "- {remark}");
    }
    let _ = writeln!(out, "\n{:<22}{:<56}loss, at most (in the middle)", "method", "operations");
    for program in derivation.programs() {
        let loss = derivation.accuracy().iter().find(|(name, _)| *name == program.name);
        let loss = loss.map(|(_, [worst, median])| format!("{worst} ({median})")).unwrap_or_default();
        let _ = writeln!(out, "{:<22}{:<56}{loss}", program.name, program.code.counts().to_string());
    }
    out
}

/// The struct, and its kernel as the derive writes it.
fn written(derivation: &Derivation, file: &str) -> Result<String, String> {
    let name = format_ident!("{}", derivation.name());
    let code = derivation.rust().ok_or("the derivation of a text has no code in Rust")?;
    let item = quote! {
        /// A robot.
        pub struct #name;

        #code
    };
    let file = format!("{file} of gauss-codegen");
    let parsed = syn::parse2(item).map_err(|error| format!("{file}: {error}"))?;
    let text = prettyplease::unparse(&parsed);
    // Here nothing is derived, which rustc would say, as it would of parentheses.
    let lines = text.lines().filter(|line| line.trim() != "#[automatically_derived]");
    let lines: String = lines.map(|line| format!("{line}\n")).collect();
    Ok(format!("// Made from {file}: do not edit.\n#![allow(unused_parens)]\n\n{lines}"))
}
