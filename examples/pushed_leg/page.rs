//! The page on which the leg hops: one file, with the leg in it as a module of WebAssembly.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

/// What browsers run.
const TARGET: &str = "wasm32-unknown-unknown";
const TEMPLATE: &str = include_str!("live.html");
const STYLE: &str = include_str!("live.css");
const SCRIPT: &str = include_str!("live.js");

/// Whether the standard library of WebAssembly is there.
#[must_use]
pub fn target_is_there() -> bool {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let place = Command::new(rustc).args(["--target", TARGET, "--print", "target-libdir"]).output();
    place.is_ok_and(|out| Path::new(String::from_utf8_lossy(&out.stdout).trim()).is_dir())
}

/// The leg as a module of WebAssembly, compiled for speed or, for tests, in less time.
///
/// # Errors
/// When it cannot be compiled.
pub fn module(for_speed: bool) -> Result<Vec<u8>, Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| here.join("../target"), PathBuf::from);
    let target = target.join("pushed_leg");
    let (profile, options) = if for_speed { ("release", &["--release"][..]) } else { ("debug", &[][..]) };
    let status = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--quiet", "--locked", "--lib", "--target", TARGET, "--manifest-path"])
        .arg(here.join("pushed_leg/browser/Cargo.toml"))
        .arg("--target-dir")
        .arg(&target)
        .args(options)
        .stdout(Stdio::null())
        .status()?;
    if !status.success() {
        return Err(format!("the leg was not compiled for {TARGET}").into());
    }
    Ok(fs::read(target.join(TARGET).join(profile).join("pushed_leg_browser.wasm"))?)
}

/// The page with this module; without one it says so.
#[must_use]
pub fn html(module: &[u8]) -> String {
    let digits = module.iter().fold(String::with_capacity(2 * module.len()), |mut digits, byte| {
        let _ = write!(digits, "{byte:02x}");
        digits
    });
    // The digits last: they are not searched for marks.
    TEMPLATE.replace("{{style}}", STYLE).replace("{{script}}", SCRIPT).replace("{{module}}", &digits)
}
