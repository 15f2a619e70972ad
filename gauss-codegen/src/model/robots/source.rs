//! The file of a robot: where it is, and what is read from it.

use std::path::{Path, PathBuf};

use super::description::{At, Description, Fault};
use super::mimic::hold_followers_of_fixed;
use crate::model::language::robots::{File, Format};

/// The path from the folder of the package that is compiled; of a tool without one from where it runs.
pub fn path(file: &File) -> PathBuf {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    let path = folder.join(&file.path);
    std::path::absolute(&path).unwrap_or(path)
}

/// # Errors
/// Why there is no such text.
pub fn text(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("cannot read `{}`: {error}", path.display()))?;
    String::from_utf8(bytes).map_err(|_| format!("`{}` is no text in UTF-8", path.display()))
}

/// # Errors
/// Everything that is wrong in it.
pub fn read(format: Format, text: &str) -> Result<Description, Vec<Fault>> {
    let mut description = by_format(format, text)?;
    hold_followers_of_fixed(&mut description);
    Ok(description)
}

fn by_format(format: Format, text: &str) -> Result<Description, Vec<Fault>> {
    match format {
        #[cfg(feature = "urdf")]
        Format::Urdf => super::urdf::read(text),
        #[cfg(not(feature = "urdf"))]
        Format::Urdf => Err(without("urdf", text)),
        #[cfg(feature = "mjcf")]
        Format::Mjcf => super::mjcf::read(text),
        #[cfg(not(feature = "mjcf"))]
        Format::Mjcf => Err(without("mjcf", text)),
    }
}

/// A reader that is not compiled in.
#[cfg(not(all(feature = "urdf", feature = "mjcf")))]
fn without(feature: &str, _: &str) -> Vec<Fault> {
    let message = format!("such files are read with the feature `{feature}` of gauss-runtime; add it in Cargo.toml");
    vec![Fault { at: At::default(), message }]
}

/// `robots/arm.urdf:12:3: message`.
pub fn located(file: &File, at: At, message: &str) -> String {
    match at {
        At { line: 0, .. } => format!("{}: {message}", file.path),
        At { line, column } => format!("{}:{line}:{column}: {message}", file.path),
    }
}
