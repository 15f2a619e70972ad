//! The file of a robot: where it is, what is read from it.

use std::path::{Path, PathBuf};

use gauss_robots::description::{Description, Fault};
use gauss_robots::{Text, Written};

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
    gauss_robots::whole(of_reader(file.format), main)
}

/// # Errors
/// Everything that is wrong in it.
pub fn read(format: Format, text: &Text) -> Result<Description, Vec<Fault>> {
    gauss_robots::read(of_reader(format), text)
}

fn of_reader(format: Format) -> gauss_robots::Format {
    match format {
        Format::Urdf => gauss_robots::Format::Urdf,
        Format::Mjcf => gauss_robots::Format::Mjcf,
    }
}
