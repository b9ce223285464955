//! The record as Parquet: one row per tick, null where there is no value; the meaning of each column among the metadata.

use std::{io, path::Path, sync::Arc};

use parquet::{
    basic::{LogicalType, Repetition, Type as Physical},
    column::writer::ColumnWriterImpl,
    data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type},
    errors::ParquetError,
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        writer::{SerializedColumnWriter, SerializedFileWriter},
    },
    schema::types::{Type, TypePtr},
};

use super::{COLUMNS, Column, Record, Value};
use crate::files::whole_file;

impl Record {
    /// Writes the record as Parquet.
    ///
    /// # Errors
    /// The path and what went wrong, in one line.
    pub fn write_parquet(&self, path: &Path) -> Result<(), String> {
        whole_file::write(path, |file| {
            let metadata =
                COLUMNS.iter().map(|column| KeyValue::new(column.name.into(), column.about.to_owned())).collect();
            let properties = WriterProperties::builder().set_key_value_metadata(Some(metadata)).build();
            let mut parquet = SerializedFileWriter::new(file, schema()?, Arc::new(properties))?;
            let mut rows = parquet.next_row_group()?;
            for column in COLUMNS {
                let mut writer = rows.next_column()?.ok_or_else(|| io::Error::other("fewer columns than names"))?;
                self.write_column(column, &mut writer)?;
                writer.close()?;
            }
            rows.close()?;
            parquet.close()?;
            Ok(())
        })
    }

    fn write_column(&self, column: &Column, writer: &mut SerializedColumnWriter<'_>) -> Result<(), ParquetError> {
        match column.value {
            Value::Integer(get) => write(writer.typed::<Int64Type>(), self.samples.iter().map(get)),
            Value::Real(get) => {
                let finite = |sample| get(self, sample).filter(|value| value.is_finite());
                write(writer.typed::<DoubleType>(), self.samples.iter().map(finite))
            }
            Value::Text(get) => {
                let bytes = |sample| get(sample).map(|text| ByteArray::from(text.into_bytes()));
                write(writer.typed::<ByteArrayType>(), self.samples.iter().map(bytes))
            }
        }
    }
}

fn write<T: DataType>(
    writer: &mut ColumnWriterImpl<'_, T>,
    values: impl Iterator<Item = Option<T::T>> + Clone,
) -> Result<(), ParquetError> {
    let present: Vec<i16> = values.clone().map(|value| i16::from(value.is_some())).collect();
    let values: Vec<T::T> = values.flatten().collect();
    writer.write_batch(&values, Some(&present), None)?;
    Ok(())
}

fn schema() -> Result<TypePtr, ParquetError> {
    let fields: Result<Vec<_>, ParquetError> = COLUMNS
        .iter()
        .map(|column| {
            let (physical, logical) = match column.value {
                Value::Integer(_) => (Physical::INT64, None),
                Value::Real(_) => (Physical::DOUBLE, None),
                Value::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            };
            let builder = Type::primitive_type_builder(column.name, physical).with_logical_type(logical);
            Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).build()?))
        })
        .collect();
    Ok(Arc::new(Type::group_type_builder("flight").with_fields(fields?).build()?))
}
