//! Columns for Arrow, and files of them.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{DataType, Field, Schema};

use crate::error::TableError;
use crate::table::Column;

pub fn batch<'a>(columns: impl Iterator<Item = Column<'a>>) -> Result<RecordBatch, TableError> {
    let (mut fields, mut arrays) = (Vec::new(), Vec::<ArrayRef>::new());
    for Column { name, unit, values, .. } in columns {
        let unit = unit.map(|unit| ("unit".to_owned(), unit.to_owned()));
        fields.push(Field::new(name, DataType::Float64, false).with_metadata(HashMap::from_iter(unit)));
        arrays.push(Arc::new(Float64Array::from(values.to_vec())));
    }
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(format)
}

pub fn arrow(batch: &RecordBatch) -> Result<Vec<u8>, TableError> {
    let mut writer = FileWriter::try_new(Vec::new(), &batch.schema()).map_err(format)?;
    writer.write(batch).map_err(format)?;
    writer.into_inner().map_err(format)
}

fn format(error: impl std::error::Error + Send + Sync + 'static) -> TableError {
    TableError::Format(Box::new(error))
}
