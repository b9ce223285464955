//! What came of a flight.

use serde::Serialize;
use sha2::{Digest, Sha256};
use shared::{
    commands::{Abort, Commands, Phase},
    device::{MM_PER_M, TICK_HZ},
};

use super::{EnergyUsed, TICK_S, Tick, actuators::Actuators, closed_loop::LINGER_S};
use crate::flight::mission_file::{M_PER_DEG, Start};

/// How a flight ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// At the surface, mission flown.
    Completed,
    /// At the surface, mission ended early.
    Aborted,
    /// It did not come back.
    Lost,
}

/// Why a vehicle did not come back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Loss {
    /// Its centre of buoyancy reached the sea floor: this model has no contact, and counts the vehicle as stuck.
    Grounded,
    /// Deeper than the hull bears.
    Crushed,
    /// Not back long after its mission's time was up.
    Overdue,
}

/// A place relative to the start, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NorthEast {
    /// North, m.
    pub north_m: f64,
    /// East, m.
    pub east_m: f64,
}

impl NorthEast {
    /// Latitude, and longitude from −180 to below 180, deg; as the controller reckons, on a sphere.
    #[must_use]
    pub fn latitude_longitude_deg(&self, start: &Start) -> [f64; 2] {
        let latitude_deg = start.latitude_deg + self.north_m / M_PER_DEG;
        let east_deg = self.east_m / (M_PER_DEG * libm::cos(start.latitude_deg.to_radians()));
        [latitude_deg, (start.longitude_deg + east_deg + 180.0).rem_euclid(360.0) - 180.0]
    }
}

/// Where the vehicle came up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Surfacing {
    /// By its own dead reckoning, before the first position fix after the dive.
    pub predicted: Option<NorthEast>,
    /// In truth, at the same time.
    pub actual: Option<NorthEast>,
}

/// What came of a flight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// How it ended.
    pub outcome: Outcome,
    /// Why it did not come back, if it did not.
    pub loss: Option<Loss>,
    /// From the start to the end, s.
    pub duration_s: f64,
    /// Deepest place of the centre of buoyancy, m.
    pub max_depth_m: f64,
    /// Ticks flown.
    pub ticks: u32,
    /// Electrical energy used, J.
    pub energy_j: EnergyUsed,
    /// Ideal work p ΔV of the pump, J: over `energy_j.pump`, the efficiency of the buoyancy engine.
    pub pump_work_j: f64,
    /// Charge drawn from the battery, as a coulomb counter sees it, C.
    pub charge_c: f64,
    /// Where it came up.
    pub surfacing: Surfacing,
    /// Reasons for which the mission ended early.
    pub aborts: Vec<String>,
    /// Time that the loop took, s.
    pub wall_s: f64,
    /// Simulated over real time of the loop.
    pub real_time_factor: f64,
    /// SHA-256 of all commands as encoded on the wire.
    pub trace_hash: String,
}

impl Summary {
    /// Why it did not come back or ended early; empty if neither.
    #[must_use]
    pub fn reason(&self) -> String {
        let loss = self.loss.map(|loss| format!("{loss:?}"));
        loss.into_iter().chain(self.aborts.iter().cloned()).collect::<Vec<_>>().join(" ")
    }
}

/// Whether a phase belongs to the end of a flight.
fn is_over(phase: Phase) -> Option<Outcome> {
    match phase {
        Phase::Complete => Some(Outcome::Completed),
        Phase::Recovery => Some(Outcome::Aborted),
        Phase::Surface
        | Phase::Dive
        | Phase::Drift
        | Phase::Apogee
        | Phase::Climb
        | Phase::Crest
        | Phase::Surfacing => None,
    }
}

/// Gathers the summary tick by tick.
pub(super) struct Log {
    ticks: u32,
    max_depth_m: f64,
    dived: bool,
    /// A position was fixed after the dive.
    fixed: bool,
    surfacing: Surfacing,
    abort: Option<Abort>,
    trace: TraceHash,
    phase: Phase,
    over_ticks: u32,
}

impl Log {
    pub(super) fn new() -> Self {
        Self {
            ticks: 0,
            max_depth_m: 0.0,
            dived: false,
            fixed: false,
            surfacing: Surfacing { predicted: None, actual: None },
            abort: None,
            trace: TraceHash::default(),
            phase: Phase::Surface,
            over_ticks: 0,
        }
    }

    pub(super) fn take(&mut self, tick: &Tick<'_>) {
        let (commands, position) = (tick.commands, &tick.state.position_m);
        self.ticks += 1;
        self.max_depth_m = self.max_depth_m.max(position.z);
        self.dived |= commands.phase == Phase::Dive;
        self.fixed |= is_over(commands.phase).is_some() && tick.measurements.gps.is_some();
        if self.dived && !self.fixed {
            let metres = |mm: i32| f64::from(mm) / f64::from(MM_PER_M);
            self.surfacing = Surfacing {
                predicted: Some(NorthEast { north_m: metres(commands.north_mm), east_m: metres(commands.east_mm) }),
                actual: Some(NorthEast { north_m: position.x, east_m: position.y }),
            };
        }
        self.abort = commands.abort;
        self.trace.take(commands);
        self.phase = commands.phase;
    }

    /// How the flight ended, once it has been over, antenna clear, for long enough.
    pub(super) fn ended(&mut self, antenna_is_clear: bool) -> Option<super::Outcome> {
        let over = is_over(self.phase).filter(|_| antenna_is_clear)?;
        self.over_ticks += 1;
        (self.over_ticks >= LINGER_S * TICK_HZ).then_some(over)
    }

    pub(super) fn summary(self, outcome: Result<Outcome, Loss>, actuators: &Actuators<'_>, wall_s: f64) -> Summary {
        let duration_s = f64::from(self.ticks) * TICK_S;
        Summary {
            outcome: outcome.unwrap_or(Outcome::Lost),
            loss: outcome.err(),
            duration_s,
            max_depth_m: self.max_depth_m,
            ticks: self.ticks,
            energy_j: actuators.used,
            pump_work_j: actuators.pump_work_j,
            charge_c: actuators.battery.charge_c(),
            surfacing: self.surfacing,
            aborts: self.abort.iter().map(|abort| format!("{abort:?}")).collect(),
            wall_s,
            real_time_factor: duration_s / wall_s,
            trace_hash: self.trace.finish(),
        }
    }
}

/// SHA-256 over commands as they are encoded on the wire.
#[derive(Clone, Debug, Default)]
pub struct TraceHash(Sha256);

impl TraceHash {
    /// Takes the commands of one tick.
    pub fn take(&mut self, commands: &Commands) {
        let mut bytes = [0; shared::wire::MAX_FRAME];
        let encoded = postcard::to_slice(commands, &mut bytes).map_or(&[][..], |used| &*used);
        self.0.update(encoded);
    }

    /// The hash, in hexadecimal.
    #[must_use]
    pub fn finish(self) -> String {
        self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
