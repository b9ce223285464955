//! `glider fly`: a mission, controller in the loop.

use std::path::PathBuf;

use shared::{
    autopilot::{Autopilot, ConfigurationError},
    table::TrimTable,
};

use super::progress::Progress;
use crate::{
    flight::{FlyingVehicle, fly},
    mission_file::MissionFile,
    table::{Envelope, describe, generate},
};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a mission file, or the name of an embedded mission
    #[arg(default_value = "default")]
    mission: String,
    /// Path of a vehicle file, or the name of an embedded vehicle (default: the mission's)
    #[arg(long, value_name = "VEHICLE")]
    vehicle: Option<String>,
    /// Fly with this trim table instead of one made for the vehicle now
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Seed of all noise
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for report, record and summary
    #[arg(long, value_name = "DIR", default_value = "dive")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let file = MissionFile::load(&args.mission).map_err(|error| error.to_string())?;
    let vehicle = super::load_vehicle(args.vehicle.as_ref().unwrap_or(&file.vehicle))?;
    let flying = FlyingVehicle::new(&vehicle)?;
    let table_bytes = match &args.table {
        Some(path) => std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?,
        None => generate(&vehicle, &Envelope::default())?,
    };
    let table = TrimTable::parse(&table_bytes).and_then(|table| table.for_vehicle(vehicle.hash()));
    let table = table.map_err(|error| format!("{}: {}", table_name(args), describe(&error)))?;
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters)
        .map_err(|error| format!("{}: {}", args.mission, describe_refusal(&error)))?;
    let progress = Progress::new(&file.mission);
    let summary = fly(&flying, &file.mission, &file.start, args.seed, &mut autopilot, &mut |tick| {
        progress.show(tick);
        if std::env::var_os("TRACE").is_some() && tick.tick % 20 == 0 {
            let e = crate::plant::euler_from_quaternion(&tick.state.quaternion).map(f64::to_degrees);
            eprintln!(
                "{:7.1} {:?} yo{} z {:6.2} n {:7.1} e {:7.1} V {:.3} roll {:6.2} pitch {:6.2} head {:6.2} | r {:.3} mu {:6.1} vbd {:7.1} | tp {} th {} dr {} {}",
                tick.tick as f64 * 0.25,
                tick.commands.phase,
                tick.commands.yo,
                tick.state.position_m.z,
                tick.state.position_m.x,
                tick.state.position_m.y,
                tick.state.velocity_m_s.norm(),
                e.x,
                e.y,
                e.z,
                tick.state.r_px_m,
                tick.state.mu_rad.to_degrees(),
                tick.measurements.vbd_ul as f64 * 1e-3,
                tick.commands.target_pitch_cdeg,
                tick.commands.target_heading_cdeg,
                tick.commands.north_mm / 1000,
                tick.commands.east_mm / 1000
            );
        }
    })?;
    progress.finish();
    super::print_json(&summary)
}

fn table_name(args: &Args) -> String {
    args.table.as_ref().map_or_else(|| "trim table".into(), |path| path.display().to_string())
}

/// Why a mission cannot be flown, in one line.
fn describe_refusal(error: &ConfigurationError) -> String {
    match error {
        ConfigurationError::Mission(wrong) => {
            format!(
                "{} is {}; this vehicle and its trim table take {} to {}",
                wrong.field, wrong.value, wrong.min, wrong.max
            )
        }
        ConfigurationError::Parameter(row, value) => {
            format!("parameter {} is {value}; it goes from {} to {}", row.name, row.min, row.max)
        }
    }
}
