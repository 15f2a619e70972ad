//! The methods that tables get.

use std::path::Path;

use gauss_runtime::system::GaussSystem;

use crate::error::TableError;
use crate::table::Table;

/// Files and plots of a [`Table`]. Folders above a file are made where they are missing; a file that cannot be written
/// whole, as on a full disk, leaves the one before it unchanged.
pub trait Export: crate::sealed::Sealed {
    /// Writes CSV: names and units in the first line, and every digit.
    ///
    /// # Errors
    /// [`TableError::Io`].
    fn write_csv(&self, file: impl AsRef<Path>) -> Result<(), TableError>;

    /// Plots all columns over the first one, a panel for each unit, into a file of SVG. Columns without a unit have a
    /// panel each.
    ///
    /// # Errors
    /// [`TableError::NotSvg`] of other names, [`TableError::NothingToPlot`], [`TableError::Io`].
    #[cfg(feature = "plot")]
    fn plot(&self, file: impl AsRef<Path>) -> Result<(), TableError>;

    /// The same picture as text.
    ///
    /// # Errors
    /// [`TableError::NothingToPlot`].
    #[cfg(feature = "plot")]
    fn svg(&self) -> Result<String, TableError>;

    /// The columns for Arrow, with their units as metadata.
    ///
    /// # Errors
    /// [`TableError::Format`].
    #[cfg(feature = "arrow")]
    fn record_batch(&self) -> Result<arrow_array::RecordBatch, TableError>;

    /// Writes a file of Arrow (IPC, Feather).
    ///
    /// # Errors
    /// [`TableError::Io`], [`TableError::Format`].
    #[cfg(feature = "arrow")]
    fn write_arrow(&self, file: impl AsRef<Path>) -> Result<(), TableError>;

    /// Writes a file of Parquet.
    ///
    /// # Errors
    /// [`TableError::Io`], [`TableError::Format`].
    #[cfg(feature = "parquet")]
    fn write_parquet(&self, file: impl AsRef<Path>) -> Result<(), TableError>;
}

impl<S: GaussSystem> Export for Table<S> {
    fn write_csv(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), self.to_string().as_bytes())
    }

    #[cfg(feature = "plot")]
    fn plot(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        let file = file.as_ref();
        if !file.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg")) {
            return Err(TableError::NotSvg(file.to_owned()));
        }
        write(file, self.svg()?.as_bytes())
    }

    #[cfg(feature = "plot")]
    fn svg(&self) -> Result<String, TableError> {
        crate::picture::draw(&self.iter().collect::<Vec<_>>())
    }

    #[cfg(feature = "arrow")]
    fn record_batch(&self) -> Result<arrow_array::RecordBatch, TableError> {
        crate::columns::batch(self.iter())
    }

    #[cfg(feature = "arrow")]
    fn write_arrow(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), &crate::columns::arrow(&self.record_batch()?)?)
    }

    #[cfg(feature = "parquet")]
    fn write_parquet(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), &crate::columns::parquet(&self.record_batch()?)?)
    }
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), TableError> {
    gauss_files::write(file, bytes).map_err(|source| TableError::Io { file: file.to_owned(), source })
}
