//! `glider paper`: every figure and table of the paper, drawn anew.

use std::path::PathBuf;

use serde::Serialize;

use crate::analysis::paper::{
    VEHICLE,
    comparison::{Row, Trend},
    reproduce,
};
use crate::model::vehicle::Vehicle;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Folder for figures, data and comparison
    #[arg(long, value_name = "DIR", default_value = "paper")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    values: &'a [Row],
    trends: &'a [Trend],
    figures: Vec<&'a str>,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle: Vehicle = super::load_vehicle(VEHICLE)?;
    let all = reproduce(&vehicle)?;
    all.write(&args.out)?;
    if args.json {
        let figures = all.figures.iter().map(|(name, _)| name.as_str()).collect();
        return super::print_json(&Answer { values: &all.rows, trends: &all.trends, figures });
    }
    let reproduced = all.rows.iter().filter(|row| row.reproduced).count();
    let mut lines = vec![format!("{reproduced} of {} printed values to their digits; the others:", all.rows.len())];
    lines.extend(
        all.rows
            .iter()
            .filter(|row| !row.reproduced)
            .map(|row| format!("  {} {}: {} for {}: {}", row.place, row.quantity, row.ours, row.printed, row.remark)),
    );
    lines.push("Trends that hold in no reading:".to_owned());
    let missed = all.trends.iter().filter(|trend| !trend.readings.iter().any(|reading| reading.holds));
    lines.extend(missed.map(|trend| format!("  {}: {}", trend.place, trend.says)));
    lines.push(format!("{} figures, comparison.html and comparison.md: {}", all.figures.len(), args.out.display()));
    super::print(&lines.join("\n"))
}
