//! The record as CSV: one line per tick, empty where there is no value.

use std::path::Path;

use super::{COLUMNS, Record, Value};
use crate::files::whole_file;

impl Record {
    /// Writes the record as CSV; numbers in as many digits as it takes to read the same value back.
    ///
    /// # Errors
    /// The path and what went wrong, in one line.
    pub fn write_csv(&self, path: &Path) -> Result<(), String> {
        whole_file::write(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            csv.write_record(COLUMNS.iter().map(|column| column.name))?;
            for sample in &self.samples {
                csv.write_record(COLUMNS.iter().map(|column| match column.value {
                    Value::Integer(get) => get(sample).map(|value| value.to_string()).unwrap_or_default(),
                    Value::Real(get) => {
                        let value = get(self, sample).filter(|value| value.is_finite());
                        value.map(|value| format!("{value:?}")).unwrap_or_default()
                    }
                    Value::Text(get) => get(sample).unwrap_or_default(),
                }))?;
            }
            csv.flush()
        })
    }
}
