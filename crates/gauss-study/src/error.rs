//! Why there is no study, or no file of it.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

/// Mistakes in a declaration, all of them.
#[derive(Debug)]
pub struct DeclarationError {
    pub(crate) mistakes: Vec<String>,
}

impl DeclarationError {
    /// A line for each mistake: the field, its value, the rule.
    #[must_use]
    pub fn mistakes(&self) -> &[String] {
        &self.mistakes
    }
}

impl fmt::Display for DeclarationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the study cannot be: {}", self.mistakes.join("; "))
    }
}

impl Error for DeclarationError {}

/// Why a study does not go on.
#[derive(Debug)]
#[non_exhaustive]
pub enum StudyError {
    /// A file cannot be read or written.
    Io {
        /// The file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The folder holds another study.
    Other {
        /// The folder.
        folder: PathBuf,
        /// A line for each field that differs.
        differences: Vec<String>,
    },
    /// The folder holds no study.
    None(PathBuf),
    /// The declaration that is kept in the folder cannot be read.
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// A file of results is not whole, or not of this study.
    Damaged {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// Runs are missing that a merged file would need.
    Missing {
        /// Number of missing parts.
        parts: u64,
        /// Number of all parts.
        of: u64,
    },
    /// There is no such column.
    NoColumn(String),
}

impl StudyError {
    pub(crate) fn io(file: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let file = file.into();
        move |source| Self::Io { file, source }
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io { file, source } => write!(f, "`{}`: {source}", file.display()),
            Self::Other { folder, differences } => {
                write!(f, "`{}` holds another study; ", folder.display())?;
                write!(f, "{}; choose another folder", differences.join("; "))
            }
            Self::None(folder) => write!(f, "`{}` holds no study", folder.display()),
            Self::Unreadable { file, reason } => write!(f, "`{}` cannot be read: {reason}", file.display()),
            Self::Damaged { file, reason } => write!(f, "`{}`: {reason}", file.display()),
            Self::Missing { parts, of } => write!(f, "{parts} of {of} parts are missing: `run` makes them"),
            Self::NoColumn(name) => write!(f, "there is no column `{name}`"),
        }
    }
}

impl Error for StudyError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}
