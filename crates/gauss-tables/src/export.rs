//! Files and plots of tables.

use std::path::Path;

use crate::error::TableError;
use crate::table::Table;

/// Files and plots. Folders above a file are made where they are missing; a file that cannot be written whole, as on a
/// full disk, leaves the one before it unchanged.
impl<Row> Table<Row> {
    /// Writes CSV: names and units in the first line, and every digit.
    ///
    /// # Errors
    /// [`TableError::Io`].
    pub fn write_csv(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), self.to_string().as_bytes())
    }

    /// Plots all columns over the first one, a panel for each unit, into a file of SVG; columns without a unit have a
    /// panel each. [`select`](Self::select) chooses columns, [`panel`](Self::panel) what stands together, and
    /// [`points`](Self::points) what is not joined.
    ///
    /// # Errors
    /// [`TableError::MixedUnits`] of a panel with two units,
    /// [`TableError::NotSvg`] of other names, [`TableError::NothingToPlot`], [`TableError::Io`].
    #[cfg(feature = "plot")]
    pub fn plot(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        let file = file.as_ref();
        if !file.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg")) {
            return Err(TableError::NotSvg(file.to_owned()));
        }
        write(file, self.svg()?.as_bytes())
    }

    /// The same picture as text.
    ///
    /// # Errors
    /// [`TableError::NothingToPlot`].
    #[cfg(feature = "plot")]
    pub fn svg(&self) -> Result<String, TableError> {
        crate::picture::draw(&self.iter().collect::<Vec<_>>(), self.panels())
    }

    /// The columns for Arrow, with their units as metadata.
    ///
    /// # Errors
    /// [`TableError::Format`].
    #[cfg(feature = "arrow")]
    pub fn record_batch(&self) -> Result<arrow_array::RecordBatch, TableError> {
        crate::columns::batch(self.iter())
    }

    /// Writes a file of Arrow (IPC, Feather).
    ///
    /// # Errors
    /// [`TableError::Io`], [`TableError::Format`].
    #[cfg(feature = "arrow")]
    pub fn write_arrow(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), &crate::columns::arrow(&self.record_batch()?)?)
    }

    /// Writes a file of Parquet; units are metadata of the file, `unit:NAME`.
    ///
    /// # Errors
    /// [`TableError::Io`], [`TableError::Format`].
    #[cfg(feature = "parquet")]
    pub fn write_parquet(&self, file: impl AsRef<Path>) -> Result<(), TableError> {
        write(file.as_ref(), &crate::parquet::file(self.iter())?)
    }
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), TableError> {
    gauss_files::write(file, bytes).map_err(|source| TableError::Io { file: file.to_owned(), source })
}
