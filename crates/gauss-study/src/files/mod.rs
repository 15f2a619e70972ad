//! A study's folder: its declaration and its parts.

mod checksum;
mod merge;
mod part;
mod results;
mod schema;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

pub use part::PartState;
pub use results::Results;

use crate::declaration::Declaration;
use crate::draw::Draw;
use crate::error::StudyError;
use crate::row::Row;

/// The file of the declaration, and of all results in one.
const DECLARATION: &str = "study.json";
const MERGED: &str = "study.parquet";

/// Whoever writes a part or the merged file writes all the time: what rests for so long is of nobody.
const ABANDONED: Duration = Duration::from_secs(3600);

/// The folder of a study.
#[derive(Debug)]
pub struct Folder<'a> {
    path: &'a Path,
    declaration: &'a Declaration,
}

impl<'a> Folder<'a> {
    /// A folder that holds this study, or that becomes its folder.
    pub fn make(path: &'a Path, declaration: &'a Declaration) -> Result<Self, StudyError> {
        let file = path.join(DECLARATION);
        if !file.exists() {
            // Of several that begin at once one writes, and all read what is there.
            match gauss_files::write_new(&file, declaration.to_json()) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                written => written.map_err(StudyError::io(&file))?,
            }
        }
        Self::open(path, declaration)
    }

    /// A folder that holds this study.
    pub fn open(path: &'a Path, declaration: &'a Declaration) -> Result<Self, StudyError> {
        let file = path.join(DECLARATION);
        let kept = match fs::read_to_string(&file) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(StudyError::None(path.to_owned())),
            kept => kept.map_err(StudyError::io(&file))?,
        };
        let unreadable = |error: serde_json::Error| StudyError::Unreadable { file, reason: error.to_string() };
        let differences = declaration.differences(&kept).map_err(unreadable)?;
        if differences.is_empty() {
            Ok(Self { path, declaration })
        } else {
            Err(StudyError::Other { folder: path.to_owned(), differences })
        }
    }

    fn part(&self, part: u64) -> PathBuf {
        self.path.join(format!("part-{part:08}.parquet"))
    }

    /// State of a part: the end of its file is read, which is written last and says how many rows there are and of
    /// which study.
    pub fn state(&self, part: u64) -> Result<PartState, StudyError> {
        let file = self.part(part);
        match fs::File::open(&file) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(PartState::Missing),
            opened => {
                let opened = opened.map_err(StudyError::io(&file))?;
                let runs = self.declaration.runs_of(part);
                Ok(part::state(&opened, self.declaration, runs.end - runs.start))
            }
        }
    }

    /// The same, of which all was read and held to its checksum.
    pub fn checked(&self, part: u64) -> Result<PartState, StudyError> {
        let state = self.state(part)?;
        match state {
            PartState::Whole { .. } => match checksum::read(&self.part(part)) {
                Ok(_) => Ok(state),
                Err(StudyError::Damaged { reason, .. }) => Ok(PartState::Damaged(reason)),
                Err(error) => Err(error),
            },
            other => Ok(other),
        }
    }

    /// Writes a part, whole or not at all.
    pub fn write(&self, part: u64, samples: &[Draw], rows: &[Row]) -> Result<(), StudyError> {
        let file = self.part(part);
        let bytes = part::bytes(self.declaration, samples, rows);
        let bytes = bytes.map_err(|error| StudyError::Damaged { file: file.clone(), reason: error.to_string() })?;
        gauss_files::write(&file, bytes).map_err(StudyError::io(file))
    }

    /// Puts all parts into one file, whose bytes do not depend on who made the parts; returns its path. What killed
    /// workers left an hour ago is removed.
    pub fn merge(&self) -> Result<PathBuf, StudyError> {
        let mut missing = 0;
        for part in 0..self.declaration.parts() {
            match self.state(part)? {
                PartState::Whole { .. } => {}
                PartState::Missing => missing += 1,
                PartState::Damaged(reason) => return Err(StudyError::Damaged { file: self.part(part), reason }),
            }
        }
        if missing > 0 {
            return Err(StudyError::Missing { parts: missing, of: self.declaration.parts() });
        }
        let file = self.path.join(MERGED);
        gauss_files::write_with(&file, |out| {
            merge::merge(self.declaration, (0..self.declaration.parts()).map(|part| self.part(part)), out)
        })
        .map_err(|error| error.downcast().unwrap_or_else(StudyError::io(&file)))?;
        self.tidy()?;
        Ok(file)
    }

    /// Removes unfinished files of workers that were killed. A file that was written to a short while ago may be of one
    /// that is at work: another merge, or a worker that makes a part which somebody else has made meanwhile.
    fn tidy(&self) -> Result<(), StudyError> {
        for entry in fs::read_dir(self.path).map_err(StudyError::io(self.path))? {
            let entry = entry.map_err(StudyError::io(self.path))?;
            if !entry.file_name().to_string_lossy().starts_with(gauss_files::UNFINISHED) {
                continue;
            }
            // What is gone meanwhile was not left.
            let written = entry.metadata().and_then(|about| about.modified()).ok();
            let still = written.and_then(|written| written.elapsed().ok());
            if still.is_some_and(|still| still > ABANDONED) {
                fs::remove_file(entry.path()).map_err(StudyError::io(entry.path()))?;
            }
        }
        Ok(())
    }

    /// The parts that are whole, in order.
    pub fn whole(&self) -> Result<Vec<PathBuf>, StudyError> {
        let parts = (0..self.declaration.parts()).filter_map(|part| match self.state(part) {
            Ok(PartState::Whole { .. }) => Some(Ok(self.part(part))),
            Ok(_) => None,
            Err(error) => Some(Err(error)),
        });
        parts.collect()
    }
}
