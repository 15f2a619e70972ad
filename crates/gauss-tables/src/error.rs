//! Why a table does not become a file.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;

/// Why there is no file, or no picture.
#[derive(Debug)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be written.
    Io {
        /// The file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A picture is SVG: the name of the file ends otherwise.
    NotSvg(PathBuf),
    /// There are fewer than two rows, or fewer than two columns.
    NothingToPlot,
    /// The columns of a panel have several units, and a panel has one axis.
    MixedUnits {
        /// The columns with their units.
        columns: Vec<String>,
    },
    /// The picture cannot be laid out.
    Plot(String),
    /// The error of the writer of Arrow or Parquet.
    Format(Box<dyn Error + Send + Sync>),
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io { file, source } => write!(f, "`{}` cannot be written: {source}", file.display()),
            Self::NotSvg(file) => {
                write!(f, "pictures are SVG, so a file should be called `….svg`, not `{}`", file.display())
            }
            Self::NothingToPlot => f.write_str("a plot needs two rows and two columns"),
            Self::MixedUnits { columns } => {
                write!(f, "a panel has one axis, and these columns have several units: {}", columns.join(", "))
            }
            Self::Plot(reason) => write!(f, "the plot cannot be laid out: {reason}"),
            Self::Format(error) => write!(f, "the table cannot be written: {error}"),
        }
    }
}

impl Error for TableError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Format(error) => Some(&**error),
            _ => None,
        }
    }
}
