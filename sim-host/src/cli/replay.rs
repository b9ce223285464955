//! `glider replay`: a recorded flight once more, by its measurements alone.

use std::{
    fs::{self, File},
    io::BufReader,
    path::PathBuf,
};

use shared::model::table::TrimTable;

use crate::analysis::table::describe;
use crate::flight::replay::{Replay, replay};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Log of a flight: `flight.frames` of the folder that `glider fly` wrote, or what went over the link to firmware
    log: PathBuf,
    /// The trim table that flew it (default: the log's name with `.table`)
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let log = args.log.display();
    let file = File::open(&args.log).map_err(|error| format!("{log}: {error}"))?;
    let table = args.table.clone().unwrap_or_else(|| args.log.with_extension("table"));
    let bytes = fs::read(&table)
        .map_err(|error| format!("{}: {error}; --table names the trim table that flew it", table.display()))?;
    let table = TrimTable::parse(&bytes).map_err(|error| format!("{}: {}", table.display(), describe(&error)))?;
    let replayed = replay(BufReader::new(file), &table).map_err(|error| format!("{log}: {error}"))?;
    if args.json {
        super::print_json(&replayed)?;
    }
    match &replayed.difference {
        Some(difference) => Err(format!("{log}: {difference}")),
        None if args.json => Ok(()),
        None => super::print(&describe_replay(args, &replayed)),
    }
}

fn describe_replay(args: &Args, replayed: &Replay) -> String {
    let Replay { ticks, board, build, trace_hash, .. } = replayed;
    format!(
        "{}: {ticks} ticks replay to the same commands\nflown by {board}, build {build}; trace {trace_hash}",
        args.log.display()
    )
}
