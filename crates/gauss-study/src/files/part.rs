//! One part: some runs as a file of Parquet.

use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::{KeyValue, ParquetMetaData, ParquetMetaDataReader};
use parquet::file::reader::ChunkReader;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};

use super::checksum;
use super::schema::{KEY, properties, schema};
use crate::declaration::Declaration;
use crate::draw::Draw;
use crate::row::{Kind, Row, Value};

/// State of a part.
#[derive(Debug, PartialEq, Eq)]
pub enum PartState {
    Missing,
    /// A whole part, with so many failed runs.
    Whole {
        failed: u64,
    },
    /// Not whole, or of another study.
    Damaged(String),
}

/// The file of these runs, with its checksum.
pub fn bytes(declaration: &Declaration, samples: &[Draw], rows: &[Row]) -> Result<Vec<u8>, ParquetError> {
    let mut writer = SerializedFileWriter::new(Vec::new(), schema(declaration)?, properties(declaration))?;
    writer.append_key_value_metadata(KeyValue::new(checksum::KEY.to_owned(), checksum::OPEN.to_owned()));
    let mut group = writer.next_row_group()?;
    // The bits of numbers above 2⁶³ stay; the schema says that they are unsigned.
    let whole = |of: fn(&Draw) -> u64| samples.iter().map(|sample| of(sample) as i64).collect::<Vec<_>>();
    put::<Int64Type>(&mut group, &whole(Draw::seed), None)?;
    put::<Int64Type>(&mut group, &whole(Draw::run), None)?;
    for place in 0..declaration.parameters.len() {
        let values: Vec<f64> = samples.iter().map(|sample| sample.values[place]).collect();
        put::<DoubleType>(&mut group, &values, None)?;
    }
    for (place, column) in declaration.columns.iter().enumerate() {
        let values = || rows.iter().map(|row| row.values[place].as_ref());
        match column.kind {
            Kind::Number => optional::<DoubleType>(&mut group, values().map(|value| as_number(value?)))?,
            Kind::Integer => optional::<Int64Type>(&mut group, values().map(|value| as_integer(value?)))?,
            Kind::Flag => optional::<BoolType>(&mut group, values().map(|value| as_flag(value?)))?,
            Kind::Text => optional::<ByteArrayType>(&mut group, values().map(|value| as_text(value?)))?,
        }
    }
    let causes = rows.iter().map(|row| row.cause.as_deref().map(ByteArray::from));
    optional::<ByteArrayType>(&mut group, causes)?;
    group.close()?;
    let mut bytes = writer.into_inner()?;
    checksum::close(&mut bytes);
    Ok(bytes)
}

fn as_number(value: &Value) -> Option<f64> {
    if let Value::Number(number) = value { Some(*number) } else { None }
}

fn as_integer(value: &Value) -> Option<i64> {
    if let Value::Integer(integer) = value { Some(*integer) } else { None }
}

fn as_flag(value: &Value) -> Option<bool> {
    if let Value::Flag(flag) = value { Some(*flag) } else { None }
}

fn as_text(value: &Value) -> Option<ByteArray> {
    if let Value::Text(text) = value { Some(ByteArray::from(text.as_str())) } else { None }
}

type Group<'a> = SerializedRowGroupWriter<'a, Vec<u8>>;

fn optional<T: DataType>(
    group: &mut Group<'_>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut there, mut levels) = (Vec::new(), Vec::new());
    for value in values {
        levels.push(i16::from(value.is_some()));
        there.extend(value);
    }
    put::<T>(group, &there, Some(&levels))
}

fn put<T: DataType>(group: &mut Group<'_>, values: &[T::T], levels: Option<&[i16]>) -> Result<(), ParquetError> {
    let mut column =
        group.next_column()?.ok_or_else(|| ParquetError::General("more columns than the schema".into()))?;
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}

/// Whether a file is a part of this study with so many runs: its end is read.
pub fn state(file: &impl ChunkReader, declaration: &Declaration, runs: u64) -> PartState {
    match ParquetMetaDataReader::new().parse_and_finish(file) {
        Err(error) => PartState::Damaged(format!("is not whole: {error}")),
        Ok(metadata) if value(&metadata, KEY) != Some(declaration.to_json().as_str()) => {
            PartState::Damaged("is of another study".to_owned())
        }
        Ok(metadata) if value(&metadata, checksum::KEY).is_none() => {
            PartState::Damaged("has no checksum: an earlier version wrote it".to_owned())
        }
        Ok(metadata) if metadata.file_metadata().num_rows() != runs as i64 => {
            PartState::Damaged(format!("has {} runs, not {runs}", metadata.file_metadata().num_rows()))
        }
        Ok(metadata) => PartState::Whole { failed: runs.saturating_sub(without_cause(&metadata)) },
    }
}

/// Value that a file holds under a key.
fn value<'a>(metadata: &'a ParquetMetaData, key: &str) -> Option<&'a str> {
    let pairs = metadata.file_metadata().key_value_metadata()?;
    pairs.iter().find(|pair| pair.key == key)?.value.as_deref()
}

/// Number of runs without a cause of failure, by the statistics of the last column.
fn without_cause(metadata: &ParquetMetaData) -> u64 {
    let last = metadata.row_groups().iter().filter_map(|group| group.columns().last()?.statistics()?.null_count_opt());
    last.sum()
}
