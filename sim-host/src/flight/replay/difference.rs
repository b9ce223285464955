//! Where a replay first differs from its record.

use std::fmt;

use serde::Serialize;
use serde_json::Value;
use shared::commands::Commands;

use super::conversation::Tick;
use crate::flight::{TICK_S, record::BadFrame};

/// The commands of one tick that replay to others.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The tick.
    pub tick: u32,
    /// Offset of the recorded commands' frame in the log.
    pub at_byte: u64,
    /// Every field that differs.
    pub fields: Vec<FieldDifference>,
}

/// A field of [`Commands`] with its two values, in its own units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldDifference {
    /// Its name, or the path to it.
    pub field: String,
    /// What was recorded.
    pub recorded: Value,
    /// What the controller commands now.
    pub replayed: Value,
}

impl Difference {
    pub(super) fn between(tick: u32, recorded: &Tick, replayed: &Commands) -> Result<Self, BadFrame> {
        let at_byte = recorded.at_byte;
        // Field by field under their own names; that integers and words have no JSON does not happen.
        let value = |commands: &Commands| {
            serde_json::to_value(commands).map_err(|error| BadFrame { at_byte, what: error.to_string() })
        };
        let mut fields = Vec::new();
        compare("", &value(&recorded.commands)?, &value(replayed)?, &mut fields);
        Ok(Self { tick, at_byte, fields })
    }
}

fn compare(path: &str, recorded: &Value, replayed: &Value, fields: &mut Vec<FieldDifference>) {
    match (recorded, replayed) {
        (Value::Object(theirs), Value::Object(ours)) if theirs.keys().eq(ours.keys()) => {
            for ((name, theirs), ours) in theirs.iter().zip(ours.values()) {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                compare(&path, theirs, ours, fields);
            }
        }
        _ if recorded == replayed => {}
        _ => fields.push(FieldDifference {
            field: path.to_owned(),
            recorded: recorded.clone(),
            replayed: replayed.clone(),
        }),
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: tick {} ({} s): ", self.at_byte, self.tick, f64::from(self.tick) * TICK_S)?;
        for (index, FieldDifference { field, recorded, replayed }) in self.fields.iter().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}`{field}` was {recorded} and replays as {replayed}")?;
        }
        Ok(())
    }
}
