//! One mission under way: the autopilot, the tick that comes next, and what was last said about it.

use shared::{
    autopilot::{Autopilot, ConfigurationError},
    commands::{Abort, Commands, Phase},
    device::Measurements,
    model::table::TrimTable,
    wire::{Configuration, Refusal},
};

use crate::log::log;

/// A free-running count of the core clock.
pub trait Stopwatch {
    /// The count now.
    fn now(&self) -> u32;
    /// Counts of the core clock since an earlier `now`, less than one turn of the counter ago.
    fn clocks_since(&self, start: u32) -> u32;
}

/// The autopilot with its place in time.
#[derive(Debug)]
pub struct Flight<'t> {
    autopilot: Autopilot<'t>,
    next_tick: u32,
    phase: Phase,
    abort: Option<Abort>,
}

impl<'t> Flight<'t> {
    /// Checks a configuration and makes ready for tick 0.
    ///
    /// # Errors
    /// [`Refusal::InvalidConfiguration`]; the value that is wrong is logged.
    pub fn new(table: &TrimTable<'t>, configuration: &Configuration) -> Result<Self, Refusal> {
        let mission = &configuration.mission;
        match Autopilot::new(table, mission, &configuration.parameters) {
            Ok(autopilot) => {
                log!(info, "configuration accepted: {} yos to {} mm", mission.yos, mission.dive_to_mm);
                Ok(Self { autopilot, next_tick: 0, phase: Phase::Surface, abort: None })
            }
            Err(ConfigurationError::Mission(wrong)) => {
                let (field, value) = (wrong.field, wrong.value);
                log!(warn, "configuration refused: {} is {}, not {} to {}", field, value, wrong.min, wrong.max);
                Err(Refusal::InvalidConfiguration)
            }
            Err(ConfigurationError::Parameter(row, value)) => {
                log!(warn, "configuration refused: {} is {}, not {} to {}", row.name, value, row.min, row.max);
                Err(Refusal::InvalidConfiguration)
            }
        }
    }

    /// The tick that [`Flight::step`] will fly.
    #[must_use]
    pub const fn next_tick(&self) -> u32 {
        self.next_tick
    }

    /// Flies one tick; also gives the counts of the core clock that the autopilot took.
    pub fn step(&mut self, measurements: &Measurements, stopwatch: &impl Stopwatch) -> (Commands, u32) {
        let start = stopwatch.now();
        let commands = self.autopilot.step(self.next_tick, measurements);
        let clocks = stopwatch.clocks_since(start);
        self.tell_changes(&commands);
        self.next_tick = self.next_tick.saturating_add(1);
        (commands, clocks)
    }

    fn tell_changes(&mut self, commands: &Commands) {
        let tick = self.next_tick;
        if let Some(abort) = commands.abort
            && self.abort.is_none()
        {
            log!(warn, "tick {}: abort, {:?}", tick, abort);
        }
        if commands.phase != self.phase {
            log!(info, "tick {}: {:?}, yo {}", tick, commands.phase, commands.yo);
        }
        (self.abort, self.phase) = (commands.abort, commands.phase);
    }
}
