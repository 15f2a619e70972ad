//! No two files import each other, nor two folders, by whatever way round; `syn` is named where structs are read, the
//! scene as it was written up to `translate`; no function is longer than a screen, no file than 600 lines, no comment
//! wider than 120 columns; docs begin with what an item is or does.
//!
//! Of every file the names are looked up that it takes from others: in `use` declarations and in paths, through
//! re-exports to the file that defines them. A module that only hands on is seen through; tests do not count.

mod components;
mod functions;
mod modules;
mod references;
mod words;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use components::components;
use functions::{Function, functions, functions_below};
use modules::{Module, Modules};
use references::{Imports, between_parts, imports, paths};

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// What imports each other, and what it takes, circle by circle.
fn circles(imports: &Imports) -> Vec<(BTreeSet<String>, String)> {
    let circle = |members: BTreeSet<String>| {
        let inside = imports.iter().filter(|((from, to), _)| members.contains(from) && members.contains(to));
        let lines = inside.map(|((from, to), names)| {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            format!("  {from} → {to}: {}\n", names.join(", "))
        });
        let lines: String = lines.collect();
        (members, lines)
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

/// All files of Rust, by path from the top of the repository.
fn files() -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![here().join("..")];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if path.is_dir() && name != "target" && !name.starts_with('.') {
                folders.push(path);
            } else if name.ends_with(".rs") {
                let path = path.strip_prefix(here().join("..")).expect("it is below");
                found.push(path.display().to_string());
            }
        }
    }
    found.sort();
    found
}

/// The root files of all libraries, programs and tests that have more than one file.
fn roots() -> Vec<String> {
    let is_root = |file: &String| ["lib.rs", "main.rs"].iter().any(|root| Path::new(file).ends_with(root));
    files().into_iter().filter(is_root).collect()
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let roots = roots();
    assert!(roots.len() > 60, "{roots:?}");
    assert!(libraries().iter().all(|library| roots.contains(&format!("{library}/src/lib.rs"))), "{roots:?}");
    let mut found = String::new();
    for root in roots {
        for (files, lines) in circles(&imports(&Modules::of(&here().join("..").join(&root)))) {
            found += &format!("{root}: a circle of {} files\n{lines}", files.len());
        }
    }
    assert!(found.is_empty(), "\n{found}");
}

#[test]
fn no_folders_import_each_other_in_a_circle() {
    let mut found = String::new();
    for library in libraries() {
        let imports = imports(&Modules::of(&here().join("..").join(&library).join("src/lib.rs")));
        for (parts, lines) in between_parts(&imports).iter().flat_map(circles) {
            found += &format!("{library}: a circle of {} folders\n{lines}", parts.len());
        }
    }
    assert!(found.is_empty(), "\n{found}");
}

/// Files beside those of `model` that name `syn`: what is handed a struct, or the text of one.
const ENTRANCES: [&str; 4] = ["derivation/mod.rs", "emit/fallback.rs", "expand.rs", "scene.rs"];

#[test]
fn syn_is_named_where_structs_are_read() {
    let modules = Modules::of(&here().join("src/lib.rs"));
    let of_syn = |module: &Module| paths(module).iter().any(|path| path.first().is_some_and(|root| root == "syn"));
    let named = modules.iter().map(|(_, module)| module).filter(|module| of_syn(module)).map(|module| &module.file);
    let files: BTreeSet<&str> = named.map(String::as_str).filter(|file| !file.starts_with("model/")).collect();
    assert_eq!(files, BTreeSet::from(ENTRANCES));
}

/// What names the scene as it was written beside `model` and `translate`, and why.
const READERS: [(&str, &str); 5] = [
    // Structs in the text of a file are derived as well.
    ("derivation/mod.rs", "only_struct_in"),
    ("derivation/mod.rs", "struct_in"),
    // The steps, one after another.
    ("expand.rs", "Model"),
    ("expand.rs", "parse"),
    // Scenes in Rust become the struct that is parsed.
    ("scene.rs", "item"),
];

#[test]
fn nothing_behind_the_translation_names_the_model() {
    let imports = imports(&Modules::of(&here().join("src/lib.rs")));
    let of_model = |file: &str| file.starts_with("model/");
    let mut found: BTreeSet<(&str, &str)> = BTreeSet::new();
    for ((from, to), names) in &imports {
        if of_model(to) && !of_model(from) && !from.starts_with("translate/") {
            found.extend(names.iter().map(|name| (from.as_str(), name.as_str())));
        }
    }
    assert_eq!(found, BTreeSet::from(READERS));
}

/// Files of `emit` that name the chart of a scene: for people, and where the runtime has functions for each.
const OF_CHARTS: [&str; 3] = ["emit/chart.rs", "emit/quantities/pose.rs", "emit/text/documentation.rs"];

#[test]
fn emission_does_not_ask_for_the_chart_of_a_scene() {
    let imports = imports(&Modules::of(&here().join("src/lib.rs")));
    let of_charts = imports.keys().filter(|(from, to)| from.starts_with("emit/") && to == "terms/charts.rs");
    let files: BTreeSet<&str> = of_charts.map(|(from, _)| from.as_str()).collect();
    assert_eq!(files, BTreeSet::from(OF_CHARTS));
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
        let modules = Modules::of(&here().join("..").join(package).join("src/lib.rs"));
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

/// Lines that a file may have, and columns of a comment.
const LINES_OF_FILE: usize = 600;
const COLUMNS: usize = 120;

#[test]
fn files_are_short_and_comments_narrow() {
    let mut found = String::new();
    for file in files() {
        let path = here().join("..").join(&file);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
        if text.lines().count() > LINES_OF_FILE {
            found += &format!("{file} has {} lines\n", text.lines().count());
        }
        // Rows of tables and code that is a test cannot be broken, and what compilers say of a mistake names its line.
        let mut in_code = file.starts_with("tests/compile_fail/");
        for (line, number) in text.lines().zip(1..) {
            let Some(comment) = line.trim_start().strip_prefix("//") else { continue };
            let comment = comment.trim_start_matches(['/', '!', ' ']);
            in_code ^= comment.starts_with("```");
            if !in_code && !comment.starts_with('|') && line.chars().count() > COLUMNS {
                found += &format!("{file}:{number} has {} columns\n", line.chars().count());
            }
        }
    }
    assert!(found.is_empty(), "\n{found}");
}
