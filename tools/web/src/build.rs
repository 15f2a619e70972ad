//! Compiles this crate for the browser.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What browsers run.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Whether the standard library of [`TARGET`] is there.
#[must_use]
pub fn target_is_there() -> bool {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let place = Command::new(rustc).args(["--target", TARGET, "--print", "target-libdir"]).output();
    place.is_ok_and(|out| Path::new(String::from_utf8_lossy(&out.stdout).trim()).is_dir())
}

/// The kernels as a module of WebAssembly. `options` are of Cargo, such as `--release`.
///
/// # Errors
/// When they cannot be compiled.
pub fn kernels(options: &[&str]) -> Result<Vec<u8>, Box<dyn Error>> {
    if !target_is_there() {
        return Err(format!("`rustup target add {TARGET}` installs the missing target").into());
    }
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let out = Command::new(cargo)
        .args(["build", "--locked", "--lib", "--target", TARGET, "--message-format=json", "--manifest-path"])
        .arg(manifest)
        .args(options)
        .stderr(std::process::Stdio::inherit())
        .output()?;
    if !out.status.success() {
        return Err(format!("the kernels were not compiled for {TARGET}").into());
    }
    let messages = String::from_utf8(out.stdout)?;
    Ok(fs::read(module(&messages).ok_or("Cargo does not say where the module is")?)?)
}

/// The file of the module, from Cargo's messages.
fn module(messages: &str) -> Option<PathBuf> {
    let files = messages.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let names = files.filter_map(|message| {
        let all = message["filenames"].as_array()?.iter();
        all.filter_map(|file| file.as_str()).find(|file| file.ends_with("gauss_web.wasm")).map(PathBuf::from)
    });
    names.reduce(|_, last| last)
}
