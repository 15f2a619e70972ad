//! The file: a ZIP archive, written whole or not at all.

use std::io::{Cursor, Write};
use std::path::Path;

use zip::result::ZipError;
use zip::write::{SimpleFileOptions, ZipWriter};

use crate::FmuError;

/// C that every FMU has.
pub const FIXED: [(&str, &str); 7] = [
    ("fmu.c", include_str!("../c/fmu.c")),
    ("gauss.h", include_str!("../c/gauss.h")),
    ("checks.c", include_str!("../c/checks.c")),
    ("motion.c", include_str!("../c/motion.c")),
    ("variables.c", include_str!("../c/variables.c")),
    ("steps.c", include_str!("../c/steps.c")),
    ("contacts.c", include_str!("../c/contacts.c")),
];

/// The functions of FMI 2.0.
pub const FMI2: &str = include_str!("../c/fmi2.c");

/// The functions of FMI 3.0.
pub const FMI3: &str = include_str!("../c/fmi3.c");

/// A file in the archive.
pub struct Entry {
    name: String,
    bytes: Vec<u8>,
}

impl Entry {
    pub fn new(name: &str, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.to_owned(), bytes: bytes.into() }
    }
}

/// Writes all files. Entries have no date: the same scene gives the same bytes.
///
/// # Errors
/// Errors of the operating system.
pub fn write(file: &Path, entries: &[Entry]) -> Result<(), FmuError> {
    let bytes = packed(entries).map_err(|error| FmuError::Io(error.into()))?;
    gauss_files::write(file, bytes).map_err(FmuError::Io)
}

fn packed(entries: &[Entry]) -> Result<Vec<u8>, ZipError> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for Entry { name, bytes } in entries {
        archive.start_file(name.as_str(), SimpleFileOptions::default())?;
        archive.write_all(bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}
