//! `cargo gauss new`: a package that runs, one for Python, or an FMU.

use std::fs;

use crate::arguments::New;
use crate::fmu;
use crate::package::{Files, clone, from};
use crate::python;

const MAIN: &str = include_str!("template.rs.txt");

/// Crates that every program has, and the one that the package depends on.
const TAKEN: [&str; 6] = ["std", "core", "alloc", "proc_macro", "test", "gauss_runtime"];

/// Folders that Cargo makes next to the programs that it builds.
const FOLDERS: [&str; 4] = ["build", "deps", "examples", "incremental"];

/// Files that Windows has not.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Why no package has such a name, by the rules of `cargo new`.
fn impossible(name: &str) -> Option<&'static str> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let small = name.to_ascii_lowercase();
    let numbered = |device: &str| small.strip_prefix(device).is_some_and(|n| n.len() == 1 && ("0"..="9").contains(&n));
    let krate = name.replace('-', "_");
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) || !name.chars().all(fits) {
        Some("letters, digits, `-` and `_`, a letter first")
    } else if syn::parse_str::<syn::Ident>(name).is_err() && !name.contains('-') {
        Some("it is a word of Rust")
    } else if TAKEN.contains(&krate.as_str()) {
        Some("a crate of this name is there already, of Rust or of Gauss")
    } else if FOLDERS.contains(&name) {
        Some("Cargo makes folders of this name next to programs that it builds")
    } else if DEVICES.contains(&small.as_str()) || numbered("com") || numbered("lpt") {
        Some("Windows has no such files")
    } else {
        None
    }
}

/// Makes the folder with its manifest and its program, or the FMU.
///
/// # Errors
/// A name that no package can have, a folder that exists, mistakes in a robot's file, an error of the operating system;
/// of an FMU also mistakes of the scene and its numbers, and clauses without a counterpart.
pub fn create(wanted: &New) -> Result<(), String> {
    if wanted.fmu {
        return fmu::create(wanted);
    }
    let folder = &wanted.folder;
    let name = folder.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let why = impossible(name).or_else(|| if wanted.python { python::impossible(name) } else { None });
    if let Some(why) = why {
        return Err(format!("`{name}` is no name of a package: {why}"));
    }
    if folder.exists() {
        return Err(format!("{} exists", folder.display()));
    }
    // All of it is known to be right before anything is written.
    let files = if wanted.python { python::files(wanted, name)? } else { program(wanted, name)? };
    for (file, text) in &files {
        let path = folder.join(file);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|error| format!("{}: {error}", parent.display()))?;
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    match (&wanted.gauss, clone(wanted)) {
        (Some(_), _) => {}
        (None, Some(clone)) => println!("its crates are those of {}; `--gauss FOLDER` takes others", clone.display()),
        (None, None) => println!("its crates are the published ones; `--gauss FOLDER` takes those of a clone"),
    }
    let then = if wanted.python { "pip install ." } else { "cargo run --release" };
    println!("made {}; now `cd {} && {then}`", folder.display(), folder.display());
    Ok(())
}

/// A program.
fn program(wanted: &New, name: &str) -> Result<Files, String> {
    let (runtime, tables) = (from(wanted, "gauss-runtime")?, from(wanted, "crates/gauss-tables")?);
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\ngauss-runtime = {{ {runtime} }}\n\
         gauss-tables = {{ {tables}, default-features = false }}\n\n\
         # A macro that is not optimised takes longer to compile than it saves.\n[profile.dev.build-override]\nopt-level = 1\n\n\
         [workspace]\n"
    );
    let files = [("Cargo.toml", &manifest[..]), ("src/main.rs", MAIN), (".gitignore", "/target\n/top.csv\n")];
    Ok(files.map(|(file, text)| (file.to_owned(), text.as_bytes().to_vec())).to_vec())
}
