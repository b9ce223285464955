//! Printed values beside ours.

use maud::{Markup, html};
use serde::Serialize;

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

/// All comparisons, as Markdown.
#[must_use]
pub fn markdown(rows: &[Row], trends: &[Trend]) -> String {
    let mut lines = vec![
        "# Fan & Woolsey (2013), side by side".to_owned(),
        String::new(),
        summary(rows, trends),
        String::new(),
        "| where | quantity | printed | ours | difference | digits | remark |".to_owned(),
        "|---|---|---:|---:|---:|---|---|".to_owned(),
    ];
    lines.extend(rows.iter().map(|row| {
        let Row { place, quantity, printed, ours, difference, remark, .. } = row;
        format!("| {place} | {quantity} | {printed} | {ours} | {difference:+.2e} | {} | {remark} |", digits(row))
    }));
    lines.extend(
        [
            "",
            "## What the paper says of trends",
            "",
            "| where | statement | reading | holds | found |",
            "|---|---|---|---|---|",
        ]
        .map(str::to_owned),
    );
    for trend in trends {
        for reading in &trend.readings {
            let Reading { reading, holds, found } = reading;
            lines.push(format!("| {} | {} | {reading} | {} | {found} |", trend.place, trend.says, yes(*holds)));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// The same as tables of a page.
#[must_use]
pub fn tables(rows: &[Row], trends: &[Trend]) -> Markup {
    html! {
        p { (summary(rows, trends)) }
        table {
            thead { tr { th { "where" } th { "quantity" } th.number { "printed" } th.number { "ours" } th.number { "difference" } th { "digits" } th { "remark" } } }
            tbody {
                @for row in rows {
                    tr.missed[!row.reproduced] {
                        td { (row.place) } td { (row.quantity) }
                        td.number { (row.printed) } td.number { (row.ours) } td.number { (format!("{:+.2e}", row.difference)) }
                        td { (digits(row)) } td { (row.remark) }
                    }
                }
            }
        }
        h2 { "What the paper says of trends" }
        table {
            thead { tr { th { "where" } th { "statement" } th { "reading" } th { "holds" } th { "found" } } }
            tbody {
                @for trend in trends {
                    @for reading in &trend.readings {
                        tr.missed[!reading.holds] {
                            td { (trend.place) } td { (trend.says) } td { (reading.reading) }
                            td { (yes(reading.holds)) } td { (reading.found) }
                        }
                    }
                }
            }
        }
    }
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

fn digits(row: &Row) -> &'static str {
    if row.reproduced { "all" } else { "not all" }
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
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
