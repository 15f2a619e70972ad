//! No two files import each other, by whatever way round; no function is longer than a screen.
//!
//! Of every file the names are looked up that it takes from others: in `use` declarations and in paths, through
//! re-exports to the file that defines them. A module that only hands on is seen through; tests do not count.

mod components;
mod functions;
mod modules;
mod references;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use components::components;
use functions::{Function, functions, functions_below};
use modules::Modules;
use references::imports;

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Files that import each other, and what they take, circle by circle.
fn circles(source: &Path) -> Vec<(BTreeSet<String>, String)> {
    let modules = Modules::of(source);
    let imports = imports(&modules);
    let circle = |files: BTreeSet<String>| {
        let inside = imports.iter().filter(|((from, to), _)| files.contains(from) && files.contains(to));
        let lines = inside.map(|((from, to), names)| {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            format!("  {from} → {to}: {}\n", names.join(", "))
        });
        let lines: String = lines.collect();
        (files, lines)
    };
    components(imports.keys()).into_iter().map(circle).collect()
}

/// The folders of the published libraries: the three main ones, and all in `crates`.
fn libraries() -> Vec<String> {
    let mut found = ["gauss-codegen", "gauss-derive", "gauss-runtime"].map(str::to_owned).to_vec();
    let folder = here().join("../crates");
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    found.extend(entries.map(|entry| format!("crates/{}", entry.expect("an entry").file_name().to_string_lossy())));
    found
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let libraries = libraries();
    assert!(libraries.len() > 10, "{libraries:?}");
    let mut found = String::new();
    for name in libraries {
        for (files, lines) in circles(&here().join("..").join(&name).join("src")) {
            found += &format!("{name}: a circle of {} files\n{lines}", files.len());
        }
    }
    assert!(found.is_empty(), "\n{found}");
}

/// Lines that a function may have between its braces.
const LINES: usize = 60;

/// Longer ones, and why they are: each is a table, a match whose arms are messages and nothing else.
const TABLES: [(&str, &str, &str); 3] = [
    ("gauss-codegen", "model/names/places.rs", "refusal"),
    ("gauss-codegen", "model/names/places.rs", "mismatch"),
    ("gauss-runtime", "error.rs", "fmt"),
];

#[test]
fn no_function_is_longer_than_a_screen() {
    let mut tables = TABLES.to_vec();
    let mut found = String::new();
    for package in ["gauss-codegen", "gauss-derive", "gauss-runtime"] {
        let modules = Modules::of(&here().join("..").join(package).join("src"));
        for Function { file, name, lines } in functions(&modules).into_iter().filter(|one| one.lines > LINES) {
            match tables.iter().position(|table| *table == (package, file.as_str(), name.as_str())) {
                Some(table) => drop(tables.remove(table)),
                None => found += &format!("{package}: {file}: {name} has {lines} lines\n"),
            }
        }
    }
    for folder in ["benches", "crates", "examples", "gauss-codegen/examples", "tests/src", "tools"] {
        for Function { file, name, lines } in functions_below(&here().join("..").join(folder)) {
            if lines > LINES {
                found += &format!("{file}: {name} has {lines} lines\n");
            }
        }
    }
    assert!(found.is_empty(), "\n{found}");
    assert!(tables.is_empty(), "no longer long: {tables:?}");
}
