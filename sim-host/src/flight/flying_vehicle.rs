//! A vehicle with what flying takes: its devices, their errors, and their faults.

use super::{Cells, Faults, SensorErrors};
use crate::model::vehicle::{Buoyancy, Energy, Limits, Vehicle};

/// A vehicle that has all it takes to fly.
#[derive(Clone, Debug)]
pub struct FlyingVehicle<'a> {
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// Its buoyancy engine.
    pub buoyancy: &'a Buoyancy,
    /// Its electrical loads.
    pub energy: &'a Energy,
    /// Its limits.
    pub limits: &'a Limits,
    /// How its battery gives way.
    pub cells: Cells,
    /// How large the errors of its instruments are.
    pub sensor_errors: SensorErrors,
    /// What goes wrong.
    pub faults: Faults,
}

impl<'a> FlyingVehicle<'a> {
    /// Checks that the vehicle file has the sections that flying needs; sound devices with the usual errors.
    ///
    /// # Errors
    /// One line that names the missing section.
    pub fn new(vehicle: &'a Vehicle) -> Result<Self, String> {
        let lacks = |section: &str| format!("{}: flying needs the section [{section}]", vehicle.name);
        Ok(Self {
            vehicle,
            buoyancy: vehicle.buoyancy.as_ref().ok_or_else(|| lacks("buoyancy"))?,
            energy: vehicle.energy.as_ref().ok_or_else(|| lacks("energy"))?,
            limits: vehicle.limits.as_ref().ok_or_else(|| lacks("limits"))?,
            cells: Cells::default(),
            sensor_errors: SensorErrors::default(),
            faults: Faults::default(),
        })
    }
}
