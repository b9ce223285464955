//! Judges a controller over many flights, with vehicles, instruments and currents that nobody knows exactly.
//!
//! A seed stands for one vehicle on one day: its coefficients, ballast and current ([`Drawn`]) and all errors of
//! its instruments. Every pilot flies the same seeds in every water, so that they can be compared flight by flight. A flight
//! depends on its seed alone, not on how many fly at a time.

mod crew;
mod draw;
mod metrics;
mod page;
mod statistics;
mod table;

use std::num::NonZero;

pub use crew::{Flyer, Pilots, Water};
pub use draw::{Drawn, FACTORS};
pub use metrics::{METRICS, Metric, Seen};
pub use page::{distributions, html};
pub use statistics::{Spread, Tally, tallies};
pub(crate) use statistics::{parties, quantile, sorted};
pub(crate) use table::{cells, share};
pub use table::{text, write_csv};

use crate::flight::{
    FlyingVehicle, Outcome, SensorErrors, Summary, Tick, fly,
    mission_file::MissionFile,
    pilot::Pilot,
    record::{Record, Sample},
};
use crate::model::{ocean::Ocean, vehicle::Vehicle};
use crate::parallel;

/// Deviation that a compass keeps after calibration, constant over a flight, deg rms.
const COMPASS_DEVIATION_DEG: f64 = 2.0;

/// Many flights of one mission.
#[derive(Clone, Debug)]
pub struct Campaign<'a> {
    /// The vehicle as its file says; each seed flies one a little different.
    pub vehicle: &'a Vehicle,
    /// What is flown.
    pub file: &'a MissionFile,
    /// Where, and who flies there.
    pub waters: &'a [Water<'a>],
    /// Seeds 1 to this one.
    pub seeds: u64,
    /// Speed of a steady current from an unknown direction, m/s.
    pub current_m_s: f64,
}

/// What one flight came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Flown {
    /// Name of the water.
    pub water: String,
    /// Name of the pilot.
    pub pilot: &'static str,
    /// Its seed.
    pub seed: u64,
    /// What the seed drew.
    pub drawn: Drawn,
    /// How it ended.
    pub outcome: Outcome,
    /// Why it ended early or did not come back; empty if neither.
    pub reason: String,
    /// In the order of [`METRICS`]; nothing where a flight did not come to it.
    pub values: Vec<Option<f64>>,
}

impl Flown {
    /// A figure by its name; nothing if there is none, or the flight did not come to it.
    #[must_use]
    pub fn value(&self, metric: &str) -> Option<f64> {
        let index = METRICS.iter().position(|known| known.name == metric)?;
        self.values.get(index).copied().flatten()
    }
}

/// Flies all waters, pilots and seeds, in this order, on some threads; `landed` hears of each flight that is over.
///
/// # Errors
/// What keeps the vehicle from flying, in one line.
pub fn run(campaign: &Campaign<'_>, threads: NonZero<usize>, landed: impl FnMut(&Flown)) -> Result<Vec<Flown>, String> {
    let waters = campaign.waters.iter();
    let parties = waters.flat_map(|water| water.pilots.iter().map(move |pilot| (water, pilot)));
    let flights: Vec<_> = parties.flat_map(|party| (1..=campaign.seeds).map(move |seed| (party, seed))).collect();
    let fly = |index: usize| {
        let ((water, pilot), seed) = flights[index];
        fly_one(campaign, water, pilot, seed)
    };
    parallel::in_order(flights.len(), threads, fly, landed)
}

/// One flight; its record is measured and dropped.
fn fly_one(campaign: &Campaign<'_>, water: &Water<'_>, flyer: &Flyer<'_>, seed: u64) -> Result<Flown, String> {
    let (record, summary) = recorded(campaign, water, flyer, seed)?;
    let seen = Seen { mission: &campaign.file.mission, record: &record, summary: &summary };
    Ok(Flown {
        water: water.name.clone(),
        pilot: flyer.name(),
        seed,
        drawn: Drawn::new(seed, campaign.current_m_s),
        outcome: summary.outcome,
        reason: summary.reason(),
        values: METRICS.iter().map(|metric| (metric.of)(&seen)).collect(),
    })
}

/// One flight with its record.
///
/// # Errors
/// What keeps the vehicle from flying, in one line.
pub(crate) fn recorded(
    campaign: &Campaign<'_>,
    water: &Water<'_>,
    flyer: &Flyer<'_>,
    seed: u64,
) -> Result<(Record, Summary), String> {
    let start = campaign.file.start;
    let mut record = Record { start, water: campaign.vehicle.water.clone(), samples: Vec::new() };
    let flight = DrawnFlight {
        nominal: campaign.vehicle,
        charted: &water.ocean,
        file: campaign.file,
        drawn: &Drawn::new(seed, campaign.current_m_s),
        seed,
        sensor_errors: sensor_errors(),
    };
    let summary = flight.fly(flyer.fresh().as_mut(), &mut |tick| record.samples.push(Sample::from(tick)))?;
    Ok((record, summary))
}

/// A flight of the vehicle, in the water and with the instruments that a seed drew.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DrawnFlight<'a> {
    /// The vehicle of the file.
    pub(crate) nominal: &'a Vehicle,
    /// The water as it is charted.
    pub(crate) charted: &'a Ocean,
    /// What is flown.
    pub(crate) file: &'a MissionFile,
    /// What is different about vehicle and water.
    pub(crate) drawn: &'a Drawn,
    /// Seed of all errors of the instruments.
    pub(crate) seed: u64,
    /// How large these are.
    pub(crate) sensor_errors: SensorErrors,
}

impl DrawnFlight<'_> {
    /// Flies it; `observe` sees every tick.
    ///
    /// # Errors
    /// What keeps the vehicle from flying, in one line.
    pub(crate) fn fly(&self, pilot: &mut dyn Pilot, observe: &mut dyn FnMut(&Tick<'_>)) -> Result<Summary, String> {
        let MissionFile { mission, start, .. } = self.file;
        let vehicle = self.drawn.vehicle(self.nominal);
        let ocean = self.drawn.ocean(self.charted, self.nominal, f64::from(mission.dive_to_mm) / 1e3);
        let flying = FlyingVehicle { sensor_errors: self.sensor_errors, ..FlyingVehicle::new(&vehicle)? };
        fly(&flying, &ocean, mission, start, self.seed, pilot, observe)
    }
}

/// The usual instruments, but for the compass: it deviates more.
pub(crate) fn sensor_errors() -> SensorErrors {
    let mut errors = SensorErrors::default();
    errors.compass.heading_bias_deg = COMPASS_DEVIATION_DEG;
    errors
}
