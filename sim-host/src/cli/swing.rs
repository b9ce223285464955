//! `glider swing`: the compass on the pier, and the section `[compass]` that corrects it.

use std::{io::Write, path::PathBuf};

use crate::files::whole_file;
use crate::flight::{FlyingVehicle, faults_file::FaultsFile};
use crate::model::vehicle::Vehicle;
use crate::studies::swing::{section, swing, vehicle_file};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// Path of a faults file, or the name of embedded faults: how large the compass's errors are
    #[arg(long, value_name = "FAULTS", default_value = "none")]
    faults: String,
    /// Seed of the compass and of all noise: that of the flights that it is for
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Where the vehicle file with the new section goes (default: only the section, on stdout)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let faults = FaultsFile::load(&args.faults).map_err(|error| error.to_string())?;
    let found = swing(&faults.on(FlyingVehicle::new(&vehicle)?), args.seed)?;
    let origin = format!("`glider swing` --faults {} --seed {}", args.faults, args.seed);
    let section = section(&found, &origin);
    if let Some(path) = &args.output {
        let text = Vehicle::text(&args.vehicle).map_err(|error| error.to_string())?;
        let text = vehicle_file(&text, &section)?;
        whole_file::write(path, |file| write!(file, "{text}"))?;
    }
    if args.json {
        return super::print_json(&found);
    }
    for warning in &found.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(section.trim_end())
}
