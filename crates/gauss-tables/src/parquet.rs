//! Files of Parquet: numbers without nulls, not compressed, and the units as metadata of the file.

use std::sync::Arc;

use parquet::basic::{Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::error::TableError;
use crate::table::Column;

/// The bytes of a file.
pub fn file<'a>(columns: impl Iterator<Item = Column<'a>>) -> Result<Vec<u8>, TableError> {
    written(&columns.collect::<Vec<_>>()).map_err(|error| TableError::Format(Box::new(error)))
}

fn written(columns: &[Column<'_>]) -> Result<Vec<u8>, ParquetError> {
    let field = |column: &Column<'_>| {
        let field = Type::primitive_type_builder(column.name, Physical::DOUBLE).with_repetition(Repetition::REQUIRED);
        field.build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
    let unit = |column: &Column<'_>| Some(KeyValue::new(format!("unit:{}", column.name), column.unit?.to_owned()));
    let units: Vec<KeyValue> = columns.iter().filter_map(unit).collect();
    let properties = WriterProperties::builder().set_key_value_metadata(Some(units)).build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in columns {
        let missing = || ParquetError::General("more columns than the schema".into());
        let mut place = group.next_column()?.ok_or_else(missing)?;
        place.typed::<DoubleType>().write_batch(column.values, None, None)?;
        place.close()?;
    }
    group.close()?;
    writer.into_inner()
}
