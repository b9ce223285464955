//! `glider fly`: a mission, controller in the loop.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use serde::Serialize;
use shared::{model::table::TrimTable, wire::Configuration};

use super::progress::Progress;
use crate::analysis::table::{Envelope, describe, generate};
use crate::files::whole_file;
use crate::flight::{
    FlyingVehicle, Summary,
    faults_file::FaultsFile,
    fly,
    mission_file::MissionFile,
    pilot::ready,
    record::{Record, Sample},
};
use crate::model::ocean::Ocean;
use crate::pages::report::{self, Flight};
use crate::studies::campaign::Drawn;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a mission file, or the name of an embedded mission
    #[arg(default_value = "default")]
    mission: String,
    /// Path of a vehicle file, or the name of an embedded vehicle (default: the mission's)
    #[arg(long, value_name = "VEHICLE")]
    vehicle: Option<String>,
    /// Path of an environment file or of a CTD cast (.csv), or the name of an embedded environment: still, calm,
    /// tropical, temperate, polar, baltic
    #[arg(long, value_name = "ENVIRONMENT", default_value = "still")]
    environment: String,
    /// Fly with this trim table instead of one made for the vehicle now
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Seed of all noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Path of a faults file, or the name of embedded faults: none, leak, dead-pressure, compass-deviation, altimeter-dropout,
    /// weak-battery, stuck-pump. What goes wrong, and how large the errors of the instruments are
    #[arg(long, value_name = "FAULTS", default_value = "none")]
    faults: String,
    /// Folder for report, record, summary, and the frames and trim table that `glider replay` takes
    #[arg(long, value_name = "DIR", default_value = "dive")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

/// What came of it, and what was made to go wrong.
#[derive(Serialize)]
struct Answer<'a> {
    faults: &'a str,
    #[serde(flatten)]
    summary: &'a Summary,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let asked = MissionFile::load(&args.mission).map_err(|error| error.to_string())?;
    let vehicle = super::load_vehicle(args.vehicle.as_ref().unwrap_or(&asked.vehicle))?;
    let faults = FaultsFile::load(&args.faults).map_err(|error| error.to_string())?;
    let flying = faults.on(FlyingVehicle::new(&vehicle)?);
    let ocean = Ocean::load(&args.environment, &vehicle.water).map_err(|error| error.to_string())?;
    let table_bytes = match &args.table {
        Some(path) => fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?,
        None => generate(&vehicle, &Envelope::default())?,
    };
    let table = TrimTable::parse(&table_bytes).and_then(|table| table.for_vehicle(vehicle.hash()));
    let table = table.map_err(|error| format!("{}: {}", table_name(args), describe(&error)))?;
    let (file, mut autopilot) = ready(asked, &flying, &table, &ocean)?;
    let ocean = Drawn::nominal().ocean(&ocean, &vehicle, f64::from(file.mission.dive_to_mm) / 1e3);
    fs::create_dir_all(&args.out).map_err(|error| format!("{}: {error}", args.out.display()))?;

    let progress = Progress::new(&file.mission);
    let mut record = Record { start: file.start, water: vehicle.water.clone(), samples: Vec::new() };
    let summary = fly(&flying, &ocean, &file.mission, &file.start, args.seed, &mut autopilot, &mut |tick| {
        progress.show(tick);
        record.samples.push(Sample::from(tick));
    })?;
    progress.finish();

    let flight = Flight { vehicle: &vehicle, mission: &file.mission, record: &record, summary: &summary };
    let answer = Answer { faults: &args.faults, summary: &summary };
    write_folder(&args.out, &flight, &answer)?;
    let configuration = Configuration { mission: file.mission.clone(), parameters: file.parameters };
    record.write_frames(&args.out.join("flight.frames"), vehicle.hash(), &configuration)?;
    whole_file::write(&args.out.join("flight.table"), |file| file.write_all(&table_bytes))?;
    if args.json { super::print_json(&answer) } else { super::print(&describe_flight(args, &summary)) }
}

/// Report, record and summary of a flight, in one folder.
fn write_folder(out: &Path, flight: &Flight<'_>, answer: &Answer<'_>) -> Result<(), String> {
    flight.record.write_csv(&out.join("record.csv"))?;
    flight.record.write_parquet(&out.join("record.parquet"))?;
    whole_file::write(&out.join("report.html"), |file| writeln!(file, "{}", report::html(flight)))?;
    whole_file::write(&out.join("picture.svg"), |file| writeln!(file, "{}", report::picture(flight)))?;
    whole_file::write(&out.join("summary.json"), |file| {
        serde_json::to_writer_pretty(&mut *file, answer)?;
        writeln!(file)
    })
}

fn describe_flight(args: &Args, summary: &Summary) -> String {
    let energy = &summary.energy_j;
    let loss = summary.loss.map(|loss| format!("{loss:?}"));
    let reasons: Vec<_> = summary.aborts.iter().cloned().chain(loss).collect();
    let reasons = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join(", ")) };
    let mut lines = vec![
        format!(
            "{:?}{reasons} after {:.1} min, {:.1} m deep",
            summary.outcome,
            summary.duration_s / 60.0,
            summary.max_depth_m
        ),
        format!(
            "energy {:.1} kJ: pump {:.1}, pitch {:.2}, roll {:.2}, hotel {:.1}",
            energy.total() / 1e3,
            energy.pump / 1e3,
            energy.pitch / 1e3,
            energy.roll / 1e3,
            energy.hotel / 1e3
        ),
    ];
    if let (Some(predicted), Some(actual)) = (summary.surfacing.predicted, summary.surfacing.actual) {
        let miss_m = (predicted.north_m - actual.north_m).hypot(predicted.east_m - actual.east_m);
        let made_good_m = actual.north_m.hypot(actual.east_m);
        lines.push(format!("surfaced {miss_m:.0} m from where it expected, {made_good_m:.0} m from its start"));
    }
    lines.push(format!("{:.0} times faster than real time; trace {}", summary.real_time_factor, summary.trace_hash));
    lines.push(format!("report: {}", args.out.join("report.html").display()));
    lines.join("\n")
}

fn table_name(args: &Args) -> String {
    args.table.as_ref().map_or_else(|| "trim table".into(), |path| path.display().to_string())
}
