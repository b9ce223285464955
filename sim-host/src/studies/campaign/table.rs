//! A campaign as text, and flight by flight as CSV.

use std::{fmt::Write, path::Path};

use super::{FACTORS, Flown, METRICS, Spread, Tally};
use crate::files::whole_file;
use crate::flight::Outcome;

/// Width of the column with the names.
const NAME: usize = 24;
/// Width of a number's column.
const NUMBER: usize = 9;

/// One block per water, pilots side by side.
#[must_use]
pub fn text(tallies: &[Tally]) -> String {
    let blocks = tallies.chunk_by(|a, b| a.environment == b.environment);
    blocks.map(block).collect::<Vec<_>>().join("\n")
}

fn block(pilots: &[Tally]) -> String {
    let mut text = String::new();
    let mut row = |name: &str, cells: &mut dyn Iterator<Item = String>| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:NAME$}{}", cells.collect::<String>());
    };
    let wide = 4 * NUMBER;
    let environment = pilots.first().map_or("", |tally| tally.environment.as_str());
    row(environment, &mut pilots.iter().map(|tally| format!("{:>wide$}", tally.pilot)));
    row("completed", &mut pilots.iter().map(|tally| format!("{:>wide$}", share(tally))));
    let heads = ["p10", "median", "p90", "worst"].map(|head| format!("{head:>NUMBER$}")).concat();
    row("", &mut pilots.iter().map(|_| heads.clone()));
    for (index, metric) in METRICS.iter().enumerate() {
        row(metric.name, &mut pilots.iter().map(|tally| numbers(tally.spreads.get(index).copied().flatten())));
    }
    text
}

/// Share of completed flights.
pub(crate) fn share(tally: &Tally) -> String {
    format!("{:.1} % of {}", 100.0 * tally.completed as f64 / tally.flights as f64, tally.flights)
}

fn numbers(spread: Option<Spread>) -> String {
    cells(spread).map(|cell| format!("{cell:>NUMBER$}")).concat()
}

/// Lower tenth, median, upper tenth and worst, in three digits or so.
pub(crate) fn cells(spread: Option<Spread>) -> [String; 4] {
    let Some(Spread { p10, median, p90, worst }) = spread else { return ["", "", "", ""].map(String::from) };
    [p10, median, p90, worst].map(|value| {
        let decimals = if worst < 10.0 { 2 } else { usize::from(worst < 100.0) };
        format!("{value:.decimals$}")
    })
}

/// One row per flight of each mission: what was drawn, how it ended, its figures; empty where there is no value.
///
/// # Errors
/// The path and what went wrong, in one line.
pub fn write_csv(path: &Path, missions: &[(&str, &[Flown])]) -> Result<(), String> {
    let drawn = ["ballast_kg", "current_north_m_s", "current_east_m_s"].map(String::from);
    let factors = FACTORS.iter().map(|factor| format!("{}_factor", factor.name));
    let figures = METRICS.iter().map(|metric| metric.name.to_string());
    let names = ["mission", "environment", "pilot", "seed", "outcome", "reason"].map(String::from);
    whole_file::write(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(names.into_iter().chain(figures).chain(drawn).chain(factors))?;
        for (mission, flight) in missions.iter().flat_map(|(name, flown)| flown.iter().map(move |one| (name, one))) {
            csv.write_record(std::iter::once((*mission).to_owned()).chain(fields(flight)))?;
        }
        csv.flush()
    })
}

fn fields(flight: &Flown) -> impl Iterator<Item = String> {
    let outcome = match flight.outcome {
        Outcome::Completed => "completed",
        Outcome::Aborted => "aborted",
        Outcome::Lost => "lost",
    };
    let seed = flight.seed.to_string();
    let words = [&flight.water, flight.pilot, &seed, outcome, &flight.reason].map(String::from);
    let [north_m_s, east_m_s] = flight.drawn.current_m_s;
    let drawn = [flight.drawn.ballast_kg, north_m_s, east_m_s].into_iter().chain(flight.drawn.factors).map(Some);
    let numbers = flight.values.iter().copied().chain(drawn);
    // As many digits as it takes to read the same value back.
    words.into_iter().chain(numbers.map(|value| value.map(|value| format!("{value:?}")).unwrap_or_default()))
}
