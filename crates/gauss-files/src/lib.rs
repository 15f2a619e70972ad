#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

#[cfg(not(target_family = "wasm"))]
use std::fs;
use std::fs::File;
use std::io;
use std::io::Write;
use std::path::Path;

mod output;

pub use output::{output_folder, output_folder_or_argument};

/// Writes a file whole or not at all, and makes the folders above it where they are missing.
///
/// The contents go into a temporary file of the same folder, which takes the place of `file` when all of it has reached
/// the disk. An existing file keeps its permissions; a link keeps pointing where it points, and the file there is
/// replaced. Pipes and devices are written to directly.
///
/// # Errors
/// The error of the operating system. The file that was there before is then unchanged.
pub fn write(file: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> io::Result<()> {
    write_with(file, |out| out.write_all(contents.as_ref()))
}

/// The same of contents that are written piece by piece, for what memory does not hold.
///
/// # Errors
/// The error of the operating system, or that of `contents`. The file that was there before is then unchanged.
pub fn write_with(file: impl AsRef<Path>, contents: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let file = file.as_ref();
    make_folder(file)?;
    replace(file, contents)
}

/// Writes a file that is not there yet, whole or not at all: of several programs that write it at once one does.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] where the file is there; it is unchanged. The error of the operating system.
pub fn write_new(file: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> io::Result<()> {
    let file = file.as_ref();
    make_folder(file)?;
    create(file, contents.as_ref())
}

/// Prefix of the names of files that are not whole: such a file is left where a program was killed while it wrote.
pub const UNFINISHED: &str = ".gauss-";

fn make_folder(file: &Path) -> io::Result<()> {
    file.parent().map_or(Ok(()), std::fs::create_dir_all)
}

#[cfg(not(target_family = "wasm"))]
fn replace(file: &Path, contents: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let there = match fs::metadata(file) {
        Ok(there) => Some(there),
        // Also a link that leads nowhere: it is replaced by the file.
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if there.as_ref().is_some_and(|there| !there.is_file()) {
        return contents(&mut File::options().write(true).open(file)?);
    }
    let place = if there.is_some() { fs::canonicalize(file)? } else { file.to_owned() };
    let mut new = unfinished(&place)?;
    contents(new.as_file_mut())?;
    if let Some(there) = there {
        new.as_file().set_permissions(there.permissions())?;
    }
    new.as_file().sync_all()?;
    new.persist(&place)?;
    Ok(())
}

#[cfg(not(target_family = "wasm"))]
fn create(file: &Path, contents: &[u8]) -> io::Result<()> {
    let mut new = unfinished(file)?;
    new.write_all(contents)?;
    new.as_file().sync_all()?;
    new.persist_noclobber(file)?;
    Ok(())
}

/// A temporary file beside the place that it will take.
#[cfg(not(target_family = "wasm"))]
fn unfinished(place: &Path) -> io::Result<tempfile::NamedTempFile> {
    // A bare name has the empty path above it.
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED);
    // By default only the owner could read a temporary file; the system still applies its umask to these permissions.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

#[cfg(target_family = "wasm")]
fn replace(file: &Path, contents: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    contents(&mut File::create(file)?)
}

#[cfg(target_family = "wasm")]
fn create(file: &Path, contents: &[u8]) -> io::Result<()> {
    File::create_new(file)?.write_all(contents)
}
