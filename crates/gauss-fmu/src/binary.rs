//! The binary for this platform, by the C compiler of the system.

use std::path::Path;
use std::process::Command;

use crate::{FmuError, Version};

/// Compilers, in the order in which they are looked for.
const COMPILERS: [&str; 3] = ["cc", "gcc", "clang"];

/// Products are not fused with sums, so that every platform gives the same numbers.
const OPTIONS: [&str; 6] = ["-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-fvisibility=hidden"];

/// The folder of binaries for this platform, and how they end; `None` where FMI names none.
pub fn platform(version: Version) -> Option<(&'static str, &'static str)> {
    let (system, processor) = (std::env::consts::OS, std::env::consts::ARCH);
    Some(match (version, system, processor) {
        (Version::Two, "linux", "x86_64") => ("linux64", "so"),
        (Version::Two, "macos", "x86_64" | "aarch64") => ("darwin64", "dylib"),
        (Version::Two, "windows", "x86_64") => ("win64", "dll"),
        (Version::Three, "linux", "x86_64") => ("x86_64-linux", "so"),
        (_, "linux", "aarch64") => ("aarch64-linux", "so"),
        (Version::Three, "macos", "x86_64") => ("x86_64-darwin", "dylib"),
        (Version::Three, "macos", "aarch64") => ("aarch64-darwin", "dylib"),
        (Version::Three, "windows", "x86_64") => ("x86_64-windows", "dll"),
        _ => return None,
    })
}

/// The shared library of `fmu.c` in a folder; `None` where there is no compiler.
///
/// # Errors
/// Words of a compiler that refuses it.
pub fn compiled(folder: &Path) -> Result<Option<Vec<u8>>, FmuError> {
    let runs = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
    let Some(compiler) = COMPILERS.into_iter().find(runs) else { return Ok(None) };
    let binary = folder.join("fmu.bin");
    let mut command = Command::new(compiler);
    command.args(OPTIONS).arg(folder.join("fmu.c")).arg("-o").arg(&binary).arg("-lm");
    let output = command.output().map_err(FmuError::Io)?;
    if !output.status.success() {
        return Err(FmuError::Compiler(format!("{compiler}: {}", String::from_utf8_lossy(&output.stderr))));
    }
    std::fs::read(&binary).map(Some).map_err(FmuError::Io)
}
