//! What packages consist of: files, and crates of Gauss that they depend on.

use std::path::{Path, PathBuf};

use crate::arguments::New;

/// Names of files, and what is in them.
pub type Files = Vec<(String, Vec<u8>)>;

/// Where a crate comes from: the registry, or a clone.
pub fn from(wanted: &New, folder: &str) -> Result<String, String> {
    match clone(wanted) {
        Some(clone) => at(&clone, folder),
        None => Ok(format!("version = \"{}\"", env!("CARGO_PKG_VERSION"))),
    }
}

/// The clone that the user names, or else the one that this command was built from, as long as it is there.
pub fn clone(wanted: &New) -> Option<PathBuf> {
    let own = || {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2)?;
        root.join("crates/gauss-python/Cargo.toml").is_file().then(|| root.to_owned())
    };
    wanted.gauss.clone().or_else(own)
}

/// A crate in a clone.
fn at(clone: &Path, folder: &str) -> Result<String, String> {
    let folder = clone.join(folder);
    let absolute = folder.canonicalize().map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(format!("path = {:?}", absolute.display().to_string()))
}
