//! The sea trials of the autopilot: what it promises, beside what many flights and its models come to.
//!
//! Every embedded mission is flown in water at rest, stratified and sheared, by the autopilot and by the classical
//! controller on the same seeds. A [`Claim`] that does not hold stays in the list, with its number.

mod claims;
mod example;
mod learning;
mod models;
mod page;
mod pictures;
mod promises;

use std::{num::NonZero, path::Path};

use serde::Serialize;

pub use claims::{Claim, Limit};
pub use promises::{Measure, PROMISES, Promise, Quantile, judge};

use shared::model::table::TrimTable;

use crate::analysis::{
    margins,
    table::{Envelope, describe, generate},
};
use crate::flight::{FlyingVehicle, mission_file::MissionFile};
use crate::model::vehicle::Vehicle;
use crate::pages::chart::Figure;
use crate::studies::campaign::{self, Campaign, Flown, Pilots, Tally, Water};

/// A mission and where it is flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Its name in tables and of its files.
    pub name: &'static str,
    /// An embedded mission.
    pub mission: &'static str,
    /// How often it surfaces, where that is not what its file says.
    pub surfacings: Option<u16>,
    /// Embedded environments that are deep enough for it.
    pub waters: &'static [&'static str],
    /// Speed of a steady current, besides those of the water, from a direction that nobody knows, m/s.
    pub current_m_s: f64,
}

/// At rest, stratified, sheared: for a hull that does not give way, as slocum-paper's.
const WATERS: &[&str] = &["still", "temperate", "tropical"];
/// The same for a hull that gives way, which nobody can ballast for water of one density.
const COMPRESSED: &[&str] = &["calm", "temperate", "tropical"];
/// Where 1000 m are deep enough.
const DEEP: &[&str] = &["calm", "tropical"];

const fn trial(mission: &'static str, waters: &'static [&'static str]) -> Trial {
    Trial { name: mission, mission, surfacings: None, waters, current_m_s: 0.0 }
}

/// In a current that nobody knows, half as fast as the vehicle.
const fn in_current(name: &'static str, mission: &'static str, surfacings: Option<u16>) -> Trial {
    Trial { name, mission, surfacings, waters: &["still"], current_m_s: 0.2 }
}

/// Everything that is flown.
pub const TRIALS: [Trial; 8] = [
    trial("default", WATERS),
    trial("fast-50", WATERS),
    trial("slow-50", COMPRESSED),
    trial("slow-200", COMPRESSED),
    trial("slow-1000", DEEP),
    in_current("legs", "legs", None),
    in_current("turn", "zigzag", Some(2)),
    in_current("zigzag", "zigzag", None),
];

/// What came of the trials.
#[derive(Clone, Debug)]
pub struct Trials {
    /// Seeds 1 to this one.
    pub seeds: u64,
    /// The flights of each.
    pub flights: Vec<Flights>,
    /// What was promised, and what is so.
    pub claims: Vec<Claim>,
    /// The controller's loops in each mission's glides.
    pub margins: Vec<GlideMargins>,
    /// Single flights, and what is known before one.
    pub pictures: Vec<Picture>,
}

/// A figure with a name for its file and a line that says what it shows.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its file, without extension.
    pub name: String,
    /// What it shows.
    pub about: String,
    /// The figure.
    pub figure: Figure,
}

/// All flights of a trial.
#[derive(Clone, Debug, Serialize)]
pub struct Flights {
    /// The trial's name.
    pub name: &'static str,
    /// Its mission.
    pub mission: &'static str,
    /// The vehicle's name.
    pub vehicle: String,
    /// Speed of the unknown current, m/s.
    pub current_m_s: f64,
    /// Every flight.
    #[serde(skip)]
    pub flown: Vec<Flown>,
    /// Their spreads, water by water and pilot by pilot.
    pub results: Vec<Tally>,
}

/// The margins at one glide of a mission.
#[derive(Clone, Debug, Serialize)]
pub struct GlideMargins {
    /// The mission.
    pub mission: &'static str,
    /// Of which glide.
    #[serde(flatten)]
    pub node: margins::Node,
}

/// A mission with all that it takes to fly it.
struct Equipped {
    trial: Trial,
    file: MissionFile,
    vehicle: Vehicle,
    table: Vec<u8>,
}

