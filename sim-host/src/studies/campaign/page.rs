//! A campaign as one HTML page that needs nothing else.

use maud::{Markup, PreEscaped, html};

use super::{
    Flown, METRICS, Tally,
    statistics::{parties, quantile, sorted, values},
    table::{cells, share},
};
use crate::pages::{
    chart::{Figure, Line, Panel, Scale, Stroke},
    page::{STYLE, page},
};

/// Figures that are drawn.
const DRAWN: [&str; 8] = [
    "apogee_over_percent",
    "apogee_under_percent",
    "heading_rms_deg",
    "turn_settling_s",
    "energy_j_per_km",
    "surfacing_error_percent",
    "pitch_moves_per_km",
    "roll_moves_per_km",
];
/// Axes end at this quantile of the widest spread: one stray flight shall not squeeze all others.
const SHOWN: f64 = 0.98;

const ABOUT: &str = "Each seed is a vehicle that differs a little from its file: coefficients by up to 10 %, damping by up \
    to 20 %, ballast by up to 30 g, a compass that deviates by 2° rms. Every pilot flies the same seeds. The figures are \
    over the flights that completed the mission; less is better in all of them.";

/// The page; `title` says what was flown.
#[must_use]
pub fn html(title: &str, flown: &[Flown], tallies: &[Tally]) -> String {
    let body = html! {
                h1 { (title) }
                p { (ABOUT) }
                div.scroll { (PreEscaped(distributions("Share of flights below a value", flown).svg())) }
                @for pilots in tallies.chunk_by(|a, b| a.environment == b.environment) { (table(pilots)) }
                dl { @for metric in METRICS { dt { (metric.name) } dd { (metric.about) } } }
    };
    page(title, STYLE, &body)
}

fn table(pilots: &[Tally]) -> Markup {
    html! {
        table {
            caption { (pilots.first().map_or("", |tally| tally.environment.as_str())) }
            thead {
                tr { th {} @for tally in pilots { th colspan="4" { (tally.pilot) ", " (share(tally)) " completed" } } }
                tr { th {} @for _ in pilots { th { "p10" } th { "median" } th { "p90" } th { "worst" } } }
            }
            tbody {
                @for (index, metric) in METRICS.iter().enumerate() {
                    tr {
                        th { (metric.name) }
                        @for tally in pilots {
                            @for cell in cells(tally.spreads.get(index).copied().flatten()) { td { (cell) } }
                        }
                    }
                }
            }
        }
    }
}

/// Share of flights below each value: a panel per figure, a colour per water, a stroke per pilot.
#[must_use]
pub fn distributions(title: &str, flown: &[Flown]) -> Figure {
    let drawn = METRICS.iter().enumerate().filter(|(_, metric)| DRAWN.contains(&metric.name));
    let panels = drawn.map(|(index, metric)| panel(flown, index, metric.name)).collect();
    Figure { title: title.into(), columns: 2, panels }
}

fn panel(flown: &[Flown], metric: usize, name: &str) -> Panel {
    let mut lines = Vec::new();
    let mut waters: Vec<&str> = Vec::new();
    let mut most: f64 = 0.0;
    for party in parties(flown) {
        let Some(first) = party.first() else { continue };
        let sorted = sorted(values(party, metric));
        if waters.last() != Some(&first.water.as_str()) {
            waters.push(&first.water);
        }
        let colour = waters.len() - 1;
        most = most.max(if sorted.is_empty() { 0.0 } else { quantile(&sorted, SHOWN) });
        lines.push(Line {
            name: Some(format!("{}, {}", first.pilot, first.water)),
            stroke: if first.pilot == "baseline" { Stroke::Dashed(colour) } else { Stroke::Solid(colour) },
            points: shares(&sorted),
        });
    }
    Panel {
        title: name.replace('_', " "),
        x: Scale::exactly(name, [0.0, if most > 0.0 { 1.05 * most } else { 1.0 }]),
        y: Scale::exactly("share of flights, %", [0.0, 100.0]),
        lines,
        places: Vec::new(),
    }
}

/// A cumulative distribution, at every hundredth of the flights.
fn shares(sorted: &[f64]) -> Vec<[f64; 2]> {
    if sorted.is_empty() {
        return Vec::new();
    }
    (0..=100).map(f64::from).map(|percent| [quantile(sorted, percent / 100.0), percent]).collect()
}
