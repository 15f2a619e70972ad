//! All parts in one file: their columns are copied as they are, and their checksums compared on the way.

use std::fs::File;
use std::io;
use std::path::PathBuf;

use bytes::Bytes;
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaDataReader;
use parquet::file::writer::SerializedFileWriter;

use super::checksum;
use super::schema::{properties, schema};
use crate::declaration::Declaration;

/// Writes the parts one after another. What a part lacks is a [`StudyError`](crate::StudyError) in the error.
pub fn merge(declaration: &Declaration, parts: impl Iterator<Item = PathBuf>, out: &mut File) -> io::Result<()> {
    let named = |file: &PathBuf, error: ParquetError| io::Error::other(format!("{}: {error}", file.display()));
    let mut writer = SerializedFileWriter::new(out, schema(declaration)?, properties(declaration))?;
    for file in parts {
        append(&mut writer, &checksum::read(&file).map_err(io::Error::other)?).map_err(|error| named(&file, error))?;
    }
    writer.close()?;
    Ok(())
}

fn append(writer: &mut SerializedFileWriter<&mut File>, part: &Bytes) -> Result<(), ParquetError> {
    let metadata = ParquetMetaDataReader::new().parse_and_finish(part)?;
    for group in metadata.row_groups() {
        let mut copy = writer.next_row_group()?;
        for column in group.columns() {
            let result = ColumnCloseResult {
                bytes_written: column.compressed_size() as u64,
                rows_written: group.num_rows() as u64,
                metadata: column.clone(),
                bloom_filter: None,
                column_index: None,
                offset_index: None,
            };
            copy.append_column(part, result)?;
        }
        copy.close()?;
    }
    Ok(())
}
