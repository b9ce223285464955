//! `glider trials`: the evidence that the autopilot can be trusted.

use std::{fs, num::NonZero, path::PathBuf, thread};

use serde::Serialize;

use super::progress;
use crate::studies::trials::{self, Claim, Flights, GlideMargins, TRIALS};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Vehicles to fly in each water: seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seeds: u64,
    /// Folder for trials.md, trials.html, trials.csv and the figures
    #[arg(short, long, value_name = "DIR", default_value = "trials")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    seeds: u64,
    claims: &'a [Claim],
    trials: &'a [Flights],
    margins: &'a [GlideMargins],
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    // Before the flights: they take minutes.
    fs::create_dir_all(&args.out).map_err(|error| format!("{}: {error}", args.out.display()))?;
    let bar = progress::flights(trials::count(&TRIALS, args.seeds));
    let threads = thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let trials = trials::run(&TRIALS, args.seeds, threads, |_| bar.inc(1))?;
    bar.finish_and_clear();
    trials.write(&args.out)?;
    if args.json {
        let (claims, margins) = (&trials.claims, &trials.margins);
        return super::print_json(&Answer { seeds: args.seeds, claims, trials: &trials.flights, margins });
    }
    super::print(&format!("{}\n{}", trials.in_words(), args.out.join("trials.md").display()))
}
