//! `glider campaign`: a mission over many seeds, the autopilot beside a classical controller.

use std::{fs, io::Write, num::NonZero, path::PathBuf, thread};

use serde::Serialize;
use shared::model::table::TrimTable;

use super::progress;
use crate::analysis::table::{Envelope, describe, generate};
use crate::files::whole_file;
use crate::flight::{FlyingVehicle, mission_file::MissionFile};
use crate::model::vehicle::Vehicle;
use crate::studies::campaign::{self, Campaign, Pilots, Tally, Water};

/// Fastest steady current that a flight may meet, m/s; a glider makes half of one.
const CURRENT_M_S: f64 = 3.0;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a mission file, or the name of an embedded mission: default, fast-50, slow-50, slow-200, slow-1000,
    /// legs, zigzag, waypoints, mooring, drift
    #[arg(default_value = "default")]
    mission: String,
    /// Path of a vehicle file, or the name of an embedded vehicle (default: the mission's)
    #[arg(long, value_name = "VEHICLE")]
    vehicle: Option<String>,
    /// Where: as `glider fly` takes it; may be given several times
    #[arg(long = "environment", value_name = "ENVIRONMENT", default_values_t = ["still".to_string()])]
    environments: Vec<String>,
    /// Vehicles to fly: seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Speed of a steady current from an unknown direction
    #[arg(long, value_name = "M_S", default_value_t = 0.0, allow_negative_numbers = true)]
    current: f64,
    /// Who flies
    #[arg(long, value_enum, default_value_t = Pilots::Both)]
    pilot: Pilots,
    /// Folder for campaign.csv and campaign.html
    #[arg(long, value_name = "DIR", default_value = "campaign")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    mission: &'a str,
    vehicle: &'a str,
    seeds: u64,
    current_m_s: f64,
    results: &'a [Tally],
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    check_current(args.current)?;
    let asked = MissionFile::load(&args.mission).map_err(|error| error.to_string())?;
    let vehicle = super::load_vehicle(args.vehicle.as_ref().unwrap_or(&asked.vehicle))?;
    let flying = FlyingVehicle::new(&vehicle)?;
    let table_bytes = generate(&vehicle, &Envelope::default())?;
    let table = TrimTable::parse(&table_bytes).map_err(|error| format!("trim table: {}", describe(&error)))?;
    let file = asked.resolve(&table).map_err(|error| error.to_string())?;
    let waters = args.environments.iter().map(|name| Water::new(name, args.pilot, &vehicle, &table, &file));
    let waters = waters.collect::<Result<Vec<_>, _>>()?;
    file.check_energy(&flying, &table).map_err(|error| error.to_string())?;
    fs::create_dir_all(&args.out).map_err(|error| format!("{}: {error}", args.out.display()))?;

    let seeds = args.seeds;
    let campaign = Campaign { vehicle: &vehicle, file: &file, waters: &waters, seeds, current_m_s: args.current };
    let bar = progress::flights(seeds * waters.iter().map(|water| water.pilots.len() as u64).sum::<u64>());
    let threads = thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let flown = campaign::run(&campaign, threads, |_| bar.inc(1))?;
    bar.finish_and_clear();

    let tallies = campaign::tallies(&flown);
    let (csv, html) = (args.out.join("campaign.csv"), args.out.join("campaign.html"));
    campaign::write_csv(&csv, &[(&args.mission, &flown)])?;
    let title = title(args, &vehicle);
    whole_file::write(&html, |out| writeln!(out, "{}", campaign::html(&title, &flown, &tallies)))?;
    if args.json {
        let (mission, vehicle) = (args.mission.as_str(), vehicle.name.as_str());
        return super::print_json(&Answer { mission, vehicle, seeds, current_m_s: args.current, results: &tallies });
    }
    super::print(&format!("{title}\n\n{}\n{}\n{}", campaign::text(&tallies), csv.display(), html.display()))
}

/// Whether a flight may meet a current of this speed.
pub(super) fn check_current(current_m_s: f64) -> Result<(), String> {
    if !(0.0..=CURRENT_M_S).contains(&current_m_s) {
        return Err(format!("--current {current_m_s}: a speed from 0 to {CURRENT_M_S} m/s"));
    }
    Ok(())
}

fn title(args: &Args, vehicle: &Vehicle) -> String {
    let current =
        if args.current > 0.0 { format!(", an unknown current of {} m/s", args.current) } else { String::new() };
    format!("{}, {}, seeds 1 to {}{current}", args.mission, vehicle.name, args.seeds)
}
