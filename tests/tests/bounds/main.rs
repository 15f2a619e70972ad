//! Bounds of rounding are never below the true error: of each operation, of kernels on thousands of random scenes, and
//! on the reference scenes, their runs included. Truth is the same code in double-double numbers (31 digits), or exact
//! scaling where magnitudes leave their range.
//!
//! `cargo test -p gauss-tests --test bounds -- --nocapture` prints by how much bounds exceed errors.

#[path = "../common/mod.rs"]
#[macro_use]
mod common;

mod bodies;
mod compare;
mod methods;
mod operations;
mod random;
mod references;
mod systems;

/// Every file of `data/reference` is named in a test.
#[test]
fn no_reference_scene_is_left_out() {
    let tests = [include_str!("bodies.rs"), include_str!("references.rs"), include_str!("systems.rs")];
    let files = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/data/reference")).expect("the references");
    for path in files.map(|file| file.expect("a file").path()) {
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name");
        let named = tests.iter().any(|test| test.contains(&format!("\"{name}\"")));
        assert!(named || path.extension().is_none_or(|kind| kind != "json"), "{name} is in no test of bounds");
    }
}
