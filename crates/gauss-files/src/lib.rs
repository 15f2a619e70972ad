#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

use std::io;
use std::path::Path;

/// Writes a file whole or not at all, and makes the folders above it where they are missing.
///
/// The contents go into a temporary file of the same folder, which takes the place of `file` when all of it has reached
/// the disk. An existing file keeps its permissions; a link keeps pointing where it points, and the file there is
/// replaced. Pipes and devices are written to directly.
///
/// # Errors
/// The error of the operating system. The file that was there before is then unchanged.
pub fn write(file: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> io::Result<()> {
    let file = file.as_ref();
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    replace(file, contents.as_ref())
}

#[cfg(not(target_family = "wasm"))]
fn replace(file: &Path, contents: &[u8]) -> io::Result<()> {
    use std::fs;
    use std::io::Write;

    let there = match fs::metadata(file) {
        Ok(there) => Some(there),
        // Also a link that leads nowhere: it is replaced by the file.
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if there.as_ref().is_some_and(|there| !there.is_file()) {
        return fs::write(file, contents);
    }
    let place = if there.is_some() { fs::canonicalize(file)? } else { file.to_owned() };
    // A bare name has the empty path above it.
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".gauss-");
    // By default only the owner could read a temporary file; the system still applies its umask to these permissions.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut new = builder.tempfile_in(folder)?;
    new.write_all(contents)?;
    if let Some(there) = there {
        new.as_file().set_permissions(there.permissions())?;
    }
    new.as_file().sync_all()?;
    new.persist(&place)?;
    Ok(())
}

#[cfg(target_family = "wasm")]
fn replace(file: &Path, contents: &[u8]) -> io::Result<()> {
    std::fs::write(file, contents)
}
