//! What packages consist of: files, and crates of Gauss that they depend on.

use std::path::Path;

use crate::arguments::New;

/// Names of files, and what is in them.
pub type Files = Vec<(String, String)>;

/// Where a crate comes from: the registry, or a clone.
pub fn from(wanted: &New, folder: &str) -> Result<String, String> {
    match &wanted.gauss {
        Some(clone) => at(clone, folder),
        None => Ok(format!("version = \"{}\"", env!("CARGO_PKG_VERSION"))),
    }
}

/// A crate in a clone.
fn at(clone: &Path, folder: &str) -> Result<String, String> {
    let folder = clone.join(folder);
    let absolute = folder.canonicalize().map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(format!("path = {:?}", absolute.display().to_string()))
}
