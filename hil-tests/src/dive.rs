//! Dives on the real plant, by the linked autopilot or by firmware beside it.

use shared::{
    autopilot::Autopilot, commands::Commands, device::Measurements, model::table::TrimTable, wire::Configuration,
};
use sim_host::{
    flight::{FlyingVehicle, Summary, fly, link::FirmwarePilot, mission_file::MissionFile, pilot::Pilot},
    model::{ocean::Ocean, vehicle::Vehicle},
};

const SEED: u64 = 1;

/// A mission, the vehicle that flies it, and the table that the firmware embeds.
#[derive(Debug)]
pub struct Dive {
    vehicle: Vehicle,
    file: MissionFile,
    table: TrimTable<'static>,
}

impl Dive {
    /// The embedded default mission.
    #[must_use]
    pub fn standard() -> Self {
        let file = MissionFile::load("default").expect("the default mission");
        let vehicle = Vehicle::load(&file.vehicle).expect("its vehicle");
        let table = TrimTable::parse(firmware::TRIM_TABLE).expect("the embedded table");
        Self { vehicle, file, table }
    }

    /// One yo to 8 m, begun at once: every phase but the crest in a few hundred ticks.
    #[must_use]
    pub fn short() -> Self {
        let mut dive = Self::standard();
        dive.file.mission.yos = 1;
        dive.file.mission.dive_to_mm = 8_000;
        dive.file.mission.climb_to_mm = 3_000;
        dive.file.mission.surface_time_s = 0;
        dive
    }

    /// What the firmware must be told.
    #[must_use]
    pub fn configuration(&self) -> Configuration {
        Configuration { mission: self.file.mission.clone(), parameters: self.file.parameters }
    }

    /// The table that flies.
    #[must_use]
    pub const fn table(&self) -> &TrimTable<'static> {
        &self.table
    }

    /// Fingerprint of the vehicle.
    #[must_use]
    pub fn vehicle_hash(&self) -> u64 {
        self.vehicle.hash()
    }

    /// The controller, linked into this process.
    #[must_use]
    pub fn autopilot(&self) -> Autopilot<'static> {
        Autopilot::new(&self.table, &self.file.mission, &self.file.parameters).expect("a mission that can be flown")
    }

    /// Flies it.
    ///
    /// # Errors
    /// What the pilot said when it failed to answer.
    pub fn fly(&self, pilot: &mut dyn Pilot) -> Result<Summary, String> {
        let flying = FlyingVehicle::new(&self.vehicle)?;
        let ocean = Ocean::still(&self.vehicle.water);
        fly(&flying, &ocean, &self.file.mission, &self.file.start, SEED, pilot, &mut |_| {})
    }
}

/// Firmware that flies, and the linked autopilot that is given the same measurements.
#[derive(Debug)]
pub struct Twins {
    /// Whose commands are obeyed.
    pub firmware: FirmwarePilot,
    /// Who must say the same.
    pub linked: Autopilot<'static>,
}

impl Pilot for Twins {
    /// The firmware's commands; an error at the first tick at which the two differ.
    fn step(&mut self, tick: u32, measurements: &Measurements) -> Result<Commands, String> {
        let firmware = self.firmware.step(tick, measurements)?;
        let linked = self.linked.step(tick, measurements);
        if firmware == linked {
            return Ok(firmware);
        }
        Err(format!("tick {tick}: the firmware commands {firmware:?}, the linked autopilot {linked:?}"))
    }
}
