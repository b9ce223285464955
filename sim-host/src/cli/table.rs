//! `glider table`: from a vehicle file to the table that the firmware embeds.

use std::{io::Write, path::PathBuf};

use serde::Serialize;
use shared::model::table::TrimTable;

use super::envelope::EnvelopeArgs;
use crate::analysis::table::{InterpolationError, TableErrors, describe, generate, measure};
use crate::files::whole_file;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// Where the table goes
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    envelope: EnvelopeArgs,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer {
    bytes: usize,
    vehicle_hash: String,
    interpolation_error: TableErrors,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let file = generate(&vehicle, &args.envelope.envelope()?)?;
    let table = TrimTable::parse(&file).map_err(|error| describe(&error))?;
    let errors = measure(&vehicle, &table)?;
    whole_file::write(&args.output, |out| out.write_all(&file))?;
    if args.json {
        let vehicle_hash = format!("{:016x}", table.vehicle().hash);
        return super::print_json(&Answer { bytes: file.len(), vehicle_hash, interpolation_error: errors });
    }
    let side = |name: &str, error: &InterpolationError| {
        format!(
            "  {name}: speed {:.3} %, turn rate {:.2} %, pitch {:.3}°, angle of attack {:.3}°, r_px {:.2} mm",
            100.0 * error.speed,
            100.0 * error.turn_rate,
            error.pitch_rad.to_degrees(),
            error.alpha_rad.to_degrees(),
            1e3 * error.r_px_m
        )
    };
    super::print(&format!(
        "{}: {} bytes for {} ({:016x})\nlargest interpolation error against exact trim, in the middle of every cell\n{}\n{}",
        args.output.display(),
        file.len(),
        vehicle.name,
        table.vehicle().hash,
        side("dives", &errors.dive),
        side("climbs", &errors.climb)
    ))
}
