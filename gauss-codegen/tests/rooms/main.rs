//! No two files import each other, by whatever way round.
//!
//! Of every file the names are looked up that it takes from others: in `use` declarations and in paths, through
//! re-exports to the file that defines them. A module that only hands on is seen through; tests do not count.

mod components;
mod modules;
mod references;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use components::components;
use modules::Modules;
use references::imports;

/// Circles that there are still, a line each: the crate, then its files. To be emptied, never to grow.
const ALLOWED: &str = "tests/rooms/circles.txt";

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

#[test]
fn no_files_import_each_other_in_a_circle() {
    let (mut found, mut explained) = (Vec::new(), String::new());
    for name in ["gauss-codegen", "gauss-runtime"] {
        for (files, lines) in circles(&here().join("..").join(name).join("src")) {
            let list: Vec<&str> = files.iter().map(String::as_str).collect();
            explained += &format!("{name}: a circle of {} files\n{lines}", files.len());
            found.push(format!("{name}: {}\n", list.join(" ")));
        }
    }
    let path = here().join(ALLOWED);
    if std::env::var("UPDATE_CIRCLES").is_ok_and(|value| value == "1") {
        fs::write(path, found.concat()).expect("the list can be written");
        return;
    }
    let allowed = fs::read_to_string(path).unwrap_or_default();
    let files = |text: &str| text.split_whitespace().filter(|word| !word.ends_with(':')).count();
    let (now, before) = (files(&found.concat()), files(&allowed));
    println!("{explained}");
    assert!(now <= before, "\n{explained}\n{now} files are in circles; {before} were");
    assert!(now == before, "{now} files are in circles, {before} were: write that down with UPDATE_CIRCLES=1");
}
