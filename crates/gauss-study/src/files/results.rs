//! Results as they are read back, a column at a time.

use std::path::PathBuf;

use parquet::column::reader::ColumnReader;
use parquet::data_type::{BoolType, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::checksum;
use crate::error::StudyError;

/// The results that there are of a study, in the order of their runs: [`Study::results`](crate::Study::results).
///
/// Of studies that do not fit into memory other programs read the parts: `polars.scan_parquet`, `pyarrow.dataset`.
#[derive(Debug)]
pub struct Results {
    pub(crate) files: Vec<PathBuf>,
    /// The columns of numbers with their units, without those of the run itself.
    pub(crate) numbers: Vec<(String, String)>,
}

impl Results {
    /// The numbers of a parameter or a result; of whole numbers the nearest, of flags 0 and 1. Nulls stay.
    ///
    /// # Errors
    /// [`StudyError::NoColumn`], also of words; [`StudyError::Damaged`], [`StudyError::Io`].
    pub fn numbers(&self, column: &str) -> Result<Vec<Option<f64>>, StudyError> {
        self.read(column, |reader, rows| match reader {
            ColumnReader::DoubleColumnReader(mut reader) => Some(values::<DoubleType, _>(&mut reader, rows, |x| x)),
            ColumnReader::Int64ColumnReader(mut reader) => {
                Some(values::<Int64Type, _>(&mut reader, rows, |x| x as f64))
            }
            ColumnReader::BoolColumnReader(mut reader) => {
                Some(values::<BoolType, _>(&mut reader, rows, |x| f64::from(u8::from(x))))
            }
            _ => None,
        })
    }

    /// All parameters and all results that are numbers or flags, as [`numbers`](Self::numbers) has them, with NaN in
    /// the place of nulls: what `Table::from_columns` of the crate `gauss-tables` takes.
    ///
    /// # Errors
    /// Those of [`numbers`](Self::numbers).
    pub fn columns(&self) -> Result<Vec<(String, Vec<f64>)>, StudyError> {
        let column = |(name, _): &(String, String)| {
            let values = self.numbers(name)?.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect();
            Ok((name.clone(), values))
        };
        self.numbers.iter().map(column).collect()
    }

    /// The units of [`columns`](Self::columns), of those that have one: what `Table::units` takes.
    pub fn units(&self) -> impl Iterator<Item = (&str, &str)> {
        let units = self.numbers.iter().map(|(name, unit)| (name.as_str(), unit.as_str()));
        units.filter(|(_, unit)| !unit.is_empty())
    }

    /// The words of a result, or of `cause`. Nulls stay.
    ///
    /// # Errors
    /// [`StudyError::NoColumn`], also of numbers; [`StudyError::Damaged`], [`StudyError::Io`].
    pub fn words(&self, column: &str) -> Result<Vec<Option<String>>, StudyError> {
        self.read(column, |reader, rows| match reader {
            ColumnReader::ByteArrayColumnReader(mut reader) => {
                let text = |bytes: parquet::data_type::ByteArray| String::from_utf8_lossy(bytes.data()).into_owned();
                Some(values::<ByteArrayType, _>(&mut reader, rows, text))
            }
            _ => None,
        })
    }

    fn read<T>(
        &self,
        column: &str,
        values: impl Fn(ColumnReader, usize) -> Option<Result<Vec<Option<T>>, ParquetError>>,
    ) -> Result<Vec<Option<T>>, StudyError> {
        let mut all = Vec::new();
        for file in &self.files {
            let damaged = |error: ParquetError| StudyError::Damaged { file: file.clone(), reason: error.to_string() };
            let reader = SerializedFileReader::new(checksum::read(file)?).map_err(damaged)?;
            let schema = reader.metadata().file_metadata().schema_descr();
            let none = || StudyError::NoColumn(column.to_owned());
            let place = schema.columns().iter().position(|field| field.name() == column).ok_or_else(none)?;
            for group in 0..reader.num_row_groups() {
                let group = reader.get_row_group(group).map_err(damaged)?;
                let rows = group.metadata().num_rows() as usize;
                let found = values(group.get_column_reader(place).map_err(damaged)?, rows).ok_or_else(none)?;
                all.extend(found.map_err(damaged)?);
            }
        }
        Ok(all)
    }
}

type Reader<T> = parquet::column::reader::ColumnReaderImpl<T>;

fn values<T: DataType, U>(
    reader: &mut Reader<T>,
    rows: usize,
    of: impl Fn(T::T) -> U,
) -> Result<Vec<Option<U>>, ParquetError> {
    let (mut found, mut levels) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    let mut read = 0;
    while read < rows {
        let (records, ..) = reader.read_records(rows - read, Some(&mut levels), None, &mut found)?;
        if records == 0 {
            return Err(ParquetError::EOF(format!("{read} of {rows} rows")));
        }
        read += records;
    }
    // Columns without nulls have no levels.
    let all_there = levels.is_empty();
    let mut found = found.into_iter();
    Ok((0..rows).map(|row| if all_there || levels[row] == 1 { found.next().map(&of) } else { None }).collect())
}
