//! Printed values beside ours.

use serde::Serialize;

use crate::pages::document::{self, Block, Column, Table};

/// One printed value and ours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Where it stands in the paper.
    pub place: String,
    /// What it is, with its unit.
    pub quantity: String,
    /// As printed.
    pub printed: String,
    /// Ours, to the printed digits.
    pub ours: String,
    /// Ours minus printed, unrounded.
    pub difference: f64,
    /// Whether the printed digits are reproduced.
    pub reproduced: bool,
    /// Why not, or what to know of it.
    pub remark: String,
}

impl Row {
    /// Compares our value with a printed number, digit by digit.
    #[must_use]
    pub fn new(place: &str, quantity: &str, printed: &str, ours: f64, remark: &str) -> Self {
        let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let rounded = format!("{ours:.decimals$}");
        let value = printed.parse::<f64>().unwrap_or(f64::NAN);
        let half_digit = 0.5 * 10_f64.powi(-i32::try_from(decimals).unwrap_or(0));
        Self {
            place: place.into(),
            quantity: quantity.into(),
            printed: printed.into(),
            // The printed digits, however the last one is rounded.
            reproduced: (ours - value).abs() <= half_digit * (1.0 + 1e-9),
            ours: rounded,
            difference: ours - value,
            remark: remark.into(),
        }
    }
}

/// A statement of the paper about how things change, and what we find.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trend {
    /// Where it stands in the paper.
    pub place: String,
    /// What it says.
    pub says: String,
    /// How it was read, and what was found for that reading.
    pub readings: Vec<Reading>,
}

/// One way to read a statement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// What was held and varied.
    pub reading: String,
    /// Whether the statement holds.
    pub holds: bool,
    /// In numbers.
    pub found: String,
}

/// All comparisons.
pub(super) fn blocks(rows: &[Row], trends: &[Trend]) -> Vec<Block> {
    vec![
        Block::Text(summary(rows, trends)),
        Block::Table(values(rows)),
        Block::Heading("What the paper says of trends".into()),
        Block::Table(readings(trends)),
    ]
}

fn values(rows: &[Row]) -> Table {
    let row = |row: &Row| {
        let Row { place, quantity, printed, ours, difference, reproduced, remark } = row;
        let numbers = [printed, ours].map(String::clone).into_iter().chain([format!("{difference:+.2e}")]);
        let cells = [place, quantity].map(String::clone).into_iter().chain(numbers);
        let cells = cells.chain([remark.clone(), if *reproduced { "all" } else { "not all" }.into()]);
        document::Row { cells: cells.collect(), missed: !reproduced }
    };
    let numbers = ["printed", "ours", "difference"].map(|name| Column::Number(name.into()));
    let columns = ["where", "quantity"].map(words).into_iter().chain(numbers).chain(["remark", "digits"].map(words));
    Table { columns: columns.collect(), rows: rows.iter().map(row).collect() }
}

fn readings(trends: &[Trend]) -> Table {
    let row = |trend: &Trend, reading: &Reading| {
        let Reading { reading, holds, found } = reading;
        let verdict = if *holds { "yes" } else { "no" };
        let cells = [trend.place.as_str(), &trend.says, reading, found, verdict].map(str::to_owned);
        document::Row { cells: cells.into(), missed: !holds }
    };
    let rows = trends.iter().flat_map(|trend| trend.readings.iter().map(move |reading| row(trend, reading)));
    Table { columns: ["where", "statement", "reading", "found", "holds"].map(words).into(), rows: rows.collect() }
}

fn words(name: &str) -> Column {
    Column::Words(name.into())
}

fn summary(rows: &[Row], trends: &[Trend]) -> String {
    let reproduced = rows.iter().filter(|row| row.reproduced).count();
    let held = trends.iter().filter(|trend| trend.readings.iter().any(|reading| reading.holds)).count();
    format!(
        "{reproduced} of {} printed values are reproduced to their digits; {held} of {} stated trends hold in at least one reading.",
        rows.len(),
        trends.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_digits_decide() {
        let row = |printed, ours| Row::new("5.1", "x", printed, ours, "");
        assert!(row("0.2826", 0.282_64).reproduced);
        assert!(!row("0.2130", 0.212_93).reproduced);
        assert!(row("-0.85", -0.8544).reproduced);
        assert!(!row("-3.28", -3.2903).reproduced);
        assert_eq!(row("8", 8.0003).ours, "8");
    }
}