/// Number of flights that these trials take.
#[must_use]
pub fn count(trials: &[Trial], seeds: u64) -> u64 {
    trials.iter().map(|trial| 2 * seeds * trial.waters.len() as u64).sum()
}

/// Flies the trials and checks the models; `landed` hears of each flight that is over.
///
/// # Errors
/// What keeps a vehicle from flying, in one line.
pub fn run(
    trials: &[Trial],
    seeds: u64,
    threads: NonZero<usize>,
    mut landed: impl FnMut(&Flown),
) -> Result<Trials, String> {
    let equipped = trials.iter().map(Equipped::new).collect::<Result<Vec<_>, _>>()?;
    let models::Checked { claims: of_models, margins, envelopes } = models::check(&equipped, threads)?;
    let pictures = pictures::draw(&equipped, seeds, threads, &envelopes)?;
    let fly = |trial: &Equipped| {
        let flown = trial.with_campaign(seeds, |campaign| campaign::run(campaign, threads, &mut landed))?;
        let Trial { name, mission, current_m_s, .. } = trial.trial;
        let results = campaign::tallies(&flown);
        Ok(Flights { name, mission, vehicle: trial.vehicle.name.clone(), current_m_s, flown, results })
    };
    let flights = equipped.iter().map(fly).collect::<Result<Vec<_>, String>>()?;
    let of_flights = PROMISES.iter().filter_map(|promise| judge(promise, &flights));
    let claims = of_flights.chain(of_models).collect();
    Ok(Trials { seeds, flights, claims, margins, pictures })
}

impl Equipped {
    fn new(trial: &Trial) -> Result<Self, String> {
        let asked = MissionFile::load(trial.mission).map_err(|error| error.to_string())?;
        let vehicle = Vehicle::load(&asked.vehicle).map_err(|error| error.to_string())?;
        FlyingVehicle::new(&vehicle)?;
        let table = generate(&vehicle, &Envelope::default())?;
        let mut file = asked.resolve(&parsed(&table)?).map_err(|error| error.to_string())?;
        file.mission.surfacings = trial.surfacings.unwrap_or(file.mission.surfacings);
        Ok(Self { trial: *trial, file, vehicle, table })
    }

    fn table(&self) -> Result<TrimTable<'_>, String> {
        parsed(&self.table)
    }

    fn with_campaign<T>(&self, seeds: u64, act: impl FnOnce(&Campaign<'_>) -> Result<T, String>) -> Result<T, String> {
        let (vehicle, file, table) = (&self.vehicle, &self.file, self.table()?);
        let waters = self.trial.waters.iter().map(|name| Water::new(name, Pilots::Both, vehicle, &table, file));
        let waters = waters.collect::<Result<Vec<_>, _>>()?;
        act(&Campaign { vehicle, file, waters: &waters, seeds, current_m_s: self.trial.current_m_s })
    }
}

fn parsed(table: &[u8]) -> Result<TrimTable<'_>, String> {
    TrimTable::parse(table).map_err(|error| format!("trim table: {}", describe(&error)))
}

impl Trials {
    /// trials.md, trials.html, the figures, and trials.csv with every flight, into a folder.
    ///
    /// # Errors
    /// One line that names the file that could not be written.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        page::document(self).write(folder, "trials")?;
        let flown: Vec<(&str, &[Flown])> = self.flights.iter().map(|trial| (trial.name, &trial.flown[..])).collect();
        campaign::write_csv(&folder.join("trials.csv"), &flown)
    }

    /// The claims as lines of text, what does not hold first.
    #[must_use]
    pub fn in_words(&self) -> String {
        let mut claims: Vec<&Claim> = self.claims.iter().collect();
        claims.sort_by_key(|claim| claim.holds);
        let line = |claim: &Claim| {
            let Claim { what, limit, over, place, .. } = claim;
            let measured = claim.measured.map_or_else(|| "none".into(), page::in_digits);
            format!("{:<14}{what}: {measured} ({limit}; {over}; {place})", claim.verdict())
        };
        let lines = claims.into_iter().map(line);
        std::iter::once(page::in_short(&self.claims)).chain(lines).collect::<Vec<_>>().join("\n")
    }
}
