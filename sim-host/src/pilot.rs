//! Whoever flies the simulated vehicle: the linked autopilot, or firmware at the other end of a link.

use shared::{
    autopilot::Autopilot,
    device::{Commands, Measurements},
    mission::Mission,
    parameters::Parameters,
};

use crate::{ocean::Ocean, vehicle::Water};

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
