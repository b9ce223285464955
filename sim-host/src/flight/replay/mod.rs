//! A recorded flight once more: does the controller command what it commanded?
//!
//! It sees nothing but measurements, and both sides are integers, so every bit must be the same: on another host, and for
//! a flight that firmware flew. A changed controller shows the first tick at which it would have flown otherwise.

mod conversation;
mod difference;

use std::io::BufRead;

use serde::Serialize;
use shared::{
    autopilot::{Autopilot, ConfigurationError},
    model::table::TrimTable,
};

pub use difference::{Difference, FieldDifference};

use crate::flight::{TraceHash, record::BadFrame};
use conversation::Conversation;

/// What came of a replay.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// Whether every command was the same.
    pub same: bool,
    /// Ticks whose commands were the same, from the first on.
    pub ticks: u32,
    /// Fingerprint of the vehicle, in hexadecimal.
    pub vehicle_hash: String,
    /// Board that flew it; `host` for the linked controller.
    pub board: String,
    /// Build that flew it.
    pub build: String,
    /// SHA-256 of the replayed commands as encoded on the wire; for a whole flight, the one of its summary.
    pub trace_hash: String,
    /// The first tick whose commands differ, if there is one.
    pub difference: Option<Difference>,
}

/// Steps the controller through the measurements of a log, up to the first tick whose commands differ.
///
/// A log that ends between two ticks is the log of a shorter flight.
///
/// # Errors
/// Anything but the frames of one flight of this table's vehicle: what, and where in the log.
pub fn replay(log: impl BufRead, table: &TrimTable<'_>) -> Result<Replay, BadFrame> {
    let mut log = Conversation::new(log);
    let hello = log.hello(table)?;
    let (at_byte, told) = log.configuration()?;
    let autopilot = Autopilot::new(table, &told.mission, &told.parameters);
    let mut autopilot = autopilot.map_err(|error| BadFrame { at_byte, what: unflyable(&error) })?;
    log.acceptance()?;
    let mut trace = TraceHash::default();
    let (mut ticks, mut difference) = (0, None);
    while difference.is_none()
        && let Some(recorded) = log.tick(ticks)?
    {
        let commands = autopilot.step(ticks, &recorded.measurements);
        trace.take(&commands);
        if commands == recorded.commands {
            ticks += 1;
        } else {
            difference = Some(Difference::between(ticks, &recorded, &commands)?);
        }
    }
    Ok(Replay {
        same: difference.is_none(),
        ticks,
        vehicle_hash: format!("{:016x}", hello.vehicle_hash),
        board: hello.board.as_str().into(),
        build: hello.build.as_str().into(),
        trace_hash: trace.finish(),
        difference,
    })
}

/// Whoever flew it took this configuration, so the table is another one.
fn unflyable(error: &ConfigurationError) -> String {
    let (name, value, min, max) = match error {
        ConfigurationError::Mission(wrong) => (format!("mission.{}", wrong.field), wrong.value, wrong.min, wrong.max),
        ConfigurationError::Parameter(row, value) => (format!("parameters.{}", row.name), *value, row.min, row.max),
    };
    format!("configuration: `{name}` is {value}, but this trim table takes {min} to {max}; it was flown with another")
}
