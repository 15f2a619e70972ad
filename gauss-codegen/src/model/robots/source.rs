//! The file of a robot: where it is, and what is read from it.

use std::path::{Path, PathBuf};

use super::description::{At, Description, Fault};
use super::mimic::hold_followers_of_fixed;
use super::text::{Text, Written};
use crate::model::language::robots::{File, Format};

/// The path from the folder of the package that is compiled; of a tool without one from where it runs.
pub fn path(file: &File) -> PathBuf {
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    let path = folder.join(&file.path);
    std::path::absolute(&path).unwrap_or(path)
}

/// # Errors
/// Why it cannot be read: the file, or one that it includes.
pub fn text(file: &File, path: &Path) -> Result<Text, Vec<String>> {
    let main = Written::read(file.path.clone(), path.to_owned()).map_err(|error| vec![error])?;
    match file.format {
        #[cfg(feature = "mjcf")]
        Format::Mjcf => {
            let (text, faults) = super::mjcf::included(main);
            if faults.is_empty() { Ok(text) } else { Err(all_located(&text.names(), &faults)) }
        }
        _ => Ok(Text::of(main)),
    }
}

/// # Errors
/// Everything that is wrong in it.
pub fn read(format: Format, text: &Text) -> Result<Description, Vec<Fault>> {
    let mut description = by_format(format, text)?;
    hold_followers_of_fixed(&mut description);
    Ok(description)
}

fn by_format(format: Format, text: &Text) -> Result<Description, Vec<Fault>> {
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
fn without(feature: &str, _: &Text) -> Vec<Fault> {
    let message = format!("such files are read with the feature `{feature}` of gauss-runtime; add it in Cargo.toml");
    vec![Fault { at: At::default(), message }]
}

/// `robots/arm.urdf:12:3: message`, with the names of the files.
pub fn located(names: &[String], at: At, message: &str) -> String {
    let name = names.get(at.file as usize).map_or("", String::as_str);
    match at {
        At { line: 0, .. } => format!("{name}: {message}"),
        At { line, column, .. } => format!("{name}:{line}:{column}: {message}"),
    }
}

pub fn all_located(names: &[String], faults: &[Fault]) -> Vec<String> {
    faults.iter().map(|fault| located(names, fault.at, &fault.message)).collect()
}
