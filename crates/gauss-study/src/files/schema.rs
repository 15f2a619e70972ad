//! The columns of the files: `seed`, `run`, parameters, results, `cause`.

use std::sync::Arc;

use parquet::basic::{Encoding, LogicalType, Repetition, Type as Physical};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::{ColumnPath, Type};

use crate::declaration::Declaration;
use crate::row::Kind;

/// Under which word a file holds the declaration, with the units.
pub const KEY: &str = "gauss_study";

/// The columns of a study.
pub fn schema(declaration: &Declaration) -> Result<Arc<Type>, ParquetError> {
    let unsigned = LogicalType::integer(64, false);
    let mut fields = vec![
        field("seed", Physical::INT64, Repetition::REQUIRED, Some(unsigned.clone()))?,
        field("run", Physical::INT64, Repetition::REQUIRED, Some(unsigned))?,
    ];
    for parameter in &declaration.parameters {
        fields.push(field(&parameter.name, Physical::DOUBLE, Repetition::REQUIRED, None)?);
    }
    for column in &declaration.columns {
        let (physical, logical) = match column.kind {
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Integer => (Physical::INT64, None),
            Kind::Flag => (Physical::BOOLEAN, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        fields.push(field(&column.name, physical, Repetition::OPTIONAL, logical)?);
    }
    fields.push(field("cause", Physical::BYTE_ARRAY, Repetition::OPTIONAL, Some(LogicalType::String))?);
    Type::group_type_builder("study").with_fields(fields).build().map(Arc::new)
}

fn field(
    name: &str,
    physical: Physical,
    repetition: Repetition,
    logical: Option<LogicalType>,
) -> Result<Arc<Type>, ParquetError> {
    let builder = Type::primitive_type_builder(name, physical).with_repetition(repetition);
    builder.with_logical_type(logical).build().map(Arc::new)
}

/// Encodings of the columns: what repeats in a dictionary, the numbers of runs by their differences, all else as it is.
pub fn properties(declaration: &Declaration) -> Arc<WriterProperties> {
    let kept = KeyValue::new(KEY.to_owned(), declaration.to_json());
    let column = |name: &str| ColumnPath::from(name.to_owned());
    let mut builder = WriterProperties::builder()
        .set_key_value_metadata(Some(vec![kept]))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_dictionary_enabled(false)
        .set_max_row_group_row_count(None)
        .set_column_encoding(column("run"), Encoding::DELTA_BINARY_PACKED);
    let few = declaration.parameters.iter().filter(|parameter| parameter.distribution.has_few_values());
    let repeated = few.map(|parameter| parameter.name.as_str());
    let words = declaration.columns.iter().filter(|column| column.kind == Kind::Text);
    for name in repeated.chain(words.map(|column| column.name.as_str())).chain(["seed", "cause"]) {
        builder = builder.set_column_dictionary_enabled(column(name), true);
    }
    Arc::new(builder.build())
}
