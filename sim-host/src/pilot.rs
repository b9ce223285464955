//! Whoever flies the simulated vehicle: the linked autopilot, or firmware at the other end of a link.

use shared::{
    autopilot::Autopilot,
    device::{Commands, Measurements},
};

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
