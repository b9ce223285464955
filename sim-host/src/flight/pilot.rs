//! Whoever flies the simulated vehicle: the linked autopilot, or firmware at the other end of a link.

use shared::{
    autopilot::{Autopilot, ConfigurationError},
    commands::Commands,
    device::Measurements,
    mission::Mission,
    model::table::TrimTable,
    parameters::Parameters,
};

use crate::files::toml_file::FileError;
use crate::flight::{FlyingVehicle, mission_file::MissionFile};
use crate::model::{ocean::Ocean, vehicle::Water};

/// Answers one tick of measurements with commands.
pub trait Pilot {
    /// Flies one tick; ticks count from 0 at 4 Hz.
    ///
    /// # Errors
    /// What kept the answer from coming, in one line: a link that broke, a firmware that refused.
    fn step(&mut self, tick: u32, measurements: &Measurements) -> Result<Commands, String>;
}

impl Pilot for Autopilot<'_> {
    fn step(&mut self, tick: u32, measurements: &Measurements) -> Result<Commands, String> {
        Ok(Autopilot::step(self, tick, measurements))
    }
}

/// The tuning, with the water's mean density down to the dive's depth where it names none: pilots look at a chart.
#[must_use]
pub fn briefed(parameters: &Parameters, mission: &Mission, ocean: &Ocean, water: &Water) -> Parameters {
    if parameters.water_density_kg_m3 > 0 {
        return *parameters;
    }
    let density_kg_m3 = ocean.mean_density_kg_m3(f64::from(mission.dive_to_mm) / 1e3, water.gravity_m_s2);
    Parameters { water_density_kg_m3: density_kg_m3.round() as i32, ..*parameters }
}

/// The mission as this vehicle flies it, briefed with the chart, and the autopilot that will.
///
/// # Errors
/// One line with what of the mission cannot be flown.
pub fn ready<'a>(
    asked: MissionFile,
    flying: &FlyingVehicle<'_>,
    table: &TrimTable<'a>,
    ocean: &Ocean,
) -> Result<(MissionFile, Autopilot<'a>), String> {
    let mut file = asked.resolve(table).map_err(|error| error.to_string())?;
    file.parameters = briefed(&file.parameters, &file.mission, ocean, &flying.vehicle.water);
    let autopilot = autopilot(table, &file, &file.parameters)?;
    file.check_energy(flying, table).map_err(|error| error.to_string())?;
    Ok((file, autopilot))
}

/// An autopilot for a mission.
///
/// # Errors
/// One line: what cannot be flown, by its name and place in the mission file.
pub fn autopilot<'a>(
    table: &TrimTable<'a>,
    file: &MissionFile,
    parameters: &Parameters,
) -> Result<Autopilot<'a>, String> {
    Autopilot::new(table, &file.mission, parameters).map_err(|error| refusal(file, &error).to_string())
}

/// Why a mission cannot be flown, in the mission file's own names and units.
fn refusal(file: &MissionFile, error: &ConfigurationError) -> FileError {
    let (key, value, min, max) = match error {
        ConfigurationError::Mission(wrong) => {
            let (key, scale) = in_file(wrong.field);
            let [value, min, max] = [wrong.value, wrong.min, wrong.max].map(|integer| f64::from(integer) / scale);
            (format!("mission.{key}"), value, min, max)
        }
        ConfigurationError::Parameter(row, value) => {
            (format!("parameters.{}", row.name), f64::from(*value), f64::from(row.min), f64::from(row.max))
        }
    };
    file.mistake(&key, format!("`{key}` is {value}, but this vehicle and its trim table take {min} to {max}"))
}

/// Key of the mission file for a field of the mission, and how many of the field's units make one of the file's.
fn in_file(field: &str) -> (String, f64) {
    for (ours, theirs, scale) in
        [("_mm", "_m", 1e3), ("_cdeg", "_deg", 1e2), ("_cdeg_s", "_deg_s", 1e2), ("_g", "_kg", 1e3)]
    {
        if let Some(stem) = field.strip_suffix(ours) {
            return (format!("{stem}{theirs}"), scale);
        }
    }
    (field.into(), 1.0)
}
