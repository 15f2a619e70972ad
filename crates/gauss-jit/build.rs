//! The state of the sources that derive models, in a clone: what another state has derived is not read from a cache.
//! Published crates have a version for each state.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

fn main() {
    let mut files = Vec::new();
    for folder in ["../../gauss-codegen/src", "../gauss-robots/src", "src"] {
        if Path::new(folder).is_dir() {
            println!("cargo:rerun-if-changed={folder}");
            list(Path::new(folder), &mut files);
        }
    }
    files.sort();
    let mut state = DefaultHasher::new();
    for file in &files {
        file.hash(&mut state);
        std::fs::read(file).unwrap_or_default().hash(&mut state);
    }
    println!("cargo:rustc-env=GAUSS_SOURCES={:016x}", state.finish());
}

fn list(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() { list(&path, files) } else { files.push(path) }
    }
}
